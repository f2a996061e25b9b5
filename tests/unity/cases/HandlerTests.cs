// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>Handlers of a device's events may take any action.</summary>
    [TestFixture]
    public class HandlerTests : PlayerSuite
    {
        [Test]
        public void AHandlerMayStopItsDevice()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "rest");
            List<string> told = Listen(d);
            d.contactStarted.AddListener(s => d.StopDevice());
            Assert.That(d.StartDevice());
            Until(() => !d.Running, "stopped");
            Player.Frames(3);
            Assert.AreEqual("started Plate, ended Plate", Words(told));
        }

        [Test]
        public void AHandlerMayStartItsDeviceAgain()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "rest");
            int starts = 0;
            List<string> told = Listen(d);
            d.contactEnded.AddListener(s =>
            {
                if (!d.Running && ++starts < 3) // a handler finds a stopped device if that is the cause
                {
                    d.StartDevice();
                }
            });
            Assert.That(d.StartDevice());
            for (int i = 1; i <= 3; i++)
            {
                Until(() => d.Touched != null, "touched, round " + i);
                int count = told.Count;
                d.StopDevice();
                Assert.AreEqual(i, starts, Words(told));
                Assert.AreEqual(i < 3, d.Running, "round " + i);
                Assert.AreEqual(count + 1, told.Count, Words(told));
            }
        }

        [TestCase(false)]
        [TestCase(true)]
        public void AHandlerMayDestroyItsDevice(bool isAtOnce)
        {
            int before = Threads();
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "rest");
            d.contactStarted.AddListener(s =>
            {
                if (isAtOnce)
                {
                    Object.DestroyImmediate(d.gameObject);
                }
                else
                {
                    Object.Destroy(d.gameObject);
                }
            });
            Assert.That(d.StartDevice());
            Until(() => d == null, "destroyed");
            Player.Frames(3);
            NoMoreThreadsThan(before);
        }

        [Test]
        public void AHandlerMayDestroyTheDeviceThatIsBeingDisabled()
        {
            int before = Threads();
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            d.contactEnded.AddListener(s => Object.Destroy(d.gameObject));
            Until(() => d.Touched != null, "touched");
            d.enabled = false;
            Player.Frames(3);
            Assert.That(d == null);
            NoMoreThreadsThan(before);
        }

        [Test]
        public void AHandlerMayDestroySurfaces()
        {
            var all = new List<KnurlSurface>();
            for (int i = 0; i < 5; i++)
            {
                all.Add(MakeSurface(Plate()));
            }
            KnurlDevice d = MakeDevice("fake", "rest");
            int ended = 0;
            d.contactEnded.AddListener(s =>
            {
                ended++;
                foreach (KnurlSurface each in all)
                {
                    if (each != null)
                    {
                        Object.DestroyImmediate(each.gameObject);
                    }
                }
            });
            Assert.That(d.StartDevice());
            Until(() => d.Touched != null, "touched");
            Player.Frames(2);
            foreach (KnurlSurface s in all)
            {
                if (s != null)
                {
                    s.enabled = false;
                }
            }
            Until(() => ended > 0 && d.GetStatus().Surfaces == 0, "all are destroyed by the handler");
            Player.Frames(2);
            Assert.That(d.Running);
            Assert.AreEqual(1, ended);
        }

        [Test]
        public void AHandlerMayMakeSurfaces()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "rest");
            d.contactStarted.AddListener(s => MakeSurface(Plate()).transform.position = new Vector3(0.2f, 0f, 0f));
            Assert.That(d.StartDevice());
            Until(() => d.GetStatus().Surfaces == 2, "made");
            Player.Frames(2);
            Assert.That(d.Running);
        }

        [Test]
        public void AHandlersExceptionIsLoggedAndNothingElseIsLost()
        {
            KnurlSurface s = MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake:?press_at=0.5", "rest");
            var told = new List<string>();
            d.contactStarted.AddListener(x => { throw new InvalidOperationException("of started"); });
            d.buttonChanged.AddListener((index, isPressed) =>
            {
                told.Add("button " + isPressed);
                if (isPressed)
                {
                    throw new InvalidOperationException("of pressed");
                }
            });
            d.contactEnded.AddListener(x =>
            {
                told.Add("ended");
                throw new InvalidOperationException("of ended");
            });
            ExpectException("of started");
            ExpectException("of pressed");
            ExpectException("of ended");
            Assert.That(d.StartDevice());
            Until(() => d.Touched != null, "touched");
            Until(() => told.Count == 2, "the button's events come all the same");
            Assert.That(d.Running && d.Touched == s);
            long then = d.Ticks;
            Until(() => d.Ticks > then + 50, "frames go on");
            d.StopDevice();
            Assert.AreEqual("button True, button False, ended", Words(told));
            Assert.That(d.Running || s.IsTouched, Is.False);
            Assert.That(Debug.Lines.All(l => l.Type != LogType.Exception || ReferenceEquals(l.Context, d)),
                "with its context");
        }

        [Test]
        public void AnExceptionOfOneDevicesHandlerIsNotTheOthers()
        {
            KnurlSurface s = MakeSurface(Plate());
            KnurlDevice before = StartResting(), bad = StartResting(), after = StartResting();
            List<string> first = Listen(before), last = Listen(after);
            bad.contactEnded.AddListener(x => { throw new InvalidOperationException("of bad"); });
            Until(() => bad.Touched == s && before.Touched == s && after.Touched == s, "all");
            int told = first.Count + last.Count;
            ExpectException("of bad");
            Object.DestroyImmediate(s.gameObject);
            Assert.AreEqual(told + 2, first.Count + last.Count);
            Assert.That(before.Running && bad.Running && after.Running);
        }

        [TestCase("destroy")]
        [TestCase("quit")]
        [TestCase("play mode")]
        [TestCase("scene")]
        [TestCase("reload")]
        [TestCase("disable")]
        public void AHandlerThatStartsAgainHoldsNothingOpen(string end)
        {
            int before = Threads();
            KnurlSurface surface = MakeSurface(Plate());
            KnurlDevice d = StartResting();
            d.contactEnded.AddListener(s => d.StartDevice());
            Until(() => d.Touched == surface, "touched");
            LogAssert.ignoreFailingMessages = true; // that it cannot be started may be said
            switch (end)
            {
                case "destroy":
                    Object.DestroyImmediate(d.gameObject);
                    break;
                case "quit":
                    Player.Quit();
                    break;
                case "play mode":
                    Player.ExitPlayMode();
                    break;
                case "scene":
                    Player.LeaveScene();
                    break;
                case "reload":
                    Player.ReloadAssemblies();
                    break;
                default:
                    d.enabled = false;
                    break;
            }
            NoMoreThreadsThan(before);
            Assert.AreEqual(0u, NativeMethods.knurl_session_close_all(), "sessions that run");
        }

        [Test]
        public void AHandlerMayLeaveTheScene()
        {
            int before = Threads();
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "rest"), other = StartResting();
            d.contactStarted.AddListener(s => Player.LeaveScene());
            Assert.That(d.StartDevice());
            Until(() => d == null && other == null, "gone");
            Player.Frames(2);
            NoMoreThreadsThan(before);
        }

        [Test]
        public void AHandlerMayDestroyAnotherDevice()
        {
            KnurlSurface surface = MakeSurface(Plate());
            KnurlDevice first = StartResting(), second = StartResting(), third = StartResting();
            Until(() => first.Touched != null && second.Touched != null && third.Touched != null, "all");
            second.contactEnded.AddListener(s =>
            {
                Object.DestroyImmediate(first.gameObject);
                Object.DestroyImmediate(third.gameObject);
            });
            surface.enabled = false;
            Player.Frames(2);
            Assert.That(first == null && third == null && second.Running);
        }

        [Test]
        public void AHandlerMayDisableItsDevice()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake:?press_at=0.5", "rest");
            List<string> told = Listen(d);
            d.buttonChanged.AddListener((index, isPressed) => d.enabled = false);
            Assert.That(d.StartDevice());
            Until(() => !d.enabled, "a button");
            Player.Frames(3);
            Assert.That(d.Running, Is.False);
            Assert.That(told.Contains("button 0 True") && !told.Contains("button 0 False"), Words(told));
            Assert.AreEqual(told.Count(t => t.StartsWith("started")), told.Count(t => t.StartsWith("ended")),
                Words(told));
        }
    }
}
