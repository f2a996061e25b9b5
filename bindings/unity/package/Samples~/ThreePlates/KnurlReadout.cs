// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Samples
{
    /// <summary>Shows the state of the <see cref="KnurlDevice"/> beside it as text, and its last ticks as a plot.</summary>
    [RequireComponent(typeof(KnurlDevice))]
    public sealed class KnurlReadout : MonoBehaviour
    {
        KnurlDevice haptic;
        KnurlPlot plot;
        string fault = "";

        void Start()
        {
            haptic = GetComponent<KnurlDevice>();
            haptic.fault.AddListener((code, text) => fault = code < 32 ? text : ""); // 32 and up: recovered
            plot = new KnurlPlot();
        }

        void OnDestroy()
        {
            if (plot != null)
            {
                plot.Release();
            }
        }

        void Update()
        {
            plot.Draw(haptic);
        }

        void OnGUI()
        {
            GUI.Label(new Rect(20f, 16f, 600f, 24f), haptic.Running
                ? haptic.DeviceName + (haptic.Device == "mouse" ? "   press: left button, deeper: wheel" : "")
                : "no device is running: the console says why");
            GUI.Label(new Rect(20f, 40f, 600f, 24f), haptic.Touched == null ? "nothing is touched"
                : haptic.Touched.name + "   " + haptic.TemporalFrequency.ToString("F0") + " Hz   "
                + (1e3f * haptic.Height).ToString("F2") + " mm   " + haptic.Force.magnitude.ToString("F2") + " N");
            GUI.Label(new Rect(20f, 64f, 600f, 24f), fault);
            plot.Show(new Rect(20f, Screen.height - KnurlPlot.Height - 20f, KnurlPlot.Width, KnurlPlot.Height));
        }
    }
}
