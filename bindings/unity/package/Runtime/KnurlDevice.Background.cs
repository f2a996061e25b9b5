// Opening the device, and starting, stopping and listing without blocking a frame. SPDX-License-Identifier: MIT
using System;
using System.Threading.Tasks;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        /// <summary>A device that another thread opens; until that has ended, nothing else uses the session.</summary>
        sealed class Opening
        {
            internal Task<KnurlException> Work;
            internal bool IsRetry;
            internal readonly TaskCompletionSource<bool> Told = new TaskCompletionSource<bool>();
        }

        [NonSerialized] Opening opening;

        /// <summary>Starts it like <see cref="StartDevice"/>, but opens the device on another thread, so that no frame waits
        /// for it. It runs from one of the next frames on. A call that needs the device earlier waits.</summary>
        /// <returns>Done in the frame in which it runs (true) or its start has failed or was given up (false); an error goes
        /// to the console.</returns>
        public Task<bool> StartDeviceAsync()
        {
            hasFailed = false;
            KnurlException failure = isRunning ? null : TryOpen(false);
            if (failure != null)
            {
                Complain("start", failure.Message);
            }
            return opening != null ? opening.Told.Task : Task.FromResult(isRunning);
        }

        /// <summary>Stops it like <see cref="StopDevice"/>, but the force ramps down and the device is closed on another
        /// thread. For the game it is stopped at once. Blocks all the same with surfaces of <see cref="LoadGltf"/>, because
        /// they stay, and while <see cref="StartDeviceAsync"/> opens the device.</summary>
        /// <returns>Done once the device is closed.</returns>
        public Task StopDeviceAsync()
        {
            if (!isRunning || hasFiles)
            {
                StopDevice();
                return Task.FromResult(0);
            }
            SessionHandle closing = session;
            isNew = hasFailed = isRunning = false;
            PlaySound(); // stops it
            session = null;
            following = null; // its surfaces go with the scene
            givenCount = 0;
            DropRumble();
            Registry.Devices.Remove(this);
            Task<int> closed = Background.Run(() =>
            {
                closing.Dispose();
                return 0;
            });
            EndContact(); // last: handlers may start it
            return closed;
        }

        /// <summary>Lists the devices like <see cref="ListDevices"/>, on another thread.</summary>
        /// <exception cref="KnurlException">The native library is missing.</exception>
        public static Task<KnurlDeviceListing[]> ListDevicesAsync()
        {
            Library.Demand();
            return Background.Run(ListDevices);
        }

        /// <summary>Begins to open the device, unless that has begun. Returns why it cannot, or null.</summary>
        KnurlException TryOpen(bool isRetry)
        {
            isNew = false;
            if (opening != null)
            {
                opening.IsRetry &= isRetry;
                return null;
            }
            try
            {
                Demand();
                NeedSession();
                SessionHandle handle = session;
                SessionSettings settings = Describe();
                opening = new Opening { IsRetry = isRetry, Work = Background.Run(() => settings.TryOpen(handle)) };
                return null;
            }
            catch (KnurlException e)
            {
                retryAt = Time.unscaledTime + retry;
                Release();
                return e;
            }
        }

        /// <summary>Goes on with a device that is being opened; waits for it. Does nothing if there is none.</summary>
        void FinishOpening(bool isWanted = true)
        {
            Opening done = opening;
            if (done == null)
            {
                return;
            }
            KnurlException failure = done.Work.Result;
            opening = null;
            failure = failure ?? (isWanted ? TryBegin() : null);
            if (failure != null || !isWanted)
            {
                Release();
            }
            hasFailed = done.IsRetry && failure != null;
            retryAt = Time.unscaledTime + retry;
            if (failure != null && !done.IsRetry && isWanted)
            {
                Complain("start", failure.Message);
            }
            done.Told.SetResult(isRunning); // last: code that awaits it may run here
        }

        /// <summary>Starts the loop of a session that was opened. Returns why it cannot, or null.</summary>
        KnurlException TryBegin()
        {
            try
            {
                Follow();
                Begin();
                return null;
            }
            catch (KnurlException e)
            {
                return e;
            }
        }

        /// <summary>Opens the device first: if that fails, no mesh needs to be read.</summary>
        void Open()
        {
            NeedSession();
            SessionSettings settings = Describe();
            Background.Wait(); // it may be closing there
            KnurlException failure = settings.TryOpen(session);
            if (failure != null)
            {
                throw failure;
            }
            Follow();
        }

        unsafe SessionSettings Describe()
        {
            var settings = new SessionSettings
            {
                Device = Utf8.Bytes(device, "device"),
                Stroke = Utf8.Bytes(stroke, "stroke"),
                Response = evenSensation && responseFile != null ? responseFile.bytes : null,
            };
            if (settings.Response != null && settings.Response.Length == 0)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_FORMAT, "response: expected text, found an empty file");
            }
            latestScale = workspaceScale;
            latestPosition = transform.position;
            latestRotation = transform.rotation;
            fixed (knurl_session_desc* desc = &settings.Desc)
            {
                NativeMethods.knurl_session_desc_init(desc, (uint)sizeof(knurl_session_desc));
                desc->reconnect = reconnect ? 1u : 0u;
                desc->clamp = clamp ? 1u : 0u;
                desc->update_rate_hz = rate;
                desc->even = evenSensation ? 1u : 0u;
                Axes.ToWorkspace(latestPosition, latestRotation, workspaceScale, &desc->workspace);
            }
            return settings;
        }

        void Follow()
        {
            following = new Following(session, layers);
            following.Fill();
        }
    }
}
