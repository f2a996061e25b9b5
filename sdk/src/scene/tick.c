/* The tick: a device position in, a device force out. Read knurl_scene_tick(), at the end, first. Steps: read the HIP;
 * update contacts (broad phase, candidates, contact); compute forces (grating, Eq. 9, friction) between the guard's
 * protections; convert the sum to device axes; the last stage; publish. Code called from here never uses the heap, a
 * lock, a system call, a clock, a log or a file. SPDX-License-Identifier: MIT */
#include "hip/force_law.h"
#include "scene/scene.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"
#include "motion/velocity.h"
#include "proxy/felt.h"

#include <stddef.h>
#include <string.h>

/* m/s: above the speed between any two valid positions, at any update rate. */
#define SPEED_MAX 1e15

/* Clears the members that contacts add to. */
static void begin_output(knurl_tick_output *out) {
    out->flags = out->contacts = 0;
    memset(out->reserved, 0, sizeof out->reserved);
}

/* Fills in an output without contact. Field by field, because clearing the block (rep stos) takes twice as long as all
 * this. */
static void clear_contact_output(knurl_tick_output *out) {
    vec3_copy(out->hip, out->proxy);
    out->normal[0] = out->normal[1] = out->normal[2] = 0.0;
    out->surface_velocity[0] = out->surface_velocity[1] = 0.0;
    out->depth = out->height = 0.0;
    out->spatial_frequency = out->temporal_frequency = 0.0;
    out->event = KNURL_NO_EVENT;
    out->cycles[0] = out->cycles[1] = 0.0;
    out->surface = 0;
}

/* Moves the workspace to its pose in this tick. A jump ends contacts: it sweeps nothing in between. Returns the growth
 * of its scale since the last tick, as a share of the scale, 1/s. */
static double move_workspace(knurl_hip *hip) {
    const double before = hip->workspace.scale;
    const knurl_hip_clock *clock = &hip->contacts.clock;
    const int jumped = knurl_workspace_advance(&hip->move, clock->time, &hip->workspace, &hip->is_rotated);
    const double scale = hip->workspace.scale;
    if (jumped) {
        knurl_contacts_reset(&hip->contacts);
    }
    if (scale == before) {
        return 0.0;
    }
    knurl_hip_set_scale(hip, scale);
    return jumped ? 0.0 : (scale - before) / (scale * clock->period);
}

/* Adds the velocity of the workspace at a HIP, m/s. zoom: 1/s, see move_workspace(). */
static void add_workspace_velocity(const knurl_hip *hip, const double at[3], double zoom, double velocity[3]) {
    const knurl_hip_clock *clock = &hip->contacts.clock;
    double own[3];
    double from_origin[3];
    knurl_motion_velocity(&hip->move.motion.frame, clock->time, clock->period, at, own);
    vec3_madd(velocity, 1.0, own, velocity);
    vec3_sub(at, hip->workspace.origin, from_origin);
    vec3_madd(velocity, zoom, from_origin, velocity);
}

/* Maps the device's position and velocity into the scene. A missing velocity is estimated in device axes, because
 * positions are quantised along these. Returns 0 if the position is invalid. */
static int read_hip(knurl_hip *hip, const knurl_tick_input *input, knurl_tick_output *out) {
    const knurl_workspace *w = &hip->workspace;
    const double *velocity = input->velocity;
    /* also without a position: otherwise the next tick would take the growth since for its own */
    const int is_moving = knurl_workspace_is_moving(&hip->move);
    const double zoom = is_moving ? move_workspace(hip) : 0.0;
    if (KNURL_UNLIKELY(input->absent)) {
        return 0;
    }
    if (!input->has_velocity) {
        if (!vec3_finite(input->position)) { /* keep it out of the estimator */
            return 0;
        }
        knurl_velocity_update(&hip->velocity, input->position, hip->estimate);
        velocity = hip->estimate;
    }
    double at[3], moving[3];
    if (KNURL_UNLIKELY(hip->is_rotated)) {
        double turned[3]; /* a copy, as below, so that `at` itself can stay in registers */
        knurl_workspace_to_scene(w, input->position, turned);
        vec3_copy(turned, at);
        mat3_mul(w->rotation, velocity, moving);
        vec3_scale(w->scale, moving, moving);
    } else {
        vec3_madd(w->origin, w->scale, input->position, at);
        vec3_scale(w->scale, velocity, moving);
    }
    if (KNURL_UNLIKELY(is_moving)) {
        double there[3] = {at[0], at[1], at[2]}, moved[3] = {moving[0], moving[1], moving[2]};
        add_workspace_velocity(hip, there, zoom, moved);
        vec3_copy(moved, moving);
    }
    vec3_copy(at, out->hip);
    vec3_copy(moving, out->hip_velocity);
    begin_output(out);
    return vec3_sum(at) <= KNURL_COORDINATE_MAX && vec3_sum(moving) <= SPEED_MAX;
}

