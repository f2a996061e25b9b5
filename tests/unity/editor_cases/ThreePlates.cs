// SPDX-License-Identifier: MIT
using Knurl.Samples;
using Knurl.Tests;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Cases
{
    /// <summary>The sample, played.</summary>
    [TestFixture]
    public sealed class ThreePlates
    {
        [TearDown]
        public void TearDown()
        {
            Input.MouseButtons[0] = false;
            Player.LeaveScene();
        }

        [Test]
        public void A_pressed_mouse_feels_the_plate_below_it()
        {
            var demo = new GameObject("Demo").AddComponent<KnurlDemo>();
            Player.Frames(2);
            Assert.IsTrue(demo.Haptic.Running);
            Assert.AreEqual("mouse", demo.Haptic.Device);
            Assert.AreEqual(3, Object.FindObjectsOfType<KnurlSurface>().Length);
            foreach (KnurlSurface surface in Object.FindObjectsOfType<KnurlSurface>())
            {
                CollectionAssert.IsEmpty(surface.GetWarnings(), surface.name);
            }
            Input.MouseButtons[0] = true;
            Assert.IsTrue(Player.Until(() => demo.Haptic.InContact));
            Assert.IsTrue(Player.Until(() => demo.Haptic.Touched != null));
            Assert.AreEqual("Grid of 2 mm", demo.Haptic.Touched.name); // the stand-in's camera looks straight ahead
            Assert.IsTrue(Player.Until(() => demo.Haptic.Force.y > 0.1f));
            Input.MouseButtons[0] = false;
            Assert.IsTrue(Player.Until(() => !demo.Haptic.InContact));
        }

        [Test]
        public void Where_a_device_does_not_start_the_mouse_takes_over()
        {
            UnityEngine.TestTools.LogAssert.Expect(LogType.Error, new System.Text.RegularExpressions.Regex("nothing"));
            GameObject holder = new GameObject("Demo");
            holder.SetActive(false);
            var demo = holder.AddComponent<KnurlDemo>();
            var fields = new UnityEditor.SerializedObject(demo);
            fields.FindProperty("device").stringValue = "nothing";
            fields.ApplyModifiedProperties();
            holder.SetActive(true);
            Player.Frames(2);
            Assert.IsTrue(demo.Haptic.Running);
            Assert.AreEqual("mouse", demo.Haptic.Device);
        }
    }
}
