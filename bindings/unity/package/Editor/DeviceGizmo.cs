// SPDX-License-Identifier: MIT
using System.Collections.Generic;
using UnityEditor;
using UnityEngine;

namespace Knurl.Editing
{
    /// <summary>Draws a device in the scene view: its workspace and axes; while it runs, also the HIP, the proxy and
    /// the force.</summary>
    internal static class DeviceGizmo
    {
        const float Axis = 0.01f; // m of the device's
        const float Hip = 0.002f; // m of the device's: the ball's radius
        const float MetresPerNewton = 0.02f;
        static readonly Color Box = new Color(1.0f, 0.62f, 0.2f);
        static readonly Color Proxy = new Color(0.2f, 0.9f, 1.0f);

        /// <summary>m: the workspace of each device, by the scheme of its URI. A Touch's is its maker's figure, a
        /// Falcon's a cube of 4 inches; fake is a simulated Touch.</summary>
        static readonly Dictionary<string, Vector3> Reaches = new Dictionary<string, Vector3>
        {
            { "touch", new Vector3(0.160f, 0.120f, 0.070f) },
            { "falcon", new Vector3(0.1016f, 0.1016f, 0.1016f) },
            { "fake", new Vector3(0.160f, 0.120f, 0.070f) },
        };

        /// <summary>m of the device's motion; zero if it is unknown ("mouse": no limits).</summary>
        internal static Vector3 ReachOf(string uri)
        {
            Vector3 reach;
            bool known = Reaches.TryGetValue((uri ?? "").Split(':')[0], out reach);
            return known ? reach : Vector3.zero;
        }

        [DrawGizmo(GizmoType.Selected | GizmoType.NonSelected | GizmoType.Pickable)]
        static void Draw(KnurlDevice device, GizmoType type)
        {
            Gizmos.matrix = device.Workspace;
            Gizmos.color = Box;
            Gizmos.DrawWireCube(Vector3.zero, ReachOf(device.Device));
            DrawAxes();
            Gizmos.matrix = Matrix4x4.identity;
            if (device.Running)
            {
                DrawRun(device, device.Workspace.MultiplyVector(Vector3.right).magnitude);
            }
        }

        /// <summary>x to the right and y up, as in Unity; z towards the user, opposite to Unity's.</summary>
        static void DrawAxes()
        {
            Gizmos.color = Color.red;
            Gizmos.DrawLine(Vector3.zero, Axis * Vector3.right);
            Gizmos.color = Color.green;
            Gizmos.DrawLine(Vector3.zero, Axis * Vector3.up);
            Gizmos.color = Color.blue;
            Gizmos.DrawLine(Vector3.zero, Axis * Vector3.back);
        }

        /// <summary>scale: m of the scene per metre of the device's.</summary>
        static void DrawRun(KnurlDevice device, float scale)
        {
            Gizmos.color = Box;
            Gizmos.DrawSphere(device.HipPosition, Hip * scale);
            if (device.InContact)
            {
                Gizmos.color = Proxy;
                Gizmos.DrawWireSphere(device.ProxyPosition, Hip * scale);
                Gizmos.DrawLine(device.ProxyPosition, device.ProxyPosition + MetresPerNewton * scale * device.Force);
            }
        }
    }
}
