// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>How ridges are rendered. The numbers are those of Knurl's C interface.</summary>
    public enum GratingMethod
    {
        /// <summary>Leaves it to Knurl: as <see cref="Locked"/>.</summary>
        Default = 0,

        /// <summary>Looks the height up at the position. Exact at low speeds; at high ones ridges are missed, and the
        /// mean force is off.</summary>
        S1 = 1,

        /// <summary>Plays balanced events at the frequency that the velocity asks for. No mean force; loses step with
        /// the surface.</summary>
        S2 = 2,

        /// <summary>Plays balanced events that keep step with the surface.</summary>
        Locked = 3,

        /// <summary>Gives the mean of the ridges passed since the last tick. Steady at any speed, and the same ridges
        /// backwards; half a tick late.</summary>
        Area = 4
    }
}
