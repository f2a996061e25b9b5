// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>The hit of a line segment on a surface. See <see cref="KnurlDevice.CastRay"/>.</summary>
    public struct KnurlRayHit
    {
        /// <summary>Global.</summary>
        public Vector3 Position;

        /// <summary>Outward, of length 1.</summary>
        public Vector3 Normal;

        /// <summary>m, from the segment's start.</summary>
        public float Distance;

        /// <summary>Null for a surface of <see cref="KnurlDevice.LoadGltf"/>.</summary>
        public KnurlSurface Surface;
    }
}
