// SPDX-License-Identifier: MIT
using System;
using System.Threading;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A device's sound, requested like Unity does.</summary>
    [TestFixture]
    public class SoundTests : PlayerSuite
    {
        const int Channels = 2;

        /// <summary>The loudest of `blocks` times 10 ms at 44100 Hz, on a thread of its own.</summary>
        static float Listen(GameObject from, int blocks = 50)
        {
            float peak = 0f;
            Exception thrown = null;
            Action<float[], int> play = Player.Audio(from);
            var thread = new Thread(() =>
            {
                try
                {
                    var data = new float[441 * Channels];
                    for (int i = 0; i < blocks; i++)
                    {
                        play(data, Channels);
                        for (int k = 0; k < data.Length; k++)
                        {
                            Assert.IsFalse(float.IsNaN(data[k]) || float.IsInfinity(data[k]));
                            Assert.AreEqual(data[k - k % Channels], data[k], "all channels are the same");
                            peak = Math.Max(peak, Math.Abs(data[k]));
                        }
                        Thread.Sleep(10);
                    }
                }
                catch (Exception e)
                {
                    thrown = e;
                }
            });
            thread.Start();
            while (thread.IsAlive)
            {
                Player.Frames(1);
            }
            Assert.IsNull(thrown);
            return peak;
        }

        KnurlDevice Stroked()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake");
            d.Stroke = "line";
            d.Sound = true;
            Assert.IsTrue(d.StartDevice());
            Until(() => d.InContact && d.Velocity.magnitude > 0.05f, "on its way");
            return d;
        }

        static void IsHeard(GameObject from)
        {
            Assert.That(Listen(from), Is.GreaterThan(0.001f).And.LessThanOrEqualTo(1f));
        }

        static void IsSilent(GameObject from)
        {
            Listen(from, 60);
            Assert.AreEqual(0f, Listen(from, 5));
        }

        [Test]
        public void AStrokeIsHeardWhileItIsWanted()
        {
            KnurlDevice d = Stroked();
            Assert.IsNotNull(d.GetComponent<KnurlSound>());
            IsHeard(d.gameObject);
            d.Sound = false;
            Player.Frames(2);
            Assert.AreEqual(0f, Listen(d.gameObject, 5));
            d.Sound = true;
            Player.Frames(2);
            IsHeard(d.gameObject);
            d.StopDevice();
            Assert.AreEqual(0f, Listen(d.gameObject, 5));
            Assert.IsTrue(d.StartDevice());
            Until(() => d.InContact && d.Velocity.magnitude > 0.05f, "again");
            IsHeard(d.gameObject);
            Assert.AreEqual(1, d.GetComponents<KnurlSound>().Length);
        }

        [Test]
        public void ARestingFingerIsSilent()
        {
            MakeSurface(Plate());
            KnurlDevice d = StartPressing();
            d.Sound = true;
            Until(() => d.InContact && d.Velocity == Vector3.zero, "rests");
            IsSilent(d.gameObject);
        }

        [Test]
        public void ADeviceMayGoWhileItIsHeard()
        {
            KnurlDevice d = Stroked();
            Action<float[], int> play = Player.Audio(d.gameObject);
            bool ends = false;
            Exception thrown = null;
            var audio = new Thread(() =>
            {
                try
                {
                    var data = new float[1024 * Channels];
                    while (!ends)
                    {
                        play(data, Channels);
                    }
                }
                catch (Exception e)
                {
                    thrown = e;
                }
            });
            audio.Start();
            for (int i = 0; i < 20; i++)
            {
                d.StopDevice();
                Player.Frames(1);
                d.StartDevice();
                Player.Frames(3);
            }
            UnityEngine.Object.DestroyImmediate(d);
            Player.Frames(3);
            ends = true;
            audio.Join();
            Assert.IsNull(thrown);
        }

        [Test]
        public void ARateThatSoundDoesNotKnowIsAnError()
        {
            AudioSettings.outputSampleRate = 1000;
            try
            {
                ExpectError("Sound: sample_rate_hz: expected 8000 to 192000 Hz, found 1000");
                KnurlDevice d = Stroked();
                Assert.IsTrue(d.Running);
            }
            finally
            {
                AudioSettings.outputSampleRate = 44100;
            }
        }
    }
}
