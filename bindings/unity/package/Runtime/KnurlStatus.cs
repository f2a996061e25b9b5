// SPDX-License-Identifier: MIT
namespace Knurl
{
    /// <summary>Everything that a device's run counts, since its start; all zeros while it does not run. For people who
    /// look for what is wrong.</summary>
    public struct KnurlStatus
    {
        /// <summary>Whether the haptic thread runs.</summary>
        public bool Running;

        /// <summary>Ticks made.</summary>
        public long Ticks;

        /// <summary>Ticks that came late, by more than half a period.</summary>
        public long Overruns;

        /// <summary>Times the watchdog zeroed the force, because the haptic thread stalled.</summary>
        public long Watchdogs;

        /// <summary>Ticks left out because the device was lost or gave no position that can be trusted.</summary>
        public long Absences;

        /// <summary>Whether such was the latest one.</summary>
        public bool Absent;

        /// <summary>Whether the haptic thread has the system's real-time priority.</summary>
        public bool Realtime;

        /// <summary>Whether what a tick needs is locked into RAM.</summary>
        public bool MemoryLocked;

        /// <summary>How long the computation of a tick took, median (us).</summary>
        public double TickUsP50;

        /// <summary>How long the computation of a tick took, 99th percentile (us).</summary>
        public double TickUsP99;

        /// <summary>How long the computation of a tick took at most (us).</summary>
        public double TickUsMax;

        /// <summary>How late ticks began, median (us).</summary>
        public double JitterUsP50;

        /// <summary>How late ticks began, 99th percentile (us).</summary>
        public double JitterUsP99;

        /// <summary>How late ticks began at most (us).</summary>
        public double JitterUsMax;

        /// <summary>The longest force that the device can play (N).</summary>
        public double MaxForce;

        /// <summary>Whether the device is gone.</summary>
        public bool Lost;

        /// <summary>Whether the force was zeroed and nothing has taken the device up again.</summary>
        public bool Halted;

        /// <summary>Faults reported, with the news that all is well again.</summary>
        public long Faults;

        /// <summary>Ticks in contact.</summary>
        public long ContactTicks;

        /// <summary>Vibration events started (method S2) or ridges begun (Bandlimited).</summary>
        public long Events;

        /// <summary>Ridges and grooves that the HIP passed, with every method, not rounded.</summary>
        public double HalfCyclesCrossed;

        /// <summary>Half cycles of the gratings' square waves that were played.</summary>
        public long HalfCyclesPlayed;

        /// <summary>Ticks whose force was shortened to <see cref="MaxForce"/>.</summary>
        public long ForceLimitTicks;

        /// <summary>Ticks whose motion asked for a frequency above half the rate.</summary>
        public long AboveNyquistTicks;

        /// <summary>Ticks whose position or force was not a number.</summary>
        public long NonFiniteTicks;

        /// <summary>Ticks in which a wall that was suddenly there came in as a ramp.</summary>
        public long EntryTicks;

        /// <summary>Ticks whose force was kept from jumping.</summary>
        public long SlewTicks;

        /// <summary>Ticks whose force was shortened to what warm motors can hold.</summary>
        public long HeatTicks;

        /// <summary>Ticks whose force was shortened because a wall gave out more energy than was put in.</summary>
        public long PassivityTicks;

        /// <summary>Ticks in which two surfaces closed in on the HIP, so that one of them no longer holds it.</summary>
        public long SqueezedTicks;

        /// <summary>Ticks that met the limit of what contact looks at: the scene is too crowded there, or a
        /// grating's amplitude too great for its mesh.</summary>
        public long VisitLimitTicks;

        /// <summary>The longest force played (N).</summary>
        public double ForceMax;

        /// <summary>How warm the motors are, by a model: 0 cold to 1, as warm as they may get in the long
        /// run.</summary>
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
