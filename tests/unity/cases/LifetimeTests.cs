// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;
using Object = UnityEngine.Object;

namespace Knurl.Tests
{
    /// <summary>After any action of a game or an editor, no haptic thread outlives it, and no force remains.</summary>
    [TestFixture]
    public class LifetimeTests : PlayerSuite
    {
        KnurlDevice TouchPlate()
        {
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            Until(() => d.Touched != null, "touched");
            return d;
        }

        KnurlDevice PressPlate()
        {
            KnurlDevice d = TouchPlate();
            Until(() => d.Force.magnitude > 0.05f, "pressed");
            return d;
        }

        [Test]
        public void PlayModeWithoutDomainReloadStartsAnewEachTime()
        {
            int before = Threads();
            for (int i = 0; i < 3; i++)
            {
                Player.ExitPlayMode();
                Player.EnterPlayMode();
                MakeSurface(Plate());
                KnurlDevice d = MakeDevice("fake", "rest");
                List<string> told = Listen(d);
                d.Autostart = true;
                Until(() => told.Count > 0, "touched");
                Assert.AreEqual("started Plate", Words(told));
                Assert.AreEqual(1L, d.GetStatus().Surfaces, "round " + i);
                Player.ExitPlayMode();
                Assert.That(d == null);
                NoMoreThreadsThan(before);
            }
            Player.EnterPlayMode();
        }

        [Test]
        public void ObjectsThatStayedBehindDoNotComeBack()
        {
            // Statics are kept without a domain reload; an object whose OnDisable never came must not be felt.
            KnurlSurface s = MakeSurface(Plate());
            KnurlDevice d = StartResting();
            Until(() => d.Touched != null, "touched");
            int during = Threads();
            Player.EnterPlayMode(); // as if the end of the last round had been missed
            Assert.That(d.Running, Is.False, "what ran is stopped before a new round");
            Assert.That(Waits(() => Threads() < during));
            Assert.That(s.IsTouched, Is.False);
            Assert.DoesNotThrow(() => Player.Frames(3));
        }

        [Test]
        public void QuittingStopsEverything()
        {
            int before = Threads();
            TouchPlate();
            Assert.That(Threads(), Is.GreaterThan(before), "there is something to count");
            Player.Quit();
            NoMoreThreadsThan(before);
        }

        [Test]
        public void QuittingStopsAlsoWhatIsNotDisabledByIt()
        {
            // Application.quitting comes before any OnDisable; the force of a player that ends there is zero.
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            bool isRunning = true;
            Until(() => d.Touched != null, "touched");
            Action last = () => isRunning = d.Running;
            Application.quitting += last; // after the package's own
            try
            {
                Player.Quit();
            }
            finally
            {
                Application.quitting -= last;
            }
            Assert.That(isRunning, Is.False);
        }

        [Test]
        public void LeavingASceneStopsItsDevice()
        {
            int before = Threads();
            KnurlDevice d = TouchPlate();
            Player.LeaveScene();
            Assert.That(d == null);
            NoMoreThreadsThan(before);
            Player.Frames(3);
        }

        [Test]
        public void ADeviceThatIsKeptGoesOnWithoutTheScene()
        {
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            Object.DontDestroyOnLoad(d.gameObject);
            List<string> told = Listen(d);
            Until(() => told.Count == 1, "touched");
            Player.LeaveScene();
            Assert.AreEqual("started Plate, ended Plate", Words(told).Replace("ended null", "ended Plate"));
            Player.Frames(3);
            Assert.That(d.Running);
            Assert.AreEqual(0L, d.GetStatus().Surfaces);
            Until(() => d.Force == Vector3.zero, "no force");
        }

        [Test]
        public void AnAssemblyReloadStopsEverything()
        {
            int before = Threads();
            KnurlDevice d = TouchPlate();
            Player.ReloadAssemblies();
            Assert.That(d.Running, Is.False);
            NoMoreThreadsThan(before);
        }

