// Checks that the native library is present and matches this package. SPDX-License-Identifier: MIT
using System;

namespace Knurl
{
    internal static unsafe class Library
    {
        const string Remedy = "install the package com.knurl.haptics anew, as a whole, and restart the editor (it "
            + "keeps a native library loaded until it ends)";

        static bool isChecked;
        static string wrong;
        static bool isMissing;

        /// <summary>Null if the library can be called, otherwise the reason and a remedy: then nothing else may be
        /// called. The result is cached; a failure is checked again after <see cref="ForgetFailure"/>.</summary>
        internal static string Check()
        {
            if (!isChecked)
            {
                wrong = Look();
                isChecked = true;
            }
            return wrong;
        }

        /// <summary>True if there is no library that this system could load: on a console, a phone, a page.</summary>
        internal static bool IsMissing
        {
            get { return Check() != null && isMissing; }
        }

        /// <summary>Throws the message of <see cref="Check"/>, if there is one.</summary>
        internal static void Demand()
        {
            if (Check() != null)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_UNSUPPORTED, wrong);
            }
        }

        /// <summary>Makes the next <see cref="Check"/> try again, because the library may have been installed
        /// since.</summary>
        internal static void ForgetFailure()
        {
            isChecked = isChecked && wrong == null;
        }

        static string Look()
        {
            isMissing = false;
            try
            {
                string found = Utf8.Read(NativeMethods.knurl_unity_interface());
                string version = Utf8.Read(NativeMethods.knurl_version_string());
                return found == NativeMethods.Interface && version == NativeMethods.Version
                    ? FindWrongSize() : Differs(version, found);
            }
            catch (EntryPointNotFoundException)
            {
                return Differs(FindVersion(), "none");
            }
            catch (DllNotFoundException)
            {
                return CannotLoad("it was not found, or a library that it needs was not");
            }
            catch (BadImageFormatException)
            {
                return CannotLoad("it is made for another processor");
            }
        }

        internal static string Differs(string version, string found)
        {
            return "The native library " + NativeMethods.Library + " is not the one of this package: expected Knurl "
                + NativeMethods.Version + " (interface " + NativeMethods.Interface + "), found Knurl " + version
                + " (interface " + found + "): " + Remedy + ".";
        }

        static string CannotLoad(string why)
        {
            isMissing = true;
            return "The native library " + NativeMethods.Library + " of Knurl " + NativeMethods.Version
                + " cannot be loaded (" + why + "). There is one for Windows and one for Linux, both on x86_64, in the "
                + "package's folder Plugins; where it is not there, " + Remedy + ".";
        }

        static string FindVersion()
        {
            try
            {
                return Utf8.Read(NativeMethods.knurl_version_string());
            }
            catch (EntryPointNotFoundException)
            {
                return "of no known version";
            }
        }

        /// <summary>Both sides were made from the same headers, but their compilers may lay out a struct
        /// differently.</summary>
        static string FindWrongSize()
        {
            knurl_unity_layout_row row;
            for (uint i = 0; NativeMethods.knurl_unity_layout(i, &row) != 0; i++)
            {
                string type = Utf8.Read(row.type);
                int size = row.field[0] == 0 ? NativeMethods.SizeOf(type) : 0;
                if (size != 0 && size != (int)row.size)
                {
                    return "The native library " + NativeMethods.Library + " (Knurl " + NativeMethods.Version
                        + ") lays " + type + " out in " + row.size + " bytes, this package's C# (Knurl "
                        + NativeMethods.Version + ") in " + size + ": " + Remedy + ".";
                }
            }
            return null;
        }
    }
}
