// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    /// <summary>Plays what the <see cref="KnurlDevice"/> of its object feels, see <see cref="KnurlDevice.Sound"/>, by the
    /// AudioSource beside it, which says how loud, from where and to which mixer group. All channels get the same, added to
    /// what the source plays itself.</summary>
    [AddComponentMenu("Knurl/Knurl Sound")]
    [RequireComponent(typeof(AudioSource))]
    [DisallowMultipleComponent]
    public sealed class KnurlSound : MonoBehaviour
    {
        [NonSerialized] volatile SoundHandle sound; // read by the audio thread

        internal void Play(SessionHandle session)
        {
            sound = SoundHandle.Of(session, AudioSettings.outputSampleRate);
            GetComponent<AudioSource>().Play();
        }

        internal void Stop()
        {
            SoundHandle old = sound;
            sound = null;
            if (old != null)
            {
                old.Dispose(); // given back when the audio thread is out of it
            }
        }

        void OnDestroy()
        {
            Stop();
        }

        /// <summary>On the audio thread. No memory is allocated.</summary>
        unsafe void OnAudioFilterRead(float[] data, int channels)
        {
            const int most = 256;
            float* mono = stackalloc float[most];
            SoundHandle from = sound;
            int frames = data.Length / channels;
            for (int done = 0; from != null && done < frames; done += most)
            {
                int count = Math.Min(most, frames - done);
                if (!from.Fill(mono, count))
                {
                    return;
                }
                for (int i = 0; i < count * channels; i++)
                {
                    data[done * channels + i] += mono[i / channels];
                }
            }
        }
    }
}
