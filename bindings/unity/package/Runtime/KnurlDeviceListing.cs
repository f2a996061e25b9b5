// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>A device that a driver has found. See <see cref="KnurlDevice.ListDevices"/>.</summary>
    public struct KnurlDeviceListing
    {
        internal unsafe KnurlDeviceListing(knurl_device_listing* from)
        {
            Uri = Utf8.Read(from->uri);
            Name = Utf8.Read(from->name);
            Reason = Utf8.Read(from->reason);
        }

        /// <summary>What <see cref="KnurlDevice.Device"/> opens it with.</summary>
        public string Uri { get; }

        /// <summary>What it is, for people.</summary>
        public string Name { get; }

        /// <summary>Why it cannot be opened; "" where it can.</summary>
        public string Reason { get; }
    }
}
