/* KnurlDevice.get_status(): all counters in one Dictionary. SPDX-License-Identifier: MIT */
#include "status.h"

#include <knurl/device.h>

#include <stdlib.h>
#include <string.h>

static void number(void *dictionary, const char *key, double value) {
    gd_dictionary_set(dictionary, key, GDEXTENSION_VARIANT_TYPE_FLOAT, &value);
}

static void whole(void *dictionary, const char *key, uint64_t value) {
    const int64_t copy = (int64_t)value;
    gd_dictionary_set(dictionary, key, GDEXTENSION_VARIANT_TYPE_INT, &copy);
}

static void truth(void *dictionary, const char *key, int value) {
    const uint8_t copy = value != 0;
    gd_dictionary_set(dictionary, key, GDEXTENSION_VARIANT_TYPE_BOOL, &copy);
}

static void tell_loop(const knurl_loop_stats *stats, void *to) {
    whole(to, "ticks", stats->ticks);
    whole(to, "overruns", stats->overruns);
    whole(to, "watchdogs", stats->watchdog_trips);
    whole(to, "absences", stats->absences);
    truth(to, "absent", stats->absent != 0);
    truth(to, "realtime", stats->realtime != 0);
    truth(to, "io_realtime", stats->io_realtime != 0);
    truth(to, "memory_locked", stats->memory_locked != 0);
    number(to, "tick_us_p50", 1e-3 * stats->tick_ns.p50);
    number(to, "tick_us_p99", 1e-3 * stats->tick_ns.p99);
    number(to, "tick_us_max", 1e-3 * stats->tick_ns.max);
    number(to, "jitter_us_p50", 1e-3 * stats->jitter_ns.p50);
    number(to, "jitter_us_p99", 1e-3 * stats->jitter_ns.p99);
    number(to, "jitter_us_max", 1e-3 * stats->jitter_ns.max);
}

static void tell_device(const knurl_device *opened, void *to) {
    knurl_device_info info;
    knurl_device_status status;
    knurl_device_info_init(&info, sizeof info);
    knurl_device_status_init(&status, sizeof status);
    (void)knurl_device_get_info(opened, &info);
    (void)knurl_device_get_status(opened, &status);
    number(to, "max_force", info.max_force);
    truth(to, "lost", status.lost != 0);
    truth(to, "halted", status.halted != 0);
    whole(to, "faults", status.events);
}

static void tell_hip(const knurl_scene *scene, void *to) {
    knurl_hip_counts counts;
    memset(&counts, 0, sizeof counts);
    (void)knurl_scene_get_tick(scene, 0, NULL, &counts);
    whole(to, "contact_ticks", counts.contact_ticks);
    whole(to, "events", counts.events);
    number(to, "half_cycles_crossed", counts.half_cycles_crossed);
    whole(to, "half_cycles_played", counts.half_cycles_played);
    whole(to, "force_limit_ticks", counts.force_limit_ticks);
    whole(to, "above_nyquist_ticks", counts.above_nyquist_ticks);
    whole(to, "non_finite_ticks", counts.non_finite_ticks);
    whole(to, "entry_ticks", counts.entry_ticks);
    whole(to, "slew_ticks", counts.slew_ticks);
    whole(to, "heat_ticks", counts.heat_ticks);
    whole(to, "passivity_ticks", counts.passivity_ticks);
    whole(to, "squeezed_ticks", counts.squeezed_ticks);
    whole(to, "visit_limit_ticks", counts.visit_limit_ticks);
    number(to, "force_max", counts.force_max);
    number(to, "heat", counts.heat);
    whole(to, "surfaces", knurl_scene_get_surface_count(scene));
    whole(to, "scene_bytes", knurl_scene_get_bytes(scene));
}

void status_tell(void *self, const void *const *arguments, void *result) {
    const device *d = self;
    knurl_loop_stats stats;
    (void)arguments;
    truth(result, "running", d->runs);
    if (d->runs) {
        knurl_loop_stats_init(&stats, sizeof stats);
        (void)knurl_loop_get_stats(knurl_session_get_loop(d->session), &stats);
        tell_loop(&stats, result);
        tell_device(knurl_session_get_device(d->session), result);
        tell_hip(knurl_session_get_scene(d->session), result);
    }
}

static void add_text(void *dictionary, const char *key, const char *text) {
    gd_string string;
    gd.string_new_with_utf8_chars(&string, text);
    gd_dictionary_set(dictionary, key, GDEXTENSION_VARIANT_TYPE_STRING, &string);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
}

void status_list(void *self, const void *const *arguments, void *result) {
    enum { MOST = 32 };
    knurl_device_listing *found = calloc(MOST, sizeof *found);
    const uint32_t count = found ? knurl_device_list(found, MOST) : 0;
    (void)self;
    (void)arguments;
    for (uint32_t i = 0; i < count && i < MOST; i++) {
        gd_value dictionary;
        int64_t ignored = 0;
        gd_types[GDEXTENSION_VARIANT_TYPE_DICTIONARY].make(&dictionary, NULL);
        add_text(&dictionary, "device", found[i].uri);
        add_text(&dictionary, "name", found[i].name);
        add_text(&dictionary, "reason", found[i].reason);
        truth(&dictionary, "usable", found[i].reason[0] == '\0');
        gd_variant wrapped = gd_wrap(GDEXTENSION_VARIANT_TYPE_DICTIONARY, &dictionary);
        const void *given[1] = {&wrapped};
        gd_builtin.ARRAY_append(result, given, &ignored, 1);
        gd.variant_destroy(&wrapped);
        gd_types[GDEXTENSION_VARIANT_TYPE_DICTIONARY].end(&dictionary);
    }
    free(found);
}
