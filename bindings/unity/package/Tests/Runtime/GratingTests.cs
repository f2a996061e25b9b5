// SPDX-License-Identifier: MIT
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    [TestFixture]
    public class GratingTests : Suite
    {
        [Test]
        public void HasTheDefaultsOfEveryKnurlBinding()
        {
            KnurlGrating g = Made(ScriptableObject.CreateInstance<KnurlGrating>());
            Assert.AreEqual(new Vector2(1000f, 0f), g.SpatialFrequency);
            Assert.AreEqual(0.0002f, g.Amplitude);
            Assert.AreEqual(400f, g.Stiffness);
            Assert.AreEqual(0f, g.Damping);
            Assert.AreEqual(0f, g.Friction);
            Assert.AreEqual(0f, g.Orientation);
            Assert.AreEqual(GratingMethod.Default, g.Method);
        }

        [Test]
        public void KeepsWhatItIsGiven()
        {
            KnurlGrating g = Made(ScriptableObject.CreateInstance<KnurlGrating>());
            g.SpatialFrequency = new Vector2(500f, 250f);
            g.Amplitude = 0.0005f;
            g.Stiffness = 300f;
            g.Damping = 2f;
            g.Friction = 0.3f;
            g.Orientation = 0.5f;
            g.Method = GratingMethod.S2;
            Assert.AreEqual(new Vector2(500f, 250f), g.SpatialFrequency);
            Assert.AreEqual(0.0005f, g.Amplitude);
            Assert.AreEqual(300f, g.Stiffness);
            Assert.AreEqual(2f, g.Damping);
            Assert.AreEqual(0.3f, g.Friction);
            Assert.AreEqual(0.5f, g.Orientation);
            Assert.AreEqual(GratingMethod.S2, g.Method);
        }

        [Test]
        public void MethodsHaveTheNumbersOfC()
        {
            Assert.AreEqual(NativeMethods.KNURL_METHOD_DEFAULT, (int)GratingMethod.Default);
            Assert.AreEqual(NativeMethods.KNURL_METHOD_S1, (int)GratingMethod.S1);
            Assert.AreEqual(NativeMethods.KNURL_METHOD_S2, (int)GratingMethod.S2);
            Assert.AreEqual(NativeMethods.KNURL_METHOD_BANDLIMITED, (int)GratingMethod.Bandlimited);
            Assert.AreEqual(0, (int)GratingMethod.Default);
        }

        [Test]
        public void EveryChangeIsCounted()
        {
            KnurlGrating g = Made(ScriptableObject.CreateInstance<KnurlGrating>());
            long before = g.Version;
            g.Stiffness = 300f;
            long after = g.Version;
            g.Method = GratingMethod.S1;
            Assert.That(after, Is.Not.EqualTo(before));
            Assert.That(g.Version, Is.Not.EqualTo(after));
        }

        [Test]
        public void OneOfZeroFrequencyIsASmoothWall()
        {
            MakeSmooth(Plate());
            AreNear(Wall(Vector3.up), PressDown(0.01f, 0.02f), 1e-5);
        }

        [Test]
        public void StiffnessIsFelt()
        {
            KnurlSurface surface = MakeSmooth(Plate());
            surface.Grating.Stiffness = 250f;
            AreNear(new Vector3(0f, 0.25f, 0f), PressDown(0f, 0f), 1e-5);
        }

        [Test]
        public void TwoSurfacesMayShareOne()
        {
            KnurlSurface first = MakeSmooth(Plate(0.02f));
            KnurlSurface second = MakeSmooth(Plate(0.02f));
            second.transform.position = new Vector3(0.1f, 0f, 0f);
            second.Grating = first.Grating;
            first.Grating.Stiffness = 200f;
            AreNear(new Vector3(0f, 0.2f, 0f), PressDown(0f, 0f), 1e-5);
            AreNear(new Vector3(0f, 0.2f, 0f), PressDown(0.1f, 0f), 1e-5);
        }
    }
}
