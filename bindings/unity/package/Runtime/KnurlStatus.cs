// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>All counters of a device's run since its start; all zeros if it does not run. For debugging.</summary>
    public struct KnurlStatus
    {
        /// <summary>True while the haptic thread runs.</summary>
        public bool Running;

        /// <summary>Number of ticks.</summary>
        public long Ticks;

        /// <summary>Ticks that were late by more than half a period.</summary>
        public long Overruns;

        /// <summary>Number of times that the watchdog zeroed the force because the haptic thread stalled.</summary>
        public long Watchdogs;

        /// <summary>Ticks without a valid position, because the device was lost or its position was rejected.</summary>
        public long Absences;

        /// <summary>True if the last tick was one of these.</summary>
        public bool Absent;

        /// <summary>True if the haptic thread has the system's real-time priority.</summary>
        public bool Realtime;

        /// <summary>True if the memory that a tick uses is locked into RAM.</summary>
        public bool MemoryLocked;

        /// <summary>Computation time of a tick, median (us).</summary>
        public double TickUsP50;

        /// <summary>Computation time of a tick, 99th percentile (us).</summary>
        public double TickUsP99;

        /// <summary>Computation time of a tick, maximum (us).</summary>
        public double TickUsMax;

        /// <summary>Lateness of ticks, median (us).</summary>
        public double JitterUsP50;

        /// <summary>Lateness of ticks, 99th percentile (us).</summary>
        public double JitterUsP99;

        /// <summary>Lateness of ticks, maximum (us).</summary>
        public double JitterUsMax;

        /// <summary>The maximum force of the device (N).</summary>
        public double MaxForce;

        /// <summary>True if the device is lost.</summary>
        public bool Lost;

        /// <summary>True if the force was zeroed and has not resumed.</summary>
        public bool Halted;

        /// <summary>Reported faults, including recoveries.</summary>
        public long Faults;

        /// <summary>Ticks in contact.</summary>
        public long ContactTicks;

        /// <summary>Vibration events started (method S2) or ridges started (Bandlimited).</summary>
        public long Events;

        /// <summary>Ridges and grooves that the HIP passed, with every method, not rounded.</summary>
        public double HalfCyclesCrossed;

        /// <summary>Half cycles of the gratings' square waves that were played.</summary>
        public long HalfCyclesPlayed;

        /// <summary>Ticks whose force was reduced to <see cref="MaxForce"/>.</summary>
        public long ForceLimitTicks;

        /// <summary>Ticks whose temporal frequency was above half the rate.</summary>
        public long AboveNyquistTicks;

        /// <summary>Ticks whose position or force was not finite.</summary>
        public long NonFiniteTicks;

        /// <summary>Ticks in which the force of a wall that appeared suddenly was ramped up.</summary>
        public long EntryTicks;

        /// <summary>Ticks in which the slew limit held the force back.</summary>
        public long SlewTicks;

        /// <summary>Ticks whose force was reduced because the motors were warm.</summary>
        public long HeatTicks;

        /// <summary>Ticks whose force was reduced because a wall returned more energy than it received.</summary>
        public long PassivityTicks;

        /// <summary>Ticks in which two surfaces closed in on the HIP, so that one of them no longer holds it.</summary>
        public long SqueezedTicks;

        /// <summary>Ticks that reached the limit of contact search: the scene is too crowded there, or a grating's
        /// amplitude is too large for its mesh.</summary>
        public long VisitLimitTicks;

        /// <summary>The largest force played (N).</summary>
        public double ForceMax;

        /// <summary>Temperature of the motors, by a model: 0: cold, 1: the limit for continuous use.</summary>
        public double Heat;

        /// <summary>Surfaces in the scene.</summary>
        public long Surfaces;

        /// <summary>Memory that the scene holds (bytes).</summary>
        public long SceneBytes;

        internal static unsafe KnurlStatus Of(SessionHandle session)
        {
            var status = new KnurlStatus { Running = true };
            status.TellLoop(NativeMethods.knurl_session_get_loop(session));
            status.TellDevice(NativeMethods.knurl_session_get_device(session));
            status.TellHip(NativeMethods.knurl_session_get_scene(session));
            return status;
        }

        unsafe void TellLoop(knurl_loop* loop)
        {
            knurl_loop_stats stats;
            NativeMethods.knurl_loop_stats_init(&stats, (uint)sizeof(knurl_loop_stats));
            NativeMethods.knurl_loop_get_stats(loop, &stats);
            Ticks = (long)stats.ticks;
            Overruns = (long)stats.overruns;
            Watchdogs = (long)stats.watchdog_trips;
            Absences = (long)stats.absences;
            Absent = stats.absent != 0;
            Realtime = stats.realtime != 0;
            MemoryLocked = stats.memory_locked != 0;
            TickUsP50 = 1e-3 * stats.tick_ns.p50;
            TickUsP99 = 1e-3 * stats.tick_ns.p99;
            TickUsMax = 1e-3 * stats.tick_ns.max;
            JitterUsP50 = 1e-3 * stats.jitter_ns.p50;
            JitterUsP99 = 1e-3 * stats.jitter_ns.p99;
            JitterUsMax = 1e-3 * stats.jitter_ns.max;
        }

        unsafe void TellDevice(knurl_device* device)
        {
            knurl_device_info info;
            knurl_device_status now;
            NativeMethods.knurl_device_info_init(&info, (uint)sizeof(knurl_device_info));
            NativeMethods.knurl_device_status_init(&now, (uint)sizeof(knurl_device_status));
            NativeMethods.knurl_device_get_info(device, &info);
            NativeMethods.knurl_device_get_status(device, &now);
            MaxForce = info.max_force;
            Lost = now.lost != 0;
            Halted = now.halted != 0;
            Faults = (long)now.events;
        }

        unsafe void TellHip(knurl_scene* scene)
        {
            var counts = default(knurl_hip_counts);
            NativeMethods.knurl_scene_get_tick(scene, 0, null, &counts);
            ContactTicks = (long)counts.contact_ticks;
            Events = (long)counts.events;
            HalfCyclesCrossed = counts.half_cycles_crossed;
            HalfCyclesPlayed = (long)counts.half_cycles_played;
            ForceLimitTicks = (long)counts.force_limit_ticks;
            AboveNyquistTicks = (long)counts.above_nyquist_ticks;
            NonFiniteTicks = (long)counts.non_finite_ticks;
            EntryTicks = (long)counts.entry_ticks;
            SlewTicks = (long)counts.slew_ticks;
            HeatTicks = (long)counts.heat_ticks;
            PassivityTicks = (long)counts.passivity_ticks;
            SqueezedTicks = (long)counts.squeezed_ticks;
            VisitLimitTicks = (long)counts.visit_limit_ticks;
            ForceMax = counts.force_max;
            Heat = counts.heat;
            Surfaces = NativeMethods.knurl_scene_get_surface_count(scene);
            SceneBytes = (long)NativeMethods.knurl_scene_get_bytes(scene);
        }
    }
}
