// What a KnurlDevice's run is doing, and what is asked of it. SPDX-License-Identifier: MIT
using System;
using System.Collections.Generic;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        /// <summary>Whether the haptic thread runs.</summary>
        public bool Running
        {
            get { return isRunning; }
        }

        /// <summary>The haptic interaction point: where the device is, in the latest tick (m, global). Before the first
        /// tick, and while nothing runs: where this object is.</summary>
        public unsafe Vector3 HipPosition
        {
            get
            {
                knurl_session_state state = GetState();
                return state.ticks > 0 ? Axes.ToUnity(state.hip) : transform.position;
            }
        }

        /// <summary>The point of the surface that holds the haptic interaction point (m, global): where a cursor is
        /// drawn. Without contact the haptic interaction point.</summary>
        public unsafe Vector3 ProxyPosition
        {
            get
            {
                knurl_session_state state = GetState();
                return state.ticks > 0 ? Axes.ToUnity(state.proxy) : transform.position;
            }
        }

        /// <summary>The latest force (N, global).</summary>
        public unsafe Vector3 Force
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToUnity(state.force);
            }
        }

        /// <summary>Whether anything is touched, as of the latest frame: from <see cref="contactStarted"/> to <see
        /// cref="contactEnded"/>.</summary>
        public bool InContact
        {
            get { return touchedId != 0; }
        }

        /// <summary>What is touched, as of the latest frame; null for nothing, and for a surface of
        /// <see cref="LoadGltf"/>.</summary>
        public KnurlSurface Touched
        {
            get { return touched; }
        }

        /// <summary>The grating's height under the finger in the latest tick (m).</summary>
        public float Height => (float)GetState().height;

        /// <summary>Ridges a second that the motion asks for (Hz).</summary>
        public float TemporalFrequency => (float)GetState().temporal_frequency;

        /// <summary>How fast the haptic interaction point moves (m/s, global).</summary>
        public unsafe Vector3 Velocity
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToUnity(state.velocity);
            }
        }

        /// <summary>How deep the device is in what it touches (m).</summary>
        public float Depth => (float)GetState().depth;

        /// <summary>The device's buttons that are pressed, a bit each, as of the latest frame.</summary>
        public int Buttons => (int)GetState().buttons;

        /// <summary>How the stylus is turned (global), as of the latest frame, to draw one: contact is a point's. The
        /// identity with a device that does not measure it.</summary>
        public unsafe Quaternion StylusRotation
        {
            get
            {
                knurl_session_state state = GetState();
                return Axes.ToRotation(state.stylus);
            }
        }

        /// <summary>What is wrong with how it is set up: a sentence each. Empty where all is well.</summary>
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
            if (!string.IsNullOrEmpty(stroke) && !(device ?? "").StartsWith("fake", StringComparison.Ordinal))
            {
                warnings.Add("It has a stroke, which only the device fake has a hand for.");
            }
            return warnings.ToArray();
        }

        /// <summary>The devices that drivers find now, with why those that cannot be opened cannot. Takes a
        /// while.</summary>
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

        /// <summary>Ticks since the start.</summary>
        public long Ticks => (long)GetState().ticks;

        /// <summary>Ticks that came late, as of the latest frame.</summary>
        public long Overruns => (long)GetState().overruns;

        /// <summary>What the running device is, for people; "" while nothing runs.</summary>
        public string DeviceName
        {
            get { return isRunning ? deviceName : ""; }
        }

        /// <summary>Moves the haptic interaction point of the device "mouse"; nothing while another device runs, or
        /// none. What comes in steps is smoothed: it lags 25 ms behind. A position that is not finite is an error in
        /// the console.</summary>
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

        /// <summary>Adds a square wave to the force, as a cue, in place of one that plays. Bounded like <see
        /// cref="AddedForce"/>. What cannot be played is an error in the console.</summary>
        /// <param name="method">How its periods are made of whole ticks.</param>
        /// <param name="frequency">Hz, 0.1 to half of <see cref="Rate"/>.</param>
        /// <param name="amplitude">N, half peak to peak.</param>
        /// <param name="duration">s; 0 ends the one that plays.</param>
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

        /// <summary>Adds all surfaces that are tagged in the extras of a .gltf or .glb file, at the scene's origin,
        /// without any object; they stay as long as this component, and are told as null by its events. Play mode
        /// only.</summary>
        /// <param name="path">A file on the disk, also in a built game (as one in
        /// Application.streamingAssetsPath).</param>
        /// <returns>How many there were, or -1 after an error, which goes to the console.</returns>
        public unsafe int LoadGltf(string path)
        {
            try
            {
                knurl_gltf_report report;
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

        /// <summary>The latest ticks, oldest first, at most 8192: two numbers each, the grating's height (m) and the
        /// force along the normal (N).</summary>
        /// <param name="rows">Filled from its beginning: room for half as many ticks as it is long.</param>
        /// <returns>How many ticks there were; 0 while nothing runs.</returns>
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

        /// <summary>Everything that is counted: ticks, times, limits that took hold, memory. All zeros while nothing
        /// runs. For people who look for what is wrong; not for every frame.</summary>
        public KnurlStatus GetStatus()
        {
            return isRunning ? KnurlStatus.Of(session) : default(KnurlStatus);
        }

        /// <summary>Where the workspace lies, in device metres to global, but for what a clutch has moved it by. The
        /// object's scale does not count.</summary>
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
