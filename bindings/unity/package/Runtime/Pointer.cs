// SPDX-License-Identifier: MIT
using UnityEngine;
#if KNURL_INPUT_SYSTEM && ENABLE_INPUT_SYSTEM && !ENABLE_LEGACY_INPUT_MANAGER
using UnityEngine.InputSystem;
#endif

namespace Knurl
{
    /// <summary>The mouse, with either input system.</summary>
    internal static class Pointer
    {
#if KNURL_INPUT_SYSTEM && ENABLE_INPUT_SYSTEM && !ENABLE_LEGACY_INPUT_MANAGER
        /// <summary>Pixels from the window's lower left corner.</summary>
        internal static Vector3 Position
        {
            get { return Mouse.current == null ? Vector2.zero : Mouse.current.position.ReadValue(); }
        }

        internal static bool Pressed
        {
            get { return Mouse.current != null && Mouse.current.leftButton.isPressed; }
        }

        /// <summary>Notches of the wheel since the last frame, up or down.</summary>
        internal static float Notches
        {
            get { return Mouse.current == null ? 0f : Mathf.Clamp(Mouse.current.scroll.ReadValue().y, -1f, 1f); }
        }
#else
        /// <summary>Pixels from the window's lower left corner.</summary>
        internal static Vector3 Position
        {
            get { return Input.mousePosition; }
        }

        internal static bool Pressed
        {
            get { return Input.GetMouseButton(0); }
        }

        /// <summary>Notches of the wheel since the last frame, up or down.</summary>
        internal static float Notches
        {
            get { return Mathf.Clamp(Input.mouseScrollDelta.y, -1f, 1f); }
        }
#endif
    }
}
