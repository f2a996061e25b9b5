// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A game's control of the force, events at surfaces, and a workspace that moves with its object. A smooth
    /// wall of 400 N/m, 1 mm deep, gives 0.4 N.</summary>
    [TestFixture]
    public class ForceTests : PlayerSuite
    {
        static bool IsAbout(float found, float expected)
        {
            return Mathf.Abs(found - expected) < 0.01f;
        }

        [Test]
        public void AGainScalesTheForceOfThisRunAndOfLaterOnes()
        {
            MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            d.Gain = 0.25f;
            Until(() => IsAbout(d.Force.y, 0.1f) && d.InContact, "a quarter of it");
            d.StopDevice();
            d.StartDevice();
            PressAgain(d);
            Until(() => IsAbout(d.Force.y, 0.1f), "the next run has it too");
            d.Gain = 7f;
            Until(() => IsAbout(d.Force.y, 0.4f), "no more than all of it");
        }

        [Test]
        public void AGamesForceIsAddedAndBounded()
        {
            KnurlDevice d = StartPressing();
            d.AddedForce = new Vector3(1.5f, 0f, 0f);
            Until(() => IsAbout(d.Force.x, 1.5f), "as given, in Unity's axes");
            d.AddedForce = new Vector3(0f, 100f, 0f);
            Until(() => IsAbout(d.Force.y, 3.3f), "as much as the device has");
            d.Paused = true;
            Until(() => d.Force == Vector3.zero, "none in a pause");
            d.Paused = false;
            ExpectError("AddedForce: force: expected at most 1000 N");
            d.AddedForce = new Vector3(0f, float.NaN, 0f);
            Player.Frames(3);
            d.AddedForce = Vector3.zero;
            Until(() => d.Force == Vector3.zero, "no more");
        }

        [Test]
        public void ARayFindsTheFirstSurfaceFromItsFront()
        {
            KnurlSurface plate = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            KnurlRayHit hit;
            Assert.That(d.CastRay(new Vector3(0.01f, 0.3f, 0.02f), new Vector3(0.01f, -0.3f, 0.02f), out hit));
            Assert.That(hit.Surface == plate);
            Assert.That((hit.Position - new Vector3(0.01f, 0f, 0.02f)).magnitude, Is.LessThan(1e-6f));
            Assert.That((hit.Normal - Vector3.up).magnitude, Is.LessThan(1e-6f));
            Assert.That(hit.Distance, Is.EqualTo(0.3f).Within(1e-6f));
            Assert.That(!d.CastRay(new Vector3(0f, -0.3f, 0f), new Vector3(0f, 0.3f, 0f), out hit), "from behind");
            ExpectError("CastRay: from: expected");
            Assert.That(!d.CastRay(new Vector3(0f, float.NaN, 0f), Vector3.zero, out hit));
            d.StopDevice();
            Assert.That(!d.CastRay(Vector3.up, Vector3.down, out hit), "without a run");
        }

        [Test]
        public void AVibrationIsPlayedAlongItsDirectionAndEnds()
        {
            KnurlDevice d = StartPressing();
            var seen = new HashSet<int>();
            d.Vibrate(KnurlVibration.T3, 100f, 1f, 60f, Vector3.forward);
            Until(() =>
            {
                seen.Add(Mathf.RoundToInt(100f * d.Force.z));
                return seen.Contains(100) && seen.Contains(-100);
            }, "forwards and backwards");
            d.Vibrate(KnurlVibration.T3, 100f, 1f, 0f, Vector3.forward);
            Until(() => d.Force == Vector3.zero, "no seconds end it");
            ExpectError("Vibrate: vibration: expected 0.1 to 500 Hz");
            d.Vibrate(KnurlVibration.T3, 700f, 1f, 1f, Vector3.up);
            d.StopDevice();
            ExpectError("Vibrate: expected a device that runs");
            d.Vibrate(KnurlVibration.T3, 100f, 1f, 1f, Vector3.up);
        }

        [Test]
        public void ASurfaceIsFeltByDevicesOfItsLayers()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "both are on layer 1");
            s.Layers = 2;
            Until(() => !d.InContact && d.Force == Vector3.zero, "not felt on another");
            Contains(string.Join(" ", s.GetWarnings()), "layers");
            d.Layers = 3;
            Player.Frames(2);
            PressAgain(d);
            Until(() => IsAbout(d.Force.y, 0.4f), "felt by a device with both");
            Assert.IsEmpty(s.GetWarnings());
            d.Layers = 4;
            Until(() => !d.InContact, "the device's are changed");
        }

        [Test]
        public void AWorkspaceGoesWithItsObject()
        {
            KnurlDevice d = MakeDevice("fake");
            d.transform.position = new Vector3(0f, 0.02f, 0f);
            Assert.IsTrue(d.StartDevice());
            Until(() => d.Ticks > 0 && Mathf.Abs(d.HipPosition.y - 0.02f) < 1e-3f, "where it started");
            d.transform.position = new Vector3(0.05f, 0.03f, 0.01f);
            Until(() => (d.HipPosition - d.transform.position).magnitude < 1e-3f, "a move");
            d.transform.position = new Vector3(5f, 0f, 0f);
            Until(() => (d.HipPosition - d.transform.position).magnitude < 1e-3f, "a leap");
        }

        [Test]
        public void AWorkspaceThatGoesDownPressesTheHandIntoAWall()
        {
            MakeSmooth(Plate());
            KnurlDevice d = MakeDevice("fake");
            d.transform.position = new Vector3(0f, 0.01f, 0f);
            Assert.IsTrue(d.StartDevice());
            for (int i = 0; i < 30; i++)
            {
                d.transform.position -= new Vector3(0f, 0.0004f, 0f); // to 2 mm below it
                Player.Frames(1);
            }
            Until(() => d.Force.y > 0.2f && IsAbout(d.Force.y, -400f * d.HipPosition.y), "the hand yields to the wall");
        }

        /// <summary>The hand rests 1 mm deep in a wall 30 mm below the object.</summary>
        [Test]
        public void AWorkspaceIsZoomedWhileItRuns()
        {
            MakeSmooth(Plate()).transform.position = new Vector3(0f, -0.03f, 0f);
            KnurlDevice d = MakeDevice("fake");
            d.Stroke = "rest";
            Assert.IsTrue(d.StartDevice());
            Until(() => d.Force.y > 0.15f, "rests on the wall");
            float resting = d.Force.y;
            d.WorkspaceScale = 1.2f;
            Until(() => d.Force.y > resting + 0.1f, "pressed in");
            var rows = new float[600];
            int count = d.GetHistory(rows);
            for (int i = 1; i < count; i++) // 400 N/m times 0.5 m/s, in a tick: 0.2 N
            {
                Assert.That(Mathf.Abs(rows[2 * i + 1] - rows[2 * i - 1]), Is.LessThan(0.1f), "no jump");
            }
            d.WorkspaceScale = 0.5f;
            Until(() => !d.InContact && d.HipPosition.y > -0.02f, "taken off");
            Assert.AreEqual(0.5f, d.Workspace.lossyScale.x, 1e-6f);
            d.WorkspaceScale = 1f;
            Until(() => d.Force.y > 0.15f, "and back");
            d.Clutch = true;
            Player.Frames(2);
            Vector3 at = d.HipPosition;
            d.WorkspaceScale = 3f;
            Player.Frames(2);
            d.Clutch = false;
            long ticks = d.Ticks;
            Until(() => d.Ticks > ticks + 200, "the zoom would be over");
            Assert.That((d.HipPosition - at).magnitude, Is.LessThan(1e-3f), "about the HIP");
            ExpectError("move: workspace.scale: expected 1e-09 to 1000000000, found 0");
            d.WorkspaceScale = 0f;
            Player.Frames(5);
            Assert.IsTrue(d.Running);
        }

        [Test]
        public void AClutchKeepsTheHipWhereItIs()
        {
            MakeSmooth(Plate());
            KnurlDevice d = MakeDevice("fake");
            d.Stroke = "line";
            Assert.IsTrue(d.StartDevice());
            Until(() => d.InContact && d.Velocity.magnitude > 0.05f, "on its way");
            d.Clutch = true;
            Until(() => d.Force == Vector3.zero && !d.InContact, "nothing is felt");
            Vector3 at = d.HipPosition;
            long ticks = d.Ticks;
            Until(() => d.Ticks > ticks + 200, "the hand goes on");
            Assert.AreEqual(at, d.HipPosition);
            d.Clutch = false;
            Until(() => d.HipPosition != at, "it goes on from there");
            Assert.That((d.HipPosition - at).magnitude, Is.LessThan(0.02f), "without a leap");
        }

        [Test]
        public void ASurfaceIsToldOfTouchesAndRidges()
        {
            KnurlSurface s = MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake");
            d.Stroke = "line";
            var told = new List<string>();
            int ridges = 0;
            s.touched.AddListener(by => told.Add("touched " + ReferenceEquals(by, d)));
            s.released.AddListener(by => told.Add("released " + ReferenceEquals(by, d)));
            s.ridgesPassed.AddListener((by, count) => ridges += ReferenceEquals(by, d) ? count : -1000);
            Assert.IsTrue(d.StartDevice());
            Until(() => told.Count == 1 && ridges > 10, "touched, and ridges pass");
            d.StopDevice();
            Assert.AreEqual("touched True, released True", Words(told));
            int passed = ridges;
            Player.Frames(3);
            Assert.AreEqual(passed, ridges);
        }
    }
}
