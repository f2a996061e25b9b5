// Lines of a grating's ridges on a mesh, for drawing in the editor. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    /// <summary>Ridges on a mesh's triangles as line segments, by Knurl's rules for surface coordinates: with an axis,
    /// metres along it from the object's origin; otherwise UVs scaled to metres by their mean; otherwise metres along
    /// the tangents (which define only a direction: on a curved mesh such lines do not meet). A pure function of its
    /// fields. Any thread.</summary>
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

        /// <summary>The same as KnurlSurface.Axis, then the values of its grating, in 1/m and rad.</summary>
        internal Vector3 Axis { get; set; }
        internal Vector2 SpatialFrequency { get; set; }
        internal float Orientation { get; set; }

        // Of the current triangle.
        readonly Vector3[] corners = new Vector3[3];
        readonly double[,] phases = new double[2, 3]; // ridges along x and along y, at each corner

        double uScale, vScale; // mean m per unit of u and v; 0: no UVs with an area
        int turned;            // -1: a mirror in the matrix flips the triangles
        int step, written, counted;
        Vector3[] segments;

        /// <summary>Fills in segments: two points each, in world axes.</summary>
        /// <param name="into">Room for half its length of segments; at least 2 points.</param>
        /// <param name="every">1: all ridges were drawn; n: each n-th, because there were too many.</param>
        /// <returns>The number of segments; 0 if the grating is smooth or its direction is undefined.</returns>
        internal int Draw(Vector3[] into, out int every)
        {
            int room = Math.Max(1, into.Length / 2);
            MeasureUvs();
            turned = Vector3.Dot(Vector3.Cross(ToWorld.MultiplyVector(Vector3.right),
                ToWorld.MultiplyVector(Vector3.up)), ToWorld.MultiplyVector(Vector3.forward)) < 0f ? -1 : 1;
            step = 1;
            while (Walk(null) > room && step < MostSteps)
            {
                step = (int)Math.Min(MostSteps, (long)step * Math.Max(2, counted / room));
            }
            every = step;
            return Walk(into);
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
            bool hasAxis = Axis.sqrMagnitude > 0f, hasUvs = uScale > 0.0;
            x = hasAxis ? ToWorld.MultiplyVector(Axis).normalized
                : !hasUvs && Has(Tangents) ? ToWorld.MultiplyVector(Tangents[Triangles[first]]).normalized
                : Vector3.zero;
            if ((!hasUvs && x.sqrMagnitude == 0f) || normal.sqrMagnitude == 0f)
            {
                return false;
            }
            // In left-handed axes y = n x x is turned the other way round.
            Vector3 y = Vector3.Cross(x, normal).normalized;
            Vector3 origin = ToWorld.MultiplyPoint3x4(Vector3.zero);
            double facing = hasAxis || !hasUvs ? 0.0 : Facing(first);
            double cos = Math.Cos(Orientation), sin = Math.Sin(Orientation);
            for (int i = 0; i < 3; i++)
            {
                double along = Vector3.Dot(corners[i] - origin, x), across = Vector3.Dot(corners[i] - origin, y);
                if (facing != 0.0)
                {
                    Vector2 uv = Uvs[Triangles[first + i]];
                    along = uv.x * uScale;
                    across = (uv.y - 1.0) * vScale * facing; // as glTF's v, which points down from the image's top
                }
                phases[0, i] = SpatialFrequency.x * (cos * along + sin * across);
                phases[1, i] = SpatialFrequency.y * (cos * across - sin * along);
            }
            return true;
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

        /// <summary>Area-weighted means of |dP/du| and |dP/dv|: 0 if there are no UVs with an area.</summary>
        void MeasureUvs()
        {
            double area = 0.0, u = 0.0, v = 0.0;
            for (int i = 0; Has(Uvs) && i + 2 < Triangles.Length; i += 3)
            {
                Vector2 edge1, edge2;
                double determinant = Determinant(i, out edge1, out edge2);
                FindCorners(i);
                Vector3 a = corners[1] - corners[0], b = corners[2] - corners[0];
                if (determinant != 0.0)
                {
                    double twice = Vector3.Cross(a, b).magnitude;
                    area += twice;
                    u += twice * (a * edge2.y - b * edge1.y).magnitude / Math.Abs(determinant);
                    v += twice * (b * edge1.x - a * edge2.x).magnitude / Math.Abs(determinant);
                }
            }
            uScale = area > 0.0 ? u / area : 0.0;
            vScale = area > 0.0 ? v / area : 0.0;
        }
    }
}
