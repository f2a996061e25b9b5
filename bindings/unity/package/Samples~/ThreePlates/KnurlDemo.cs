// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl.Samples
{
    /// <summary>Three gratings side by side, felt with a device, or with the mouse if there is no device. Put it on an
    /// empty object of a new scene and press play: it creates everything else.</summary>
    public sealed class KnurlDemo : MonoBehaviour
    {
        [SerializeField, Tooltip("mouse, touch, falcon, rawhid, fake; where it does not start, the mouse takes over")]
        string device = "mouse";

        [SerializeField, Tooltip("Of the fake device's hand, over the first plate: line, sweep, circle, press or rest")]
        string stroke = "sweep";

        const float Ball = 0.003f; // m: the cursor's diameter
        static readonly Vector3 WorkspaceCentre = new Vector3(0f, 0.02f, 0f); // a Touch reaches 60 mm below it
        static readonly Vector3 Eye = new Vector3(0f, 0.102f, -0.078f);

        KnurlDevice haptic;

        /// <summary>The device that feels the plates.</summary>
        public KnurlDevice Haptic
        {
            get { return haptic; }
        }

        void Start()
        {
            KnurlPlates.Make(transform);
            PlaceCamera();
            haptic = MakeDevice();
            MakeBall("HIP", new Color(1f, 0.62f, 0.2f), Ball, true);
            MakeBall("Proxy", new Color(0.2f, 0.9f, 1f), 1.2f * Ball, false);
            if (!haptic.StartDevice() && device != "mouse") // the error was logged
            {
                haptic.Device = "mouse";
                haptic.StartDevice();
            }
        }

        KnurlDevice MakeDevice()
        {
            var holder = new GameObject("Haptic Device");
            holder.transform.SetParent(transform, false);
            holder.transform.localPosition = WorkspaceCentre;
            holder.SetActive(false); // so that it does not start before its device is set
            var made = holder.AddComponent<KnurlDevice>();
            made.Device = device;
            made.Stroke = stroke;
            made.Autostart = false;
            made.Sound = true;
            holder.AddComponent<KnurlMouse>(); // used if the device is the mouse
            holder.AddComponent<KnurlReadout>();
            holder.SetActive(true);
            return made;
        }

        void PlaceCamera()
        {
            Camera found = Camera.main;
            if (found == null)
            {
                found = new GameObject("Camera").AddComponent<Camera>();
            }
            found.nearClipPlane = 0.01f; // the scene is as small as a hand
            found.transform.position = transform.TransformPoint(Eye);
            found.transform.rotation = transform.rotation * Quaternion.LookRotation(-Eye, Vector3.up);
        }

        void MakeBall(string title, Color color, float diameter, bool showsHip)
        {
            GameObject made = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            made.name = title;
            made.transform.SetParent(transform, false);
            made.transform.localScale = diameter * Vector3.one;
            made.AddComponent<KnurlPaint>().Color = color;
            var cursor = made.AddComponent<KnurlCursor>();
            cursor.Device = haptic;
            cursor.ShowsHip = showsHip;
        }
    }
}
