// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Tells a surface which device touches it, or does not any more. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlTouchEvent : UnityEvent<KnurlDevice> { }
}
