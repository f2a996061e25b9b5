// SPDX-License-Identifier: MIT
using UnityEditor;

namespace Knurl.Editing
{
    /// <summary>Stops every device before the editor takes away what it is made of: at the end of play mode,
    /// before scripts are loaded anew, and when the editor quits.</summary>
    [InitializeOnLoad]
    internal static class DeviceLifetime
    {
        static DeviceLifetime()
        {
            EditorApplication.playModeStateChanged += OnPlayModeStateChanged;
            AssemblyReloadEvents.beforeAssemblyReload += KnurlDevice.StopAll;
            EditorApplication.quitting += KnurlDevice.StopAll;
        }

        static void OnPlayModeStateChanged(PlayModeStateChange change)
        {
            if (change == PlayModeStateChange.ExitingPlayMode)
            {
                KnurlDevice.StopAll();
            }
        }
    }
}
