// How the inspector shows fields. SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>A bit for each of 32 layers: shown as a list of names to tick.</summary>
    internal sealed class LayersAttribute : PropertyAttribute
    {
    }

    /// <summary>An angle in rad: shown in degrees.</summary>
    internal sealed class DegreesAttribute : PropertyAttribute
    {
    }
}
