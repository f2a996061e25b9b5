// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Argument: the surface that is touched, or no longer touched; null for a surface of <see
    /// cref="KnurlDevice.LoadGltf"/>. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlContactEvent : UnityEvent<KnurlSurface> { }
}
