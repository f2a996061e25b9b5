// SPDX-License-Identifier: MIT
using System;
using Microsoft.Win32.SafeHandles;

namespace Knurl
{
    /// <summary>A device, its scene and its loop. The finalizer closes it if its owner did not, so that no haptic
    /// thread outlives the game.</summary>
    internal sealed class SessionHandle : SafeHandleZeroOrMinusOneIsInvalid
    {
        SessionHandle() : base(true) { }

        /// <summary>Creates a session with an empty scene. Errors: KNURL_ERROR_MEMORY.</summary>
        internal static unsafe SessionHandle Create()
        {
            var made = new SessionHandle();
            IntPtr session;
            KnurlException.Check(NativeMethods.knurl_session_create(&session));
            made.SetHandle(session);
            return made;
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.knurl_session_destroy(handle);
            return true;
        }
    }
}
