/* The tick: a device position in, a device force out. Read knurl_scene_tick(), at the end, first.
 * No heap, lock, system call, clock, log or file in anything that is called from here. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/atomic.h"

#include <string.h>

/* s that a HIP may be behind another before it takes over its time: it has not ticked for a while. */
#define MAX_LAG 0.05

/* m above a surface: where a HIP is taken to come from that slides off it and onto the next one. What lies higher than
 * this is a step that stops nobody who is already below it. */
#define HANDOVER_HEIGHT 1e-5

/* s that it may be between two surfaces: cracks of some nanometres are all that floats leave, but a tick may fall into
 * one. */
#define HANDOVER_SECONDS 0.005

/* A HIP that was pressed into a surface and is now beside it: where its proxy would be, had the surface gone on. */
typedef struct handover {
    double from[3]; /* scene, m */
    double depth;   /* m from there to the HIP */
    int given;
} handover;

/* What one tick knows of one surface. */
typedef struct touch {
    const knurl_surface_data *surface;
    const knurl_record *record;
    knurl_pose moved;       /* used while it moves */
    const knurl_pose *pose; /* of the shape's frame, now */
    knurl_contact contact;
    knurl_guard_wall wall; /* as felt */
    double force[3];       /* scene, N */
    double proxy[3];       /* scene, m */
    double normal[3];      /* scene */
    double velocity[2];    /* of the HIP over the surface, in the surface's frame */
    knurl_grating_output grating;
} touch;

/* Where the surface stands now, and the HIP before and now in the shape's frame. */
static void place_hip(knurl_hip *hip, const double position[3], knurl_near *near, touch *t,
                      knurl_contact_query *query) {
    const knurl_motion *motion = &t->record->motion;
    if (motion->start_time - hip->time > MAX_LAG) {
        knurl_store_double(&hip->time, motion->start_time);
        hip->previous_time = motion->start_time - hip->period;
    }
    t->pose = &motion->end;
    if (!knurl_motion_is_over(motion, hip->time)) {
        knurl_motion_at(motion, hip->time, &t->moved);
        t->pose = &t->moved;
    }
    /* what holds a HIP and jumps may hold it still; what jumps past one never touched it */
    const int jumped = near->asked && near->jumps != motion->jumps;
    const int let_go = jumped && near->in_contact;
    if (let_go) {
        near->in_contact = 0;
        memset(&near->contact, 0, sizeof near->contact);
    }
    knurl_pose_to_own(t->pose, position, query->hip);
    query->has_previous = hip->has_previous && !let_go;
    if (near->asked && !jumped) {
        vec3_copy(near->previous, query->previous);
    } else if (knurl_motion_is_over(motion, hip->previous_time)) {
        knurl_pose_to_own(&motion->end, hip->previous, query->previous);
    } else {
        knurl_pose before;
        knurl_motion_at(motion, hip->previous_time, &before);
        knurl_pose_to_own(&before, hip->previous, query->previous);
    }
    near->jumps = motion->jumps;
    near->asked = 1;
    vec3_copy(query->hip, near->previous);
}

/* Friction: the HIP drags an anchor along the surface by a spring of the material's stiffness, and the anchor slips
 * where the spring would pull harder than friction holds. tangential: N, shape's frame. */
static void drag(const touch *t, knurl_near *near, double tangential[3]) {
    const knurl_contact *contact = &t->contact;
    const double friction = t->record->material.friction;
    const double hold =
        t->wall.felt < 0.0 ? -friction * t->wall.felt : 0.0; /* m: the spring's length that friction can hold */
    double stretch[3] = {0.0, 0.0, 0.0};
    if (near->in_contact && hold > 0.0) {
        vec3_sub(near->anchor, contact->proxy, stretch);
        vec3_make_tangent(contact->normal, stretch);
        const double length = vec3_length(stretch);
        if (length > hold) {
            vec3_scale(hold / length, stretch, stretch);
        }
    }
    vec3_madd(contact->proxy, 1.0, stretch, near->anchor);
    vec3_scale(t->wall.stiffness, stretch, tangential);
}

/* The velocity of the HIP over the surface, in the shape's frame. */
static void relative_velocity(const knurl_hip *hip, const touch *t, const double velocity[3], double local[3]) {
    if (!knurl_motion_is_over(&t->record->motion, hip->previous_time)) {
        double surface[3];
        double over[3];
        knurl_motion_velocity(&t->record->motion, hip->time, hip->period, t->proxy, surface);
        vec3_sub(velocity, surface, over);
        knurl_pose_turn_to_own(t->pose, over, local);
    } else {
        knurl_pose_turn_to_own(t->pose, velocity, local);
    }
}

