/* knurl run: loads a scene, strokes it with a device or a simulated hand, and summarises the run.
 * SPDX-License-Identifier: MIT */
#include "faults.h"
#include "machine.h"
#include "os.h"
#include "recorder.h"
#include "sound.h"
#include "stroke.h"
#include "tool.h"
#include "travel.h"
#include "view.h"

#include <math.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

typedef struct run_options {
    const char *path, *device, *surface, *stroke, *trace, *method, *out, *limits, *wav, *response;
    knurl_gltf_options budget;
    double seconds, rate;
    int fast, full_model, clamp, reconnect, pretty, view, exact, even;
    int32_t stroke_id, method_id;
} run_options;

/* Everything that a run owns. Starts zeroed; only parts that exist are freed. */
typedef struct run {
    run_options options;
    knurl_scene *scene;
    knurl_device *device;
    knurl_loop *loop;
    knurl_surface_id surface; /* that is stroked */
    recorder recorder;
    sound sound;
    view *view;
    travel travel;
    faults faults;
    uint64_t ticks;  /* wanted */
    uint64_t cycles; /* stepped, with --fast */
    double seconds;  /* duration on the clock; 0: a simulated device, which counts ticks */
    int gave_up;     /* no position for GIVE_UP_S */
} run;

static volatile sig_atomic_t interrupted; /* by this signal */

static void on_signal(int number) {
    interrupted = number;
}

static int read_options(int argc, char **argv, run_options *o) {
    const tool_option options[] = {
        {"--device", TOOL_TEXT, &o->device, 0, 0, ""},
        {"--surface", TOOL_TEXT, &o->surface, 0, 0, ""},
        {"--stroke", TOOL_TEXT, &o->stroke, 0, 0, ""},
        {"--trace", TOOL_TEXT, &o->trace, 0, 0, ""},
        {"--method", TOOL_TEXT, &o->method, 0, 0, ""},
        {"--out", TOOL_TEXT, &o->out, 0, 0, ""},
        {"--budget", TOOL_TEXT, &o->limits, 0, 0, ""},
        {"--wav", TOOL_TEXT, &o->wav, 0, 0, ""},
        {"--response", TOOL_TEXT, &o->response, 0, 0, ""},
        {"--seconds", TOOL_NUMBER, &o->seconds, 0.001, RUN_SECONDS_MAX, "s"},
        {"--rate", TOOL_NUMBER, &o->rate, KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX, "Hz"},
        {"--fast", TOOL_FLAG, &o->fast, 0, 0, ""},
        {"--exact", TOOL_FLAG, &o->exact, 0, 0, ""},
        {"--view", TOOL_FLAG, &o->view, 0, 0, ""},
        {"--clamp", TOOL_FLAG, &o->clamp, 0, 0, ""},
        {"--even", TOOL_FLAG, &o->even, 0, 0, ""},
        {"--reconnect", TOOL_FLAG, &o->reconnect, 0, 0, ""},
        {"--full-model", TOOL_FLAG, &o->full_model, 0, 0, ""},
        {"--pretty", TOOL_FLAG, &o->pretty, 0, 0, ""}};
    o->seconds = NAN;
    o->rate = 1000.0;
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, &o->path) != TOOL_OK ||
        tool_parse_budget(o->limits, &o->budget) != TOOL_OK) {
        return TOOL_USAGE;
    }
    if (!o->path || !o->path[0]) {
        return tool_error(TOOL_USAGE, "run: expected a .gltf or .glb file, found none");
    }
    if (o->out && o->wav && strcmp(o->out, o->wav) == 0) {
        return tool_error(TOOL_USAGE, "run: expected two outputs, found '%s' for both --out and --wav", o->out);
    }
    if (o->stroke && o->trace) {
        return tool_error(TOOL_USAGE, "run: expected --stroke or --trace, found both");
    }
    if (o->exact && !o->trace) {
        return tool_error(TOOL_USAGE, "run: --exact: expected --trace, whose positions it is about");
    }
    if (o->view && o->fast) {
        return tool_error(TOOL_USAGE, "run: expected --view or --fast, found both");
    }
    if (knurl_stroke_from_name(o->stroke ? o->stroke : "line", &o->stroke_id)) {
        return tool_library_error(TOOL_USAGE, "run");
    }
    if (o->method && knurl_method_from_name(o->method, &o->method_id)) {
        return tool_library_error(TOOL_USAGE, "run");
    }
    return TOOL_OK;
}

