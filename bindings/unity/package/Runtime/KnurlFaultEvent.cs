// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Arguments: the fault's number (1 to 31: a fault, 32 and above: recovery) and its message, with value
    /// and unit. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlFaultEvent : UnityEvent<int, string> { }
}