/* The grating's share of this tick. over: velocity in the shape's frame. coordinates: where on the grating. */
static void play(const knurl_hip *hip, const double over[3], const double coordinates[2], knurl_near *near, touch *t) {
    const knurl_material_desc *m = &t->record->material;
    if (!t->record->has_grating && !near->grating.playing) { /* an event plays to its end */
        const knurl_grating_output none = {0.0, 0.0, 0.0, KNURL_NO_EVENT, 0, 0};
        t->grating = none;
        return;
    }
    double velocity[2] = {t->velocity[0], t->velocity[1]};
    double steepest = 1.0;
    if (m->method == KNURL_LOCKED &&
        !knurl_surface_rates(t->surface, t->record, &t->contact, over, velocity, &steepest)) {
        coordinates = NULL; /* it counts the way */
    }
    const knurl_grating grating = {{m->spatial_frequency[0], m->spatial_frequency[1]},
                                   t->record->is_smooth ? 0.0 : t->wall.amplitude,
                                   hip->rate,
                                   m->method,
                                   0,
                                   hip->quantum * steepest,
                                   0.0};
    knurl_grating_step(&grating, &near->grating, coordinates, velocity, &t->grating);
}

/* From a contact to a force: the grating's height at the HIP's velocity over the surface, then Eq. 9. */
static void render(const knurl_hip *hip, const double velocity[3], knurl_near *near, touch *t) {
    const knurl_material_desc *m = &t->record->material;
    const knurl_contact *contact = &t->contact;
    double over[3];
    double x[3];
    double y[3];
    double coordinates[2];
    knurl_pose_to_parent(t->pose, contact->proxy, t->proxy);
    knurl_pose_turn_to_parent(t->pose, contact->normal, t->normal);
    relative_velocity(hip, t, velocity, over);
    knurl_surface_frame(t->surface, t->record, contact, x, y, coordinates);
    const double along[2] = {vec3_dot(over, x), vec3_dot(over, y)};
    t->velocity[0] = along[0];
    t->velocity[1] = along[1];
    play(hip, over, coordinates, near, t);
    const double height = t->grating.height;
    double size = 0.0;
    if (t->wall.felt < height) { /* Eq. 9, with the wall's damping; never a pull */
        size = t->wall.stiffness * (height - t->wall.felt) - t->wall.damping * vec3_dot(over, contact->normal);
        size = size > 0.0 ? size : 0.0;
    }
    vec3_scale(size, t->normal, t->force);
    if (m->friction > 0.0) {
        double tangential[3];
        double turned[3];
        drag(t, near, tangential);
        knurl_pose_turn_to_parent(t->pose, tangential, turned);
        vec3_madd(t->force, 1.0, turned, t->force);
    }
}

/* Adds one surface's share; of several the deepest is told. */
static void add_touch(const touch *t, knurl_tick_output *out) {
    vec3_madd(out->force, 1.0, t->force, out->force);
    if (t->grating.saturated) {
        out->flags |= KNURL_TICK_FREQUENCY;
    }
    if (out->contacts++ > 0 && -t->contact.z <= out->depth) {
        return;
    }
    vec3_copy(t->proxy, out->proxy);
    vec3_copy(t->normal, out->normal);
    out->surface_velocity[0] = t->velocity[0];
    out->surface_velocity[1] = t->velocity[1];
    out->depth = -t->contact.z;
    out->height = t->grating.height;
    out->spatial_frequency = t->grating.spatial_frequency;
    out->temporal_frequency = t->grating.temporal_frequency;
    out->event = t->grating.event;
    out->surface = t->surface->id;
}

/* Whether the HIP's path in this tick comes into a surface's box. */
static int comes_near(const knurl_hip *hip, const knurl_near *near, const double position[3], double margin) {
    const double *from = hip->has_previous ? hip->previous : position;
    for (int i = 0; i < 3; i++) {
        const double low = from[i] < position[i] ? from[i] : position[i];
        const double high = from[i] < position[i] ? position[i] : from[i];
        if (high < (double)near->box[i] - margin || low > (double)near->box[3 + i] + margin) {
            return 0;
        }
    }
    return 1;
}