/* Reports one contact; of several, the deepest. */
static inline void report_contact(const knurl_active_contact *contact, const knurl_contact_force *share,
                                  knurl_tick_output *out) {
    if (KNURL_UNLIKELY(share->grating.above_nyquist)) {
        out->flags |= KNURL_TICK_ABOVE_NYQUIST;
    }
    if (KNURL_UNLIKELY(out->contacts++ > 0) && -contact->contact.z <= out->depth) {
        return;
    }
    vec3_copy(contact->candidate->proxy, out->proxy);
    vec3_copy(contact->normal, out->normal);
    out->surface_velocity[0] = share->velocity[0];
    out->surface_velocity[1] = share->velocity[1];
    out->depth = -contact->contact.z;
    out->height = share->grating.height;
    out->spatial_frequency = share->grating.spatial_frequency;
    out->temporal_frequency = share->grating.temporal_frequency;
    out->event = share->grating.event;
    out->cycles[0] = share->cycles[0];
    out->cycles[1] = share->cycles[1];
    out->surface = contact->surface->id;
}

/* Counts events and half cycles. More than 1e9 half cycles in a tick are impossible and are dropped, so that an
 * overflow cannot spoil the sum. */
static inline void count_grating(knurl_hip *hip, const knurl_active_contact *contact, const knurl_contact_force *share,
                                 int64_t events_before) {
    const double halves = 2.0 * share->grating.temporal_frequency * hip->contacts.clock.period;
    hip->counts.events += (uint64_t)(contact->candidate->grating.event_count - events_before);
    hip->counts.half_cycles_crossed += halves < 1e9 && contact->record->amplitude > 0.0 ? halves : 0.0;
    hip->counts.half_cycles_played += share->grating.turned;
}

/* Finds the tracked position, once in a tick and only for a grating that follows positions in counts. If the last tick
 * had none, it begins at the measured position. */
static void track(knurl_hip *hip, const knurl_tick_input *input) {
    const uint64_t tick = hip->counts.ticks + 1; /* 0: never */
    if (hip->tracked_at == tick) {
        return;
    }
    double tracked[3], between[3];
    knurl_velocity_get_state(&hip->velocity)->tracking = hip->tracked_at + 1 == tick;
    hip->tracked_at = tick;
    knurl_velocity_track(&hip->velocity, input->position, input->has_velocity ? input->velocity : hip->estimate,
                         tracked);
    vec3_sub(tracked, input->position, between);
    vec3_scale(hip->workspace.scale, between, hip->between);
    if (hip->is_rotated) {
        mat3_mul(hip->workspace.rotation, hip->between, hip->between);
    }
}

/* Computes one contact's force and adds it to the sum. Returns its texture's step, N. */
static inline double render_contact(knurl_hip *hip, const knurl_tick_input *input, knurl_active_contact *c,
                                    double sum[3], knurl_tick_output *out) {
    if (KNURL_UNLIKELY(hip->contacts.now.count > 1)) {
        knurl_contacts_share(&hip->contacts, c);
    }
    if (KNURL_UNLIKELY(c->surface->shape.bulge > 0.0) && !knurl_felt_find(c)) {
        return 0.0;
    }
    const int plays = c->record->has_grating || c->candidate->grating.playing; /* an event plays to its end */
    if (plays && hip->facts.resolution > 0.0 && c->record->method->follows_position) {
        track(hip, input);
    }
    const knurl_hip_motion motion = {&hip->contacts.clock, out->hip_velocity, &hip->facts, hip->between, &hip->even};
    const int64_t events = c->candidate->grating.event_count;
    knurl_wall wall;
    knurl_contact_force share;
    knurl_wall_init(&wall, &c->record->material, c->record->amplitude, c->contact.z, &c->candidate->wall);
    knurl_guard_before(&hip->guard, &wall, &out->flags);
    knurl_force_law(&motion, c, plays, &wall, &share);
    double step = 0.0;
    if (plays || wall.state->height != 0.0) { /* else it was smooth, and still is */
        step = knurl_min(1.0, c->share) * knurl_guard_after(&hip->guard, &wall);
    }
    if (plays) {
        count_grating(hip, c, &share, events);
    }
    vec3_madd(sum, 1.0, share.force, sum);
    report_contact(c, &share, out);
    return step;
}

