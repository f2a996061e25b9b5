// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>How ridges are rendered. The numbers are those of Knurl's C interface.</summary>
    public enum GratingMethod
    {
        /// <summary>Knurl's default: <see cref="Bandlimited"/>.</summary>
        Default = 0,

        /// <summary>Plays the height at the position. Exact at low speeds; at high speeds ridges are missed, and the
        /// mean force is wrong.</summary>
        S1 = 1,

        /// <summary>Plays balanced events at the frequency that follows from the velocity. No mean force; loses step
        /// with the surface.</summary>
        S2 = 2,

        /// <summary>Plays only those harmonics of the ridges that the update rate can represent, in step with the
        /// surface. No false tones, no mean force.</summary>
        Bandlimited = 3
    }
}
