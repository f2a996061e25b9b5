// A KnurlDevice's life: open, run, stop. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        // What runs does not survive a loading of scripts, so none of it may be kept by one.
        [NonSerialized] SessionHandle session; // while it runs; also between runs where a file was loaded
        [NonSerialized] Following following;   // as long as the session is open
        [NonSerialized] bool isRunning;
        [NonSerialized] bool hasFiles;
        [NonSerialized] bool isPaused; // by the application
        [NonSerialized] bool isNew; // nothing has started or stopped it since it was enabled
        [NonSerialized] bool hasFailed; // to start by itself
        [NonSerialized] float retryAt; // s, unscaled
        [NonSerialized] Vector3 impulse; // N s: of the run, as of the latest frame
        [NonSerialized] int runs;        // so far
        [NonSerialized] string deviceName;
        [NonSerialized] Vector3 latestPosition;       // where the workspace was told to be
        [NonSerialized] Quaternion latestRotation;
        [NonSerialized] float latestScale;
        [NonSerialized] Vector3 latestForce;          // as told to the run
        [NonSerialized] float latestGain;
        [NonSerialized] bool latestClutch;
        [NonSerialized] bool latestSound;
        [NonSerialized] double ridges;                // as told to the surfaces that were touched
        [NonSerialized] double framesTime, stepsTime; // s: how far the game's frames and physics steps have come

        /// <summary>Opens the device and starts to feel; nothing where it runs. Needs play mode, and this component
        /// active and enabled.</summary>
        /// <returns>Whether it runs. An error that says why not goes to the console.</returns>
        public bool StartDevice()
        {
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
                    impulse = Vector3.zero;
                }
                return null;
            }
            catch (KnurlException e)
            {
                Release();
                return e;
            }
        }

        /// <summary>Starts it for autostart and retries. A failure that repeats is reported once.</summary>
        void StartByItself()
        {
            KnurlException failure = TryStart();
            bool isFirst = failure != null && !hasFailed;
            hasFailed = failure != null;
            retryAt = Time.unscaledTime + retry;
            if (isFirst)
            {
                Complain("start", failure.Message);
                TellStartFailed(failure);
            }
        }

        /// <summary>Ramps the force down and closes the device. Twice is fine.</summary>
        public void StopDevice()
        {
            isNew = hasFailed = false;
            if (isRunning)
            {
                Release();
                EndContact(); // last: a handler finds a device that is stopped, and may start it
            }
        }

        /// <summary>Stops every device and gives back all that is native, for the editor.</summary>
        internal static void StopAll()
        {
            Registry.StopAll();
        }

        /// <summary>Stops it and gives back all that is native: what files brought, too.</summary>
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

        /// <summary>Opens the device first: where there is none, no mesh need be read.</summary>
        unsafe void Open()
        {
            knurl_session_desc desc;
            NeedSession();
            NativeMethods.knurl_session_desc_init(&desc, (uint)sizeof(knurl_session_desc));
            desc.reconnect = reconnect ? 1u : 0u;
            desc.clamp = clamp ? 1u : 0u;
            desc.update_rate_hz = rate;
            latestScale = workspaceScale;
            latestPosition = transform.position;
            latestRotation = transform.rotation;
            Axes.ToWorkspace(transform.position, transform.rotation, workspaceScale, &desc.workspace);
            fixed (byte* uri = Utf8.Bytes(device, "device"), hand = Utf8.Bytes(stroke, "stroke"))
            {
                desc.device = uri;
                desc.stroke = hand;
                KnurlException.Check(NativeMethods.knurl_session_open(session, &desc));
            }
            following = new Following(session, layers);
            following.Fill();
        }

        /// <summary>Tells the run what is another since the last frame; all of it at the start.</summary>
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

        /// <summary>The workspace goes where the object went, in the scale that was set.</summary>
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
            TellSettings(true);
            NativeMethods.knurl_device_info_init(&info, (uint)sizeof(knurl_device_info));
            NativeMethods.knurl_device_get_info(NativeMethods.knurl_session_get_device(session), &info);
            deviceName = Utf8.Read(info.name);
            if (warning[0] != 0)
            {
                Debug.LogWarning("KnurlDevice '" + name + "': " + Utf8.Read(warning), this);
            }
        }

        /// <summary>Closes the session without reporting its last events: that the contact ended is reported by <see
        /// cref="EndContact"/>.</summary>
        unsafe void Release()
        {
            knurl_session_event ignored;
            bool ran = isRunning;
            isRunning = false;
            if (ran)
            {
                PlaySound(); // no longer
            }
            if (session != null)
            {
                NativeMethods.knurl_session_close(session);
                while (NativeMethods.knurl_session_next_event(session, &ignored) != 0) { }
            }
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

        /// <summary>It starts in its first frame: all of the scene is there then, and settings that a script gives to a
        /// component that it has just added count.</summary>
        void Update()
        {
            bool isDue = isNew || (hasFailed && retry > 0f && Time.unscaledTime >= retryAt);
            isNew = false;
            if (isDue && autostart && !isRunning)
            {
                StartByItself();
            }
        }

        /// <summary>Pauses for the property, for the application, or for a time scale of 0.</summary>
        void Pause()
        {
            if (session != null)
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
                MoveWorkspace(); // before the end of a clutch: a scale that was set meanwhile is one about the HIP
                TellSettings(false);
                following.Follow(layers);
                React();
                TellEvents();
                TellRidges();
            }
        }

        /// <summary>The body of what is touched gets the opposite of the forces that the hand got since the last
        /// frame.</summary>
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

        /// <summary>In real time: a time scale changes how much of the game's a frame or a step is, not when it
        /// comes.</summary>
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
