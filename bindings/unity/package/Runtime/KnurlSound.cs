// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    /// <summary>Plays the sound of its object's <see cref="KnurlDevice"/>, see <see cref="KnurlDevice.Sound"/>, through
    /// the AudioSource of the same object, which sets volume, position and mixer group. All channels get the same
    /// samples, added to those that the source plays itself.</summary>
    [AddComponentMenu("Knurl/Knurl Sound")]
    [HelpURL(Manual.Sound)]
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
                old.Dispose(); // released once the audio thread has left it
            }
        }

        void OnDestroy()
        {
            Stop();
        }

        /// <summary>Runs on the audio thread and allocates no memory.</summary>
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
