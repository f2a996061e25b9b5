// Test-only, never shipped: sound. See Player.cs for messages.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine
{
    /// Faithful: its place among the types.
    public class AudioBehaviour : Behaviour { }

    /// Faithful: whether it plays. Not: clips, mixer groups, position.
    public sealed class AudioSource : AudioBehaviour
    {
        public bool isPlaying { get; private set; }
        public void Play() { isPlaying = true; }
    }

    /// Not: another rate than a test gives it.
    public static class AudioSettings
    {
        public static int outputSampleRate = 44100;
    }

    public static partial class Player
    {
        /// The output of an object's source and filters, chunk by chunk and with some number of channels, on any
        /// thread. The object's components are collected now.
        public static Action<float[], int> Audio(GameObject from)
        {
            AudioSource source = from.GetComponent<AudioSource>();
            var filters = new List<Action<float[], int>>();
            foreach (MonoBehaviour b in from.GetComponents<MonoBehaviour>())
            {
                MethodInfo method = Method(KindOf(b.GetType()), b.GetType(), "OnAudioFilterRead");
                if (method != null)
                {
                    filters.Add((Action<float[], int>)Delegate.CreateDelegate(typeof(Action<float[], int>), b, method));
                }
            }
            return (data, channels) =>
            {
                Array.Clear(data, 0, data.Length);
                for (int i = 0; i < filters.Count && source.isPlaying; i++)
                {
                    filters[i](data, channels);
                }
            };
        }
    }
}
