/* The tick: a device position in, a device force out. Read knurl_scene_tick(), at the end, first.
 * No heap, lock, system call, clock, log or file in anything that is called from here. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/vec3.h"

#include <string.h>

/* One surface's share of a tick. */
typedef struct touch {
    double force[3]; /* scene, N, along the normal */
    double proxy[3]; /* scene, m */
    double normal[3];
    double z;
    double velocity[2]; /* of the HIP over the surface, in the surface's frame */
    knurl_grating_output grating;
} touch;

static void to_surface(const knurl_surface_data *surface, const double scene_point[3], double out[3]) {
    double offset[3];
    vec3_sub(scene_point, surface->position, offset);
    mat3_mul_transposed(surface->rotation, offset, out);
}

/* Contact of one HIP with one surface; everything in the surface's own frame. */
static int find_contact(const knurl_surface_data *surface, const knurl_hip *hip, const double position[3],
                        knurl_contact_state *state, knurl_contact *contact) {
    knurl_contact_query query;
    to_surface(surface, position, query.hip);
    to_surface(surface, hip->previous, query.previous);
    query.has_previous = hip->has_previous;
    query.reach = surface->reach;
    query.double_sided = surface->double_sided;
    return surface->mesh ? knurl_mesh_contact(surface->mesh, &query, state, contact)
                         : knurl_plane_contact(&surface->plane, &query, state, contact);
}

/* From a contact to a force: the grating's height at the HIP's velocity over the surface, then Eq. 9. */
static void render(const knurl_surface_data *surface, double rate, const double velocity[3],
                   const knurl_contact *contact, knurl_grating_state *state, touch *out) {
    const knurl_material_desc *m = &surface->material;
    double local_velocity[3];
    double x[3];
    double y[3];
    double coordinates[2];
    mat3_mul_transposed(surface->rotation, velocity, local_velocity); /* the surface stands still */
    knurl_surface_frame(surface, contact, x, y, coordinates);
    out->velocity[0] = vec3_dot(local_velocity, x);
    out->velocity[1] = vec3_dot(local_velocity, y);
    const knurl_grating grating = {{m->spatial_frequency[0], m->spatial_frequency[1]},
                                   surface->reach > 0.0 ? m->amplitude : 0.0,
                                   rate,
                                   m->method,
                                   0};
    knurl_grating_step(&grating, state, coordinates, out->velocity, &out->grating);
    const double height = out->grating.height;
    const double approach = vec3_dot(local_velocity, contact->normal);
    double size = 0.0;
    if (contact->z < height) { /* Eq. 9, with the wall's damping; never a pull */
        size = fmax(0.0, m->stiffness * (height - contact->z) - m->damping * approach);
    }
    mat3_mul(surface->rotation, contact->normal, out->normal);
    mat3_mul(surface->rotation, contact->proxy, out->proxy);
    vec3_madd(out->proxy, 1.0, surface->position, out->proxy);
    vec3_scale(size, out->normal, out->force);
    out->z = contact->z;
}

/* Adds one surface's share; of several the deepest is told. */
static void add_touch(const touch *t, knurl_surface id, knurl_tick_output *out) {
    vec3_madd(out->force, 1.0, t->force, out->force);
    if (t->grating.saturated) {
        out->flags |= KNURL_TICK_FREQUENCY;
    }
    if (out->contacts++ > 0 && -t->z <= out->depth) {
        return;
    }
    vec3_copy(t->proxy, out->proxy);
    vec3_copy(t->normal, out->normal);
    out->surface_velocity[0] = t->velocity[0];
    out->surface_velocity[1] = t->velocity[1];
    out->depth = -t->z;
    out->height = t->grating.height;
    out->spatial_frequency = t->grating.spatial_frequency;
    out->temporal_frequency = t->grating.temporal_frequency;
    out->event = t->grating.event;
    out->surface = id;
}

/* One surface in one slot; lets the slot go where there is no contact any more. */
static int touch_surface(const knurl_scene *scene, knurl_hip *hip, knurl_slot *slot, knurl_tick_output *out) {
    const knurl_surface_data *surface = &scene->surfaces[slot->surface];
    const int64_t events = slot->grating.event_count;
    knurl_contact contact;
    touch t = {0};
    if (!find_contact(surface, hip, out->hip, &slot->contact, &contact)) {
        memset(slot, 0, sizeof *slot);
        return 0;
    }
    slot->used = 1;
    render(surface, hip->rate, out->hip_velocity, &contact, &slot->grating, &t);
    hip->counts.events += (uint64_t)(slot->grating.event_count - events);
    add_touch(&t, (uint64_t)surface->generation << 32 | (slot->surface + 1), out);
    return 1;
}

/* Whether the HIP's path in this tick comes within reach of a surface's bounds. */
static int near(const knurl_surface_data *surface, const knurl_hip *hip, const double position[3]) {
    const double margin = surface->reach + (hip->has_previous ? 1e-9 : KNURL_CAPTURE_DEPTH);
    const double *from = hip->has_previous ? hip->previous : position;
    for (int axis = 0; axis < 3; axis++) {
        const double low = from[axis] < position[axis] ? from[axis] : position[axis];
        const double high = from[axis] < position[axis] ? position[axis] : from[axis];
        if (high < surface->bounds_min[axis] - margin || low > surface->bounds_max[axis] + margin) {
            return 0;
        }
    }
    return 1;
}

static int is_held(const knurl_hip *hip, uint32_t surface) {
    for (int i = 0; i < KNURL_MAX_CONTACTS; i++) {
        if (hip->slots[i].used && hip->slots[i].surface == surface) {
            return 1;
        }
    }
    return 0;
}

