// Events of a KnurlDevice since the last frame. Any handler may stop the device, restart it, or destroy it.
// SPDX-License-Identifier: MIT
using System;
using UnityEngine;
using UnityEngine.Events;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        [NonSerialized] ulong touchedId;      // as reported: in the session's scene, or 0
        [NonSerialized] KnurlSurface touched; // as reported: null also for a file's surface

        /// <summary>Reports the end of contact with a disabled surface immediately.</summary>
        internal void EndContactWith(KnurlSurface surface)
        {
            if (ReferenceEquals(touched, surface))
            {
                EndContact();
            }
        }

        unsafe void TellEvents()
        {
            int run = runs;
            knurl_session_event e;
            while (isRunning && run == runs && NativeMethods.knurl_session_next_event(session, &e) != 0)
            {
                switch (e.kind)
                {
                    case NativeMethods.KNURL_SESSION_CONTACT_STARTED:
                        Touch(e.surface);
                        break;
                    case NativeMethods.KNURL_SESSION_CONTACT_ENDED:
                        EndContact(); // does nothing if its surface was disabled: already reported
                        break;
                    case NativeMethods.KNURL_SESSION_BUTTON:
                        TellButton(e.code, e.value != 0.0);
                        break;
                    case NativeMethods.KNURL_SESSION_FAULT:
                        TellFault(e.code, e.value);
                        break;
                    case NativeMethods.KNURL_SESSION_ENDED:
                        StopDevice();
                        break;
                }
            }
        }

        /// <summary>Starts a contact. Handlers get null for a file's surface. They are not called for a surface that
        /// was removed
        /// meanwhile.</summary>
        unsafe void Touch(ulong id)
        {
            KnurlSurface surface = following.Find(id);
            if ((object)surface == null && NativeMethods.knurl_scene_has_surface(
                NativeMethods.knurl_session_get_scene(session), id) == 0)
            {
                return;
            }
            touchedId = id;
            touched = surface;
            Tell(contactStarted, surface);
            if (surface != null && touchedId == id) // a handler may have stopped the device, or destroyed the surface
            {
                Tell(surface.touched, this);
            }
        }

        void EndContact()
        {
            if (touchedId != 0)
            {
                KnurlSurface surface = touched;
                touchedId = 0;
                touched = null;
                Tell(contactEnded, surface);
                if ((object)surface != null)
                {
                    Tell(surface.released, this);
                }
            }
        }

        void Tell<T>(UnityEvent<T> what, T value)
        {
            try
            {
                what.Invoke(value);
            }
            catch (Exception e)
            {
                Debug.LogException(e, this);
            }
        }

        /// <summary>Reports the number of ridges since the last frame to the touched surface.</summary>
        void TellRidges()
        {
            double now = isRunning ? GetState().ridges : 0.0;
            int count = (int)Math.Min(int.MaxValue, now - ridges);
            if (count > 0)
            {
                KnurlSurface surface = touched;
                ridges = surface != null ? ridges + count : now;
                try
                {
                    if (surface != null)
                    {
                        surface.ridgesPassed.Invoke(this, count);
                    }
                }
                catch (Exception e)
                {
                    Debug.LogException(e, this);
                }
            }
        }

        void TellButton(int index, bool pressed)
        {
            try
            {
                buttonChanged.Invoke(index, pressed);
            }
            catch (Exception e)
            {
                Debug.LogException(e, this);
            }
        }

        void TellStartFailed(KnurlException failure)
        {
            try
            {
                startFailed.Invoke(failure.Code, failure.Message);
            }
            catch (Exception e)
            {
                Debug.LogException(e, this);
            }
        }

        unsafe void TellFault(int code, double value)
        {
            const int size = 256;
            byte* text = stackalloc byte[size];
            NativeMethods.knurl_session_fault_text(code, value, text, size);
            try
            {
                fault.Invoke(code, Utf8.Read(text));
            }
            catch (Exception e)
            {
                Debug.LogException(e, this);
            }
        }
    }
}
