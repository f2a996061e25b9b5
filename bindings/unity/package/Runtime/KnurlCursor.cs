// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>Puts its object where a device feels: at the point of the surface that holds the stylus back, or at the
    /// stylus itself. Give it any mesh to be seen by. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Cursor")]
    [DefaultExecutionOrder(1001)] // after the devices
    [DisallowMultipleComponent]
    public sealed class KnurlCursor : MonoBehaviour
    {
        [SerializeField, Tooltip("Whose cursor it is. None: of the first device that runs.")]
        KnurlDevice device;

        [SerializeField, Tooltip("Whether it shows the stylus (the HIP), which goes into surfaces, and not the proxy, "
            + "which they hold back.")]
        bool showsHip;

        /// <summary>Whose cursor it is; null, the default: of the first device that runs.</summary>
        public KnurlDevice Device
        {
            get { return device; }
            set { device = value; }
        }

        /// <summary>Whether it shows the stylus (the HIP), which goes into surfaces, and not the proxy, which they hold
        /// back. Default false.</summary>
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