/* --method: for every surface, instead of its own. */
static knurl_result set_methods(knurl_scene *scene, int32_t method) {
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene); i++) {
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        knurl_result result = knurl_scene_get_material(scene, surface, &material);
        material.method = method;
        result = result ? result : knurl_scene_set_material(scene, surface, &material);
        if (result) {
            const char *name = "";
            (void)knurl_scene_get_surface_name(scene, surface, &name);
            return knurl_fail(result, "surface '%s': %s", name, knurl_error_message());
        }
    }
    return KNURL_OK;
}

/* Protects files that a device's URI names after geometry=, firmware= and library=. */
static void protect_device_files(const char *uri) {
    const char *pair = strchr(uri, '?');
    while (pair) {
        char path[4096];
        const char *value = pair + 1 + strcspn(pair + 1, "=&");
        if (*value == '=') {
            (void)snprintf(path, sizeof path, "%.*s", (int)strcspn(value + 1, "&"), value + 1);
            out_protect(path); /* a number is not normally a file's name */
        }
        pair = strchr(pair + 1, '&');
    }
}

static int load(run *r) {
    const run_options *o = &r->options;
    uint32_t skipped = 0;
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.full_model = o->full_model != 0;
    if (knurl_scene_create(&desc, &r->scene) || tool_load(r->scene, o->path, &o->budget, &skipped) ||
        (o->method && set_methods(r->scene, o->method_id)) || knurl_scene_commit(r->scene)) {
        return tool_library_error(TOOL_FAILURE, NULL);
    }
    if (knurl_scene_get_surface_count(r->scene) == 0) {
        return tool_error(TOOL_FAILURE,
                          "%s: nothing is tagged, so there is nothing to feel; 'knurl inspect' explains how to tag",
                          o->path);
    }
    return TOOL_OK;
}

static int is_fake(const run_options *o) {
    return !o->device || strncmp(o->device, "fake", 4) == 0;
}

/* Prints a note if the trace is in an encoder's counts. */
static int tell_counts(const run *r) {
    knurl_device_info info;
    knurl_device_info_init(&info, sizeof info);
    (void)knurl_device_get_info(r->device, &info);
    if (info.resolution > 0.0 && !(r->options.device && strstr(r->options.device, "resolution="))) {
        tool_tell("note", "%s: positions are in counts of %.4g mm and felt as such; --exact takes them as exact",
                  r->options.trace, 1e3 * info.resolution);
    }
    return TOOL_OK;
}

/* Gives a fake device its hand or trace; a real one is moved by its user. */
static int lay(run *r, knurl_surface_id surface, double *last_t) {
    const run_options *o = &r->options;
    if (!is_fake(o)) {
        const char *fakes = o->fast ? "--fast" : o->stroke ? "--stroke" : o->trace ? "--trace" : NULL;
        return fakes ? tool_error(TOOL_USAGE, "run: only the fake device takes %s, found --device %s", fakes, o->device)
                     : stroke_place(r->scene, r->device, surface);
    }
    if (o->trace) {
        const int code = stroke_play(r->scene, r->device, o->trace, last_t);
        return code ? code : tell_counts(r);
    }
    r->travel.stroke = o->stroke_id;
    return stroke_lay(r->scene, r->device, surface, o->stroke_id, &r->travel.stroke_length);
}

