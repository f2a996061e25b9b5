// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>A device found by a driver, or a kind without a device. See <see
    /// cref="KnurlDevice.ListDevices"/>.</summary>
    public struct KnurlDeviceListing
    {
        internal unsafe KnurlDeviceListing(knurl_device_listing* from)
        {
            Uri = Utf8.Read(from->uri);
            Name = Utf8.Read(from->name);
            Reason = Utf8.Read(from->reason);
        }

        /// <summary>The value of <see cref="KnurlDevice.Device"/> that opens it.</summary>
        public string Uri { get; }

        /// <summary>Name for display.</summary>
        public string Name { get; }

        /// <summary>Why it cannot be opened; "" if it can.</summary>
        public string Reason { get; }
    }
}
