// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl.Tests
{
    /// <summary>Ridges are drawn where they are felt.</summary>
    [TestFixture]
    public class StripesTests : PlayerSuite
    {
        const int Probes = 40;
        KnurlSurface surface;

        [SetUp]
        public void Forget()
        {
            Graphics.Drawn.Clear();
        }

        /// <summary>A box of 0.1 m without UVs, whose front faces look out: clockwise.</summary>
        Mesh Box()
        {
            var places = new List<Vector3>();
            for (int face = 0; face < 6; face++)
            {
                int k = face / 2;
                Vector3 n = Vector3.zero, a = Vector3.zero, b = Vector3.zero;
                n[k] = face % 2 == 0 ? 0.05f : -0.05f;
                a[(k + 1) % 3] = 0.05f;
                b[(k + 2) % 3] = face % 2 == 0 ? 0.05f : -0.05f;
                places.AddRange(new[] { n - a - b, n + a - b, n + a + b, n - a - b, n + a + b, n - a + b });
            }
            Mesh mesh = Made(new Mesh());
            mesh.vertices = places.ToArray();
            mesh.triangles = Enumerable.Range(0, places.Count).ToArray();
            return mesh;
        }

        Graphics.Drawing Drawn()
        {
            surface.gameObject.AddComponent<KnurlStripes>();
            Render();
            return Graphics.Drawn.Single();
        }

        static void Render()
        {
            Camera.onPreCull(null);
        }

        /// <summary>At random points: drawn as a ridge if pressing there gives more than the wall's force, as a groove if
        /// less. Near the flanks, the last digits decide.</summary>
        int CountDifferences()
        {
            surface.Grating.Method = GratingMethod.S1;
            Graphics.Drawing drawing = Drawn();
            Vector3[] places = drawing.Mesh.vertices;
            Vector2[] cycles = drawing.Mesh.uv;
            Vector2 frequency = surface.Grating.SpatialFrequency;
            var random = new System.Random(1);
            int differences = 0;
            for (int i = 0; i < Probes;)
            {
                int first = 3 * random.Next(places.Length / 3);
                float s = (float)random.NextDouble(), t = (float)random.NextDouble() * (1f - s), rest = 1f - s - t;
                Vector2 phase = rest * cycles[first] + s * cycles[first + 1] + t * cycles[first + 2];
                double height = Math.Cos(2.0 * Math.PI * phase.x) * (frequency.y > 0f ? Math.Cos(2.0 * Math.PI * phase.y) : 1.0);
                if (Math.Abs(height) < 0.4 || Math.Min(s, Math.Min(t, rest)) < 0.1f)
                {
                    continue;
                }
                Vector3 a = drawing.Matrix.MultiplyPoint3x4(places[first]), b = drawing.Matrix.MultiplyPoint3x4(places[first + 1]);
                Vector3 c = drawing.Matrix.MultiplyPoint3x4(places[first + 2]);
                Vector3 normal = Vector3.Cross(b - a, c - a).normalized * (Mirrors(drawing.Matrix) ? -1f : 1f);
                float force = Vector3.Dot(Press(rest * a + s * b + t * c, normal), normal);
                differences += force > Stiffness * Depth == height > 0.0 ? 0 : 1;
                i++;
            }
            return differences;
        }

        static bool Mirrors(Matrix4x4 m)
        {
            return Vector3.Dot(Vector3.Cross(m.MultiplyVector(Vector3.right), m.MultiplyVector(Vector3.up)),
                m.MultiplyVector(Vector3.forward)) < 0f;
        }

        void Make(Mesh mesh, Vector3 scale)
        {
            surface = MakeSurface(mesh);
            surface.Grating.SpatialFrequency = new Vector2(200f, 100f);
            surface.Grating.Orientation = 0.3f;
            surface.transform.localScale = scale;
            surface.transform.localRotation = new Quaternion(0.1f, 0.2f, 0.3f, 0.927362f);
        }

        [TestCase(1f)]
        [TestCase(-1f)]
        public void ByUvs(float side)
        {
            Make(Plate(), new Vector3(side, 1f, 1.5f));
            Assert.AreEqual(0, CountDifferences());
        }

        /// <summary>The plate is 0.1 m wide in u, and v runs along its z.</summary>
        [Test]
        public void TheScaleOfUvsIsInMetres()
        {
            Make(Plate(), new Vector3(2f, 1f, 1.5f));
            AreNear(new Vector3(0.2f, 0.15f, 0f), surface.GetUvScale(), 1e-6);
            surface.Axis = Vector3.right;
            Assert.AreEqual(Vector2.zero, surface.GetUvScale());
        }

        [Test]
        public void ByAnAxis()
        {
            Make(Plate(), new Vector3(1f, 1f, 1.5f));
            surface.Axis = new Vector3(1f, 0f, 2f);
            Assert.AreEqual(0, CountDifferences());
        }

        [TestCase(1f)]
        [TestCase(-1f)]
        public void ByPositionsOnABox(float side)
        {
            Make(Box(), new Vector3(side, 0.7f, 1.3f));
            Assert.AreEqual(0, CountDifferences());
        }

        [Test]
        public void AnotherGratingOrScaleIsDrawnAnewAndNothingElse()
        {
            Make(Plate(), Vector3.one);
            Mesh mesh = Drawn().Mesh;
            Vector2[] before = mesh.uv;
            surface.transform.position = new Vector3(1f, 2f, 3f);
            Render();
            CollectionAssert.AreEqual(before, mesh.uv);
            surface.Grating.SpatialFrequency = new Vector2(400f, 0f);
            Render();
            Assert.That(mesh.uv[1] != before[1]);
            before = mesh.uv;
            surface.transform.localScale = new Vector3(1f, 1f, 3f);
            surface.Axis = Vector3.forward;
            Render();
            Assert.That(mesh.uv[1] != before[1]);
            Assert.AreEqual(4, Graphics.Drawn.Count);
        }

        /// <summary>No device feels it: it is on no layer, or the library refuses it.</summary>
        [TestCase(0, false)]
        [TestCase(1, true)]
        public void WhatIsNotFeltIsNotDrawn(int layers, bool isRefused)
        {
            Mesh mesh = Plate();
            mesh.tangents = Enumerable.Repeat(new Vector4(1f, 0f, 0f, 1f), mesh.vertexCount).ToArray();
            Make(mesh, Vector3.one);
            surface.Layers = layers;
            surface.Axis = isRefused ? Vector3.right : Vector3.zero;
            surface.BoxCoordinates = isRefused;
            if (isRefused)
            {
                ExpectError("axis: expected zeros");
            }
            surface.gameObject.AddComponent<KnurlStripes>();
            Render();
            CollectionAssert.IsEmpty(Graphics.Drawn);
            surface.Layers = 1;
            surface.Axis = Vector3.zero;
            Render();
            Assert.AreEqual(1, Graphics.Drawn.Count, "now it is felt");
        }

        /// <summary>Its shear changes in each frame; a change of its grating is drawn at once.</summary>
        [Test]
        public void WhatTurnsBelowAnUnevenScaleIsLaidOutInAFiftiethOfTheTime()
        {
            const int frames = 300;
            Make(Plate(), Vector3.one);
            GameObject uneven = MakeObject("Uneven");
            uneven.transform.localScale = new Vector3(1f, 1f, 2f);
            surface.transform.SetParent(uneven.transform, false);
            Mesh mesh = Drawn().Mesh;
            int changes = 0;
            for (int i = 1; i <= frames; i++)
            {
                Vector2 before = mesh.uv[0];
                surface.transform.localRotation = Quaternion.Euler(0f, 0.1f * i, 0f);
                Render();
                changes += mesh.uv[0] != before ? 1 : 0;
            }
            Assert.That(changes, Is.InRange(1, frames / 5), "of 300 frames");
            System.Threading.Thread.Sleep(500);
            surface.transform.localRotation = Quaternion.Euler(0f, 45f, 0f);
            Vector2 late = mesh.uv[0];
            Render();
            Assert.That(mesh.uv[0] != late, "in the end it is drawn as it is");
            late = mesh.uv[0];
            surface.Grating.Orientation = 1f;
            Render();
            Assert.That(mesh.uv[0] != late);
        }

        /// <summary>The built-in pipeline, and URP and HDRP, call for each camera.</summary>
        [Test]
        public void EachPipelinesCamerasAreDrawnForUntilItIsDisabled()
        {
            Make(Plate(), Vector3.one);
            Camera eye = MakeObject("Eye").AddComponent<Camera>();
            surface.gameObject.AddComponent<KnurlStripes>();
            Camera.onPreCull(eye);
            RenderPipelineManager.Begin(eye);
            Assert.AreEqual(2, Graphics.Drawn.Count(drawing => drawing.Camera == eye));
            surface.GetComponent<KnurlStripes>().enabled = false;
            RenderPipelineManager.Begin(eye);
            Assert.IsNull(Camera.onPreCull);
            Assert.AreEqual(2, Graphics.Drawn.Count);
        }

        [Test]
        public void ColoursAreTheComponents()
        {
            Make(Plate(), Vector3.one);
            Material material = Drawn().Material;
            Assert.AreEqual("KnurlStripes", material.shader.name);
            surface.GetComponent<KnurlStripes>().Ridge = Color.red;
            Render();
            Assert.AreEqual(Color.red, material.Colors["_Ridge"]);
        }
    }
}
