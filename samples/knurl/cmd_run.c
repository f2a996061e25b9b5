/* knurl run: loads a scene, strokes it with a device or a simulated hand, and summarises the run.
 * SPDX-License-Identifier: MIT */
#include "os.h"
#include "run.h"

#include <math.h>
#include <signal.h>
#include <time.h>

static volatile sig_atomic_t interrupted; /* by this signal */

static void on_signal(int number) {
    interrupted = number;
}

static void show_progress(const run *r, double seconds) {
    knurl_tick_output now;
    knurl_hip_counts counts;
    if (knurl_scene_get_tick(r->scene, 0, &now, &counts) == KNURL_OK && counts.ticks > 0) {
        say_progress("%5.1f of %.1f s   in contact %3.0f %%   %5.0f Hz   force %5.2f N ", seconds,
                     (double)r->ticks / r->options.rate, 100.0 * (double)counts.contact_ticks / (double)counts.ticks,
                     now.temporal_frequency,
                     sqrt(now.force[0] * now.force[0] + now.force[1] * now.force[1] + now.force[2] * now.force[2]));
    }
}

/* A run ends after this long without a position. */
#define GIVE_UP_S 30.0

static int waits_too_long(const knurl_loop_stats *stats, double rate) {
    static uint64_t ticks;
    static uint64_t absences;
    if (!stats->absent || stats->ticks != ticks) {
        ticks = stats->ticks;
        absences = stats->absences;
    }
    return (double)(stats->absences - absences) > GIVE_UP_S * rate;
}

/* s on the loops' clock. */
static double now(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Steps for a while in simulated time, one cycle at a time, so that each fault is shown with the time of its cycle. */
static void step(run *r) {
    for (int i = 0; i < 4096; i++) {
        (void)knurl_loop_step(r->loop, 1);
        faults_show(&r->faults, r->device, (double)++r->cycles / r->options.rate);
    }
}

/* Until the loop is done: drains recorder and sound, shows faults and progress; ends it at Ctrl-C and
 * when its time is up. */
static void play(run *r) {
    const double end = now() + r->seconds;
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    do {
        if (r->options.fast) {
            step(r);
        } else {
            (void)knurl_loop_wait(r->loop, r->seconds > 0.0 ? fmin(0.05, end - now()) : 0.05);
        }
        if (r->recorder.ring.rows) {
            recorder_drain(&r->recorder);
        }
        if (r->sound.audio) {
            sound_drain(&r->sound);
        }
        faults_show(&r->faults, r->device, -1.0);
        (void)knurl_loop_get_stats(r->loop, &stats);
        show_progress(r, r->seconds > 0.0 ? r->seconds - (end - now()) : (double)stats.ticks / r->options.rate);
        r->gave_up |= waits_too_long(&stats, r->options.rate);
        if (interrupted || r->gave_up || (r->seconds > 0.0 && now() >= end)) {
            knurl_loop_request_stop(r->loop);
        }
    } while (stats.state == KNURL_LOOP_RUNNING);
    say_progress_end();
}

/* Call it after the load: until then there is no output, so a signal may simply end the program. */
static void catch_signals(void) {
    (void)knurl_device_zero_on_exit(0); /* before the handler below, which ends a run with a ramp */
    os_on_interrupt(on_signal);
}

static int perform(run *r) {
    knurl_loop_stats stats;
    int code = run_load(r);
    catch_signals();
    code = code == TOOL_OK ? run_prepare(r) : code;
    if (code != TOOL_OK) {
        return code;
    }
    if (!r->options.fast && knurl_loop_start(r->loop)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    faults_start(&r->faults);
    play(r);
    knurl_loop_stats_init(&stats, sizeof stats);
    (void)knurl_loop_get_stats(r->loop, &stats);
    if (!r->options.fast && !stats.realtime) {
        tool_tell("note", "real-time scheduling is not permitted here (see ulimit -r); timing may suffer");
    }
    const int cut_short = interrupted && stats.ticks < r->ticks;
    code = recorder_close(&r->recorder, !cut_short);
    code = sound_close(&r->sound, !cut_short) == TOOL_OK ? code : TOOL_FAILURE;
    if (cut_short) {
        const char *out = r->options.out ? r->options.out : r->options.wav;
        code = tool_error(TOOL_INTERRUPTED + interrupted, "run: interrupted after %llu of %llu ticks%s%s",
                          (unsigned long long)stats.ticks, (unsigned long long)r->ticks, out ? "; not written: " : "",
                          out ? out : "");
    }
    if (stats.state != KNURL_LOOP_LOST && !interrupted && r->gave_up) {
        code = tool_error(TOOL_FAILURE, "run: no position for %g s, after %llu ticks", GIVE_UP_S,
                          (unsigned long long)stats.ticks);
    } else if (stats.state != KNURL_LOOP_LOST && !interrupted && stats.ticks == 0) {
        code = tool_error(TOOL_FAILURE, "run: the device gave no position within %g s", r->seconds);
    }
    if (stats.state == KNURL_LOOP_LOST) {
        code = tool_error(TOOL_FAILURE, "run: the device was lost after %llu ticks", (unsigned long long)stats.ticks);
    }
    run_print_summary(r, &stats);
    return code == TOOL_OK && run_is_fake(&r->options)
               ? travel_check(&r->travel, r->scene, r->surface, (double)stats.ticks / r->options.rate)
               : code;
}

int cmd_run(int argc, char **argv) {
    run r;
    memset(&r, 0, sizeof r);
    int code = run_read_options(argc, argv, &r.options);
    if (code == TOOL_OK) {
        code = perform(&r);
    }
    knurl_loop_destroy(r.loop);
    (void)recorder_close(&r.recorder, 0);
    (void)sound_close(&r.sound, 0);
    view_close(r.view);
    knurl_device_close(r.device);
    knurl_scene_destroy(r.scene);
    return code;
}
