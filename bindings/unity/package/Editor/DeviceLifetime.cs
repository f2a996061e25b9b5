// SPDX-License-Identifier: MIT
using UnityEditor;

namespace Knurl.Editing
{
    /// <summary>Lets go of every device before the editor quits. The end of play mode and the loading of scripts are
    /// looked after where devices are: by World.</summary>
    [InitializeOnLoad]
    internal static class DeviceLifetime
    {
        static DeviceLifetime()
        {
            EditorApplication.quitting += World.StopAll;
        }
    }
}
