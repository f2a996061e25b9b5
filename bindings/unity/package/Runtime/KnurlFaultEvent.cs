// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Tells a fault's number (1 to 31: something went wrong, 32 and above: it is well again) and its
    /// sentence, with the value and its unit. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlFaultEvent : UnityEvent<int, string> { }
}
