// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Behaviour of a device frame by frame.</summary>
    [TestFixture]
    public class RunTests : PlayerSuite
    {
        [Test]
        public void StartsByItselfInItsFirstFrame()
        {
            KnurlDevice d = MakeObject("Device").AddComponent<KnurlDevice>();
            Assert.That(d.Running, Is.False, "not before its first frame");
            Player.Frames(2);
            Assert.That(d.Running);
            d.gameObject.SetActive(false);
            Assert.That(d.Running, Is.False, "stops with its object");
            d.gameObject.SetActive(true);
            Player.Frames(2);
            Assert.That(d.Running, "starts with its object");
            d.enabled = false;
            Assert.That(d.Running, Is.False, "stops with itself");
            d.enabled = true;
            Player.Frames(2);
            Assert.That(d.Running, "starts with itself");
        }

        [Test]
        public void DoesNotStartByItselfWhereItShallNot()
        {
            KnurlDevice d = MakeDevice();
            Player.Frames(5);
            Assert.That(d.Running, Is.False);
        }

        [Test]
        public void DoesNotStartOutsideOfPlayMode()
        {
            Player.ExitPlayMode();
            KnurlDevice d = MakeDevice();
            d.Autostart = true;
            Player.Frames(3);
            Assert.That(d.Running, Is.False);
            ExpectError("play mode");
            Assert.That(d.StartDevice(), Is.False);
        }

        [Test]
        public void StrokesAPlateAndTellsWhatIsFelt()
        {
            KnurlSurface surface = MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake", "line");
            Assert.That(d.StartDevice());
            Until(() => d.Ticks > 500, "ticks");
            Until(() => d.InContact && d.Force.y > 0.05f, "feels");
            Assert.That(d.Touched == surface);
            Assert.That(surface.IsTouched);
            Assert.AreEqual(2, surface.TriangleCount);
            Assert.That(Mathf.Abs(d.ProxyPosition.y), Is.LessThan(1e-6f), "the proxy lies on the plate");
            Assert.That(d.HipPosition.y, Is.LessThan(0f), "the HIP lies below");
            Until(() => Mathf.Abs((float)d.TemporalFrequency - 100f) < 15f, "100 mm/s over 1 mm ridges");
            var history = new float[2 * 1000];
            int ticks = d.GetHistory(history);
            Assert.That(ticks, Is.GreaterThan(500).And.LessThanOrEqualTo(1000));
            var heights = new HashSet<double>();
            for (int i = 0; i < ticks; i++)
            {
                heights.Add(System.Math.Round(1e7 * history[2 * i]));
            }
            Assert.That(heights.Contains(2000) && heights.Contains(-2000), "of ridges and grooves");
            KnurlStatus status = d.GetStatus();
            Assert.That(status.Running && status.Ticks > 500 && status.Surfaces == 1 && status.ContactTicks > 0);
            d.StopDevice();
            Assert.AreEqual(Vector3.zero, d.Force);
            Assert.That(d.InContact || d.Touched != null || surface.IsTouched, Is.False);
            Assert.AreEqual(0, surface.TriangleCount);
        }

        [Test]
        public void AHistoryWithoutRoomIsNoCrash()
        {
            MakeSurface(Plate());
            KnurlDevice d = StartResting();
            Until(() => d.Ticks > 100, "ticks");
            Assert.AreEqual(0, d.GetHistory(new float[0]));
            Assert.AreEqual(0, d.GetHistory(new float[1]));
            Assert.AreEqual(1, d.GetHistory(new float[3]));
            Assert.That(d.GetHistory(new float[2 * 10000]), Is.LessThanOrEqualTo(8192));
        }

        [Test]
        public void TellsContactsAndButtons()
        {
            KnurlSurface s = MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake:?press_at=0.5", "press");
            List<string> told = Listen(d);
            Assert.That(d.StartDevice());
            Until(() => told.Contains("started Plate"), "a contact");
            Until(() => told.Contains("button 0 True"), "a button");
            Until(() => told.Contains("button 0 False"), "and its end");
            Until(() => d.Touched != null, "down again");
            int ends = told.Count(t => t == "ended Plate");
            Object.DestroyImmediate(s.gameObject);
            Assert.AreEqual(ends + 1, told.Count(t => t.StartsWith("ended")),
                "destroyed while touched: " + Words(told));
            Until(() => d.Force == Vector3.zero && !d.InContact, "and no force");
            Assert.That(d.Running && d.Touched == null);
        }

        [Test]
        public void AMouseIsMovedByTheGame()
        {
            KnurlSurface s = MakeSmooth(Plate());
            KnurlDevice d = MakeDevice("mouse");
            List<string> told = Listen(d);
            Assert.That(d.StartDevice());
            Player.Frames(20);
            Assert.That(d.Ticks == 0 && d.Force == Vector3.zero, "a mouse that has not moved is nowhere");
            d.MoveHip(new Vector3(0.01f, 0.02f, -0.03f));
            Until(() => d.Ticks > 50, "then it ticks");
            AreNear(new Vector3(0.01f, 0.02f, -0.03f), d.HipPosition, 1e-6);
            d.MoveHip(new Vector3(0.01f, -0.002f, -0.03f));
            Until(() => told.Count == 1 && d.Force.y > 0.5f, "down");
            AreNear(new Vector3(0.01f, 0f, -0.03f), d.ProxyPosition, 1e-5);
            d.MoveHip(new Vector3(0.01f, 0.02f, -0.03f));
            Until(() => told.Count == 2, "up");
            Assert.AreEqual("started Plate, ended Plate", Words(told));
            Assert.That(s.IsTouched, Is.False);
        }

        [Test]
        public void ADeviceThatIsLostIsFoundAgain()
        {
            KnurlDevice d = MakeDevice("fake:?lose_at=0.2");
            List<string> faults = ListenToFaults(d);
            Assert.That(d.StartDevice());
            Until(() => faults.Any(t => t.StartsWith("1 ") && t.Contains("gone")), "lost");
            Until(() => faults.Any(t => t.StartsWith("33 ")), "found again");
            long then = d.Ticks;
            Until(() => d.Running && d.Ticks > then + 50, "and runs");
        }

        [Test]
        public void WithoutReconnectALostDeviceStops()
        {
            MakeSurface(Plate());
            KnurlDevice d = MakeDevice("fake:?lose_at=0.3", "rest");
            d.Reconnect = false;
            List<string> told = Listen(d), faults = ListenToFaults(d);
            Assert.That(d.StartDevice());
            Until(() => !d.Running, "stops");
            Assert.That(faults.Any(t => t.StartsWith("1 ")), Words(faults));
            Assert.AreEqual(told.Count(t => t.StartsWith("started")), told.Count(t => t.StartsWith("ended")),
                Words(told));
            Assert.That(d.StartDevice(), "and can be started again");
        }

        [Test]
        public void SettingsCountFromTheNextStart()
        {
            KnurlDevice d = MakeDevice();
            Assert.That(d.StartDevice());
            d.Device = "nonsense";
            d.Rate = 2000f;
            Player.Frames(3);
            Assert.That(d.Running);
            d.StopDevice();
            ExpectError("nonsense");
            Assert.That(d.StartDevice(), Is.False);
        }

        [Test]
        public void AnErrorHasTheDeviceAsItsContext()
        {
            KnurlDevice d = MakeDevice("nonsense");
            ExpectError("nonsense");
            d.StartDevice();
            LogLine line = Debug.Lines.Last(l => l.Type == LogType.Error);
            Assert.That(ReferenceEquals(line.Context, d));
        }

        [Test]
        public void FilesStayBetweenRuns()
        {
            KnurlDevice d = MakeDevice();
            Assert.AreEqual(3, d.LoadGltf(Repository.Asset("plate_1d.glb")));
            for (int i = 0; i < 2; i++)
            {
                Assert.That(d.StartDevice());
                Assert.AreEqual(3L, d.GetStatus().Surfaces);
                d.StopDevice();
            }
            MakeSurface(Plate());
            Assert.That(d.StartDevice());
            Assert.AreEqual(4L, d.GetStatus().Surfaces);
        }

        [Test]
        public void ASurfaceOfAFileIsToldAsNull()
        {
            KnurlDevice d = MakeDevice("fake", "rest");
            List<string> told = Listen(d);
            Assert.AreEqual(3, d.LoadGltf(Repository.Asset("plate_1d.glb")));
            Assert.That(d.StartDevice());
            Until(() => told.Count > 0, "touched");
            Assert.AreEqual("started null", told[0]);
            Assert.That(d.InContact && d.Touched == null);
        }

        [Test] // Unity refuses such indices as they are set; a mesh from a file may have them
        public void IndicesThatNameNoVertexAreNoCrash()
        {
            Mesh mesh = Plate();
            mesh.SetIndices(new[] { 0, 1, 99 }, MeshTopology.Triangles, 0);
            MakeSmooth(mesh);
            UnityEngine.TestTools.LogAssert.ignoreFailingMessages = true;
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
        }

        [Test]
        public void EightDevicesRunAtOnce()
        {
            MakeSurface(Plate());
            var all = new List<KnurlDevice>();
            for (int i = 0; i < 8; i++)
            {
                all.Add(StartResting());
            }
            Until(() => all.All(d => d.Ticks > 20), "all tick");
            foreach (KnurlDevice d in all)
            {
                d.StopDevice();
            }
        }
    }
}
