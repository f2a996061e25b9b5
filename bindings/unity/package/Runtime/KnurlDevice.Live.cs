// State and commands of a KnurlDevice's run. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        /// <summary>True while the haptic thread runs.</summary>
        public bool Running
        {
            get { return isRunning; }
        }

        /// <summary>The haptic interaction point: the device's position in the last tick (m, global). Before the first
        /// tick, and if the device does not run: this object's position.</summary>
        public unsafe Vector3 HipPosition
        {
            get
            {
                knurl_session_state state = GetState();
                return state.ticks > 0 ? Axes.ToUnity(state.hip) : transform.position;
            }
        }

        /// <summary>The surface point that holds the haptic interaction point (m, global): the place to draw a cursor.
        /// Without contact, the haptic interaction point.</summary>
        public unsafe Vector3 ProxyPosition
        {
            get
            {
                knurl_session_state state = GetState();
                return state.ticks > 0 ? Axes.ToUnity(state.proxy) : transform.position;
            }
        }

        /// <summary>The last force (N, global).</summary>
        public unsafe Vector3 Force
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToUnity(state.force);
            }
        }

        /// <summary>True if a surface was touched in the last frame: from <see cref="contactStarted"/> to <see
        /// cref="contactEnded"/>.</summary>
        public bool InContact
        {
            get { return touchedId != 0; }
        }

        /// <summary>The surface touched in the last frame; null if there is no contact, or for a surface of
        /// <see cref="LoadGltf"/>.</summary>
        public KnurlSurface Touched
        {
            get { return touched; }
        }

        /// <summary>The grating's height under the finger in the last tick (m).</summary>
        public float Height => (float)GetState().height;

        /// <summary>Ridges crossed per second at the current velocity (Hz).</summary>
        public float TemporalFrequency => (float)GetState().temporal_frequency;

        /// <summary>Velocity of the haptic interaction point (m/s, global).</summary>
        public unsafe Vector3 Velocity
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToUnity(state.velocity);
            }
        }

        /// <summary>Depth of the haptic interaction point below the touched surface (m).</summary>
        public float Depth => (float)GetState().depth;

        /// <summary>The pressed buttons, one bit each, as of the last frame.</summary>
        public int Buttons => (int)GetState().buttons;

        /// <summary>Rotation of the stylus (global), as of the last frame, for drawing; contact is computed for a
        /// point. The identity if the device does not measure it.</summary>
        public unsafe Quaternion StylusRotation
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToRotation(state.stylus);
            }
        }

        /// <summary>Problems with its settings, one sentence each. Empty if there are no problems.</summary>
        public string[] GetWarnings()
        {
            var warnings = new List<string>();
            if (Library.Check() != null)
            {
                warnings.Add(Library.Check());
            }
            if (!(workspaceScale > 0f))
            {
                warnings.Add("Its workspace scale is not above 0: it cannot start.");
            }
            if (string.IsNullOrEmpty(stroke) && device == "fake")
            {
                warnings.Add("Its simulated hand stands still and feels nothing unless a surface is where it is: choose a "
                    + "Stroke, for example sweep, or another Device.");
            }
            return warnings.ToArray();
        }

        /// <summary>Lists the devices that drivers find now, with the reason for those that cannot be opened. Takes
        /// some milliseconds.</summary>
        public static unsafe KnurlDeviceListing[] ListDevices()
        {
            Library.Demand();
            const int most = 16;
            knurl_device_listing* found = stackalloc knurl_device_listing[most];
            var listed = new KnurlDeviceListing[Math.Min(most, NativeMethods.knurl_device_list(found, most))];
            for (int i = 0; i < listed.Length; i++)
            {
                listed[i] = new KnurlDeviceListing(&found[i]);
            }
            return listed;
        }

        /// <summary>Number of ticks since the start.</summary>
        public long Ticks => (long)GetState().ticks;

        /// <summary>Number of late ticks, as of the last frame.</summary>
        public long Overruns => (long)GetState().overruns;

        /// <summary>Name of the running device, for display; "" if it does not run.</summary>
        public string DeviceName
        {
            get { return isRunning ? deviceName : ""; }
        }

        /// <summary>Moves the haptic interaction point of the device "mouse"; does nothing if another device or no
        /// device runs. Steps are smoothed, with a delay of 25 ms. A position that is not finite is an error in the
        /// console.</summary>
        /// <param name="global">m, global.</param>
        public unsafe void MoveHip(Vector3 global)
        {
            double* position = stackalloc double[3];
            Axes.ToScene(global, position);
            int result = isRunning ? NativeMethods.knurl_session_move_hip(session, position) : NativeMethods.KNURL_OK;
            if (result != NativeMethods.KNURL_OK && result != NativeMethods.KNURL_ERROR_STATE)
            {
                Complain("MoveHip", Utf8.Read(NativeMethods.knurl_error_message()));
            }
        }

        /// <summary>Adds a square wave to the force, as a cue, replacing the current one. Bounded like <see
        /// cref="AddedForce"/>. Invalid arguments are errors in the console.</summary>
        /// <param name="method">How its periods are composed of whole ticks.</param>
        /// <param name="frequency">Hz, 0.1 to half of <see cref="Rate"/>.</param>
        /// <param name="amplitude">N, half peak to peak.</param>
        /// <param name="duration">s; 0 stops the current one.</param>
        /// <param name="direction">Global, of any length above 0.</param>
        public unsafe void Vibrate(KnurlVibration method, float frequency, float amplitude, float duration,
            Vector3 direction)
        {
            double* along = stackalloc double[3];
            Axes.ToScene(direction, along);
            if (!isRunning)
            {
                Complain("Vibrate", "expected a device that runs, found one that does not");
                return;
            }
            Check("Vibrate", NativeMethods.knurl_session_vibrate(session, (int)method, frequency, amplitude, along,
                duration));
        }

        /// <summary>Adds all surfaces tagged in the extras of a .gltf or .glb file at the scene's origin, without
        /// objects; they exist as long as this component, and its events report them as null. Play mode only.</summary>
        /// <param name="path">A file on disk, also in a built game (for example in
        /// Application.streamingAssetsPath).</param>
        /// <returns>Their number, or -1 after an error, which goes to the console.</returns>
        public unsafe int LoadGltf(string path)
        {
            try
            {
                knurl_gltf_report report;
                FinishOpening();
                Demand();
                NeedSession();
                NativeMethods.knurl_gltf_report_init(&report, (uint)sizeof(knurl_gltf_report));
                fixed (byte* file = Utf8.Bytes(path, "path"))
                {
                    KnurlException.Check(NativeMethods.knurl_gltf_load_file(NativeMethods.knurl_session_get_scene(session),
                        file, null, &report));
                }
                hasFiles = true;
                return (int)report.surfaces;
            }
            catch (KnurlException e)
            {
                Complain("LoadGltf", e.Message);
                if (!isRunning)
                {
                    Release();
                }
                return -1;
            }
        }

        /// <summary>The last ticks, oldest first, at most 8192: two numbers each, the grating's height (m) and the
        /// force along the normal (N).</summary>
        /// <param name="rows">Filled from its start; half its length is the maximum number of ticks.</param>
        /// <returns>The number of ticks; 0 if it does not run.</returns>
        /// <exception cref="ArgumentNullException">rows is null.</exception>
        public unsafe int GetHistory(float[] rows)
        {
            if (rows == null)
            {
                throw new ArgumentNullException("rows");
            }
            if (!isRunning)
            {
                return 0;
            }
            fixed (float* to = rows)
            {
                return (int)NativeMethods.knurl_session_get_history(session, (uint)(rows.Length / 2), to);
            }
        }

        /// <summary>All counters: ticks, times, limits applied to the force, memory. All zeros if it does not run. For
        /// debugging, not for every frame.</summary>
        public KnurlStatus GetStatus()
        {
            return isRunning ? KnurlStatus.Of(session) : default(KnurlStatus);
        }

        /// <summary>Device metres to global, without the offset of a clutch. The object's scale is ignored.</summary>
        internal Matrix4x4 Workspace
        {
            get { return Matrix4x4.TRS(transform.position, transform.rotation, workspaceScale * Vector3.one); }
        }

        internal bool FindPlane(Ray ray, ref Plane plane, bool isKnown)
        {
            return isRunning && following.FindPlane(ray, ref plane, isKnown);
        }

        internal int CountTriangles(KnurlSurface surface)
        {
            return isRunning ? following.CountTriangles(surface) : 0;
        }

        internal void Forget(Mesh mesh)
        {
            if (following != null)
            {
                following.Forget(mesh);
            }
        }

        internal void Explain(KnurlSurface surface, List<string> warnings)
        {
            if (isRunning)
            {
                following.Explain(surface, warnings);
            }
        }

        unsafe knurl_session_state GetState()
        {
            var state = default(knurl_session_state);
            if (isRunning)
            {
                NativeMethods.knurl_session_get_state(session, &state);
            }
            return state;
        }
    }
}
