// SPDX-License-Identifier: MIT
using System;

namespace Knurl
{
    /// <summary>An error of Knurl. The message names the object, the expected value and the one found.</summary>
    public sealed class KnurlException : Exception
    {
        internal KnurlException(int code, string message) : base(message)
        {
            Code = code;
        }

        /// <summary>The result code of Knurl's C interface (sdk/include/knurl/base.h): negative, for example -1: an
        /// argument is out of range; -7: a file could not be read; -8: a file is invalid in its format.</summary>
        public int Code { get; }

        /// <summary>Throws the error of the last call on this thread, unless its result is KNURL_OK.</summary>
        internal static unsafe void Check(int result)
        {
            if (result != NativeMethods.KNURL_OK)
            {
                throw new KnurlException(result, Utf8.Read(NativeMethods.knurl_error_message()));
            }
        }
    }
}
