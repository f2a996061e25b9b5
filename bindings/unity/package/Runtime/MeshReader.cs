// Converts meshes for Knurl. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>A mesh in scene axes.</summary>
    internal sealed class MeshData
    {
        internal float[] Positions; // x, y, z a vertex
        internal float[] Normals;   // x, y, z a vertex, or null
        internal float[] Tangents;  // x, y, z, w per vertex, or null: only if there are no UVs
        internal float[] Uvs;       // u, v per vertex, or null
        internal uint[] Indices;    // three per triangle, counter-clockwise from outside
    }

    internal static unsafe class MeshReader
    {
        /// <summary>Why a mesh cannot be felt at all, or null.</summary>
        internal static string Refusal(Mesh mesh)
        {
            if (!mesh.isReadable)
            {
                return "Its mesh '" + mesh.name + "' cannot be read: switch Read/Write on in the import settings of "
                    + "its model.";
            }
            return CountTriangles(mesh) > 0 ? null
                : "Its mesh '" + mesh.name + "' has no triangles"
                    + Others(mesh, ": expected the topology Triangles, found ") + ".";
        }

        /// <summary>A warning about parts of a readable mesh that are not felt, or null.</summary>
        internal static string Omission(Mesh mesh)
        {
            string others = Others(mesh, "");
            return others == "" ? null
                : "Of its mesh '" + mesh.name + "' only triangles are felt, not " + others + ".";
        }

        /// <summary>All triangles of a mesh for which <see cref="Refusal"/> is null. rest: baked into it, 3 by 3,
        /// row-major, scene axes.</summary>
        internal static MeshData Read(Mesh mesh, double* rest)
        {
            var data = new MeshData();
            data.Positions = ReadPositions(mesh, rest);
            data.Normals = ReadNormals(mesh, rest);
            data.Indices = ReadIndices(mesh, Axes.Determinant(rest) < 0.0);
            data.Uvs = ReadUvs(mesh);
            if (!HaveArea(data.Uvs, data.Indices))
            {
                data.Uvs = null;
                data.Tangents = ReadTangents(mesh, rest);
            }
            return data;
        }

        /// <summary>True if the UVs define a direction of u. They have priority over tangents, which are derived from
        /// them, and which an importer of glTF files may convert to Unity's axes differently from positions (glTFast
        /// does).</summary>
        static bool HaveArea(float[] uvs, uint[] indices)
        {
            for (int i = 0; uvs != null && i + 2 < indices.Length; i += 3)
            {
                long a = 2L * indices[i], b = 2L * indices[i + 1], c = 2L * indices[i + 2];
                bool areThere = Math.Max(a, Math.Max(b, c)) < uvs.Length; // otherwise it is refused, with a message
                if (areThere && ((double)uvs[b] - uvs[a]) * ((double)uvs[c + 1] - uvs[a + 1])
                    != ((double)uvs[c] - uvs[a]) * ((double)uvs[b + 1] - uvs[a + 1]))
                {
                    return true;
                }
            }
            return false;
        }

        static float[] ReadPositions(Mesh mesh, double* rest)
        {
            var from = new List<Vector3>();
            mesh.GetVertices(from);
            var to = new float[3 * from.Count];
            for (int i = 0; i < from.Count; i++)
            {
                Turn(rest, from[i].x, from[i].y, from[i].z, to, 3 * i);
            }
            return to;
        }

        /// <summary>Normals turn by the inverse's transpose; only their directions matter.</summary>
        static float[] ReadNormals(Mesh mesh, double* rest)
        {
            var from = new List<Vector3>();
            mesh.GetNormals(from);
            double* turn = stackalloc double[9];
            double side = Axes.Determinant(rest) < 0.0 ? -1.0 : 1.0;
            for (int i = 0; i < 9; i++)
            {
                int row = 3 * ((i / 3 + 1) % 3), lastRow = 3 * ((i / 3 + 2) % 3), column = (i + 1) % 3, last = (i + 2) % 3;
                turn[i] = side * (rest[row + column] * rest[lastRow + last] - rest[row + last] * rest[lastRow + column]);
            }
            double* n = stackalloc double[3];
            var to = from.Count > 0 && from.Count == mesh.vertexCount ? new float[3 * from.Count] : null;
            for (int i = 0; to != null && i < to.Length; i += 3)
            {
                Vector3 given = from[i / 3];
                for (int k = 0; k < 3; k++)
                {
                    n[k] = turn[3 * k + 1] * given.y + turn[3 * k + 2] * given.z - turn[3 * k] * given.x;
                }
                double length = Math.Sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                for (int k = 0; k < 3; k++)
                {
                    to[i + k] = length > 0.0 ? (float)(n[k] / length) : 0f;
                }
            }
            return to;
        }

        static float[] ReadTangents(Mesh mesh, double* rest)
        {
            var from = new List<Vector4>();
            mesh.GetTangents(from);
            var to = from.Count > 0 && from.Count == mesh.vertexCount ? new float[4 * from.Count] : null;
            for (int i = 0; to != null && i < from.Count; i++)
            {
                Turn(rest, from[i].x, from[i].y, from[i].z, to, 4 * i);
                to[4 * i + 3] = from[i].w;
            }
            return to;
        }

        /// <summary>glTF's v points down the image, Unity's up.</summary>
        static float[] ReadUvs(Mesh mesh)
        {
            var from = new List<Vector2>();
            mesh.GetUVs(0, from);
            var to = from.Count > 0 && from.Count == mesh.vertexCount ? new float[2 * from.Count] : null;
            for (int i = 0; to != null && i < from.Count; i++)
            {
                to[2 * i] = from[i].x;
                to[2 * i + 1] = 1f - from[i].y;
            }
            return to;
        }

        /// <summary>Unity's front faces are clockwise, in left-handed axes: mirrored, they face inwards, unless a
        /// mirror is baked in as well.</summary>
        static uint[] ReadIndices(Mesh mesh, bool isMirrored)
        {
            var to = new uint[3 * CountTriangles(mesh)];
            int written = 0;
            for (int part = 0; part < mesh.subMeshCount; part++)
            {
                int[] from = mesh.GetTopology(part) == MeshTopology.Triangles ? mesh.GetIndices(part) : null;
                for (int i = 0; from != null && i + 2 < from.Length; i += 3)
                {
                    to[written] = (uint)from[i];
                    to[written + 1] = (uint)from[isMirrored ? i + 1 : i + 2];
                    to[written + 2] = (uint)from[isMirrored ? i + 2 : i + 1];
                    written += 3;
                }
            }
            return to;
        }

        /// <summary>to = rest F from.</summary>
        static void Turn(double* rest, double x, double y, double z, float[] to, int at)
        {
            for (int i = 0; i < 3; i++)
            {
                to[at + i] = (float)(rest[3 * i + 1] * y + rest[3 * i + 2] * z - rest[3 * i] * x);
            }
        }

        static long CountTriangles(Mesh mesh)
        {
            long count = 0;
            for (int i = 0; i < mesh.subMeshCount; i++)
            {
                count += mesh.GetTopology(i) == MeshTopology.Triangles ? mesh.GetIndexCount(i) / 3 : 0;
            }
            return count;
        }

        /// <summary>Text about submeshes of other topologies, after a given start; "" if there are none.</summary>
        static string Others(Mesh mesh, string beginning)
        {
            string text = "";
            for (int i = 0; i < mesh.subMeshCount; i++)
            {
                if (mesh.GetTopology(i) != MeshTopology.Triangles)
                {
                    text += (text == "" ? beginning : ", ") + mesh.GetTopology(i) + " (submesh " + i + ")";
                }
            }
            return text;
        }
    }
}
