// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Tells which surface is touched, or is not touched any more; null for a surface of <see
    /// cref="KnurlDevice.LoadGltf"/>. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlContactEvent : UnityEvent<KnurlSurface> { }
}
