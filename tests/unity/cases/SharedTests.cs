// SPDX-License-Identifier: MIT
using System;
using System.Diagnostics;
using NUnit.Framework;
using UnityEngine;

namespace Knurl.Tests
{
    /// <summary>Copies of a mesh, as of a prefab or a pool, share one shape in a device's scene.</summary>
    [TestFixture]
    public class SharedTests : PlayerSuite
    {
        const int Copies = 200;

        /// <summary>A square of 0.1 m, 2 n n triangles, with waves of a height; level ones would be felt as a
        /// plane.</summary>
        internal static Mesh Sheet(int n, float height)
        {
            var mesh = new Mesh();
            var vertices = new Vector3[(n + 1) * (n + 1)];
            var uvs = new Vector2[vertices.Length];
            var indices = new int[6 * n * n];
            for (int i = 0; i < vertices.Length; i++)
            {
                float u = i % (n + 1) / (float)n, v = i / (n + 1) / (float)n;
                vertices[i] = new Vector3(0.1f * u - 0.05f, height * Mathf.Sin(40f * u + 9f * v), 0.1f * v - 0.05f);
                uvs[i] = new Vector2(u, v);
            }
            for (int i = 0; i < n * n; i++)
            {
                int corner = i / n * (n + 1) + i % n;
                int[] quad = { corner, corner + n + 1, corner + 1, corner + 1, corner + n + 1, corner + n + 2 };
                Array.Copy(quad, 0, indices, 6 * i, 6);
            }
            mesh.vertices = vertices;
            mesh.uv = uvs;
            mesh.SetIndices(indices, MeshTopology.Triangles, 0);
            return mesh;
        }

        KnurlSurface Copy(Mesh mesh, int i)
        {
            KnurlSurface surface = MakeSurface(mesh);
            surface.transform.position = new Vector3(0f, -1f - 0.1f * i, 0f);
            return surface;
        }

        [Test]
        public void CopiesOfAMeshAreReadOnce()
        {
            KnurlDevice d = StartResting();
            Mesh mesh = Made(Sheet(70, 0.001f));
            Copy(mesh, 0);
            Player.Frames(1);
            long bytes = d.GetStatus().SceneBytes;
            var watch = Stopwatch.StartNew();
            for (int i = 1; i < Copies; i++)
            {
                Copy(mesh, i);
            }
            Player.Frames(1);
            long more = d.GetStatus().SceneBytes - bytes;
            Console.WriteLine("note: {0} more copies of {1} triangles: {2} ms, {3} bytes each; the first {4}", Copies - 1,
                2 * 70 * 70, watch.ElapsedMilliseconds, more / (Copies - 1), bytes);
            Assert.AreEqual((long)Copies, d.GetStatus().Surfaces);
            Assert.That(more, Is.LessThan(bytes));
        }

        [Test]
        public void AnotherScaleAxisOrSmoothnessIsAnotherShape()
        {
            KnurlDevice d = StartResting();
            Mesh mesh = Made(Sheet(70, 0.001f));
            Copy(mesh, 0);
            Player.Frames(1);
            long one = d.GetStatus().SceneBytes;
            Copy(mesh, 1).transform.localScale = new Vector3(1f, 1f, 1.5f);
            Copy(mesh, 2).Axis = Vector3.forward;
            Copy(mesh, 3).Smooth = SurfaceSmoothness.Off;
            Player.Frames(1);
            Assert.That(d.GetStatus().SceneBytes, Is.GreaterThan(3 * one));
        }

        [Test]
        public void TheFirstOfThemMayGo()
        {
            Mesh mesh = Made(Sheet(2, 0f));
            KnurlSurface first = Copy(mesh, 0), second = MakeSmooth(mesh);
            KnurlDevice d = StartPressing();
            Until(() => d.Force.y > 0.39f, "pressed");
            UnityEngine.Object.Destroy(first.gameObject);
            Player.Frames(3);
            Copy(mesh, 3);
            Player.Frames(3);
            Assert.AreEqual(2L, d.GetStatus().Surfaces);
            Assert.AreEqual(8, second.TriangleCount);
            Assert.That(d.Force.y, Is.GreaterThan(0.39f));
        }

        [Test]
        public void AMeshThatHasChangedIsReadByWhoIsToldAndByNewCopies()
        {
            Mesh mesh = Made(Sheet(2, 0f));
            KnurlSurface told = Copy(mesh, 0), untold = Copy(mesh, 1);
            KnurlDevice d = StartResting();
            Player.Frames(2);
            mesh.SetIndices(new[] { 0, 3, 1 }, MeshTopology.Triangles, 0);
            told.UpdateMesh();
            KnurlSurface fresh = Copy(mesh, 2);
            Player.Frames(2);
            Assert.AreEqual("1 8 1", told.TriangleCount + " " + untold.TriangleCount + " " + fresh.TriangleCount);
            untold.UpdateMesh();
            Player.Frames(2);
            Assert.AreEqual(1, untold.TriangleCount);
            Assert.That(d.Running);
        }
    }
}
