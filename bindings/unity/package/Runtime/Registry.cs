// All surfaces and devices. SPDX-License-Identifier: MIT
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>Main thread. Statics outlive play mode where domains are not loaded anew: they are cleared before each
    /// one.</summary>
    internal static class Registry
    {
        /// <summary>Those that are enabled, in the order of enabling.</summary>
        internal static readonly List<KnurlSurface> Surfaces = new List<KnurlSurface>();

        /// <summary>Those that hold a session: they run, or have loaded a file.</summary>
        internal static readonly List<KnurlDevice> Devices = new List<KnurlDevice>();

        static bool isHooked;

        internal static void Add(KnurlSurface surface)
        {
            Surfaces.Add(surface);
            for (int i = 0; i < Devices.Count; i++)
            {
                Devices[i].Add(surface);
            }
        }

        /// <summary>Contacts with the surface end at once: in the next frame it may be destroyed. Handlers are called
        /// last, because they may add or remove devices and surfaces.</summary>
        internal static void Remove(KnurlSurface surface)
        {
            Surfaces.Remove(surface);
            for (int i = 0; i < Devices.Count; i++)
            {
                Devices[i].Drop(surface);
            }
            for (int i = Devices.Count - 1; i >= 0; i--)
            {
                if (i < Devices.Count)
                {
                    Devices[i].EndContactWith(surface);
                }
            }
        }

        /// <summary>Stops all devices and gives all that is native back: when the game ends; in the editor also when
        /// play mode is left and before scripts are loaded anew.</summary>
        internal static void StopAll()
        {
            for (int i = Devices.Count - 1; i >= 0; i--)
            {
                if (i < Devices.Count)
                {
                    Devices[i].StopAndFree();
                }
            }
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        internal static void Begin()
        {
            StopAll();
            Surfaces.Clear();
            Devices.Clear();
            Library.ForgetFailure();
            if (!isHooked)
            {
                isHooked = true;
                Application.quitting += StopAll;
            }
        }
    }
}
