// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>Moves its object to a device's contact point on a surface, or to the stylus itself. Give the object a
    /// mesh to make it visible. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Cursor")]
    [HelpURL(Manual.Cursor)]
    [DefaultExecutionOrder(1001)] // after the devices
    [DisallowMultipleComponent]
    public sealed class KnurlCursor : MonoBehaviour
    {
        [SerializeField, Tooltip("Whose cursor it is. None: of the first device that runs.")]
        KnurlDevice device;

        [SerializeField, Tooltip("Whether it shows the stylus (the HIP), which goes into surfaces, and not the proxy, "
            + "which they hold back.")]
        bool showsHip;

        /// <summary>The device that it shows; null, the default: the first running device.</summary>
        public KnurlDevice Device
        {
            get { return device; }
            set { device = value; }
        }

        /// <summary>True: shows the stylus (the HIP), which enters surfaces; false, the default: the proxy, which stays
        /// on them.</summary>
        public bool ShowsHip
        {
            get { return showsHip; }
            set { showsHip = value; }
        }

        void LateUpdate()
        {
            KnurlDevice shown = device;
            for (int i = 0; shown == null && i < Registry.Devices.Count; i++)
            {
                shown = Registry.Devices[i].Running ? Registry.Devices[i] : null;
            }
            if (shown != null && shown.Running)
            {
                transform.position = showsHip ? shown.HipPosition : shown.ProxyPosition;
            }
        }
    }
}
