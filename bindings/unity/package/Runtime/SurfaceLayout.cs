// SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    /// <summary>How Knurl's library lays ridges out on a surface, found in a scene of its own, for drawing.</summary>
    internal sealed unsafe class SurfaceLayout
    {
        /// <summary>See knurl_surface_info.coordinates: "axis", "uvs", "tangents", "box"...; "" if it cannot be felt.</summary>
        internal readonly string Coordinates = "";

        /// <summary>Metres of the surface per unit of u and v; zero if coordinates are not "uvs".</summary>
        internal readonly double UScale, VScale;

        /// <summary>Scale, shear and mirror of the object, baked into its mesh: 3 by 3, row-major, scene axes.</summary>
        internal readonly double[] Rest = new double[9];

        /// <summary>Takes some milliseconds for a large mesh. Main thread.</summary>
        internal SurfaceLayout(KnurlSurface surface)
        {
            knurl_session_pose pose;
            knurl_surface_info info;
            double* rows = stackalloc double[12];
            Matrix4x4 place = surface.transform.localToWorldMatrix;
            Axes.ToScene(&place, rows);
            if (Library.Check() != null || NativeMethods.knurl_session_split_pose(rows, &pose) == 0)
            {
                return;
            }
            for (int i = 0; i < 9; i++)
            {
                Rest[i] = pose.rest[i];
            }
            using (SessionHandle session = SessionHandle.Create())
            {
                var following = new Following(session, surface.Layers);
                following.Add(surface);
                following.Follow(surface.Layers);
                if (following.Describe(surface, &info))
                {
                    Coordinates = Utf8.Read(info.coordinates);
                    UScale = info.uv_scale[0];
                    VScale = info.uv_scale[1];
                }
            }
        }

        /// <summary>True if ridges follow positions.</summary>
        internal bool IsBox
        {
            get { return Coordinates.StartsWith("box", StringComparison.Ordinal); }
        }
    }
}