/* Where a HIP comes from that has slid off a surface, as long as it is behind where the surface was. */
static void hand_over(const knurl_hip *hip, const double position[3], handover *over) {
    double offset[3];
    vec3_sub(position, hip->left_proxy, offset);
    const double along = vec3_dot(offset, hip->left_normal);
    if (along < 0.0) {
        over->depth = HANDOVER_HEIGHT - along;
        vec3_madd(position, over->depth, hip->left_normal, over->from);
        over->given = 1;
    }
}

/* One surface of the list. Where there is no contact (any more), its state is cleared. */
static void ask(const knurl_world *world, knurl_hip *hip, knurl_near *near, handover *over, knurl_tick_output *out) {
    touch t;
    knurl_contact_query query;
    t.surface = near->place < world->capacity ? __atomic_load_n(&world->items[near->place], __ATOMIC_SEQ_CST) : NULL;
    if (!t.surface || (near->in_contact && near->generation != t.surface->generation)) {
        near->in_contact = near->asked = 0; /* it was taken out; another may be in its place */
        memset(&near->contact, 0, sizeof near->contact);
        knurl_guard_leave(&near->guard);
        if (!t.surface) {
            return;
        }
    }
    if (near->generation != t.surface->generation) {
        near->generation = t.surface->generation;
        near->asked = 0;
    }
    t.record = __atomic_load_n(&t.surface->record, __ATOMIC_SEQ_CST);
    place_hip(hip, out->hip, near, &t, &query);
    query.reach = t.record->reach;
    query.double_sided = t.surface->double_sided;
    int held = knurl_shape_contact(&t.surface->shape, &query, &near->contact, &t.contact);
    if (!held && near->in_contact) {
        vec3_copy(near->proxy, hip->left_proxy);
        vec3_copy(near->normal, hip->left_normal);
        hip->guard.left = near->guard.depth;
        hand_over(hip, out->hip, over);
        hip->left_time = over->given ? hip->time : -1.0;
    } else if (!held && over->given && query.has_previous) {
        knurl_pose_to_own(t.pose, over->from, query.previous);
        held = knurl_shape_contact(&t.surface->shape, &query, &near->contact, &t.contact);
    }
    if (held && !near->in_contact) {
        if (out->contacts == KNURL_MAX_CONTACTS) { /* beyond what is felt at once; asked again at the next tick */
            out->flags |= KNURL_TICK_CONTACTS_FULL;
            memset(&near->contact, 0, sizeof near->contact);
            return;
        }
        memset(&near->grating, 0, sizeof near->grating);
        knurl_guard_meet(&hip->guard, &near->guard, over->given);
    }
    if (held) {
        const int64_t events = near->grating.event_count;
        knurl_guard_clamp(&hip->guard, &t.record->material, t.contact.z, &t.wall);
        knurl_guard_enter(&hip->guard, &near->guard, &t.wall, &out->flags);
        knurl_guard_soften(&hip->guard, &t.wall, &out->flags);
        render(hip, out->hip_velocity, near, &t);
        knurl_guard_texture(&hip->guard, &near->guard, &t.wall, t.grating.height);
        hip->counts.events += (uint64_t)(near->grating.event_count - events);
        add_touch(&t, out);
        vec3_copy(t.proxy, near->proxy);
        vec3_copy(t.normal, near->normal);
    } else {
        knurl_guard_leave(&near->guard);
    }
    near->in_contact = (uint32_t)held;
}

/* m along the axis where it is farthest: from a point to a surface's box; negative inside. */
static double gap(const knurl_near *near, const double p[3]) {
    double widest = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const double below = (double)near->box[i] - p[i];
        const double above = p[i] - (double)near->box[3 + i];
        widest = below > widest ? below : widest;
        widest = above > widest ? above : widest;
    }
    return widest;
}

/* Whether the HIP is still where no box but those of what it touches can be met. */
static int is_calm(const knurl_hip *hip, const double p[3]) {
    return fabs(p[0] - hip->calm_at[0]) < hip->calm && fabs(p[1] - hip->calm_at[1]) < hip->calm &&
           fabs(p[2] - hip->calm_at[2]) < hip->calm;
}

/* Whatever is near and not touched (asked: what was, as bits) may begin. Finds out how far the HIP can go before it
 * comes near anything else. */
