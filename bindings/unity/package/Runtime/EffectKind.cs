// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>Kinds of <see cref="KnurlEffect"/>. The numbers are those of Knurl's C interface.</summary>
    public enum EffectKind
    {
        /// <summary>Pulls to the object's position.</summary>
        Spring = 1,

        /// <summary>Notches along the axis, one of them at the object's position.</summary>
        Detent = 2,

        /// <summary>Resists motion, as a thick liquid does.</summary>
        Damper = 3,

        /// <summary>Holds the finger on the line through the object's position along the axis.</summary>
        Line = 4,

        /// <summary>Holds the finger in the plane through the object's position across the axis, from both
        /// sides.</summary>
        Plane = 5,

        /// <summary>A constant force along the axis.</summary>
        Force = 6
    }
}