/* The share of `asked` that is within `most`. */
static double share_within(double asked, double most, uint32_t *flags) {
    if (asked <= most) {
        return 1.0;
    }
    *flags |= KNURL_TICK_PASSIVITY;
    return most / asked;
}

/* Adds the forces of effects, at most as stiff and as viscous as is stable in a loose hand. */
static void add_effects(const knurl_hip *hip, const knurl_effects *effects, double sum[3], knurl_tick_output *out) {
    const knurl_guard *guard = &hip->guard;
    const knurl_effect_shares shares = {share_within(effects->stiffness, guard->effect_stiffness, &out->flags),
                                        share_within(effects->damping, guard->effect_damping, &out->flags)};
    double force[3];
    knurl_effects_force(effects, &shares, out->hip, out->hip_velocity, hip->contacts.clock.time, force);
    vec3_madd(sum, 1.0, force, sum);
}

/* 1 if there is no contact, no effect, no added force and no force at the last tick: there is nothing to limit. */
static inline int is_at_rest(const knurl_hip *hip, const knurl_effects *effects, const knurl_added_force *added) {
    const double *force = hip->last.force;
    return hip->contacts.now.count == 0 && !effects && !added && force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0;
}

/* Converts the sum of all forces to device axes and limits it there: a rotating workspace must not make the device's
 * force jump. Returns its length, N. */
static inline double send_force(knurl_hip *hip, double steps, const double force[3], knurl_tick_output *out) {
    const knurl_workspace *w = &hip->workspace;
    double sent[3] = {force[0], force[1], force[2]};
    if (KNURL_UNLIKELY(hip->is_rotated)) {
        mat3_mul_transposed(w->rotation, force, sent);
    }
    const double asked[3] = {sent[0], sent[1], sent[2]};
    const double length = knurl_last_stage_limit(&hip->last, hip->guard.gain, steps, sent, &out->flags);
    vec3_copy(sent, out->device_force);
    if (KNURL_LIKELY(!hip->is_rotated)) {
        vec3_copy(sent, out->force);
    } else if (vec3_distance2(sent, asked) > 0.0) {
        mat3_mul(w->rotation, sent, out->force);
    } else { /* rotating it back would only round it */
        vec3_copy(force, out->force);
    }
    return length;
}

static inline void send_none(knurl_tick_output *out) {
    out->force[0] = out->force[1] = out->force[2] = 0.0;
    out->device_force[0] = out->device_force[1] = out->device_force[2] = 0.0;
}

/* Sums the forces of all contacts, of effects and of the game (N, scene), and sends the sum. Returns its length. */
static inline double sum_forces(knurl_hip *hip, const knurl_tick_input *input, const knurl_effects *effects,
                                const knurl_added_force *added, knurl_tick_output *out) {
    double force[3] = {0.0, 0.0, 0.0};
    double steps = 0.0;
    for (uint32_t i = 0; i < hip->contacts.now.count; i++) {
        steps += render_contact(hip, input, &hip->contacts.now.list[i], force, out);
    }
    if (KNURL_UNLIKELY(effects != NULL)) {
        add_effects(hip, effects, force, out);
    }
    if (KNURL_UNLIKELY(added != NULL)) {
        vec3_madd(force, 1.0, added->force, force);
        steps += added->step;
    }
    return send_force(hip, steps, force, out);
}

/* Ends all contacts and the force; the next tick is a first one. */
static void end_contacts(knurl_hip *hip) {
    const double none[3] = {0.0, 0.0, 0.0};
    knurl_contacts_reset(&hip->contacts);
    knurl_last_stage_note(&hip->last, none);
}

/* After invalid input or results: zero output, contacts end, the next tick counts as the first. */
static void reset(knurl_hip *hip, uint32_t why, knurl_tick_output *out) {
    const uint64_t tick = out->tick;
    memset(out, 0, sizeof *out);
    knurl_velocity_reset(&hip->velocity);
    end_contacts(hip);
    out->tick = tick;
    out->event = KNURL_NO_EVENT;
    out->flags = why;
}

