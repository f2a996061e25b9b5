/* knurl run, in stages: options; load, device and loop; play; summary. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_RUN_H
#define KNURL_TOOL_RUN_H

#include "faults.h"
#include "recorder.h"
#include "sound.h"
#include "tool.h"
#include "travel.h"
#include "view.h"

#include <string.h>

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

static inline int run_is_fake(const run_options *o) {
    return !o->device || strncmp(o->device, "fake", 4) == 0;
}

/* Each returns TOOL_OK, or what the program returns, with a message. */
int run_read_options(int argc, char **argv, run_options *options);
int run_load(run *r);
int run_prepare(run *r); /* device, hand, outputs, loop */

void run_print_summary(const run *r, const knurl_loop_stats *stats);

#endif
