// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>Where a straight line goes through what a device feels. See <see cref="KnurlDevice.CastRay"/>.</summary>
    public struct KnurlRayHit
    {
        /// <summary>Global.</summary>
        public Vector3 Position;

        /// <summary>Outward, of length 1.</summary>
        public Vector3 Normal;

        /// <summary>m, from the line's beginning.</summary>
        public float Distance;

        /// <summary>Null for one of <see cref="KnurlDevice.LoadGltf"/>.</summary>
        public KnurlSurface Surface;
    }
}
