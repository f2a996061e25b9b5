// SPDX-License-Identifier: MIT
using System;
using Microsoft.Win32.SafeHandles;

namespace Knurl
{
    /// <summary>The sound of a session's run, which it may outlive.</summary>
    internal sealed unsafe class SoundHandle : SafeHandleZeroOrMinusOneIsInvalid
    {
        SoundHandle() : base(true) { }

        /// <summary>Errors: KNURL_ERROR_STATE (it does not run), KNURL_ERROR_ARGUMENT (rate, Hz).</summary>
        internal static SoundHandle Of(SessionHandle session, double rate)
        {
            var made = new SoundHandle();
            knurl_sound* sound;
            KnurlException.Check(NativeMethods.knurl_session_get_sound(session, rate, &sound));
            made.SetHandle((IntPtr)sound);
            return made;
        }

        /// <summary>False if it was disposed. [audio thread]</summary>
        internal bool Fill(float* samples, int count)
        {
            bool isHeld = false;
            try
            {
                DangerousAddRef(ref isHeld);
                NativeMethods.knurl_sound_fill((knurl_sound*)handle, samples, (uint)count);
                return true;
            }
            catch (ObjectDisposedException)
            {
                return false;
            }
            finally
            {
                if (isHeld)
                {
                    DangerousRelease();
                }
            }
        }

        /// <summary>bands: room for two numbers. False after an error. Main thread.</summary>
        internal bool GetRumble(double* bands)
        {
            return NativeMethods.knurl_sound_get_rumble((knurl_sound*)handle, bands) == NativeMethods.KNURL_OK;
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.knurl_sound_release((knurl_sound*)handle);
            return true;
        }
    }
}
