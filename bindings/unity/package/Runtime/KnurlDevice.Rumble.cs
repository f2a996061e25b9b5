// The force for a gamepad's motors. SPDX-License-Identifier: MIT
using System;
using UnityEngine;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        [NonSerialized] SoundHandle rumble; // of the run, once it was asked for

        /// <summary>The force as the strengths of two motors, 0 to 1: x for a gamepad's slow, heavy one (3 to 80 Hz), y for the
        /// fast, light one (above); a sine of 1 N gives 1. Zero if it does not run, in a pause, and after the game has hung for a
        /// quarter of a second.</summary>
        public unsafe Vector2 GetRumble()
        {
            double* bands = stackalloc double[2];
            if (!isRunning)
            {
                return Vector2.zero;
            }
            try
            {
                int rate = AudioSettings.outputSampleRate; // Hz; 0 if the game has no audio
                rumble = rumble ?? SoundHandle.Of(session, rate > 0 ? rate : 48000);
                return rumble.GetRumble(bands) ? new Vector2((float)bands[0], (float)bands[1]) : Vector2.zero;
            }
            catch (KnurlException e)
            {
                Complain("GetRumble", e.Message);
                return Vector2.zero;
            }
        }

        void DropRumble()
        {
            if (rumble != null)
            {
                rumble.Dispose();
                rumble = null;
            }
        }
    }
}