static void begin_others(const knurl_world *world, knurl_hip *hip, uint64_t asked, double margin, handover *over,
                         knurl_tick_output *out) {
    double calm = HUGE_VAL;
    for (uint32_t i = 0; i < hip->near_count; i++) {
        knurl_near *near = &hip->near[i];
        if (asked >> i & 1) {
            calm = near->in_contact ? calm : -1.0;
            continue;
        }
        if (comes_near(hip, near, out->hip, margin + over->depth)) {
            ask(world, hip, near, over, out);
        } else {
            near->asked = 0;
        }
        if (!near->in_contact) {
            calm = fmin(calm, gap(near, out->hip));
        }
    }
    hip->calm = calm - 2e-9; /* of which comes_near() takes one */
    vec3_copy(out->hip, hip->calm_at);
}

/* What is touched stays touched until its contact ends; then whatever else is near may begin. */
static void touch_all(const knurl_scene *scene, const knurl_world *world, knurl_hip *hip, knurl_tick_output *out) {
    const int same_version = hip->version == knurl_load_acquire(&scene->version);
    handover over = {{0.0, 0.0, 0.0}, 0.0, 0};
    const double margin = hip->has_previous ? 1e-9 : KNURL_CAPTURE_DEPTH;
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        inside &= out->hip[i] >= hip->near_low[i] && out->hip[i] <= hip->near_high[i];
    }
    if (!same_version || !hip->has_previous || !inside || hip->depth > hip->near_depth || hip->near_overflow ||
        (scene->full_model & KNURL_FULL_SEARCH)) {
        knurl_hip_look_around(scene, world, hip, out->hip);
        hip->calm = -1.0;
    }
    uint64_t asked = 0;
    if (hip->time - hip->left_time < HANDOVER_SECONDS && hip->has_previous) {
        hand_over(hip, out->hip, &over);
    }
    for (uint32_t i = 0; i < hip->near_count; i++) {
        if (hip->near[i].in_contact) {
            asked |= (uint64_t)1 << i;
            ask(world, hip, &hip->near[i], &over, out);
            hip->calm = hip->near[i].in_contact ? hip->calm : -1.0;
        }
    }
    if (over.given || !is_calm(hip, out->hip)) {
        begin_others(world, hip, asked, margin, &over, out);
    }
    hip->depth = over.given ? over.depth : 0.0;
    if (out->contacts > 0) {
        hip->depth = out->depth > 0.0 ? out->depth : 0.0;
        hip->left_time = -1.0;
    }
    if (hip->near_overflow) {
        out->flags |= KNURL_TICK_CONTACTS_FULL;
    }
}

/* What is told while nothing is touched, beside the HIP: all the rest of an output, field by field, because clearing it
 * as a block takes twice as long (rep stos) as everything else that is done with it. */
static void feel_nothing(knurl_tick_output *out) {
    vec3_copy(out->hip, out->proxy);
    for (int i = 0; i < 3; i++) {
        out->force[i] = out->normal[i] = 0.0;
    }
    out->surface_velocity[0] = out->surface_velocity[1] = 0.0;
    out->depth = out->height = 0.0;
    out->spatial_frequency = out->temporal_frequency = 0.0;
    out->event = KNURL_NO_EVENT;
    out->surface = 0;
    out->flags = out->contacts = 0;
}

/* Device to scene; the velocity as given, else estimated in device axes, where the quantisation is. */
static int read_hip(knurl_hip *hip, const knurl_tick_input *input, knurl_tick_output *out) {
    const knurl_workspace *w = &hip->workspace;
    double velocity[3];
    if (input->absent || !vec3_finite(input->position)) { /* never into the estimator */
        return 0;
    }
    if (input->has_velocity) {
        vec3_copy(input->velocity, velocity);
    } else {
        knurl_velocity_update(&hip->velocity, input->position, velocity);
    }
    if (hip->is_turned) {
        knurl_workspace_to_scene(w, input->position, out->hip);
        knurl_workspace_velocity_to_scene(w, velocity, out->hip_velocity);
    } else {
        vec3_madd(w->origin, w->scale, input->position, out->hip);
        vec3_scale(w->scale, velocity, out->hip_velocity);
    }
    feel_nothing(out);
    return vec3_finite(out->hip) && vec3_finite(out->hip_velocity);
}

/* Bounded and finite, whatever came before. Returns the force's length, N. */
static double limit_force(knurl_hip *hip, knurl_tick_output *out) {
    const double length = knurl_guard_force(&hip->guard, out->force, &out->flags);
    if (!knurl_is_finite(length)) {
        out->flags |= KNURL_TICK_NOT_FINITE;
    }
    return length;
}