static int open_device(run *r) {
    const run_options *o = &r->options;
    protect_device_files(o->device ? o->device : "");
    char uri[1024];
    const char *named = o->device ? o->device : "fake";
    if (o->exact && is_fake(o)) { /* no counts: a resolution of 0 */
        (void)snprintf(uri, sizeof uri, "%s%sresolution=0", named,
                       strchr(named, '?')   ? "&"
                       : strchr(named, ':') ? "?"
                                            : ":?");
    }
    const knurl_result result = knurl_device_open(o->exact && is_fake(o) ? uri : named, &r->device);
    if (result) { /* a device that cannot be opened is a failure; an unknown name is wrong usage */
        const int is_usage = result == KNURL_ERROR_UNKNOWN || result == KNURL_ERROR_ARGUMENT;
        return tool_library_error(is_usage ? TOOL_USAGE : TOOL_FAILURE, "run: --device");
    }
    knurl_surface_id surface = knurl_scene_get_surface(r->scene, 0);
    if (o->surface && knurl_scene_find_surface(r->scene, o->surface, &surface)) {
        return tool_library_error(TOOL_FAILURE, o->path);
    }
    double last_t = 0.0;
    r->surface = surface;
    const int code = lay(r, surface, &last_t);
    if (!isnan(o->seconds)) {
        r->ticks = (uint64_t)fmax(1.0, floor(o->seconds * o->rate + 0.5));
    } else if (o->trace) {
        r->ticks = (uint64_t)floor(last_t * o->rate + 1e-6) + 1; /* including its last row */
    } else {
        r->ticks = (uint64_t)((o->view ? 600.0 : 5.0) * o->rate);
    }
    r->seconds = is_fake(o) ? 0.0 : (double)r->ticks / o->rate;
    return code;
}

/* --clamp: keeps the HIP's other settings, such as a workspace that was moved. */
static knurl_result clamp(knurl_scene *scene) {
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_hip_desc_init(&desc, sizeof desc);
    knurl_result result = knurl_scene_get_workspace(scene, 0, &workspace);
    desc.workspace = &workspace;
    desc.clamp = 1;
    return result ? result : knurl_scene_configure_hip(scene, 0, &desc);
}

static void take_tick(const knurl_tick_output *output, void *user) {
    run *r = user;
    travel_add(&r->travel, output);
    if (r->recorder.ring.rows) {
        tick_ring_put(&r->recorder.ring, output);
    }
    if (r->sound.audio) {
        sound_take(&r->sound, output);
    }
    if (r->view) {
        view_take(r->view, output);
    }
}

/* The page is in build/web, beside the preset's folder, where ./run web puts it. */
static int open_view(run *r) {
    char page[4096];
    char index[4096 + 16];
    knurl_device_info device;
    knurl_device_info_init(&device, sizeof device);
    (void)knurl_device_get_info(r->device, &device);
    (void)machine_program("../web", page, sizeof page);
    const view_desc desc = {r->scene, r->options.path, page, device.name, r->options.rate};
    if (view_open(&desc, &r->view) != TOOL_OK) {
        return TOOL_FAILURE;
    }
    (void)snprintf(index, sizeof index, "%s/index.html", page);
    if (access(index, R_OK) != 0) {
        tool_tell("note", "the page is not built, so a browser has nothing to open: ./run web");
    }
    tool_tell("note", "to see what is felt, open %s", view_url(r->view));
    return TOOL_OK;
}

