// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>The package's cost on a game's thread per frame. Times are printed, not asserted, because machines
    /// differ, and this is mono with stand-ins, not Unity. Allocations are asserted.</summary>
    [TestFixture]
    public class CostTests : PlayerSuite
    {
        const int Surfaces = 100;
        const int Frames = 600;

        static Func<long> Allocated()
        {
            MethodInfo method = typeof(GC).GetMethod("GetAllocatedBytesForCurrentThread");
            Assert.That(method, Is.Not.Null, "mono counts what a thread allocates");
            return (Func<long>)Delegate.CreateDelegate(typeof(Func<long>), method);
        }

        static Action Message(KnurlDevice device, string name)
        {
            return (Action)Delegate.CreateDelegate(typeof(Action), device,
                typeof(KnurlDevice).GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic));
        }

        List<Transform> MakeScene()
        {
            var all = new List<Transform>();
            for (int i = 0; i < Surfaces; i++)
            {
                KnurlSurface surface = MakeSurface(Plate(0.02f));
                surface.transform.position = new Vector3(0.03f * (i % 10) - 0.15f, -0.02f, 0.03f * (i / 10) - 0.15f);
                all.Add(surface.transform);
            }
            return all;
        }

        static void Move(List<Transform> all, int moving, int frame)
        {
            for (int i = 0; i < moving; i++)
            {
                Vector3 at = all[i].position;
                at.y = -0.02f + 0.001f * Mathf.Sin(0.1f * frame);
                all[i].position = at;
            }
        }

        [TestCase(0)]
        [TestCase(10)]
        [TestCase(100)]
        public void AFramesTimeIsPrinted(int moving)
        {
            List<Transform> all = MakeScene();
            KnurlDevice device = MakeDevice("fake", "line");
            Assert.That(device.StartDevice());
            Player.Frames(5);
            Assert.AreEqual((long)Surfaces, device.GetStatus().Surfaces);
            Action update = Message(device, "Update"), late = Message(device, "LateUpdate");
            var watch = new Stopwatch();
            var times = new List<double>();
            for (int i = 0; i < Frames; i++)
            {
                Move(all, moving, i);
                watch.Reset();
                watch.Start();
                update();
                late();
                watch.Stop();
                times.Add(watch.Elapsed.TotalMilliseconds * 1000.0);
                System.Threading.Thread.Sleep(1);
            }
            times.Sort();
            Console.WriteLine("note: {0} surfaces, {1} move: median {2:f0} us, p99 {3:f0} us, max {4:f0} us a frame",
                Surfaces, moving, times[Frames / 2], times[Frames * 99 / 100], times[Frames - 1]);
        }

        [Test]
        public void NothingIsAllocatedOnceAGameRuns()
        {
            List<Transform> all = MakeScene();
            MakeSurface(Plate()).transform.position = new Vector3(0f, -0.002f, 0f);
            KnurlDevice device = MakeDevice("fake", "line");
            int faults = 0; // their sentences are text; a host that stalls brings them about
            device.fault.AddListener((code, text) => faults++);
            Assert.That(device.StartDevice());
            Action update = Message(device, "Update"), late = Message(device, "LateUpdate");
            Func<long> allocated = Allocated();
            long frames = 0, most = 0;
            var history = new float[2000];
            for (int i = 0; i < 2 * Frames; i++)
            {
                Move(all, 10, i);
                int told = faults;
                long before = allocated();
                update();
                late();
                float sum = device.Force.x + device.HipPosition.x + device.ProxyPosition.x + device.Height +
                            device.TemporalFrequency + device.Ticks + device.Overruns + device.GetHistory(history);
                bool isTouching = device.InContact || device.Touched != null || device.Running || float.IsNaN(sum);
                long more = allocated() - before;
                if (i >= Frames && faults == told) // earlier frames are warm-up
                {
                    frames += more > 0 ? 1 : 0;
                    most = Math.Max(most, more);
                }
                Assert.That(isTouching);
                System.Threading.Thread.Sleep(1);
            }
            Assert.AreEqual(0L, frames, "frames that allocate, " + most + " bytes at most");
        }

        [Test]
        public void AStrangerThatAllocatesIsNoticed()
        {
            Func<long> allocated = Allocated();
            long before = allocated();
            GC.KeepAlive(new byte[1]);
            Assert.That(allocated() - before, Is.GreaterThan(0L));
        }
    }
}
