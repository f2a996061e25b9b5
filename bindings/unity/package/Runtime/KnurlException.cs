// SPDX-License-Identifier: MIT
using System;

namespace Knurl
{
    /// <summary>What Knurl could not do, in a sentence that names the thing, what was expected and what was
    /// found.</summary>
    public sealed class KnurlException : Exception
    {
        internal KnurlException(int code, string message) : base(message)
        {
            Code = code;
        }

        /// <summary>The result code of Knurl's C interface (sdk/include/knurl/base.h): negative, as -1 for an argument
        /// out of its range, -7 for a file that could not be read, -8 for one that does not hold what its format
        /// demands.</summary>
        public int Code { get; }

        /// <summary>Throws what went wrong in the latest call on this thread, unless its result is KNURL_OK.</summary>
        internal static unsafe void Check(int result)
        {
            if (result != NativeMethods.KNURL_OK)
            {
                throw new KnurlException(result, Utf8.Read(NativeMethods.knurl_error_message()));
            }
        }
    }
}
