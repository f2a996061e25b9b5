// SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using System.Linq;
using UnityEngine;
using UnityEngine.Rendering;

namespace Knurl
{
    /// <summary>The triangles of a mesh, stored beside it, so that a build can feel a mesh that is not readable, merged by
    /// static batching or without its UVs. Knurl makes them for the surfaces of scenes when a scene is built or played; the
    /// surface's inspector makes one as an asset, for prefabs. Main thread.</summary>
    [PreferBinarySerialization]
    public sealed class KnurlGeometry : ScriptableObject
    {
        [SerializeField, HideInInspector] Vector3[] vertices = new Vector3[0]; // m, mesh axes
        [SerializeField, HideInInspector] Vector3[] normals = new Vector3[0];
        [SerializeField, HideInInspector] Vector4[] tangents = new Vector4[0];
        [SerializeField, HideInInspector] Vector2[] uvs = new Vector2[0];
        [SerializeField, HideInInspector] int[] triangles = new int[0];

        [NonSerialized] Mesh mesh;

        /// <summary>Stores a mesh that can be read now; null if there is no mesh, or it has no triangles.</summary>
        internal static KnurlGeometry Of(Mesh mesh)
        {
            var made = CreateInstance<KnurlGeometry>();
            if (made.Take(mesh))
            {
                made.name = mesh.name;
                return made;
            }
            DestroyImmediate(made);
            return null;
        }

        /// <summary>Stores another mesh in its place, or the same after a change; false, and nothing changes, if there is no mesh
        /// or it has no triangles.</summary>
        internal bool Take(Mesh given)
        {
            int[] indices = given == null ? new int[0] : IndicesOf(given);
            if (indices.Length == 0 || given.vertices.Length == 0)
            {
                return false;
            }
            vertices = given.vertices;
            normals = given.normals;
            tangents = given.tangents;
            uvs = given.uv;
            triangles = indices;
            DestroyImmediate(mesh);
            mesh = null;
            return true;
        }

        static int[] IndicesOf(Mesh mesh)
        {
            var indices = new List<int>();
            for (int i = 0; i < mesh.subMeshCount; i++)
            {
                indices.AddRange(mesh.GetTopology(i) == MeshTopology.Triangles ? mesh.GetIndices(i) : new int[0]);
            }
            return indices.ToArray();
        }

        /// <summary>False if the mesh has changed since it was stored.</summary>
        internal bool IsOf(Mesh now)
        {
            return vertices.SequenceEqual(now.vertices) && uvs.SequenceEqual(now.uv) && triangles.SequenceEqual(IndicesOf(now));
        }

        /// <summary>A readable mesh, the same for all surfaces that have this geometry.</summary>
        internal Mesh Mesh
        {
            get
            {
                if (mesh == null)
                {
                    mesh = new Mesh
                    {
                        name = name,
                        indexFormat = vertices.Length > ushort.MaxValue ? IndexFormat.UInt32 : IndexFormat.UInt16,
                        vertices = vertices,
                        normals = normals,
                        tangents = tangents,
                        uv = uvs,
                    };
                    mesh.SetIndices(triangles, MeshTopology.Triangles, 0);
                    if (!Application.isEditor) // where they may be stored again
                    {
                        vertices = normals = new Vector3[0];
                        tangents = new Vector4[0];
                        uvs = new Vector2[0];
                        triangles = new int[0];
                    }
                }
                return mesh;
            }
        }

        void OnDisable()
        {
            DestroyImmediate(mesh);
        }
    }
}
