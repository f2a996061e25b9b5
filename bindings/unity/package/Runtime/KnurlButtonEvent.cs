// SPDX-License-Identifier: MIT
using System;
using UnityEngine.Events;

namespace Knurl
{
    /// <summary>Arguments: the button (0: the first), and true if it was pressed, false if released. Invoked on the
    /// main thread.</summary>
    [Serializable]
    public sealed class KnurlButtonEvent : UnityEvent<int, bool> { }
}
