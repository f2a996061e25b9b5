// SPDX-License-Identifier: MIT
using System;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>A surface's data in a scene: coordinates, directions, positions.</summary>
    [TestFixture]
    public class SceneTests : PlayerSuite
    {
        /// <summary>1 mm bars across v of a plate that is no whole number of them long: Eq. 11 at the place that glTF
        /// counts v from, which is Unity's upper edge.</summary>
        [Test]
        public void RidgesAcrossVAreCountedFromGltfsEdge()
        {
            const double size = 0.1003;
            KnurlSurface s = MakeSurface(Plate((float)size));
            s.Grating.SpatialFrequency = new Vector2(0f, 1000f);
            s.Grating.Method = GratingMethod.S1;
            KnurlDevice device = MakeDevice();
            device.Clamp = false;
            const int ticks = 2000;
            double[] forces = device.PlayTrace(new[] { 0, 0, -Depth, -0.02, 2.0, 0, -Depth, 0.02 }, ticks);
            int compared = 0;
            for (int i = 500; i < ticks; i++)
            {
                double z = -0.02 + 0.04 * i / ticks;
                double phase = Math.Abs(1000.0 * (0.5 * size - z)) % 1.0; // (1 - v) times the plate's length
                double edge = Math.Min(Math.Abs(phase - 0.25), Math.Abs(phase - 0.75));
                double height = phase < 0.25 || phase > 0.75 ? 0.0002 : -0.0002;
                if (edge > 0.05)
                {
                    Assert.AreEqual(Stiffness * (Depth + height), forces[3 * i + 1], 1e-3, "z = " + z);
                    compared++;
                }
            }
            Assert.That(compared, Is.GreaterThan(1000));
        }

        [Test]
        public void AnAxisIsScaledLikeItsMesh()
        {
            KnurlSurface s = MakeSurface(Plate());
            s.Axis = new Vector3(1f, 0f, 1f);
            s.transform.localScale = new Vector3(2f, 1f, 1f); // it runs along (2, 0, 1)
            Assert.That(Ridges(s, Vector3.zero, new Vector3(2f, 0f, 1f)), Is.InRange(30, 33), "40 a 40 mm, the ramp left out");
            Assert.That(Ridges(s, Vector3.zero, new Vector3(1f, 0f, -2f)), Is.LessThanOrEqualTo(1));
        }

        [Test]
        public void AGratingThatIsSetRightIsFelt()
        {
            KnurlSurface s = MakeSmooth(Plate());
            s.Grating.Stiffness = 0f;
            KnurlDevice d = StartMouse(new Vector3(0f, 0.02f, 0f));
            ExpectError("stiffness");
            Assert.AreEqual(0, s.TriangleCount);
            s.Grating.Stiffness = 300f;
            Until(() => s.TriangleCount == 2, "added");
            d.MoveHip(new Vector3(0f, -0.001f, 0f));
            Until(() => Math.Abs(d.Force.y - 0.3f) < 0.01f, "300 N/m");
        }

        /// <summary>A surface that jumps past a finger is not felt, one that moves against it is.</summary>
        [Test]
        public void TheFirstMoveFarFromTheOriginIsAMotion()
        {
            var far = new Vector3(3f, 0f, -2f);
            KnurlSurface s = MakeSmooth(Plate());
            s.transform.position = far;
            KnurlDevice d = StartMouse(far + new Vector3(0f, 0.0005f, 0f));
            Until(() => d.Ticks > 200, "hovers");
            Assert.That(d.InContact, Is.False);
            s.transform.position = far + new Vector3(0f, 0.0015f, 0f);
            Until(() => Math.Abs(d.Force.y - 0.4f) < 0.01f, "1 mm into the wall");
        }
    }
}
