// SPDX-License-Identifier: MIT
using System.Linq;
using Knurl.Samples;
using Knurl.Tests;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Rendering;

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
            GraphicsSettings.currentRenderPipeline = null;
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

        sealed class Pipeline : RenderPipelineAsset
        {
            internal readonly Shader Lit = Shader.Find("Universal Render Pipeline/Lit");
            public override Shader defaultShader { get { return Lit; } }
        }

        [Test]
        public void A_plate_shows_its_ridges_with_the_shader_of_the_projects_pipeline()
        {
            var pipeline = ScriptableObject.CreateInstance<Pipeline>();
            GraphicsSettings.currentRenderPipeline = pipeline;
            new GameObject("Demo").AddComponent<KnurlDemo>();
            Player.Frames(2);
            KnurlPaint[] painted = Object.FindObjectsOfType<KnurlPaint>();
            Assert.AreEqual(5, painted.Length);
            foreach (KnurlPaint each in painted)
            {
                Material material = each.GetComponent<Renderer>().sharedMaterial;
                Assert.AreSame(pipeline.Lit, material.shader, each.name);
                Assert.AreEqual(each.Color, material.color, each.name);
                Assert.AreEqual(each.GetComponent<KnurlSurface>() != null, each.GetComponent<KnurlStripes>() != null, each.name);
            }
        }

        [Test]
        public void Drawn_ridges_are_as_far_apart_as_felt_ones()
        {
            new GameObject("Demo").AddComponent<KnurlDemo>();
            Player.Frames(2);
            Graphics.Drawn.Clear();
            Camera.onPreCull(null);
            Assert.AreEqual(3, Graphics.Drawn.Count);
            Transform plate = Object.FindObjectsOfType<KnurlSurface>().Single(each => each.name == "Paper, ridges of 1 mm").transform;
            Graphics.Drawing drawing = Graphics.Drawn.Single(each => each.Matrix == plate.localToWorldMatrix);
            float[] cycles = drawing.Mesh.uv.Take(3).Select(each => each.x).ToArray(); // of a triangle, half of the quad
            Assert.AreEqual(48f, cycles.Max() - cycles.Min(), 1e-3f, "ridges on 48 mm");
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
