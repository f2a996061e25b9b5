// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>How the periods of a vibration are composed of whole ticks. See <see
    /// cref="KnurlDevice.Vibrate"/>.</summary>
    public enum KnurlVibration
    {
        /// <summary>A sampled square wave: its mean need not be zero.</summary>
        T1 = 17,

        /// <summary>Two even periods mixed: the frequency is exact.</summary>
        T2 = 18,

        /// <summary>Whole events whose impulse is zero: it does not push the hand away.</summary>
        T3 = 19
    }
}
