// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>The settings with which a session opens its device, for any thread.</summary>
    internal sealed unsafe class SessionSettings
    {
        internal knurl_session_desc Desc; // its pointers are set by TryOpen
        internal byte[] Device;           // UTF-8, ends with 0
        internal byte[] Stroke;           // the same
        internal byte[] Response;         // a file's content, or null

        /// <summary>Nothing else may use the session meanwhile. Returns why it cannot be opened, or null.</summary>
        internal KnurlException TryOpen(SessionHandle session)
        {
            try
            {
                knurl_session_desc desc = Desc;
                fixed (byte* device = Device, stroke = Stroke, response = Response)
                {
                    desc.device = device;
                    desc.stroke = stroke;
                    desc.response = response;
                    desc.response_size = Response != null ? (ulong)Response.Length : 0ul;
                    KnurlException.Check(NativeMethods.knurl_session_open(session, &desc)); // the message is the thread's
                }
                return null;
            }
            catch (KnurlException e)
            {
                return e;
            }
        }
    }
}