/* No force, no contact, a first tick next. */
static void end_contacts(knurl_hip *hip) {
    hip->near_count = 0;
    hip->has_previous = 0;
    hip->calm = hip->left_time = -1.0;
    hip->depth = 0.0;
    knurl_guard_let_go(&hip->guard);
}

/* Nothing of this tick is to be trusted. */
static void let_go(knurl_hip *hip, uint32_t why, knurl_tick_output *out) {
    const uint64_t tick = out->tick;
    memset(out, 0, sizeof *out);
    knurl_velocity_reset(&hip->velocity);
    end_contacts(hip);
    out->tick = tick;
    out->event = KNURL_NO_EVENT;
    out->flags = why;
}

static void count_rare(uint32_t flags, knurl_hip_counts *c) {
    c->force_limits += (flags & KNURL_TICK_FORCE_LIMIT) != 0;
    c->frequency_saturations += (flags & KNURL_TICK_FREQUENCY) != 0;
    c->not_finite += (flags & KNURL_TICK_NOT_FINITE) != 0;
    c->entries += (flags & KNURL_TICK_ENTRY) != 0;
    c->slews += (flags & KNURL_TICK_SLEW) != 0;
    c->heats += (flags & KNURL_TICK_HEAT) != 0;
    c->passivities += (flags & KNURL_TICK_PASSIVITY) != 0;
}

static void count_and_publish(knurl_hip *hip, double force, const knurl_tick_output *out) {
    knurl_hip_counts *c = &hip->counts;
    c->ticks++;
    c->contact_ticks += (out->flags & KNURL_TICK_CONTACT) != 0;
    if (out->flags & ~(uint32_t)KNURL_TICK_CONTACT) {
        count_rare(out->flags, c);
    }
    c->heat = hip->guard.heat.theta;
    c->force_max = force > c->force_max ? force : c->force_max;
    knurl_seqlock_begin(&hip->published.sequence);
    knurl_seqlock_put(hip->published.words, out, sizeof *out);
    knurl_seqlock_put(hip->published.words + sizeof *out / sizeof(uint64_t), c, sizeof *c);
    knurl_seqlock_end(&hip->published.sequence);
}

/* From a HIP that has been read to the force; returns its length, N. */
static double feel(const knurl_scene *scene, const knurl_world *world, knurl_hip *hip, const knurl_tick_input *input,
                   knurl_tick_output *out) {
    knurl_guard_begin(&hip->guard, input->attenuation);
    if (input->paused) {
        end_contacts(hip);
        vec3_copy(out->force, out->device_force);
        return 0.0;
    }
    touch_all(scene, world, hip, out);
    const double length = limit_force(hip, out);
    if (out->flags & KNURL_TICK_NOT_FINITE) {
        let_go(hip, KNURL_TICK_NOT_FINITE, out);
        return 0.0;
    }
    out->flags |= out->contacts > 0 ? KNURL_TICK_CONTACT : 0;
    if (hip->is_turned) {
        knurl_workspace_vector_to_device(&hip->workspace, out->force, out->device_force);
    } else {
        vec3_copy(out->force, out->device_force);
    }
    vec3_copy(out->hip, hip->previous);
    hip->has_previous = 1;
    return length;
}

knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip_index, const knurl_tick_input *input,
                              knurl_tick_output *output) {
    if (hip_index >= scene->hip_count || !scene->committed) { /* no message: this may be the haptic thread */
        memset(output, 0, sizeof *output);
        output->event = KNURL_NO_EVENT;
        return hip_index >= scene->hip_count ? KNURL_ERROR_ARGUMENT : KNURL_ERROR_STATE;
    }
    knurl_hip *hip = &scene->hips[hip_index];
    double force = 0.0;
    (void)__atomic_exchange_n(&hip->pinned, __atomic_load_n(&scene->epoch, __ATOMIC_SEQ_CST), __ATOMIC_SEQ_CST);
    const knurl_world *world = __atomic_load_n(&scene->world, __ATOMIC_SEQ_CST);
    output->tick = hip->counts.ticks;
    const double time = hip->time + hip->period;
    hip->previous_time = hip->time;
    knurl_store_double(&hip->time, time);
    if (read_hip(hip, input, output)) {
        force = feel(scene, world, hip, input, output);
    } else {
        let_go(hip, input->absent ? KNURL_TICK_ABSENT : KNURL_TICK_NOT_FINITE, output);
    }
    knurl_store_release(&hip->pinned, 0);
    count_and_publish(hip, force, output);
    return KNURL_OK;
}
