// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Reflection;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Knurl.Tests
{
    /// <summary>The stand-ins' vectors, matrices, meshes and JSON against Unity's manual.</summary>
    [TestFixture]
    public class StandInValueTests : PlayerSuite
    {
        [Test]
        public void VectorsThatAreNoNumbersEqualNone()
        {
            var nothing = new Vector3(float.NaN, 0f, 0f);
            Assert.IsFalse(nothing.Equals(nothing));
            Vector3 same = nothing;
            Assert.IsFalse(nothing == same);
            Assert.Throws<IndexOutOfRangeException>(() => nothing[3] = 1f);
        }

        [Test]
        public void RaysAreOfLength1()
        {
            Assert.AreEqual(Vector3.up, new Ray(Vector3.zero, 5f * Vector3.up).direction);
            float enter;
            Assert.IsTrue(new Plane(Vector3.up, Vector3.zero).Raycast(new Ray(Vector3.up, new Vector3(1f, -1e-5f, 0f)),
                out enter));
        }

        [Test]
        public void BoundsFollowIndicesAndNotVertices()
        {
            Mesh mesh = Made(new Mesh { vertices = new[] { Vector3.zero, Vector3.right, Vector3.up } });
            Assert.AreEqual(Vector3.zero, mesh.bounds.size);
            mesh.triangles = new[] { 0, 1, 2 };
            Assert.AreEqual(new Vector3(1f, 1f, 0f), mesh.bounds.size);
        }

        [Test]
        public void RotationsAreLeftHanded()
        {
            AreNear(Vector3.right, Quaternion.Euler(0f, 90f, 0f) * Vector3.forward, 1e-6);
            AreNear(Vector3.down, Quaternion.Euler(90f, 0f, 0f) * Vector3.forward, 1e-6);
            AreNear(Vector3.up, Quaternion.Euler(0f, 0f, 90f) * Vector3.right, 1e-6);
            // About z first, then x, then y.
            AreNear(Quaternion.AngleAxis(40f, Vector3.up) * (Quaternion.AngleAxis(30f, Vector3.right) *
                (Quaternion.AngleAxis(20f, Vector3.forward) * Vector3.one)), Quaternion.Euler(30f, 40f, 20f) * Vector3.one,
                1e-6);
        }

        [Test]
        public void MatricesAreColumnsOfAxes()
        {
            Transform t = MakeObject("t").transform;
            t.position = new Vector3(1f, 2f, 3f);
            t.rotation = Quaternion.Euler(10f, 20f, 30f);
            t.localScale = new Vector3(2f, 3f, 4f);
            Matrix4x4 m = t.localToWorldMatrix;
            AreNear(t.right * 2f, new Vector3(m.m00, m.m10, m.m20), 1e-5);
            AreNear(t.forward * 4f, new Vector3(m.m02, m.m12, m.m22), 1e-5);
            AreNear(t.position, new Vector3(m.m03, m.m13, m.m23), 1e-6);
            Assert.AreEqual(m.m12, m[1, 2]);
            Assert.AreEqual(m.m12, m[9]);
            AreNear(new Vector3(4f, 5f, 6f), t.InverseTransformPoint(t.TransformPoint(new Vector3(4f, 5f, 6f))), 1e-4);
        }

        [Test]
        public void AnArrayOfMaterialsIsACopy()
        {
            MeshRenderer drawn = MakeObject("r").AddComponent<MeshRenderer>();
            Material first = Made(new Material(null)), second = Made(new Material(null));
            drawn.sharedMaterials = new[] { first, second };
            drawn.sharedMaterials[0] = second;
            Assert.AreSame(first, drawn.sharedMaterial);
            drawn.sharedMaterial = second;
            Assert.AreEqual(2, drawn.sharedMaterials.Length, "only the first is replaced");
        }

        [Test]
        public void TextsOfVectorsAreRounded()
        {
            Assert.AreEqual("(0.00, 1.24)", new Vector2(0.001f, 1.236f).ToString());
            Assert.AreEqual("(0.00, 1.24, -2.00)", new Vector3(0.001f, 1.236f, -2f).ToString());
            Assert.AreEqual("(0.00, 0.00, 0.00, 1.00)", new Vector4(0f, 0f, 0f, 1f).ToString());
            Assert.AreEqual("(0.00000, 0.00000, 0.00000, 1.00000)", Quaternion.identity.ToString());
            Assert.AreEqual("RGBA(0.500, 0.500, 0.500, 1.000)", new Color(0.5f, 0.5f, 0.5f).ToString());
        }

        [Test]
        public void MatricesCompareAsUnitys()
        {
            Matrix4x4 nothing = Matrix4x4.identity;
            nothing.m00 = float.NaN;
            Matrix4x4 same = nothing;
            Assert.IsFalse(nothing.Equals(same));
        }

        /// <summary>box.bounds.center.x = 1f does not compile in Unity.</summary>
        [Test]
        public void PartsOfBoxesAreProperties()
        {
            foreach (Type type in new[] { typeof(Bounds), typeof(Rect), typeof(GUIContent), typeof(GUIStyle) })
            {
                CollectionAssert.IsEmpty(type.GetFields(BindingFlags.Instance | BindingFlags.Public), type.Name);
            }
        }

        [Test]
        public void ASubmeshThatIsNotThereIsAnError()
        {
            Mesh mesh = Made(new Mesh());
            ExpectError("Failed getting indices. Submesh index is out of bounds.");
            CollectionAssert.IsEmpty(mesh.GetIndices(1));
            ExpectError("Failed getting triangles. Submesh index is out of bounds.");
            CollectionAssert.IsEmpty(mesh.GetTriangles(-1));
            ExpectError("Failed getting indices. Submesh index is out of bounds.");
            mesh.SetIndices(new int[3], MeshTopology.Triangles, 1);
            ExpectError("Failed getting topology. Submesh index is out of bounds.");
            Assert.AreEqual(MeshTopology.Triangles, mesh.GetTopology(1));
            Assert.Throws<IndexOutOfRangeException>(() => mesh.GetIndexCount(1));
            Assert.Throws<ArgumentNullException>(() => mesh.GetVertices(null));
        }

        [Test]
        public void WhatIsNotReadableCannotBeWrittenEither()
        {
            Mesh mesh = Made(new Mesh { vertices = new Vector3[3] });
            mesh.UploadMeshData(true);
            ExpectError("Not allowed to access vertices");
            mesh.vertices = new Vector3[4];
            ExpectError("Not allowed to access uv");
            mesh.uv = new Vector2[3];
            ExpectError("Not allowed to access triangles/indices");
            mesh.triangles = new int[3];
            Assert.AreEqual(3, mesh.vertexCount);
        }

#pragma warning disable 649
        sealed class Unmarked
        {
            public int number;
        }

        [Serializable]
        sealed class Marked
        {
            public int number = 7;
        }

        sealed class Held
        {
            public float size = 1f;
            public string name = "none";
            public Unmarked unmarked;
            public Unmarked[] unmarkeds;
            public Marked marked;
            public Marked[] markeds;
            [NonSerialized] public int passing;
            [SerializeField] int hidden;
            public int Property { get; set; }
            internal int Hidden { get { return hidden; } }
        }
#pragma warning restore 649

        [Test]
        public void JsonFillsFieldsByTheirExactNames()
        {
            Held held = JsonUtility.FromJson<Held>(
                "{\"Size\":2,\"name\":\"it\",\"Property\":3,\"passing\":4,\"hidden\":5}");
            Assert.AreEqual(1f, held.size);
            Assert.AreEqual("it", held.name);
            Assert.AreEqual(0, held.Property);
            Assert.AreEqual(0, held.passing);
            Assert.AreEqual(5, held.Hidden);
        }

        [Test]
        public void JsonFillsFieldsOfSerializableClassesOnly()
        {
            Held held = JsonUtility.FromJson<Held>("{\"unmarked\":{\"number\":1},\"unmarkeds\":[{\"number\":1}],"
                + "\"marked\":{\"number\":2},\"markeds\":[{\"number\":3},{}]}");
            Assert.IsNull(held.unmarked);
            Assert.IsNull(held.unmarkeds);
            Assert.AreEqual(2, held.marked.number);
            Assert.AreEqual(3, held.markeds[0].number);
            Assert.AreEqual(7, held.markeds[1].number);
        }

        [Test]
        public void NoJsonIsNoObject()
        {
            Assert.IsNull(JsonUtility.FromJson<Held>(null));
            Assert.IsNull(JsonUtility.FromJson<Held>(""));
            Assert.Throws<ArgumentException>(() => JsonUtility.FromJson<Held>("{\"size\":}"));
            Assert.Throws<ArgumentException>(() => JsonUtility.FromJson<Held>("[1]"));
            Assert.Throws<ArgumentException>(() => JsonUtility.FromJson<KnurlGrating>("{}"));
        }
    }
}
