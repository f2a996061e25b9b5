// Text to and from C. SPDX-License-Identifier: MIT
using System;
using System.Text;

namespace Knurl
{
    internal static unsafe class Utf8
    {
        /// <summary>UTF-8 with a zero at its end, to be pinned for a call; null counts as "". A zero within would
        /// silently cut the text, so it is an error that names <paramref name="what"/>.</summary>
        internal static byte[] Bytes(string text, string what)
        {
            text = text ?? "";
            if (text.IndexOf('\0') >= 0)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_ARGUMENT,
                    what + ": expected text without a zero character, found one at " + text.IndexOf('\0'));
            }
            var bytes = new byte[Encoding.UTF8.GetByteCount(text) + 1];
            Encoding.UTF8.GetBytes(text, 0, text.Length, bytes, 0);
            return bytes;
        }

        /// <summary>A C string; "" for null.</summary>
        internal static string Read(byte* text)
        {
            int length = 0;
            while (text != null && text[length] != 0)
            {
                length++;
            }
            return length == 0 ? "" : Encoding.UTF8.GetString(text, length);
        }
    }
}
