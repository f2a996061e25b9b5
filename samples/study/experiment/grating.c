/* A trial of experiment 3 or 4 on a device: two plates with a grating each, and a wall between them that keeps the HIP
 * from sliding from one to the other. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include <string.h>

#define STIFFNESS   700.0 /* N/m: K = 0.7 N/mm (IV-C4) */
#define GAP         0.005 /* m from the middle to a plate's edge, the position of the wall */
#define HALF_WIDTH  0.035 /* m of a plate, along x */
#define HALF_LENGTH 0.035 /* m along z */
#define WALL        0.015 /* m above the plates */
#define PRESS       0.001 /* m below the lowest trough: target of the simulated hand */
#define PUSH        0.5   /* N, upwards: the paper's bad progression with a net force */
#define ROUGH       0.35  /* N: experiment 2's lower intensity */

typedef struct explorer {
    knurl_scene *scene;
    knurl_surface_id surfaces[2];
    uint64_t contacts[2]; /* ticks */
    int32_t wanted;       /* simulated: the side that is stroked; -1: both, before the question */
    uint32_t scan_ticks;
    const exp_trial *trial;
    knurl_wave wave; /* of the side with a fault, in contact */
} explorer;

static void tick_scene(exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]) {
    explorer *e = run->user;
    knurl_tick_input input;
    knurl_tick_output output;
    memset(&input, 0, sizeof input);
    memcpy(input.position, sample->position, sizeof input.position);
    (void)knurl_scene_tick(e->scene, 0, &input, &output); /* on an error its force is 0 */
    memcpy(force, output.device_force, sizeof output.device_force);
    for (int side = 0; side < 2; side++) {
        const int touched = output.surface == e->surfaces[side];
        const int32_t fault = touched ? e->trial->faults[side] : EXP_GOOD;
        e->contacts[side] += (uint64_t)touched;
        force[1] += fault == EXP_PUSH ? PUSH : fault != EXP_GOOD ? knurl_wave_value(&e->wave, tick) : 0.0;
    }
    if (e->wanted < 0 && e->contacts[0] > 0 && e->contacts[1] > 0) {
        __atomic_store_n(&run->ready, 1u, __ATOMIC_RELEASE);
    }
}

static const char *cue(uint64_t tick, void *user) {
    const explorer *e = user;
    return tick < e->scan_ticks ? "explore both gratings, left and right, at various speeds" : "touch both gratings";
}

static const double upward[3] = {0.0, 1.0, 0.0};

/* normal: direction of the plate's front. */
static knurl_result add_plane(knurl_scene *scene, const double centre[3], const double half[2], const double normal[3],
                              const knurl_material_desc *material, knurl_surface_id *id) {
    knurl_plane_desc plane;
    knurl_surface_desc surface;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_surface_desc_init(&surface, sizeof surface);
    memcpy(plane.half_extents, half, sizeof plane.half_extents);
    memcpy(surface.position, centre, sizeof surface.position);
    surface.plane = &plane;
    surface.material = material;
    memcpy(surface.normal, normal, sizeof surface.normal);
    return knurl_scene_add_surface(scene, &surface, id);
}

static knurl_result add_wall(knurl_scene *scene) {
    static const double half_side[2] = {HALF_LENGTH, WALL};
    static const double half_top[2] = {GAP, HALF_LENGTH};
    static const double left[3] = {-GAP, 0.0, 0.0};
    static const double right[3] = {GAP, 0.0, 0.0};
    static const double top[3] = {0.0, WALL, 0.0};
    static const double leftward[3] = {-1.0, 0.0, 0.0};
    static const double rightward[3] = {1.0, 0.0, 0.0};
    knurl_material_desc smooth;
    knurl_material_desc_init(&smooth, sizeof smooth);
    smooth.stiffness = STIFFNESS;
    knurl_result result = add_plane(scene, left, half_side, leftward, &smooth, NULL);
    result = result ? result : add_plane(scene, right, half_side, rightward, &smooth, NULL);
    return result ? result : add_plane(scene, top, half_top, upward, &smooth, NULL);
}

static knurl_result configure(knurl_scene *scene, const exp_session *session) {
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.update_rate_hz = EXP_RATE;
    hip.resolution = session->info.resolution;
    hip.max_force = session->info.max_force;
    hip.workspace = &workspace;
    hip.continuous_force = session->info.continuous_force;
    hip.heat_time = session->info.heat_time;
    hip.viscous = session->info.viscous;
    hip.delay = session->info.delay;
    hip.max_stiffness = session->info.max_stiffness;
    hip.protections = session->design->protections;
    return knurl_scene_configure_hip(scene, 0, &hip);
}