static int make_loop(run *r) {
    knurl_loop_desc desc;
    if (r->options.clamp && clamp(r->scene)) {
        return tool_library_error(TOOL_FAILURE, "run: --clamp");
    }
    if ((r->options.even || r->options.response) &&
        tool_even(r->scene, r->options.response, r->device, r->options.rate) != TOOL_OK) {
        return TOOL_FAILURE;
    }
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = r->device;
    desc.scene = r->scene;
    desc.update_rate_hz = r->options.rate;
    desc.tick_limit = r->ticks;
    desc.reconnect = (uint32_t)r->options.reconnect;
    int code = TOOL_OK;
    if (r->options.out) {
        code = recorder_open(&r->recorder, r->options.out, r->scene, r->options.rate);
    }
    if (code == TOOL_OK && r->options.wav) {
        code = sound_open(&r->sound, r->options.wav, r->options.rate);
    }
    if (code == TOOL_OK && r->options.view) {
        code = open_view(r);
    }
    if (code != TOOL_OK) {
        return code;
    }
    desc.tick_callback = take_tick;
    desc.user = r;
    r->travel.period = 1.0 / r->options.rate;
    if (knurl_loop_create(&desc, &r->loop)) {
        return tool_library_error(TOOL_FAILURE, "run");
    }
    (void)tool_warn(r->scene); /* after the loop has passed the device's limits to the scene */
    return TOOL_OK;
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

static void print_percentiles(json_writer *json, const char *key, const knurl_percentiles *p, double unit) {
    json_open(json, key, '{');
    json_number(json, "p50", p->p50 / unit);
    json_number(json, "p99", p->p99 / unit);
    json_number(json, "max", p->max / unit);
    json_close(json, '}');
}

/* Standard output, unless the rows or the sound go there. */
static FILE *summary_stream(const run_options *o) {
    const int is_taken = (o->out && strcmp(o->out, "-") == 0) || (o->wav && strcmp(o->wav, "-") == 0);
    return is_taken ? stderr : stdout;
}

static void print_summary(const run *r, const knurl_loop_stats *stats) {
    knurl_hip_counts counts;
    knurl_device_info device;
    json_writer json;
    json_start(&json, summary_stream(&r->options), r->options.pretty);
    knurl_device_info_init(&device, sizeof device);
    memset(&counts, 0, sizeof counts);
    (void)knurl_scene_get_tick(r->scene, 0, NULL, &counts);
    (void)knurl_device_get_info(r->device, &device);
    json_open(&json, NULL, '{');
    json_string(&json, "device", device.name);
    json_number(&json, "rate_hz", r->options.rate);
    json_number(&json, "resolution_m", device.resolution);
    json_number(&json, "ticks", (double)stats->ticks);
    json_number(&json, "contact_s", (double)counts.contact_ticks / r->options.rate);
    json_number(&json, "events", (double)counts.events);
    json_number(&json, "metres", r->travel.metres);
    json_number(&json, "half_cycles_crossed", floor(counts.half_cycles_crossed));
    json_number(&json, "half_cycles_played", (double)counts.half_cycles_played);
    json_number(&json, "overruns", (double)stats->overruns);
    json_number(&json, "watchdogs", (double)stats->watchdog_trips);
    json_number(&json, "absences", (double)stats->absences);
    json_number(&json, "force_limit_ticks", (double)counts.force_limit_ticks);
    json_number(&json, "above_nyquist_ticks", (double)counts.above_nyquist_ticks);
    json_number(&json, "non_finite_ticks", (double)counts.non_finite_ticks);
    json_number(&json, "entry_ticks", (double)counts.entry_ticks);
    json_number(&json, "slew_ticks", (double)counts.slew_ticks);
    json_number(&json, "heat_ticks", (double)counts.heat_ticks);
    json_number(&json, "passivity_ticks", (double)counts.passivity_ticks);
    json_number(&json, "squeezed_ticks", (double)counts.squeezed_ticks);
    json_number(&json, "visit_limit_ticks", (double)counts.visit_limit_ticks);
    json_number(&json, "heat", counts.heat);
    json_number(&json, "force_max_n", counts.force_max);
    tool_print_even(&json, r->scene);
    faults_print(&r->faults, &json);
    print_percentiles(&json, "tick_ns", &stats->tick_ns, 1.0);
    print_percentiles(&json, "jitter_us", &stats->jitter_ns, 1000.0);
    json_close(&json, '}');
}

/* Call it after the load: until then there is no output, so a signal may simply end the program. */
static void catch_signals(void) {
    (void)knurl_device_zero_on_exit(0); /* before the handler below, which ends a run with a ramp */
    os_on_interrupt(on_signal);
}

static int perform(run *r) {
    knurl_loop_stats stats;
    int code = load(r);
    catch_signals();
    code = code == TOOL_OK ? open_device(r) : code;
    code = code == TOOL_OK ? make_loop(r) : code;
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
    print_summary(r, &stats);
    return code == TOOL_OK && is_fake(&r->options)
               ? travel_check(&r->travel, r->scene, r->surface, (double)stats.ticks / r->options.rate)
               : code;
}

int cmd_run(int argc, char **argv) {
    run r;
    memset(&r, 0, sizeof r);
    int code = read_options(argc, argv, &r.options);
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