/* Computes the device's force at the HIP's position. Returns its length, N. */
static double render(const knurl_scene *scene, knurl_hip *hip, const knurl_tick_input *input,
                     const knurl_added_force *added, knurl_tick_output *out) {
    const knurl_broad_index *index = __atomic_load_n(&scene->broad_phase.index, __ATOMIC_SEQ_CST);
    knurl_guard_begin(&hip->guard, input->attenuation);
    if (KNURL_UNLIKELY(input->paused)) {
        end_contacts(hip);
        clear_contact_output(out);
        send_none(out);
        return 0.0;
    }
    knurl_contacts_update(&hip->contacts, &scene->broad_phase, index, out->hip, &out->flags);
    const knurl_effects *effects = __atomic_load_n(&hip->effects, __ATOMIC_SEQ_CST);
    double length = 0.0;
    if (is_at_rest(hip, effects, added)) {
        send_none(out);
        knurl_heat_add(&hip->last.heat, 0.0);
    } else {
        length = sum_forces(hip, input, effects, added, out);
    }
    if (KNURL_UNLIKELY(!knurl_is_finite(length))) {
        reset(hip, KNURL_TICK_NOT_FINITE, out);
        return 0.0;
    }
    if (out->contacts > 0) {
        out->flags |= KNURL_TICK_CONTACT;
    } else {
        clear_contact_output(out);
    }
    knurl_contacts_keep(&hip->contacts, out->hip);
    return length;
}

/* Static messages only: this may be the haptic thread. */
static knurl_result refuse(knurl_result why, const char *sentence, knurl_tick_output *output) {
    if (output) {
        memset(output, 0, sizeof *output);
        output->event = KNURL_NO_EVENT;
    }
    return knurl_fail_static(why, sentence);
}

void knurl_hip_tick(knurl_scene *scene, knurl_hip *hip, const knurl_tick_input *input, const knurl_added_force *added,
                    knurl_tick_output *output) {
    double force = 0.0;
    output->tick = hip->counts.ticks;
    knurl_epoch_pin(&scene->epoch, &hip->pinned);
    knurl_hip_clock_advance(&hip->contacts.clock);
    if (KNURL_LIKELY(read_hip(hip, input, output))) {
        force = render(scene, hip, input, added, output);
    } else {
        reset(hip, input->absent ? KNURL_TICK_ABSENT : KNURL_TICK_NOT_FINITE, output);
    }
    knurl_epoch_unpin(&hip->pinned);
    hip->counts.heat = knurl_heat_theta(&hip->last.heat);
    knurl_counts_add(&hip->counts, output, force);
    knurl_snapshot_publish(&hip->published, output, &hip->counts);
}

/* Eight bytes at a time, which is faster than field by field. */
static inline int is_reserved_zero(const knurl_tick_input *input) {
    uint64_t any = input->reserved[0];
    for (int i = 1; i < 9; i += 2) {
        uint64_t word;
        memcpy(&word, &input->reserved[i], sizeof word);
        any |= word;
    }
    return any == 0;
}

knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip_index, const knurl_tick_input *input,
                              knurl_tick_output *output) {
    KNURL_RULE_OF_HIP(HAPTIC, scene, hip_index);
    if (!KNURL_IS_HANDLE(scene, SCENE) || !input || !output) {
        return refuse(KNURL_ERROR_ARGUMENT,
                      "knurl_scene_tick: expected a scene, an input and an output, found null or an invalid handle",
                      output);
    }
    if (!is_reserved_zero(input)) { /* reserved for later versions */
        return refuse(KNURL_ERROR_ARGUMENT, "knurl_scene_tick: input.reserved: expected zeros, found another number",
                      output);
    }
    if (hip_index >= scene->hip_count) {
        return refuse(KNURL_ERROR_ARGUMENT, "knurl_scene_tick: hip: expected below hip_count, found more", output);
    }
    if (knurl_load_relaxed(&scene->use) >> hip_index & 1) {
        return refuse(KNURL_ERROR_STATE,
                      "knurl_scene_tick: hip: expected one that no loop uses, found one in use by a loop", output);
    }
    if (!knurl_load_acquire(&scene->committed)) {
        return refuse(KNURL_ERROR_STATE, "knurl_scene_tick: expected a scene that is committed, found one that is not",
                      output);
    }
    knurl_hip_tick(scene, &scene->hips[hip_index], input, NULL, output);
    return KNURL_OK;
}

knurl_result knurl_scene_tick_batch(knurl_scene *scene, uint32_t hip_index, const knurl_tick_input *inputs,
                                    uint64_t count, knurl_tick_output *outputs) {
    KNURL_RULE_OF_HIP(HAPTIC, scene, hip_index);
    if (!KNURL_IS_HANDLE(scene, SCENE) || !inputs || !outputs) {
        return refuse(KNURL_ERROR_ARGUMENT,
                      "knurl_scene_tick_batch: expected a scene, inputs and outputs, found null or an invalid handle",
                      NULL);
    }
    knurl_result first = KNURL_OK;
    for (uint64_t i = 0; i < count; i++) {
        const knurl_result result = knurl_scene_tick(scene, hip_index, &inputs[i], &outputs[i]);
        first = first ? first : result;
    }
    return first;
}
