/* Failures of walls, with any texture, in the laboratory: runaways, delay, quantisation, limits of motors.
 * SPDX-License-Identifier: MIT */
#include "failures.h"
#include "stability.h"

#include <math.h>
#include <string.h>

/* ms: the parts of runs that are drawn. */
#define DRAWN 600.0

static void draw_depths(const failure_sink *sink, const char *series, const lab_case *c, const lab_signals *signals) {
    const size_t ticks = (size_t)(DRAWN / 1e3 * c->rate);
    for (size_t k = 0; k < ticks && signals->judged + k < signals->count; k++) {
        failure_point(sink, series, 1e3 * (double)k / c->rate, -1e3 * signals->height[signals->judged + k]);
    }
}

/* Runs a case raw, and with the default protections. */
static int run_raw(const failure_sink *sink, lab_case *c, lab_result *result) {
    lab_signals signals;
    lab_result guarded;
    memset(&signals, 0, sizeof signals);
    int failed = lab_run(c, &signals, result);
    if (!failed) {
        draw_depths(sink, "raw, mm deep", c, &signals);
        c->without = 0;
        failed = lab_run(c, &signals, &guarded);
        draw_depths(sink, "by default", c, &signals);
    }
    lab_signals_free(&signals);
    return !failed;
}

/* A Touch without its dry friction in a loose hand, on the stiffest wall that its maker promises. */
int failure_wall_runaway(const failure_sink *sink, double *number) {
    lab_case c;
    lab_result result;
    lab_case_init(&c);
    c.device = "preset=touch&coulomb=0";
    c.grip = lab_grip_named("loose");
    c.stiffness = 1020.0;
    if (!run_raw(sink, &c, &result)) {
        return 0;
    }
    *number = result.swing * 1e3;
    return 1;
}

int failure_wall_delay(const failure_sink *sink, double *number) {
    lab_signals signals;
    double critical[2];
    memset(&signals, 0, sizeof signals);
    for (int delay = 0; delay < 2; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        critical[delay] = stability_found(&loop, &signals);
    }
    for (int delay = 0; delay < 5; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        failure_point(sink, "(b + B)/(T/2 + td), N/m", delay, stability_bound(&loop));
        failure_point(sink, "in the laboratory", delay, stability_found(&loop, &signals));
    }
    lab_signals_free(&signals);
    *number = critical[0] / critical[1];
    return critical[0] > 0.0 && critical[1] > 0.0;
}

/* Dry friction is too small to hold it between two of the wall's force levels: beta = 2 is passive, sigma = 0.1. */
int failure_wall_quantised(const failure_sink *sink, double *number) {
    lab_signals signals;
    lab_result result;
    memset(&signals, 0, sizeof signals);
    const int failed = stability_region_run(2.0, 0.1, &signals, &result);
    for (size_t k = 0; !failed && k < 200 && signals.judged + k < signals.count; k++) {
        failure_point(sink, "um deep", (double)k, -1e6 * signals.height[signals.judged + k]);
    }
    lab_signals_free(&signals);
    *number = result.swing * 1e6;
    return !failed;
}

/* One plane that a default Touch presses into. 0, or 1 with the library's message. */
static int make_wall(const knurl_material_desc *material, uint32_t without, knurl_scene **scene) {
    knurl_surface_id surface;
    knurl_surface_desc desc;
    knurl_plane_desc plane;
    knurl_hip_desc hip;
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = plane.half_extents[1] = 0.1;
    knurl_surface_desc_init(&desc, sizeof desc);
    desc.plane = &plane;
    desc.material = material;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.protections = KNURL_PROTECT_ALL & ~without;
    return knurl_scene_create(NULL, scene) || knurl_scene_add_surface(*scene, &desc, &surface) ||
           knurl_scene_configure_hip(*scene, 0, &hip) || knurl_scene_commit(*scene);
}

/* Experiment 3 as in the paper: K = 0.7 N/mm, A = 2.7 mm on a Touch: 2 K A is 3.78 N. S1 over ridges of 1 mm at 250 Hz,
 * two ticks up and two down, pressed A deep, so that both halves are in contact. */
int failure_force_limit(const failure_sink *sink, double *number) {
    enum { TICKS = 400 };
    knurl_scene *scene = NULL;
    knurl_material_desc material;
    knurl_tick_input input;
    knurl_tick_output out;
    knurl_material_desc_init(&material, sizeof material);
    material.method = KNURL_METHOD_S1;
    material.stiffness = 700.0;
    material.amplitude = 0.0027;
    material.spatial_frequency[0] = 1000.0;
    memset(&input, 0, sizeof input);
    input.has_velocity = 1;
    input.velocity[0] = 0.25;
    input.position[2] = -material.amplitude;
    *number = 0.0;
    int made = make_wall(&material, KNURL_PROTECT_ALL, &scene) == 0;
    for (int k = 0; made && k < TICKS; k++) {
        input.position[0] = 0.25e-3 * k + 0.1e-3;
        made = knurl_scene_tick(scene, 0, &input, &out) == KNURL_OK;
        const double asked = material.stiffness * (out.height + out.depth);
        *number += (asked - out.force[2]) / TICKS;
        if (k < 20) {
            failure_point(sink, "asked for, N", k, asked);
            failure_point(sink, "felt", k, out.force[2]);
        }
    }
    knurl_scene_destroy(scene);
    return made;
}

/* A HIP pressed in with 2 N without end. */
int failure_heat(const failure_sink *sink, double *number) {
    enum { TICKS = 40000 };
    knurl_scene *scene = NULL;
    knurl_material_desc material;
    knurl_tick_input input;
    knurl_tick_output out;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = 1000.0;
    memset(&input, 0, sizeof input);
    input.has_velocity = 1;
    *number = 0.0;
    int made = make_wall(&material, 0, &scene) == 0;
    for (int k = 0; made && k < TICKS; k++) {
        input.position[2] = -fmin(0.002, 1e-5 * k);
        made = knurl_scene_tick(scene, 0, &input, &out) == KNURL_OK;
        if (k % 100 == 0) {
            failure_point(sink, "N", k / 1e3, out.force[2]);
        }
        *number = *number == 0.0 && (out.flags & KNURL_TICK_HEAT) ? k / 1e3 : *number;
    }
    knurl_scene_destroy(scene);
    return made;
}