        [Test]
        public void TheEventBeforeAnAssemblyReloadIsEnough()
        {
            int before = Threads();
            KnurlDevice d = TouchPlate();
            Assert.That(Player.AssemblyReload, Is.Not.Null, "somebody listens");
            Player.AssemblyReload(); // and no OnDisable at all
            NoMoreThreadsThan(before);
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void TheEventBeforePlayModeEndsIsEnough()
        {
            int before = Threads();
            KnurlDevice d = TouchPlate();
            Assert.That(Player.PlayModeChanged, Is.Not.Null, "somebody listens");
            Player.PlayModeChanged((int)UnityEditor.PlayModeStateChange.ExitingPlayMode);
            NoMoreThreadsThan(before);
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void DestroyingStopsAtOnce()
        {
            int before = Threads();
            KnurlDevice d = StartResting();
            Object.Destroy(d.gameObject);
            Assert.That(d.Running, "not before the frame's end");
            Player.Frame();
            Assert.That(d == null);
            NoMoreThreadsThan(before);
            KnurlDevice e = StartResting();
            Object.DestroyImmediate(e);
            NoMoreThreadsThan(before);
        }

        // A separate function keeps a forgotten handle out of this stack frame.
        static unsafe void Forget(int count)
        {
            for (int i = 0; i < count; i++)
            {
                SessionHandle session = SessionHandle.Create();
                knurl_session_desc desc;
                NativeMethods.knurl_session_desc_init(&desc, (uint)sizeof(knurl_session_desc));
                KnurlException.Check(NativeMethods.knurl_session_open(session, &desc));
                KnurlException.Check(NativeMethods.knurl_session_start(session, null, 0));
            }
        }

        [Test]
        public void AForgottenHandleEndsItsThread()
        {
            int before = Threads();
            Forget(4);
            Assert.That(Threads(), Is.GreaterThanOrEqualTo(before + 4));
            Forget(1); // mono scans the stack conservatively: overwrite its content
            Assert.That(Waits(() =>
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
                return Threads() <= before + 2; // the last one may still be referenced from the stack
            }), "expected about " + before + " threads, found " + Threads());
            Assert.That(NativeMethods.knurl_session_close_all(), Is.LessThanOrEqualTo(2u));
        }

        [Test]
        public void AHandleIsReleasedOnce()
        {
            SessionHandle session = SessionHandle.Create();
            session.Dispose();
            session.Dispose();
            Assert.That(session.IsClosed);
            Assert.Throws<ObjectDisposedException>(() => NativeMethods.knurl_session_close(session));
        }

        [Test]
        public void CollectingGarbageWhileItRunsIsHarmless()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "line");
            Assert.That(d.StartDevice());
            for (int i = 0; i < 20; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
                Player.Frames(1);
            }
            long then = d.Ticks;
            Until(() => d.Ticks > then + 100 && d.InContact, "goes on");
        }

        [Test]
        public void APausedApplicationLetsGo()
        {
            KnurlDevice d = PressPlate();
            Player.Pause(true);
            Until(() => d.Force == Vector3.zero, "no force");
            Assert.That(d.Running, "and holds on to the device");
            Player.Pause(false);
            Until(() => d.Force.magnitude > 0.05f, "and comes back");
        }

        [Test]
        public void AGameThatStandsStillLetsGo()
        {
            KnurlDevice d = PressPlate();
            Time.timeScale = 0f;
            Until(() => d.Force == Vector3.zero, "no force");
            Assert.That(d.Running, "and holds on to the device");
            Time.timeScale = 1f;
            Until(() => d.Force.magnitude > 0.05f, "and comes back");
        }

        [Test]
        public void ADeviceThatIsPausedTellsWhereItIsAndFeelsNothing()
        {
            int ended = 0;
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            d.contactEnded.AddListener(s => ended++);
            Until(() => d.Force.magnitude > 0.05f && d.InContact, "pressed");
            d.Paused = true;
            Until(() => d.Force == Vector3.zero && !d.InContact, "no force");
            long then = d.Ticks;
            Until(() => d.Ticks > then + 400, "ticks go on");
            Assert.That(d.Running && d.Paused && d.Force == Vector3.zero && ended == 1, "and nothing is felt");
            d.Paused = false;
            Until(() => d.Force.magnitude > 0.05f && d.InContact, "and comes back");
        }

        [Test]
        public void AGameThatHangsHasNoForce()
        {
            KnurlDevice d = PressPlate();
            Assert.That(Waits(() => d.Force == Vector3.zero), "no force, without a frame");
            Until(() => d.Force.magnitude > 0.05f, "and comes back");
        }

        [Test]
        public void APauseBeforeTheStartIsNotForgotten()
        {
            MakeSurface(Plate());
            Player.Pause(true);
            KnurlDevice d = StartResting();
            Player.Pause(false);
            Until(() => d.Force.magnitude > 0.05f, "pressed");
        }
    }
}
