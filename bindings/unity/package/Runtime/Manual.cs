// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>Addresses for the question mark of inspectors. package.sh fills in Page if the project has an address; without
    /// one, Help > Knurl Haptics opens the package's own copy.</summary>
    internal static class Manual
    {
        internal const string Page = "";

        internal const string Cursor = Page == "" ? "" : Page + "#knurlmouse-knurlcursor";
        internal const string Device = Page == "" ? "" : Page + "#knurldevice";
        internal const string Effect = Page == "" ? "" : Page + "#knurleffect";
        internal const string Grating = Page == "" ? "" : Page + "#knurlgrating";
        internal const string Rumble = Page == "" ? "" : Page + "#knurlrumble";
        internal const string Sound = Page == "" ? "" : Page + "#knurlsound";
        internal const string Stripes = Page == "" ? "" : Page + "#knurlstripes";
        internal const string Surface = Page == "" ? "" : Page + "#knurlsurface";
    }
}
