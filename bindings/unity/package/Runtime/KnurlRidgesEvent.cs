// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Arguments: the device, and the number of ridges that passed under its finger. Invoked on the main
    /// thread.</summary>
    [Serializable]
    public sealed class KnurlRidgesEvent : UnityEvent<KnurlDevice, int> { }
}
