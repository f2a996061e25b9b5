// Where a grating's ridges are on a mesh, for drawing. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>Phases of a grating on a mesh's triangles, and its ridges as line segments, by Knurl's rules for surface
    /// coordinates: with an axis, metres along it from the object's origin; UVs scaled to metres by the library's means;
    /// positions projected along the axis nearest to each triangle's normal; or metres along the tangents (which define only a
    /// direction: on a curved mesh such lines do not meet). A crest's middle has a whole phase. A pure function of its fields.
    /// Any thread.</summary>
    internal sealed class Stripes
    {
        const int MostSteps = 1 << 24;

        /// <summary>Mesh axes; tangents and UVs may be null or empty.</summary>
        internal Vector3[] Vertices { get; set; }
        internal Vector4[] Tangents { get; set; }
        internal Vector2[] Uvs { get; set; }
        internal int[] Triangles { get; set; }

        /// <summary>The object's localToWorldMatrix.</summary>
        internal Matrix4x4 ToWorld { get; set; }

        /// <summary>Of the surface with that matrix.</summary>
        internal SurfaceLayout Layout { get; set; }

        /// <summary>The same as KnurlSurface.Axis, then the values of its grating, in 1/m and rad.</summary>
        internal Vector3 Axis { get; set; }
        internal Vector2 SpatialFrequency { get; set; }
        internal float Orientation { get; set; }

        // Of the current triangle.
        readonly Vector3[] corners = new Vector3[3];
        readonly double[][] objects = { new double[3], new double[3], new double[3] };
        readonly double[,] phases = new double[2, 3]; // ridges along x and along y, at each corner

        int turned;            // -1: a mirror in the matrix flips the triangles
        int step, written, counted;
        Vector3[] segments;

        /// <summary>Takes a readable mesh's triangles.</summary>
        internal void Read(Mesh mesh)
        {
            var all = new List<int>();
            for (int part = 0; part < mesh.subMeshCount; part++)
            {
                if (mesh.GetTopology(part) == MeshTopology.Triangles)
                {
                    all.AddRange(mesh.GetTriangles(part));
                }
            }
            Vertices = mesh.vertices;
            Tangents = mesh.tangents;
            Uvs = mesh.uv;
            Triangles = all.ToArray();
        }

        /// <summary>Fills in segments: two points each, in world axes.</summary>
        /// <param name="into">Room for half its length of segments; at least 2 points.</param>
        /// <param name="every">1: all ridges were drawn; n: each n-th, because there were too many.</param>
        /// <returns>The number of segments; 0 if the grating is smooth or its direction is undefined.</returns>
        internal int Draw(Vector3[] into, out int every)
        {
            int room = Math.Max(1, into.Length / 2);
            Begin();
            step = 1;
            while (Walk(null) > room && step < MostSteps)
            {
                step = (int)Math.Min(MostSteps, (long)step * Math.Max(2, counted / room));
            }
            every = step;
            return Walk(into);
        }

        /// <summary>Adds three corners (mesh axes) and their phases along x and y for each triangle whose phases are defined.
        /// Phases begin near zero on each triangle, because floats count better there.</summary>
        internal void Fill(List<Vector3> places, List<Vector2> cycles)
        {
            Begin();
            for (int i = 0; i + 2 < Triangles.Length; i += 3)
            {
                if (FindPhases(i))
                {
                    double x = Math.Floor(phases[0, 0]), y = Math.Floor(phases[1, 0]);
                    for (int k = 0; k < 3; k++)
                    {
                        places.Add(Vertices[Triangles[i + k]]);
                        cycles.Add(new Vector2((float)(phases[0, k] - x), (float)(phases[1, k] - y)));
                    }
                }
            }
        }

        void Begin()
        {
            turned = Vector3.Dot(Vector3.Cross(ToWorld.MultiplyVector(Vector3.right),
                ToWorld.MultiplyVector(Vector3.up)), ToWorld.MultiplyVector(Vector3.forward)) < 0f ? -1 : 1;
        }

        /// <summary>Counts all segments at the present step, and writes as many as fit.</summary>
        int Walk(Vector3[] into)
        {
            segments = into;
            written = counted = 0;
            for (int i = 0; i + 2 < Triangles.Length && counted < int.MaxValue / 2; i += 3)
            {
                if (FindPhases(i))
                {
                    Cross(0);
                    Cross(1);
                }
            }
            return into == null ? counted : written / 2;
        }

        /// <summary>The lines on which a phase is a multiple of the step.</summary>
        void Cross(int direction)
        {
            double a = phases[direction, 0], b = phases[direction, 1], c = phases[direction, 2];
            double low = Math.Min(a, Math.Min(b, c)) / step;
            double high = Math.Max(a, Math.Max(b, c)) / step;
            if (!(high > low) || !(Math.Abs(low) < 1e9) || !(Math.Abs(high) < 1e9))
            {
                return; // one phase everywhere, or not a number
            }
            long first = (long)Math.Ceiling(low), last = (long)Math.Floor(high);
            counted = (int)Math.Min(counted + Math.Max(0L, last - first + 1L), int.MaxValue / 2);
            for (long k = first; k <= last && segments != null && written + 1 < segments.Length; k++)
            {
                Cut(direction, (double)k * step);
            }
        }

        /// <summary>Draws a line between the points on two edges with a given phase; a single corner makes no
        /// line.</summary>
        void Cut(int direction, double value)
        {
            int found = 0;
            for (int i = 0; i < 3 && found < 2; i++)
            {
                int j = (i + 1) % 3;
                double from = phases[direction, i] - value, to = phases[direction, j] - value;
                if ((from <= 0.0) != (to <= 0.0))
                {
                    segments[written + found] = Vector3.Lerp(corners[i], corners[j], (float)(from / (from - to)));
                    found++;
                }
            }
            written += found == 2 ? 2 : 0;
        }

        /// <summary>False if the grating's direction on this triangle is undefined.</summary>
        bool FindPhases(int first)
        {
            Vector3 x, normal;
            FindCorners(first);
            normal = turned * Vector3.Cross(corners[1] - corners[0], corners[2] - corners[0]);
            bool hasUvs = Layout.UScale > 0.0, isLaid = hasUvs || Layout.IsBox;
            x = isLaid ? Vector3.zero : Axis.sqrMagnitude > 0f ? ToWorld.MultiplyVector(Axis).normalized
                : Has(Tangents) ? ToWorld.MultiplyVector(Tangents[Triangles[first]]).normalized : Vector3.zero;
            if ((!isLaid && x.sqrMagnitude == 0f) || normal.sqrMagnitude == 0f)
            {
                return false;
            }
            // In left-handed axes y = n x x is turned the other way round.
            Vector3 y = Vector3.Cross(x, normal).normalized;
            Vector3 origin = ToWorld.MultiplyPoint3x4(Vector3.zero);
            double facing = hasUvs ? Facing(first) : 0.0;
            int side = Layout.IsBox ? FindSide(first) : 0;
            double cos = Math.Cos(Orientation), sin = Math.Sin(Orientation);
            for (int i = 0; i < 3; i++)
            {
                double along = Vector3.Dot(corners[i] - origin, x), across = Vector3.Dot(corners[i] - origin, y);
                if (facing != 0.0)
                {
                    Vector2 uv = Uvs[Triangles[first + i]];
                    along = uv.x * Layout.UScale;
                    across = (uv.y - 1.0) * Layout.VScale * facing; // as glTF's v, which points down from the image's top
                }
                else if (Layout.IsBox)
                {
                    Project(side, Vertices[Triangles[first + i]], out along, out across);
                }
                phases[0, i] = SpatialFrequency.x * (cos * along + sin * across);
                phases[1, i] = SpatialFrequency.y * (cos * across - sin * along);
            }
            return true;
        }

        /// <summary>A corner in scene axes, scaled but not turned: the library's object space.</summary>
        void ToObject(Vector3 vertex, double[] to)
        {
            double[] rest = Layout.Rest;
            for (int i = 0; i < 3; i++)
            {
                to[i] = rest[3 * i + 1] * vertex.y + rest[3 * i + 2] * vertex.z - rest[3 * i] * vertex.x;
            }
        }

        /// <summary>The direction that a triangle is projected along, 0 to 5: +x, -x, +y, -y, +z, -z of scene axes; see
        /// contact/projection.h of the library.</summary>
        int FindSide(int first)
        {
            for (int i = 0; i < 3; i++)
            {
                ToObject(Vertices[Triangles[first + i]], objects[i]);
            }
            double[] a = objects[0], b = objects[turned < 0 ? 1 : 2], c = objects[turned < 0 ? 2 : 1];
            var n = new double[3];
            for (int i = 0; i < 3; i++)
            {
                int j = (i + 1) % 3, k = (i + 2) % 3;
                n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
            }
            double x = Math.Abs(n[0]), y = 1.01 * Math.Abs(n[1]), z = 1.02 * Math.Abs(n[2]);
            int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
            return 2 * axis + (n[axis] < 0.0 ? 1 : 0);
        }

        void Project(int side, Vector3 vertex, out double along, out double across)
        {
            double[] p = objects[0];
            ToObject(vertex, p);
            along = side / 2 == 0 ? (side == 0 ? -p[2] : p[2]) : side == 5 ? -p[0] : p[0];
            across = side / 2 == 1 ? (side == 2 ? -p[2] : p[2]) : p[1];
        }

        void FindCorners(int first)
        {
            for (int i = 0; i < 3; i++)
            {
                corners[i] = ToWorld.MultiplyPoint3x4(Vertices[Triangles[first + i]]);
            }
        }

        bool Has<T>(T[] attribute)
        {
            return attribute != null && attribute.Length > 0 && attribute.Length == Vertices.Length;
        }

        /// <summary>The changes of u and v along the edges, and their determinant.</summary>
        double Determinant(int first, out Vector2 edge1, out Vector2 edge2)
        {
            edge1 = Uvs[Triangles[first + 1]] - Uvs[Triangles[first]];
            edge2 = Uvs[Triangles[first + 2]] - Uvs[Triangles[first]];
            return (double)edge1.x * edge2.y - (double)edge2.x * edge1.y;
        }

        /// <summary>1 if v increases along y, -1 if it decreases, 0 if the UVs have no area.</summary>
        double Facing(int first)
        {
            Vector2 edge1, edge2;
            return -turned * Math.Sign(Determinant(first, out edge1, out edge2));
        }
    }
}
