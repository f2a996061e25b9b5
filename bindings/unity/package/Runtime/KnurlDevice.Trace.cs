// KnurlDevice.PlayTrace(): forces for positions, as fast as the machine can. SPDX-License-Identifier: MIT
using System;

namespace Knurl
{
    public sealed partial class KnurlDevice
    {
        const int MostTicks = 100000000;

        /// <summary>Renders the forces along a path on this thread, as fast as the machine can, on a device that does
        /// not run. Needs a fake device, play mode, and this component active and enabled.</summary>
        /// <param name="rows">Time (s, ascending), x, y, z (m, global) of one tick or more, interpolated linearly; the
        /// last position is held.</param>
        /// <param name="ticks">1 to 100,000,000.</param>
        /// <returns>The force of every tick: x, y, z (N, global). Null after an error, which goes to the
        /// console.</returns>
        public double[] PlayTrace(double[] rows, int ticks)
        {
            double[] forces = null;
            FinishOpening();
            if (isRunning)
            {
                Complain("PlayTrace", "expected a device that is stopped, found one that runs");
                return null;
            }
            try
            {
                CheckTrace(rows, ticks);
                Demand();
                Open();
                forces = Play(Mirror(rows), ticks);
            }
            catch (KnurlException e)
            {
                Complain("PlayTrace", e.Message);
            }
            Release();
            return forces;
        }

        static void CheckTrace(double[] rows, int ticks)
        {
            if (rows == null || rows.Length < 4 || rows.Length % 4 != 0)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_ARGUMENT, "rows: expected t, x, y, z of one tick or "
                    + "more, found " + (rows == null ? "null" : rows.Length + " numbers"));
            }
            if (ticks < 1 || ticks > MostTicks)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_ARGUMENT,
                    "ticks: expected 1 to " + MostTicks + ", found " + ticks);
            }
        }

        static double[] Mirror(double[] rows)
        {
            var scene = (double[])rows.Clone();
            for (int i = 1; i < scene.Length; i += 4)
            {
                scene[i] = -scene[i];
            }
            return scene;
        }

        unsafe double[] Play(double[] rows, int ticks)
        {
            ulong played = 0;
            double[] forces;
            try
            {
                forces = new double[3L * ticks];
            }
            catch (OutOfMemoryException)
            {
                throw new KnurlException(NativeMethods.KNURL_ERROR_MEMORY, "no memory for " + ticks + " forces");
            }
            fixed (double* path = rows, to = forces)
            {
                KnurlException.Check(NativeMethods.knurl_session_play(session, path, (ulong)rows.Length / 4,
                    (ulong)ticks, to, &played));
            }
            if ((int)played < ticks)
            {
                Array.Resize(ref forces, 3 * (int)played);
            }
            for (int i = 0; i < forces.Length; i += 3)
            {
                forces[i] = 0.0 - forces[i]; // no minus zero
            }
            return forces;
        }
    }
}
