// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Changes in a scene while it is felt.</summary>
    [TestFixture]
    public class FollowTests : PlayerSuite
    {
        static bool IsAbout(float found, float expected)
        {
            return Mathf.Abs(found - expected) < 0.01f;
        }

        [Test]
        public void ASurfaceIsFeltWhereItGoes()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            s.transform.position = new Vector3(0f, -0.0005f, 0f);
            Until(() => IsAbout(d.Force.y, 0.2f), "lowered by half");
            s.transform.rotation = Quaternion.Euler(0f, 0f, 6f); // counter-clockwise: its front leans left
            Until(() => d.Force.x < -0.01f &&
                Mathf.Abs(d.Force.x + d.Force.y * Mathf.Tan(6f * Mathf.Deg2Rad)) < 1e-3f, "tilted");
            s.transform.position = new Vector3(1f, 0f, 0f);
            Until(() => d.Force == Vector3.zero, "gone");
        }

        [Test]
        public void AParentMovesItsSurfaces()
        {
            KnurlSurface s = MakeSmooth(Plate());
            Transform parent = MakeObject("Parent").transform;
            s.transform.SetParent(parent, false);
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            parent.position = new Vector3(0f, -0.0005f, 0f);
            Until(() => IsAbout(d.Force.y, 0.2f), "lowered by half");
        }

        [Test]
        public void AGratingThatChangesIsFeltAtOnce()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "400 N/m");
            s.Grating.Stiffness = 200f;
            Until(() => IsAbout(d.Force.y, 0.2f), "200 N/m");
            KnurlGrating other = MakeGrating(0f);
            other.Stiffness = 300f;
            s.Grating = other;
            Until(() => IsAbout(d.Force.y, 0.3f), "another grating, 300 N/m");
        }

        [Test]
        public void AValueOutOfItsRangeIsAnErrorAndFeelsAsBefore()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            ExpectError("stiffness");
            s.Grating.Stiffness = -1f;
            Player.Frames(5);
            Assert.That(d.Running);
            Until(() => IsAbout(d.Force.y, 0.4f), "as before");
            s.Grating.Stiffness = 200f;
            Until(() => IsAbout(d.Force.y, 0.2f), "and is well after that");
        }

        [Test]
        public void WithoutAGratingNothingIsFelt()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlGrating held = s.Grating;
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            s.Grating = null;
            Until(() => d.Force == Vector3.zero, "no grating");
            s.Grating = held;
            Player.Frames(2);
            PressAgain(d);
            Until(() => IsAbout(d.Force.y, 0.4f), "a grating again");
        }

        [Test]
        public void ADisabledSurfaceIsNotFelt()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            List<string> told = Listen(d);
            Until(() => told.Count == 1 && IsAbout(d.Force.y, 0.4f), "pressed");
            s.enabled = false;
            Until(() => told.Count == 2, "disabled while touched: ended");
            Until(() => d.Force == Vector3.zero && !d.InContact && !s.IsTouched, "no force");
            s.enabled = true;
            Player.Frames(2);
            PressAgain(d);
            Until(() => told.Count == 3 && IsAbout(d.Force.y, 0.4f), "enabled again");
            s.gameObject.SetActive(false);
            Until(() => told.Count == 4 && d.Force == Vector3.zero, "inactive");
            Assert.AreEqual("started Plate, ended Plate, started Plate, ended Plate", Words(told));
        }

        [Test]
        public void AScaleThatChangesIsBakedAnew()
        {
            KnurlSurface s = MakeSmooth(Plate());
            s.transform.localScale = new Vector3(0.2f, 1f, 0.2f);
            KnurlDevice d = StartMouse(new Vector3(0.04f, 0.02f, 0f));
            d.MoveHip(new Vector3(0.04f, -0.001f, 0f));
            Until(() => d.HipPosition.y < -0.0009f, "beside it");
            Assert.AreEqual(Vector3.zero, d.Force);
            s.transform.localScale = new Vector3(-1f, 1f, 1f);
            Player.Frames(3);
            Assert.AreEqual(1L, d.GetStatus().Surfaces);
            Assert.AreEqual(2, s.TriangleCount);
            d.MoveHip(new Vector3(0.04f, 0.01f, 0f));
            Until(() => d.HipPosition.y > 0.005f, "up");
            d.MoveHip(new Vector3(0.04f, -0.001f, 0f));
            Until(() => IsAbout(d.Force.y, 0.4f), "larger, and mirrored: its front is still its front");
            s.transform.localScale = Vector3.zero;
            Player.Frames(3);
            Until(() => d.Force == Vector3.zero, "a scale of nothing is felt as nothing");
            Contains(string.Join(" ", s.GetWarnings()), "scale");
            s.transform.localScale = Vector3.one;
            Player.Frames(3);
            Assert.AreEqual(1L, d.GetStatus().Surfaces);
        }

        [Test]
        public void ASurfaceMayComeAndGoWhileADeviceRuns()
        {
            KnurlDevice d = StartResting();
            KnurlSurface s = MakeSurface(Plate());
            Player.Frames(2);
            Assert.AreEqual(1L, d.GetStatus().Surfaces);
            Assert.AreEqual(2, s.TriangleCount);
            Object.Destroy(s.gameObject);
            Player.Frames(2);
            Assert.AreEqual(0L, d.GetStatus().Surfaces);
        }

        [Test]
        public void TwoDevicesFeelTheSameSurface()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice first = StartPressing();
            KnurlDevice second = StartPressing();
            Until(() => IsAbout(first.Force.y, 0.4f) && IsAbout(second.Force.y, 0.4f), "both");
            Assert.That(first.Touched == s && second.Touched == s);
            first.StopDevice();
            Player.Frames(2);
            Assert.That(s.IsTouched, "by the other one still");
            second.StopDevice();
            Assert.That(s.IsTouched, Is.False);
        }

        [Test]
        public void SharedGratingsTellEverySurface()
        {
            KnurlSurface a = MakeSmooth(Plate(0.02f));
            KnurlSurface b = MakeSmooth(Plate());
            a.transform.position = new Vector3(0.3f, 0f, 0f);
            b.Grating = a.Grating;
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "400 N/m");
            a.Grating.Stiffness = 100f;
            Until(() => IsAbout(d.Force.y, 0.1f), "100 N/m");
        }

        [Test]
        public void WhatIsDestroyedWhileItIsFeltIsNoCrash()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            Object.DestroyImmediate(s.GetComponent<MeshFilter>().sharedMesh);
            Player.Frames(3);
            Assert.That(d.Running, "its mesh was copied");
            Object.DestroyImmediate(s.Grating);
            s.transform.position = new Vector3(0f, -0.0005f, 0f);
            Player.Frames(3);
            Assert.That(d.Running);
            Assert.That(s.GetWarnings().Length, Is.GreaterThan(0));
            UnityEngine.TestTools.LogAssert.ignoreFailingMessages = true; // that it cannot be felt may be said
            s.enabled = false;
            s.enabled = true;
            Player.Frames(3);
            Until(() => d.Running && d.Force == Vector3.zero, "nothing is left to feel");
        }

        [Test]
        public void ANewMeshIsReadWhenItsSurfaceIsEnabledAgain()
        {
            KnurlSurface s = MakeSmooth(Plate(0.02f));
            KnurlDevice d = StartResting();
            Mesh large = Plate();
            large.SetIndices(new[] { 0, 1, 2 }, MeshTopology.Triangles, 0);
            s.GetComponent<MeshFilter>().sharedMesh = large;
            Assert.AreEqual(2, s.TriangleCount);
            s.enabled = false;
            Player.Frames(1);
            s.enabled = true;
            Player.Frames(2);
            Assert.AreEqual(1, s.TriangleCount);
            Assert.AreEqual(1L, d.GetStatus().Surfaces);
        }

        [Test]
        public void DoubleSidedAndAxisCountWhileItRuns()
        {
            KnurlSurface s = MakeSmooth(Plate());
            s.transform.rotation = Quaternion.Euler(180f, 0f, 0f); // its front faces down
            KnurlDevice d = StartMouse(new Vector3(0f, 0.02f, 0f));
            s.DoubleSided = true;
            s.Axis = new Vector3(0f, 0f, 1f);
            Player.Frames(2);
            d.MoveHip(new Vector3(0f, -0.001f, 0f));
            Until(() => IsAbout(d.Force.y, 0.4f), "held by its back");
        }

        [Test]
        public void AScaleThatNeverRestsLeavesNothingBehind()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartResting();
            long bytes = 0;
            for (int i = 0; i < 300; i++)
            {
                s.transform.localScale = new Vector3(1f + 0.001f * i, 1f, 1f);
                Player.Frames(1);
                if (i == 50)
                {
                    bytes = d.GetStatus().SceneBytes;
                }
            }
            Assert.AreEqual(1L, d.GetStatus().Surfaces);
            Until(() => d.GetStatus().SceneBytes <= bytes + bytes / 10, "expected about " + bytes + " bytes");
        }

        [TestCase(float.NaN)]
        [TestCase(float.PositiveInfinity)]
        public void ATransformThatIsNoNumberIsNoCrashAndNoFlood(float value)
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            UnityEngine.TestTools.LogAssert.ignoreFailingMessages = true;
            for (int i = 0; i < 100; i++)
            {
                s.transform.position = new Vector3(value, 0.001f * i, 0f);
                Player.Frames(1);
            }
            Assert.That(d.Running && !float.IsNaN(d.Force.y));
            Assert.That(Debug.Lines.Count, Is.LessThan(10), "lines in the log for 100 frames");
            s.transform.position = Vector3.zero;
            Player.Frames(2);
            PressAgain(d);
            Until(() => IsAbout(d.Force.y, 0.4f), "and is well after that");
        }

        [Test]
        public void AnErrorIsToldOnceAndNotOnceAFrame()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            ExpectError("stiffness");
            s.Grating.Stiffness = -1f;
            for (int i = 0; i < 50; i++)
            {
                s.transform.position = new Vector3(0f, 0f, 0.0001f * i);
                Player.Frames(1);
            }
            Assert.That(d.Running);
        }

        [Test]
        public void WhatIsGoneIsNotFeltByALaterDevice()
        {
            KnurlSurface gone = MakeSmooth(Plate()), off = MakeSmooth(Plate());
            Object.DestroyImmediate(gone.gameObject);
            off.enabled = false;
            KnurlDevice d = StartPressing();
            Until(() => d.HipPosition.y < -0.0009f, "through both");
            Assert.AreEqual(Vector3.zero, d.Force);
            Assert.AreEqual(0L, d.GetStatus().Surfaces);
        }

        [Test]
        public void AMeshThatIsReadAgainKeepsTheContact()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = StartPressing();
            Until(() => IsAbout(d.Force.y, 0.4f), "pressed");
            List<string> told = Listen(d);
            Mesh mesh = s.GetComponent<MeshFilter>().sharedMesh;
            Vector3[] lower = mesh.vertices;
            for (int i = 0; i < lower.Length; i++)
            {
                lower[i].y = -0.0005f;
            }
            mesh.vertices = lower;
            Player.Frames(5);
            Assert.That(IsAbout(d.Force.y, 0.4f), "nobody has said so yet");
            s.UpdateMesh();
            Until(() => IsAbout(d.Force.y, 0.2f), "lowered by half");
            s.transform.localScale = new Vector3(2f, 1f, 2f);
            Player.Frames(5);
            Assert.AreEqual("", Words(told));
            s.Axis = Vector3.forward;
            Player.Frames(5);
            Assert.AreEqual("", Words(told));
        }

        static void Write(KnurlSurface surface, string field, object value)
        {
            typeof(KnurlSurface).GetField(field, BindingFlags.Instance | BindingFlags.NonPublic).SetValue(surface, value);
        }

        [Test]
        public void WhatAnAnimationChangesCountsAndWhatItDoesNotIsNotReadAnew()
        {
            KnurlSurface s = MakeSmooth(Plate());
            int made = s.Made, felt = s.Felt;
            Player.ApplyAnimation(s);
            Assert.AreEqual(made, s.Made);
            Assert.AreEqual(felt, s.Felt);
            Write(s, "axis", Vector3.forward); // and OnValidate is not sent
            Player.ApplyAnimation(s);
            Player.ApplyAnimation(s);
            Assert.AreEqual(made + 1, s.Made);
            Write(s, "doubleSided", true);
            Player.ApplyAnimation(s);
            Assert.AreEqual(made + 2, s.Made);
            Write(s, "grating", MakeGrating(500f));
            Player.ApplyAnimation(s);
            Assert.AreEqual(felt + 1, s.Felt);
            Assert.AreEqual(made + 2, s.Made);
        }

        [TestCase(true)]
        [TestCase(false)]
        public void ABodyIsPushedByWhatTheHandFeelsWhereItIsToBe(bool reacts)
        {
            KnurlSurface s = MakeSmooth(Plate());
            Rigidbody body = s.gameObject.AddComponent<Rigidbody>();
            s.Reaction = reacts;
            KnurlDevice d = StartPressing();
            Until(() => d.InContact && IsAbout(d.Force.y, 0.4f), "pressed");
            long ticks = d.Ticks;
            body.Impulse = Vector3.zero;
            Until(() => reacts ? body.Impulse.y < -0.04f : d.Ticks > ticks + 200, "0.4 N for 0.1 s");
            Assert.AreEqual(0f, body.Impulse.x, 1e-4f);
            Assert.AreEqual(!reacts, body.Impulse == Vector3.zero);
        }

        [Test]
        public void ADeviceSaysWhatIsWrongWithIt()
        {
            KnurlDevice d = MakeDevice("fake", "sweep");
            Assert.AreEqual(new string[0], d.GetWarnings());
            d.Stroke = "";
            Contains(d.GetWarnings()[0], "stands still", "Stroke");
            d.Device = "touch";
            d.WorkspaceScale = 0f;
            Contains(d.GetWarnings()[0], "workspace scale");
        }

        [Test]
        public void AStartThatFailsIsToldOnceAndTriedAgain()
        {
            KnurlDevice d = MakeDevice("nothing");
            var told = new List<string>();
            d.startFailed.AddListener((code, text) => told.Add(text));
            d.Autostart = true;
            d.Retry = 0.01f;
            ExpectError("nothing");
            Player.Frames(20);
            Assert.AreEqual(1, told.Count);
            Contains(told[0], "nothing");
            d.Device = "fake";
            Until(() => d.Running, "tried again");
            d.StopDevice();
            Player.Frames(20);
            Assert.IsFalse(d.Running);
        }
    }
}