/* A fault's vibration: 20 Hz at any speed, as strong as the ridges; or T2 at 29 ms, the paper's rough one. */
static knurl_result make_fault(const exp_trial *trial, knurl_wave *wave) {
    const int is_rough = trial->faults[0] == EXP_ROUGH || trial->faults[1] == EXP_ROUGH;
    return is_rough ? knurl_wave_prepare(KNURL_WAVE_T2, 0.029, ROUGH, EXP_RATE, wave)
                    : knurl_wave_prepare(KNURL_WAVE_T3, 0.050, 1e-3 * STIFFNESS * trial->amplitude, EXP_RATE, wave);
}

static knurl_result build(const exp_session *session, const exp_trial *trial, explorer *e) {
    static const double half[2] = {HALF_WIDTH, HALF_LENGTH};
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = STIFFNESS;
    material.spatial_frequency[0] = 1e3 / trial->period;
    knurl_result result = make_fault(trial, &e->wave);
    result = result ? result : knurl_scene_create(NULL, &e->scene);
    for (int side = 0; side < 2 && !result; side++) {
        const double centre[3] = {(side ? 1.0 : -1.0) * (GAP + HALF_WIDTH), 0.0, 0.0};
        material.method = trial->methods[side];
        material.amplitude = trial->faults[side] == EXP_STEADY ? 0.0 : 1e-3 * trial->amplitude;
        result = add_plane(e->scene, centre, half, upward, &material, &e->surfaces[side]);
    }
    result = result ? result : add_wall(e->scene);
    result = result ? result : configure(e->scene, session);
    return result ? result : knurl_scene_commit(e->scene);
}

/* On the fake device: one plate, stroked at speeds from rest to 250 mm/s and back. */
static knurl_result stroke(const exp_session *session, const exp_trial *trial, int side) {
    knurl_stroke_desc desc;
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.stroke = KNURL_STROKE_SWEEP;
    desc.centre[0] = (side ? 1.0 : -1.0) * (GAP + HALF_WIDTH);
    desc.reach[0] = 0.9 * HALF_WIDTH;
    desc.depth = 1e-3 * trial->amplitude + PRESS;
    desc.speed = 0.25;
    return knurl_fake_set_stroke(session->device, &desc);
}

/* One loop over one scene. side: the one that the fake device strokes for half the time; -1: both, for a person. */
static int explore(const exp_session *session, const exp_trial *trial, int side, exp_outcome *sum) {
    explorer e;
    exp_run run;
    exp_outcome outcome;
    knurl_hip_counts counts;
    memset(&e, 0, sizeof e);
    memset(&run, 0, sizeof run);
    memset(&outcome, 0, sizeof outcome);
    memset(&counts, 0, sizeof counts);
    e.wanted = side;
    e.trial = trial;
    e.scan_ticks = session->design->scan_ticks;
    run.force = tick_scene;
    run.cue = cue;
    run.question = "Which one is better? 1 the left, 2 the right: ";
    run.cue_user = run.user = &e;
    run.question_tick = e.scan_ticks;
    run.end_tick = side < 0 ? e.scan_ticks : e.scan_ticks / 2;
    int code = TOOL_OK;
    if (build(session, trial, &e) || (side >= 0 && stroke(session, trial, side))) {
        code = tool_error(TOOL_FAILURE, "%s", knurl_error_message());
    } else if (!session->fast) {
        (void)knurl_scene_lock_memory(e.scene); /* optional: a trial works without it */
    }
    code = code ? code : exp_drive(session, &run, &outcome);
    if (e.scene) {
        (void)knurl_scene_get_tick(e.scene, 0, NULL, &counts);
    }
    sum->chosen = outcome.chosen;
    sum->stopped |= outcome.stopped;
    sum->softer_ticks += counts.passivity_ticks;
    sum->rt_s += outcome.rt_s;
    sum->ticks += outcome.ticks;
    sum->overruns += outcome.overruns;
    sum->force_limit_ticks += counts.force_limit_ticks;
    sum->above_nyquist_ticks += counts.above_nyquist_ticks;
    sum->contact_s[0] += (double)e.contacts[0] / EXP_RATE;
    sum->contact_s[1] += (double)e.contacts[1] / EXP_RATE;
    knurl_scene_destroy(e.scene);
    return code;
}

int exp_play_gratings(const exp_session *session, const exp_trial *trial, exp_outcome *outcome) {
    memset(outcome, 0, sizeof *outcome);
    if (strncmp(session->uri, "fake", 4) != 0) {
        return explore(session, trial, -1, outcome);
    }
    if (session->answers != EXP_SIMULATED) {
        return tool_error(TOOL_FAILURE, "nobody moves the fake device over gratings; it goes with --answers simulated");
    }
    const int code = explore(session, trial, 0, outcome);
    return code ? code : explore(session, trial, 1, outcome);
}
