/* The summary of knurl run. SPDX-License-Identifier: MIT */
#include "run.h"

#include <math.h>

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

void run_print_summary(const run *r, const knurl_loop_stats *stats) {
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