static int is_among(uint32_t place, const uint32_t *places, uint32_t count) {
    while (count > 0 && places[count - 1] != place) {
        count--;
    }
    return count > 0;
}

static knurl_slot *free_slot(knurl_hip *hip) {
    for (int i = 0; i < KNURL_MAX_CONTACTS; i++) {
        if (!hip->slots[i].used) {
            return &hip->slots[i];
        }
    }
    return NULL;
}

/* What is touched stays touched until its contact ends; then whatever else is near may begin. */
static void touch_all(const knurl_scene *scene, knurl_hip *hip, knurl_tick_output *out) {
    uint32_t ended[KNURL_MAX_CONTACTS]; /* they were asked already in this tick */
    uint32_t ended_count = 0;
    for (int i = 0; i < KNURL_MAX_CONTACTS; i++) {
        const uint32_t surface = hip->slots[i].surface;
        if (hip->slots[i].used && !touch_surface(scene, hip, &hip->slots[i], out)) {
            ended[ended_count++] = surface;
        }
    }
    for (uint32_t i = 0; i < scene->surface_count; i++) {
        const uint32_t place = scene->order[i];
        if (is_among(place, ended, ended_count) || is_held(hip, place) ||
            !near(&scene->surfaces[place], hip, out->hip)) {
            continue;
        }
        knurl_slot *slot = free_slot(hip);
        if (!slot) {
            knurl_contact_state none = {0, 0, 0};
            knurl_contact contact;
            if (find_contact(&scene->surfaces[place], hip, out->hip, &none, &contact)) {
                out->flags |= KNURL_TICK_CONTACTS_FULL;
                return;
            }
            continue;
        }
        slot->surface = place;
        (void)touch_surface(scene, hip, slot, out);
    }
}

/* Device to scene; the velocity as given, else estimated in device axes, where the quantisation is. */
static int read_hip(knurl_hip *hip, const knurl_tick_input *input, knurl_tick_output *out) {
    double velocity[3];
    if (!vec3_finite(input->position) || (input->has_velocity && !vec3_finite(input->velocity))) {
        return 0;
    }
    if (input->has_velocity) {
        vec3_copy(input->velocity, velocity);
    } else {
        knurl_velocity_update(&hip->velocity, input->position, velocity);
    }
    knurl_workspace_to_scene(&hip->workspace, input->position, out->hip);
    knurl_workspace_velocity_to_scene(&hip->workspace, velocity, out->hip_velocity);
    vec3_copy(out->hip, out->proxy);
    return vec3_finite(out->hip) && vec3_finite(out->hip_velocity);
}

/* Bounded and finite, whatever came before. */
static void limit_force(const knurl_hip *hip, knurl_tick_output *out) {
    const double length = vec3_length(out->force);
    if (length > hip->max_force) {
        vec3_scale(hip->max_force / length, out->force, out->force);
        out->flags |= KNURL_TICK_FORCE_LIMIT;
    }
    if (!isfinite(length)) {
        out->flags |= KNURL_TICK_NOT_FINITE;
    }
}

/* Nothing of this tick is to be trusted: no force, no contact, a first tick next. */
static void let_go(knurl_hip *hip, knurl_tick_output *out) {
    const uint64_t tick = out->tick;
    memset(out, 0, sizeof *out);
    memset(hip->slots, 0, sizeof hip->slots);
    knurl_velocity_reset(&hip->velocity);
    hip->has_previous = 0;
    out->tick = tick;
    out->event = KNURL_NO_EVENT;
    out->flags = KNURL_TICK_NOT_FINITE;
}

static void count_and_publish(knurl_hip *hip, const knurl_tick_output *out) {
    knurl_hip_counts *c = &hip->counts;
    c->ticks++;
    c->contact_ticks += (out->flags & KNURL_TICK_CONTACT) != 0;
    c->force_limits += (out->flags & KNURL_TICK_FORCE_LIMIT) != 0;
    c->frequency_saturations += (out->flags & KNURL_TICK_FREQUENCY) != 0;
    c->not_finite += (out->flags & KNURL_TICK_NOT_FINITE) != 0;
    c->force_max = fmax(c->force_max, vec3_length(out->force));
    const knurl_snapshot snapshot = {*out, *c};
    knurl_seqlock_write(&hip->published.sequence, hip->published.words, &snapshot, sizeof snapshot);
}

knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip_index, const knurl_tick_input *input,
                              knurl_tick_output *output) {
    memset(output, 0, sizeof *output);
    output->event = KNURL_NO_EVENT;
    if (hip_index >= scene->hip_count) {
        return KNURL_ERROR_ARGUMENT; /* no message: this may be the haptic thread */
    }
    if (!scene->committed) {
        return KNURL_ERROR_STATE;
    }
    knurl_hip *hip = &scene->hips[hip_index];
    output->tick = hip->counts.ticks;
    if (!read_hip(hip, input, output)) {
        let_go(hip, output);
    } else {
        touch_all(scene, hip, output);
        limit_force(hip, output);
        if (output->flags & KNURL_TICK_NOT_FINITE) {
            let_go(hip, output);
        } else {
            output->flags |= output->contacts > 0 ? KNURL_TICK_CONTACT : 0;
            knurl_workspace_vector_to_device(&hip->workspace, output->force, output->device_force);
            vec3_copy(output->hip, hip->previous);
            hip->has_previous = 1;
        }
    }
    count_and_publish(hip, output);
    return KNURL_OK;
}
