// SPDX-License-Identifier: MIT
using UnityEngine;

namespace Knurl
{
    /// <summary>The mouse as a stylus, for people without a device: moves the device "mouse" over the surface under the
    /// pointer. The left button presses, the wheel sets the depth. On a curved surface it moves in the tangent plane at
    /// the middle. Main thread.</summary>
    [AddComponentMenu("Knurl/Knurl Mouse")]
    [HelpURL(Manual.Cursor)]
    [DisallowMultipleComponent]
    [RequireComponent(typeof(KnurlDevice))]
    public sealed class KnurlMouse : MonoBehaviour
    {
        const float Step = 0.0001f; // m per notch of the wheel

        [SerializeField, Tooltip("Which camera the pointer looks through. None: the main camera.")]
        Camera eye;

        [SerializeField, Min(0f), Tooltip("How high the HIP hovers while the button is up. m")]
        float hover = 0.004f;

        [SerializeField, Min(0f), Tooltip("How deep the left button presses; the wheel changes it. m")]
        float depth = 0.0006f;

        KnurlDevice device;
        Plane plane; // in which it moved in the last frame
        bool hasPlane;

        /// <summary>The camera of the pointer; null, the default: the main camera.</summary>
        public Camera Eye
        {
            get { return eye; }
            set { eye = value; }
        }

        /// <summary>Height of the HIP above the surface while the button is up (m). Default 0.004.</summary>
        public float Hover
        {
            get { return hover; }
            set { hover = value; }
        }

        /// <summary>Depth while the left button is down (m); the wheel changes it, up to 2 mm. Default
        /// 0.0006.</summary>
        public float Depth
        {
            get { return depth; }
            set { depth = value; }
        }

        void Reset()
        {
            GetComponent<KnurlDevice>().Device = "mouse";
        }

        void Update()
        {
            device = device == null ? GetComponent<KnurlDevice>() : device;
            Camera looking = eye == null ? Camera.main : eye;
            if (!device.Running || device.Device != "mouse" || looking == null)
            {
                return;
            }
            depth = Pointer.Notches == 0f ? depth : Mathf.Clamp(depth + Step * Pointer.Notches, Step, 20f * Step);
            Ray ray = looking.ScreenPointToRay(Pointer.Position);
            hasPlane |= device.FindPlane(ray, ref plane, hasPlane);
            float distance;
            if (hasPlane && plane.Raycast(ray, out distance))
            {
                device.MoveHip(ray.GetPoint(distance) + (Pointer.Pressed ? -depth : hover) * plane.normal);
            }
        }
    }
}
