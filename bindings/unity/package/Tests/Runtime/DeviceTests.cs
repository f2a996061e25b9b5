// SPDX-License-Identifier: MIT
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>Immediate behaviour of a device; behaviour over several frames is not tested in Unity.</summary>
    [TestFixture]
    public class DeviceTests : Suite
    {
        static readonly double[] Path = { 0.0, 0.0, 0.01, 0.0, 0.2, 0.0, -0.001, 0.0 };

        static void ExpectError(string part)
        {
            LogAssert.Expect(LogType.Error, new Regex(Regex.Escape(part)));
        }

        [Test]
        public void HasTheDefaultsOfEveryKnurlBinding()
        {
            KnurlDevice d = MakeObject("Device").AddComponent<KnurlDevice>();
            Assert.AreEqual("fake", d.Device);
            Assert.AreEqual("", d.Stroke);
            Assert.AreEqual(1000f, d.Rate);
            Assert.AreEqual(1f, d.WorkspaceScale);
            Assert.That(d.Autostart && d.Reconnect && d.Clamp && !d.EvenSensation && d.ResponseFile == null);
        }

        [Test]
        public void IsAllZerosAtRest()
        {
            KnurlDevice d = MakeDevice();
            Assert.That(d.Running || d.InContact, Is.False);
            Assert.AreEqual(Vector3.zero, d.Force);
            Assert.AreEqual(0L, d.Ticks + d.Overruns);
            Assert.AreEqual("", d.DeviceName);
            Assert.That(d.Touched == null);
            Assert.That(d.GetStatus().Running, Is.False);
            Assert.AreEqual(0L, d.GetStatus().Ticks);
            Assert.AreEqual(0, d.GetHistory(new float[20]));
        }

        [Test]
        public void StartsAndStopsTwiceOver()
        {
            KnurlDevice d = MakeDevice();
            for (int i = 0; i < 2; i++)
            {
                Assert.That(d.StartDevice());
                Assert.That(d.StartDevice(), "twice is fine");
                Assert.That(d.Running);
                Assert.That(d.GetStatus().Running);
                Assert.AreEqual(3.3, d.GetStatus().MaxForce, 1e-9);
                Contains(d.DeviceName, "simulated Touch");
                d.StopDevice();
                Assert.That(d.Running, Is.False);
                d.StopDevice();
            }
        }

        [Test]
        public void RefusesWhatItDoesNotKnow()
        {
            KnurlDevice d = MakeDevice("nonsense");
            ExpectError("found 'nonsense'");
            Assert.That(d.StartDevice(), Is.False);
            d.Device = "fake:?speed=1";
            ExpectError("expected key=value with a key of");
            Assert.That(d.StartDevice(), Is.False);
            d.Device = "fake";
            d.Stroke = "wiggle";
            ExpectError("'wiggle'");
            Assert.That(d.StartDevice(), Is.False);
            d.Stroke = "";
            d.Rate = 20000f;
            ExpectError("10000");
            Assert.That(d.StartDevice(), Is.False);
            d.Rate = 1000f;
            d.WorkspaceScale = 0f;
            ExpectError("scale");
            Assert.That(d.StartDevice(), Is.False);
            d.WorkspaceScale = 1f;
            Assert.That(d.StartDevice(), "and is well after all that");
        }

        [Test]
        public void EvenSensationTakesAResponseOrTheModel()
        {
            KnurlDevice d = MakeDevice();
            d.EvenSensation = true;
            Assert.That(d.StartDevice());
            d.StopDevice();
            d.ResponseFile = new TextAsset("# knurl response 1\nfrequency_hz,gain\n20,1\n400,1\n");
            Assert.That(d.StartDevice());
            d.StopDevice();
            d.ResponseFile = new TextAsset("# knurl response 1\nfrequency_hz,gain\n20,1\n400,-1\n");
            ExpectError("response: line 4: expected a gain above 0");
            Assert.That(d.StartDevice(), Is.False);
            d.ResponseFile = new TextAsset("");
            ExpectError("response: expected text");
            Assert.That(d.StartDevice(), Is.False);
            d.EvenSensation = false; // then it does not count
            d.ResponseFile = new TextAsset("nothing");
            Assert.That(d.StartDevice());
        }

        [Test]
        public void AnErrorHasTheDeviceAsItsContext()
        {
            KnurlDevice d = MakeDevice("nonsense");
            ExpectError("nonsense");
            d.StartDevice();
            // Unity selects the object of a message when it is clicked; the stand-ins record it.
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void ADisabledDeviceDoesNotStart()
        {
            KnurlDevice d = MakeDevice();
            d.enabled = false;
            LogAssert.ignoreFailingMessages = true;
            Assert.That(d.StartDevice(), Is.False);
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void NoTextIsNoCrash()
        {
            KnurlDevice d = MakeDevice();
            d.Stroke = null;
            d.Device = null;
            LogAssert.ignoreFailingMessages = true;
            d.StartDevice();
            d.StopDevice();
            Assert.AreEqual(-1, d.LoadGltf(null));
        }

        [Test]
        public void PlaysATrace()
        {
            MakeSmooth(Plate());
            KnurlDevice d = MakeDevice();
            double[] forces = d.PlayTrace(Path, 400);
            Assert.AreEqual(1200, forces.Length);
            Assert.AreEqual(0.4, forces[1198], 1e-9);
            Assert.That(d.PlayTrace(Path, 400), Is.EqualTo(forces), "again: the same bits");
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void RefusesTracesThatAreNone()
        {
            KnurlDevice d = MakeDevice();
            ExpectError("t, x, y, z");
            Assert.That(d.PlayTrace(new double[] { 0, 0, 0 }, 10), Is.Null);
            LogAssert.ignoreFailingMessages = true;
            Assert.That(d.PlayTrace(null, 10), Is.Null);
            Assert.That(d.PlayTrace(new double[0], 10), Is.Null);
            Assert.That(d.PlayTrace(Path, 0), Is.Null);
            Assert.That(d.PlayTrace(Path, -1), Is.Null);
            Assert.That(d.PlayTrace(new[] { 0.0, 0.0, double.NaN, 0.0, 1.0, 0.0, 0.0, 0.0 }, 10), Is.Null);
            Assert.That(d.PlayTrace(new[] { 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, 10), Is.Null);
            d.Device = "mouse";
            Assert.That(d.PlayTrace(Path, 10), Is.Null);
            d.Device = "fake";
            Assert.AreEqual(30, d.PlayTrace(Path, 10).Length, "and is well after all that");
        }

        [Test]
        public void ARunningDevicePlaysNoTrace()
        {
            KnurlDevice d = MakeDevice();
            Assert.That(d.StartDevice());
            LogAssert.ignoreFailingMessages = true;
            Assert.That(d.PlayTrace(Path, 10), Is.Null);
            Assert.That(d.Running);
        }

        [Test]
        public void AFileThatIsNotThereIsAnError()
        {
            KnurlDevice d = MakeDevice();
            ExpectError("nothing.glb");
            Assert.AreEqual(-1, d.LoadGltf("nothing.glb"));
            Assert.That(d.StartDevice(), "and is well after that");
        }

        [Test]
        public void OnlyAMouseIsMoved()
        {
            KnurlDevice d = MakeDevice();
            Assert.That(d.StartDevice());
            LogAssert.ignoreFailingMessages = true;
            d.MoveHip(Vector3.zero);
            d.StopDevice();
            d.MoveHip(Vector3.zero);
            d.Device = "mouse";
            Assert.That(d.StartDevice());
            d.MoveHip(new Vector3(float.NaN, 0f, 0f));
            d.MoveHip(Vector3.zero);
            Assert.That(d.Running);
        }

        [Test]
        public void ANodeScaledToNothingIsNoCrash()
        {
            KnurlDevice d = MakeDevice();
            d.transform.localScale = Vector3.zero;
            MakeSmooth(Plate()).transform.localScale = Vector3.zero;
            LogAssert.ignoreFailingMessages = true;
            d.StartDevice();
            d.StopDevice();
            Assert.That(d.Running, Is.False);
        }
    }
}
