// SPDX-License-Identifier: MIT
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Surfaces that move, in physics steps of 20 ms or in frames, several of which a step lasts.</summary>
    [TestFixture]
    public class MoverTests : PlayerSuite
    {
        const float Speed = 0.02f; // m/s over a ridge a mm: 20 Hz

        /// <summary>The share of frames in which the speed is felt to within a tenth.</summary>
        double FeltEvenly(KnurlDevice d, Mover mover)
        {
            Until(() => d.InContact, "pressed");
            float begin = Time.time;
            Until(() => Time.time > begin + 1f, "it has moved for a second");
            int frames = 0, even = 0;
            while (Time.time < begin + 2f)
            {
                Player.Frames(1);
                frames++;
                even += Mathf.Abs(d.TemporalFrequency - 1000f * Speed) < 100f * Speed ? 1 : 0;
            }
            Assert.That(mover.Count, Is.GreaterThan(20));
            return even / (double)frames;
        }

        /// <summary>Without interpolation a body's objects count as moved in steps until they are seen to be moved in
        /// frames: by a tween, an animation, a hand in VR.</summary>
        [TestCase(true, true)]
        [TestCase(true, false)]
        [TestCase(false, true)]
        [TestCase(false, false)]
        public void WhatMovesEvenlyIsFeltEvenly(bool hasBody, bool isMovedInSteps)
        {
            KnurlSurface s = MakeSurface(Plate());
            Transform root = MakeObject("Root").transform;
            if (hasBody)
            {
                root.gameObject.AddComponent<Rigidbody>();
            }
            s.transform.SetParent(root, false);
            KnurlDevice d = StartPressing();
            Mover mover = root.gameObject.AddComponent<Mover>();
            mover.IsInSteps = isMovedInSteps;
            // 0.21 by the wrong clock; a busy machine's frames are late. Exact in virtual time: test_session_clock.
            Assert.That(FeltEvenly(d, mover), Is.GreaterThan(0.7));
        }

        sealed class Mover : MonoBehaviour
        {
            internal bool IsInSteps;
            internal int Count;

            void FixedUpdate()
            {
                Move(IsInSteps, Time.fixedDeltaTime);
            }

            void Update()
            {
                Move(!IsInSteps, Time.deltaTime);
            }

            void Move(bool isDue, float seconds)
            {
                if (isDue)
                {
                    transform.position += new Vector3(Speed * seconds, 0f, 0f);
                    Count++;
                }
            }
        }
    }
}
