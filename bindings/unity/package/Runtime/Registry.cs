// All surfaces, effects and devices. SPDX-License-Identifier: MIT
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    /// <summary>Main thread. Without a domain reload, statics outlive play mode: they are cleared before it
    /// starts.</summary>
    internal static class Registry
    {
        /// <summary>The enabled surfaces, in the order of enabling.</summary>
        internal static readonly List<KnurlSurface> Surfaces = new List<KnurlSurface>();

        /// <summary>The devices with a session: they run, or have loaded a file.</summary>
        internal static readonly List<KnurlDevice> Devices = new List<KnurlDevice>();

        /// <summary>The enabled effects, in the order of enabling: the library knows them by their index.</summary>
        internal static readonly List<KnurlEffect> Effects = new List<KnurlEffect>();

        static bool isHooked;

        internal static void Add(KnurlSurface surface)
        {
            Surfaces.Add(surface);
            for (int i = 0; i < Devices.Count; i++)
            {
                Devices[i].Add(surface);
            }
        }

        /// <summary>Ends contacts with the surface immediately, because it may be destroyed in the next frame. Calls
        /// handlers last, because they may add or remove devices and surfaces.</summary>
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

        /// <summary>Stops all devices and frees all native objects: when the game ends; in the editor also at the end
        /// of play mode and before scripts are reloaded.</summary>
        internal static void StopAll()
        {
            for (int i = Devices.Count - 1; i >= 0; i--)
            {
                if (i < Devices.Count)
                {
                    Devices[i].StopAndFree();
                }
            }
            Background.Wait();
        }

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.SubsystemRegistration)]
        internal static void Begin()
        {
            StopAll();
            Surfaces.Clear();
            Effects.Clear();
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
