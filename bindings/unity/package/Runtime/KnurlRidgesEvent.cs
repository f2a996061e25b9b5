// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Tells a surface how many ridges passed under a device's finger. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlRidgesEvent : UnityEvent<KnurlDevice, int> { }
}
