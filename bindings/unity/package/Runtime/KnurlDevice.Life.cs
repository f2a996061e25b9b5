// A KnurlDevice's life: open, run, stop. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        // A run does not survive a reload of scripts, so its state must not be serialized.
        static bool isMissingTold;

        [NonSerialized] SessionHandle session; // while it runs; also between runs if a file was loaded
        [NonSerialized] Following following;   // as long as the session is open
        [NonSerialized] bool isRunning;
        [NonSerialized] bool hasFiles;
        [NonSerialized] bool isPaused; // by the application
        [NonSerialized] bool isNew; // it was not started or stopped since it was enabled
        [NonSerialized] bool hasFailed; // the last automatic start
        [NonSerialized] float retryAt; // s, unscaled
        [NonSerialized] Vector3 impulse; // N s: of the run, as of the last frame
        [NonSerialized] int runs;        // number so far
        [NonSerialized] string deviceName;
        [NonSerialized] Vector3 latestPosition;       // the workspace's last reported position
        [NonSerialized] Quaternion latestRotation;
        [NonSerialized] float latestScale;
        [NonSerialized] Vector3 latestForce;          // as set in the run
        [NonSerialized] float latestGain;
        [NonSerialized] bool latestClutch;
        [NonSerialized] bool latestSound;
        [NonSerialized] double ridges;                // already reported to the touched surfaces
        [NonSerialized] double framesTime, stepsTime; // s: time of the game's frames and physics steps

        /// <summary>Opens the device and starts its loop; does nothing if it runs. Needs play mode, and this component
        /// must be active and enabled.</summary>
        /// <returns>True if it runs; otherwise the error is logged to the console.</returns>
        public bool StartDevice()
        {
            FinishOpening();
            hasFailed = false;
            KnurlException failure = TryStart();
            if (failure != null)
            {
                Complain("start", failure.Message);
            }
            return isRunning;
        }

        /// <summary>Starts it unless it runs. Returns why it cannot start, or null.</summary>
        KnurlException TryStart()
        {
            isNew = false;
            try
            {
                if (!isRunning)
                {
                    Demand();
                    Open();
                    Begin();
                }
                return null;
            }
            catch (KnurlException e)
            {
                Release();
                return e;
            }
        }

        /// <summary>Starts it for autostart.</summary>
        void StartByItself()
        {
            KnurlException failure = TryStart();
            bool isMissing = failure != null && Library.IsMissing && !Application.isEditor;
            hasFailed = failure != null && !isMissing; // no retry brings a library
            retryAt = Time.unscaledTime + retry;
            if (isMissing)
            {
                TellMissing();
            }
            else if (failure != null)
            {
                Complain("start", failure.Message);
            }
            if (failure != null)
            {
                TellStartFailed(failure);
            }
        }

        /// <summary>A game on a system for which there is no library goes on without haptics.</summary>
        static void TellMissing()
        {
            if (!isMissingTold)
            {
                isMissingTold = true;
                Debug.Log("Knurl: there is no library for this system: the game goes on without haptics.");
            }
        }

        /// <summary>Ramps the force down and closes the device. Does nothing if it does not run.</summary>
        public void StopDevice()
        {
            FinishOpening(false);
            isNew = hasFailed = false;
            if (isRunning)
            {
                Release();
                EndContact(); // last: handlers find a stopped device, and may start it
            }
        }

        /// <summary>Stops every device and frees all native objects, for the editor.</summary>
        internal static void StopAll()
        {
            Registry.StopAll();
        }

        /// <summary>Stops it and frees all native objects, including surfaces from files.</summary>
        internal void StopAndFree()
        {
            StopDevice();
            hasFiles = false;
            Release();
        }

        internal void Add(KnurlSurface surface)
        {
            if (following != null)
            {
                following.Add(surface);
            }
        }

        internal void Drop(KnurlSurface surface)
        {
            if (following != null)
            {
                following.Drop(surface);
            }
        }

        void Demand()
        {
            Library.Demand();
            if (!Application.isPlaying || !isActiveAndEnabled)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_STATE, Application.isPlaying
                    ? "expected a component that is active and enabled, found one that is not"
                    : "expected play mode, found edit mode: devices run in a running game");
            }
        }

        void NeedSession()
        {
            if (session == null)
            {
                session = SessionHandle.Create();
                Registry.Devices.Add(this);
            }
        }

        /// <summary>Passes settings to the run that changed since the last frame; all of them at the start.</summary>
        unsafe void TellSettings(bool all)
        {
            float wanted = Mathf.Clamp01(gain);
            double* force = stackalloc double[3];
            if (all || wanted != latestGain)
            {
                latestGain = wanted;
                NativeMethods.knurl_session_set_gain(session, wanted);
            }
            if (all || !Axes.IsSame(addedForce, latestForce))
            {
                latestForce = addedForce;
                Axes.ToScene(addedForce, force);
                Check("AddedForce", NativeMethods.knurl_session_set_force(session, force));
            }
            if (all || clutch != latestClutch)
            {
                latestClutch = clutch;
                NativeMethods.knurl_session_set_clutch(session, clutch ? 1u : 0u);
            }
            if (all || sound != latestSound)
            {
                latestSound = sound;
                PlaySound();
            }
        }

        void PlaySound()
        {
            KnurlSound player = GetComponent<KnurlSound>();
            if (!isRunning || !sound)
            {
                if (player != null)
                {
                    player.Stop();
                }
                return;
            }
            try
            {
                (player != null ? player : gameObject.AddComponent<KnurlSound>()).Play(session);
            }
            catch (KnurlException e)
            {
                Complain("Sound", e.Message);
            }
        }

        /// <summary>Moves the workspace with the object, and sets its scale.</summary>
        unsafe void MoveWorkspace()
        {
            Vector3 position = transform.position;
            Quaternion rotation = transform.rotation;
            knurl_workspace to;
            if (Axes.IsSame(position, latestPosition) && rotation.Equals(latestRotation)
                && workspaceScale.Equals(latestScale))
            {
                return;
            }
            latestScale = workspaceScale;
            latestPosition = position;
            latestRotation = rotation;
            Axes.ToWorkspace(position, rotation, workspaceScale, &to);
            uint clock = (uint)(Following.IsMovedBySteps(this) ? NativeMethods.KNURL_SESSION_STEPS
                : NativeMethods.KNURL_SESSION_FRAMES);
            Check("move", NativeMethods.knurl_session_move_workspace(session, clock, &to));
        }

        unsafe void Check(string what, int result)
        {
            if (result != NativeMethods.KNURL_OK)
            {
                Complain(what, Utf8.Read(NativeMethods.knurl_error_message()));
            }
        }

        unsafe void Begin()
        {
            const int size = 1024;
            knurl_device_info info;
            byte* warning = stackalloc byte[size];
            Pause();
            KnurlException.Check(NativeMethods.knurl_session_start(session, warning, size));
            isRunning = true;
            runs++;
            ridges = 0.0;
            impulse = Vector3.zero;
            TellSettings(true);
            NativeMethods.knurl_device_info_init(&info, (uint)sizeof(knurl_device_info));
            NativeMethods.knurl_device_get_info(NativeMethods.knurl_session_get_device(session), &info);
            deviceName = Utf8.Read(info.name);
            if (warning[0] != 0)
            {
                Debug.LogWarning("KnurlDevice '" + name + "': " + Utf8.Read(warning), this);
            }
        }

        /// <summary>Closes the session without reporting its last events: <see cref="EndContact"/> reports the end of a
        /// contact.</summary>
        unsafe void Release()
        {
            knurl_session_event ignored;
            bool ran = isRunning;
            isRunning = false;
            if (ran)
            {
                PlaySound(); // stops it
            }
            if (session != null)
            {
                NativeMethods.knurl_session_close(session);
                while (NativeMethods.knurl_session_next_event(session, &ignored) != 0) { }
            }
            DropEffects();
            DropRumble();
            if (following != null)
            {
                following.Clear();
                following = null;
            }
            if (session != null && !hasFiles)
            {
                session.Dispose();
                session = null;
                Registry.Devices.Remove(this);
            }
        }

        void OnEnable()
        {
            isPaused = false; // a disabled component is not told when a pause ends
            isNew = true;
            hasFailed = false;
        }

        /// <summary>It starts in its first frame, when the scene is complete and a script that added the component has
        /// set its properties.</summary>
        void Update()
        {
            if (opening != null && opening.Work.IsCompleted)
            {
                FinishOpening();
            }
            bool isFirst = isNew, isRetry = hasFailed && retry > 0f && Time.unscaledTime >= retryAt;
            isNew = false;
            if (isFirst && autostart && !isRunning && opening == null)
            {
                StartByItself();
            }
            else if (isRetry && autostart && !isRunning)
            {
                TryOpen(true); // a driver that searches may take longer than a frame
            }
        }

        /// <summary>Pauses for the property, for the application, or for a time scale of 0.</summary>
        void Pause()
        {
            if (session != null && opening == null)
            {
                bool all = paused || isPaused || Time.timeScale == 0f;
                NativeMethods.knurl_session_set_paused(session, all ? 1u : 0u);
            }
        }

        /// <summary>knurl_unity_update() also resets the watchdog: without frames it zeroes the force.</summary>
        void LateUpdate()
        {
            if (isRunning)
            {
                Pause();
                NativeMethods.knurl_unity_update(session);
                TellTime();
                MoveWorkspace(); // before the end of a clutch: a scale set meanwhile zooms about the HIP
                TellSettings(false);
                following.Follow(layers);
                TellEffects();
                React();
                TellEvents();
                TellRidges();
            }
        }

        /// <summary>Applies the opposite of the hand's forces since the last frame to the touched surface's
        /// body.</summary>
        unsafe void React()
        {
            knurl_session_state state = GetState();
            Vector3 now = Axes.ToUnity(state.impulse);
            Vector3 given = impulse - now;
            impulse = now;
            Rigidbody body = touched != null && touched.Reaction ? touched.GetComponentInParent<Rigidbody>() : null;
            if (body != null && given != Vector3.zero)
            {
                body.AddForceAtPosition(given, Axes.ToUnity(state.proxy), ForceMode.Impulse);
            }
        }

        void FixedUpdate()
        {
            stepsTime += Time.fixedDeltaTime / Time.timeScale; // with a time scale of 0 there are no steps
        }

        /// <summary>In real time: a time scale changes the game time of a frame or a step, not the moment when it
        /// happens.</summary>
        void TellTime()
        {
            framesTime += Time.unscaledDeltaTime;
            NativeMethods.knurl_session_tell_time(session, NativeMethods.KNURL_SESSION_FRAMES, framesTime);
            NativeMethods.knurl_session_tell_time(session, NativeMethods.KNURL_SESSION_STEPS, stepsTime);
        }

        void OnApplicationPause(bool pause)
        {
            isPaused = pause;
            Pause();
        }

        void OnDisable()
        {
            StopDevice();
        }

        void OnDestroy()
        {
            StopAndFree();
        }
    }
}
