// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>How ridges are rendered. The numbers are those of Knurl's C interface.</summary>
    public enum GratingMethod
    {
        /// <summary>Leaves it to Knurl: as <see cref="Bandlimited"/>.</summary>
        Default = 0,

        /// <summary>Looks the height up at the position. Exact at low speeds; at high ones ridges are missed, and the
        /// mean force is off.</summary>
        S1 = 1,

        /// <summary>Plays balanced events at the frequency that the velocity asks for. No mean force; loses step with
        /// the surface.</summary>
        S2 = 2,

        /// <summary>Plays of the ridges' harmonics those that the update rate can carry, in step with the surface. No
        /// false tones, no mean force.</summary>
        Bandlimited = 3
    }
}
