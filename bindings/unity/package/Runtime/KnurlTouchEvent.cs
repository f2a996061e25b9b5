// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Argument: the device that touches the surface, or no longer touches it. Invoked on the main
    /// thread.</summary>
    [Serializable]
    public sealed class KnurlTouchEvent : UnityEvent<KnurlDevice> { }
}
