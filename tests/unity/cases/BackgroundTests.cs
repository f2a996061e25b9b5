// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.Linq;
using System.Threading.Tasks;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Devices that are started, stopped and listed on another thread.</summary>
    [TestFixture]
    public class BackgroundTests : PlayerSuite
    {
        /// <summary>Mono makes threads for its pool at the first task.</summary>
        [TestFixtureSetUp]
        public void MakePool()
        {
            Task.FromResult(0).ContinueWith(done => done.Result, TaskScheduler.Default).Wait();
        }

        static double Milliseconds(Action what)
        {
            Stopwatch watch = Stopwatch.StartNew();
            what();
            return watch.Elapsed.TotalMilliseconds;
        }

        [Test]
        public void ADeviceThatIsOpenedElsewhereRunsInOneOfTheNextFrames()
        {
            MakeSmooth(Plate());
            KnurlDevice d = MakeDevice("fake", "rest");
            Task<bool> started = d.StartDeviceAsync();
            Assert.That(!d.Running && !started.IsCompleted, "only a frame goes on with it");
            Assert.AreSame(started, d.StartDeviceAsync());
            Until(() => d.Running, "it runs");
            Assert.That(started.IsCompleted && started.Result);
            Until(() => d.InContact, "it feels the surface");
            Assert.That(d.StartDeviceAsync().Result, "it runs already");
        }

        [Test]
        public void AStartElsewhereThatFailsIsTold()
        {
            KnurlDevice d = MakeDevice("nothing");
            Task<bool> started = d.StartDeviceAsync();
            ExpectError("nothing");
            Until(() => started.IsCompleted, "it has failed");
            Assert.That(!started.Result && !d.Running);
        }

        /// <summary>A failed retry goes without an error, but not a start that the game has asked for meanwhile.</summary>
        [Test]
        public void AStartDuringARetryIsTold()
        {
            KnurlDevice d = MakeDevice("nothing");
            d.Autostart = true;
            d.Retry = 1e-6f;
            ExpectError("nothing");
            Player.Frames(2); // the second tries again
            ExpectError("nothing");
            Task<bool> started = d.StartDeviceAsync();
            Until(() => started.IsCompleted, "it has failed");
            Assert.That(!started.Result);
        }

        [Test]
        public void WithoutPlayModeAStartElsewhereFailsAtOnce()
        {
            Player.ExitPlayMode();
            KnurlDevice d = MakeDevice();
            ExpectError("play mode");
            Assert.That(!d.StartDeviceAsync().Result);
        }

        [TestCase("stop")]
        [TestCase("disable")]
        [TestCase("destroy")]
        [TestCase("exit")]
        public void AStartElsewhereCanBeGivenUp(string how)
        {
            int threads = Threads();
            KnurlDevice d = MakeDevice("fake", "sweep");
            MakeSurface(Plate());
            Task<bool> started = d.StartDeviceAsync();
            if (how == "stop")
            {
                d.StopDevice();
            }
            else if (how == "disable")
            {
                d.enabled = false;
            }
            else if (how == "destroy")
            {
                UnityEngine.Object.DestroyImmediate(d.gameObject);
            }
            else
            {
                Player.ExitPlayMode();
            }
            Assert.That(started.IsCompleted && !started.Result);
            NoMoreThreadsThan(threads);
        }

        [Test]
        public void CallsThatNeedTheDeviceEarlierWait()
        {
            KnurlDevice d = MakeDevice("fake", "line");
            Task<bool> started = d.StartDeviceAsync();
            Assert.That(d.StartDevice() && started.Result);
            d.StopDevice();
            started = d.StartDeviceAsync();
            Assert.AreEqual(3, d.LoadGltf(Repository.Asset("plate_1d.glb")));
            Assert.That(d.Running && started.Result);
        }

        [Test]
        public void AStopElsewhereEndsContactsAtOnceAndClosesTheDevice()
        {
            int threads = Threads();
            MakeSmooth(Plate());
            KnurlDevice d = StartResting();
            List<string> told = Listen(d);
            Until(() => d.InContact, "in contact");
            double asynchronous = 1e9, blocking = 1e9; // the least of some: what else runs only adds
            for (int i = 0; i < 4; i++)
            {
                Task closed = null;
                asynchronous = Math.Min(asynchronous, Milliseconds(() => closed = d.StopDeviceAsync()));
                Assert.That(!d.Running && Words(told).EndsWith("ended Plate"), Words(told));
                Assert.That(closed.Wait(TimeSpan.FromSeconds(20.0)));
                NoMoreThreadsThan(threads);
                Assert.That(d.StartDevice());
                Until(() => d.InContact, "it runs again");
                blocking = Math.Min(blocking, Milliseconds(d.StopDevice));
                Assert.That(d.StartDevice());
                Until(() => d.InContact, "and again");
            }
            d.StopDevice();
            Assert.That(asynchronous, Is.LessThan(0.5 * blocking), "ms");
            Console.WriteLine("note: StopDevice blocks for {0:f1} ms, StopDeviceAsync for {1:f1} ms", blocking, asynchronous);
        }

        [Test]
        public void AStartWaitsForTheStopBeforeIt([Values(true, false)] bool isElsewhere)
        {
            MakeSmooth(Plate());
            KnurlDevice d = StartResting();
            Until(() => d.Ticks > 50, "it runs");
            Task closed = d.StopDeviceAsync();
            Task<bool> started = isElsewhere ? d.StartDeviceAsync() : Task.FromResult(d.StartDevice());
            Until(() => d.Running, "it runs again");
            Assert.That(closed.IsCompleted && started.Result);
            Until(() => d.InContact, "it feels the surface again");
        }

        [Test]
        public void ADeviceThatIsClosedElsewhereIsGoneAtTheEndOfPlayMode()
        {
            int threads = Threads();
            KnurlDevice d = StartResting();
            Task closed = d.StopDeviceAsync();
            Player.ExitPlayMode();
            KnurlDevice.StopAll(); // as the editor's part does
            Assert.That(closed.IsCompleted);
            NoMoreThreadsThan(threads);
        }

        /// <summary>They stay in the session's scene for the next run.</summary>
        [Test]
        public void SurfacesOfFilesStayAfterAStopElsewhere()
        {
            KnurlDevice d = MakeDevice("fake", "line");
            d.LoadGltf(Repository.Asset("plate_1d.glb"));
            Assert.That(d.StartDevice());
            Assert.That(d.StopDeviceAsync().IsCompleted);
            Assert.That(d.StartDevice());
            Assert.AreEqual(3L, d.GetStatus().Surfaces);
        }

        [Test]
        public void AListIsTheSameElsewhere()
        {
            string[] expected = KnurlDevice.ListDevices().Select(listing => listing.Uri).ToArray();
            CollectionAssert.AreEqual(expected, KnurlDevice.ListDevicesAsync().Result.Select(listing => listing.Uri));
            Assert.That(expected, Is.Not.Empty);
        }
    }
}
