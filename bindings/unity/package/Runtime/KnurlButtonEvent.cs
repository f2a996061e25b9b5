// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Tells which button (0: the first), and whether it was pressed. Invoked on the main thread.</summary>
    [Serializable]
    public sealed class KnurlButtonEvent : UnityEvent<int, bool> { }
}
