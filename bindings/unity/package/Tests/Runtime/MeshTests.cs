// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using System.Text.RegularExpressions;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    [TestFixture]
    public class MeshTests : Suite
    {
        // Appends a plate of 20 mm with its middle at `x`.
        static void Append(List<Vector3> points, List<Vector2> uvs, float x)
        {
            points.AddRange(new[]
            {
                new Vector3(x - 0.01f, 0, -0.01f), new Vector3(x - 0.01f, 0, 0.01f), new Vector3(x + 0.01f, 0, 0.01f),
                new Vector3(x + 0.01f, 0, -0.01f)
            });
            uvs.AddRange(new[] { new Vector2(0, 0), new Vector2(0, 1), new Vector2(1, 1), new Vector2(1, 0) });
        }

        Mesh ThreePlates()
        {
            var points = new List<Vector3>();
            var uvs = new List<Vector2>();
            for (int i = 0; i < 3; i++)
            {
                Append(points, uvs, 0.04f * i);
            }
            Mesh mesh = Made(new Mesh());
            mesh.SetVertices(points);
            mesh.SetUVs(0, uvs);
            mesh.subMeshCount = 3;
            mesh.SetIndices(new[] { 0, 1, 2, 0, 2, 3 }, MeshTopology.Triangles, 0);
            mesh.SetIndices(new[] { 4, 5, 6, 7 }, MeshTopology.Quads, 1);
            mesh.SetIndices(new[] { 8, 9, 10, 11 }, MeshTopology.Lines, 2);
            return mesh;
        }

        [Test]
        public void AllSubmeshesOfFacesAreFeltAndNoLines()
        {
            KnurlSurface surface = MakeSmooth(ThreePlates());
            AreNear(Wall(Vector3.up), PressDown(0f, 0f), 1e-5, "triangles");
            AreNear(Vector3.zero, PressDown(0.08f, 0f), 0.0, "lines");
            KnurlDevice device = MakeDevice();
            Assert.That(device.StartDevice());
            Assert.That(surface.TriangleCount, Is.EqualTo(2).Or.EqualTo(4)); // quads may be skipped or felt
            bool areQuadsFelt = surface.TriangleCount == 4;
            device.StopDevice();
            AreNear(areQuadsFelt ? Wall(Vector3.up) : Vector3.zero, PressDown(0.04f, 0f), 1e-5, "quads");
        }

        [Test]
        public void AMeshThatCannotBeReadIsAnErrorThatNamesIt()
        {
            Mesh mesh = Plate();
            mesh.UploadMeshData(true);
            KnurlSurface surface = MakeSmooth(mesh);
            string all = string.Join(" ", surface.GetWarnings());
            Contains(all, "Read/Write");
            LogAssert.ignoreFailingMessages = true; // an error or a warning, as long as nothing is thrown
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
        }

        [Test]
        public void AMeshWithoutTrianglesIsNoCrash()
        {
            MakeSmooth(Made(new Mesh()));
            LogAssert.ignoreFailingMessages = true;
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
        }

        [Test]
        public void AVertexThatIsNoNumberIsNoCrash()
        {
            Mesh mesh = Plate();
            Vector3[] points = mesh.vertices;
            points[2].y = float.NaN;
            mesh.vertices = points;
            MakeSmooth(mesh);
            LogAssert.ignoreFailingMessages = true;
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
        }

        [Test]
        public void ADestroyedMeshOrGratingIsNoCrash()
        {
            KnurlSurface surface = MakeSmooth(Plate());
            Object.DestroyImmediate(surface.GetComponent<MeshFilter>().sharedMesh);
            LogAssert.ignoreFailingMessages = true;
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
            surface.GetComponent<MeshFilter>().sharedMesh = Plate();
            Object.DestroyImmediate(surface.Grating);
            AreNear(Vector3.zero, PressDown(0f, 0f), 0.0);
            Assert.That(surface.GetWarnings().Length, Is.GreaterThan(0));
        }

        [Test]
        public void WhatIsMissingIsWarnedOf()
        {
            KnurlSurface surface = MakeObject("Lonely").AddComponent<KnurlSurface>();
            string[] warnings = surface.GetWarnings();
            Assert.AreEqual(2, warnings.Length, string.Join(" | ", warnings));
            Contains(warnings[0], "mesh");
            Contains(warnings[1], "rating");
        }

        [Test]
        public void ASurfaceHasItsMeshFilter()
        {
            KnurlSurface surface = MakeObject("Lonely").AddComponent<KnurlSurface>();
            Assert.That(surface.GetComponent<MeshFilter>(), Is.Not.Null);
            Assert.AreEqual(0, surface.TriangleCount);
            Assert.That(surface.IsTouched, Is.False);
        }

        [Test]
        public void WhatADeviceCannotDoIsWarnedOf()
        {
            KnurlSurface good = MakeSurface(Plate());
            good.Grating.Stiffness = 300f;
            good.Grating.Amplitude = 0.0001f;
            KnurlSurface far = MakeSmooth(Plate());
            far.Grating.Stiffness = 300f;
            far.transform.position = new Vector3(5f, 0f, 0f);
            KnurlSurface hard = MakeSurface(Plate());
            hard.Grating.Stiffness = 100000f;
            Assert.AreEqual(0, good.GetWarnings().Length + hard.GetWarnings().Length, "before a device runs");
            KnurlDevice device = MakeDevice();
            Assert.That(device.StartDevice());
            Assert.AreEqual(0, good.GetWarnings().Length, string.Join(" | ", good.GetWarnings()));
            Contains(string.Join(" ", far.GetWarnings()), "outside of the device's workspace");
            Contains(string.Join(" ", hard.GetWarnings()), "N/m");
        }
    }
}
