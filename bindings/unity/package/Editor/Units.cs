// SPDX-License-Identifier: MIT
using System.Globalization;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Formats numbers with units, independent of the locale.</summary>
    internal static class Units
    {
        internal static string Number(double value)
        {
            return value.ToString("0.###", CultureInfo.InvariantCulture);
        }

        /// <summary>Formats a length in m.</summary>
        internal static string Millimetres(double metres)
        {
            return Number(1e3 * metres) + " mm";
        }

        /// <summary>Formats a position in m, to a tenth of a millimetre.</summary>
        internal static string Place(Vector3 metres)
        {
            return string.Format(CultureInfo.InvariantCulture, "{0:F4}, {1:F4}, {2:F4}", metres.x, metres.y, metres.z);
        }

        /// <summary>Formats spatial frequencies in 1/m: one number if the other is 0.</summary>
        internal static string Frequency(Vector2 perMetre)
        {
            return Number(perMetre.x) + (perMetre.y != 0.0f ? " x " + Number(perMetre.y) : "") + " /m";
        }

        /// <summary>Describes a grating in a sentence. Spatial frequency in 1/m, amplitude in m.</summary>
        internal static string Describe(Vector2 frequency, float amplitude)
        {
            bool alongX = frequency.x > 0.0f;
            bool alongY = frequency.y > 0.0f;
            if ((!alongX && !alongY) || amplitude == 0.0f)
            {
                return "A smooth wall.";
            }
            string height = ", " + Millimetres(2.0 * amplitude) + " from bottom to top.";
            if (alongX && alongY)
            {
                return "A grid of " + Number(1e3 / frequency.x) + " x " + Millimetres(1.0 / frequency.y) + height;
            }
            return "A ridge every " + Millimetres(1.0 / (alongX ? frequency.x : frequency.y)) +
                (alongX ? " along x" : " along y") + height;
        }
    }
}
