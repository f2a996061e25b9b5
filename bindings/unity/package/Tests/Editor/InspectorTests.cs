// SPDX-License-Identifier: MIT
using Knurl.Editing;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Knurl.Tests
{
    [TestFixture]
    public sealed class InspectorTests
    {
        static T Make<T>() where T : Component
        {
            return new GameObject("It", typeof(MeshFilter)).AddComponent<T>();
        }

        [Test]
        public void The_fields_that_inspectors_draw_are_there()
        {
            var grating = ScriptableObject.CreateInstance<KnurlGrating>();
            var serialized = new SerializedObject(grating);
            foreach (string field in GratingInspector.Fields)
            {
                Assert.IsNotNull(serialized.FindProperty(field), field);
            }
            var surface = Make<KnurlSurface>();
            foreach (string field in new[] { "grating", "doubleSided", "axis", "boxCoordinates", "smooth" })
            {
                Assert.IsNotNull(new SerializedObject(surface).FindProperty(field), field);
            }
            var device = Make<KnurlDevice>();
            foreach (string field in new[] { "device", "stroke", "rate", "workspaceScale", "autostart", "reconnect",
                "clamp", "evenSensation", "responseFile", "contactStarted", "contactEnded", "buttonChanged", "fault" })
            {
                Assert.IsNotNull(new SerializedObject(device).FindProperty(field), field);
            }
            Object.DestroyImmediate(grating);
            Object.DestroyImmediate(surface.gameObject);
            Object.DestroyImmediate(device.gameObject);
        }

        [Test]
        public void A_presets_numbers_are_copied_all()
        {
            var from = ScriptableObject.CreateInstance<KnurlGrating>();
            var to = ScriptableObject.CreateInstance<KnurlGrating>();
            to.name = "mine";
            from.SpatialFrequency = new Vector2(1f, 2f);
            from.Amplitude = 3f;
            from.Stiffness = 4f;
            from.Damping = 5f;
            from.Friction = 6f;
            from.Orientation = 7f;
            from.Method = GratingMethod.S2;
            GratingInspector.Copy(new SerializedObject(from), new SerializedObject(to));
            Assert.AreEqual(new Vector2(1f, 2f), to.SpatialFrequency);
            Assert.AreEqual(3f, to.Amplitude);
            Assert.AreEqual(4f, to.Stiffness);
            Assert.AreEqual(5f, to.Damping);
            Assert.AreEqual(6f, to.Friction);
            Assert.AreEqual(7f, to.Orientation);
            Assert.AreEqual(GratingMethod.S2, to.Method);
            Assert.AreEqual("mine", to.name);
            Object.DestroyImmediate(from);
            Object.DestroyImmediate(to);
        }

        [TestCase(1000f, 0f, 0.0002f, "A ridge every 1 mm along x, 0.4 mm from bottom to top.")]
        [TestCase(0f, 250f, 0.0001f, "A ridge every 4 mm along y, 0.2 mm from bottom to top.")]
        [TestCase(500f, 1000f, 0.0002f, "A grid of 2 x 1 mm, 0.4 mm from bottom to top.")]
        [TestCase(0f, 0f, 0.0002f, "A smooth wall.")]
        [TestCase(1000f, 0f, 0f, "A smooth wall.")]
        public void A_grating_is_described_in_millimetres(float x, float y, float amplitude, string expected)
        {
            Assert.AreEqual(expected, Units.Describe(new Vector2(x, y), amplitude));
        }

        [Test]
        public void What_devices_reach_is_known_by_their_scheme()
        {
            Assert.AreEqual(new Vector3(0.16f, 0.12f, 0.07f), DeviceGizmo.ReachOf("touch:Left Device"));
            Assert.AreEqual(DeviceGizmo.ReachOf("touch"), DeviceGizmo.ReachOf("fake:?preset=touch"));
            Assert.AreEqual(new Vector3(0.1016f, 0.1016f, 0.1016f), DeviceGizmo.ReachOf("falcon"));
            Assert.AreEqual(Vector3.zero, DeviceGizmo.ReachOf("mouse"));
            Assert.AreEqual(Vector3.zero, DeviceGizmo.ReachOf(null));
        }
    }
}
