// SPDX-License-Identifier: MIT
using UnityEditor;

namespace Knurl.Editing
{
    /// <summary>Stops every device before the editor destroys its objects: at the end of play mode, before scripts are
    /// reloaded, and when the editor quits.</summary>
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
