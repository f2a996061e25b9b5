/* Surfaces follow their nodes into the scenes of running devices. SPDX-License-Identifier: MIT */
#include "follow.h"

#include "geometry.h"
#include "shapes.h"
#include "surface_node.h"
#include "warnings.h"
#include "watch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Errors logged per frame; the rest are only counted. */
enum { MOST_ERRORS = 3 };

static void complain(device *d, surface *s) {
    char name[128];
    char sentence[1024];
    (void)snprintf(sentence, sizeof sentence, "It cannot be felt: %s.", knurl_error_message());
    warnings_keep(s, sentence);
    if (d->failures++ < MOST_ERRORS) {
        gd_node_name(surface_parent(s), name, sizeof name);
        gd_error("KnurlSurface", "KnurlSurface of '%s': %s", name, knurl_error_message());
    }
}

void follow_count_failures(device *d) {
    if (d->failures > MOST_ERRORS) {
        gd_error("KnurlSurface", "KnurlSurface: %u further surfaces are not felt",
                 (unsigned)(d->failures - MOST_ERRORS));
    }
    d->failures = 0;
}

static int can_be_felt(const surface *s) {
    char refusal[512];
    geometry_refuse(surface_parent(s), refusal, sizeof refusal);
    return s->enabled && !s->is_disabled && s->grating && !s->is_leaving && !refusal[0];
}

static void keep_rotation(surface_placement *placement, const gd_transform *transform, const double quaternion[4]) {
    memcpy(placement->basis, transform->basis, sizeof placement->basis);
    memcpy(placement->quaternion, quaternion, sizeof placement->quaternion);
}

/* Handles a surface that could not be added to the scene. An empty CSG shape or grid map is tried again in each frame.
 */
static void refuse(device *d, surface *s, knurl_result why) {
    const int may_come = why == KNURL_ERROR_STATE && geometry_is_made_later(surface_parent(s));
    if (!may_come || s->tries + 1 == TRIES) {
        complain(d, s);
    }
    if (may_come) {
        s->tries = s->tries < TRIES ? (uint8_t)(s->tries + 1) : TRIES;
        s->made_anew |= (uint8_t)(1u << d->slot);
        surface_mark(s);
    }
    follow_remove(d, s);
}

void follow_put(device *d, surface *s) {
    const uint8_t bit = (uint8_t)(1u << d->slot);
    const uint8_t others = (uint8_t)~bit;
    const knurl_surface_id before = s->ids[d->slot];
    gd_transform transform;
    knurl_session_pose at;
    s->moved &= others;
    s->changed &= others;
    s->made_anew &= others;
    s->flat &= others;
    if (!s->is_leaving) {
        watch_mesh(s);
    }
    if (!can_be_felt(s) || !surface_is_on_layer_of(s, d)) {
        follow_remove(d, s);
        return;
    }
    node_transform(s->base.object, &transform);
    if (!transform_pose(&transform, &at)) {
        s->flat |= bit;
        follow_remove(d, s);
        return;
    }
    const shape_key key = shapes_key(s, at.rest, d->slot);
    shape *shared = shapes_find(&key);
    const knurl_result failed =
        surface_put(s, knurl_session_get_scene(d->session), &at, shared ? shapes_user(shared) : 0, &s->ids[d->slot]);
    if (failed) {
        refuse(d, s, failed);
        return;
    }
    shapes_join(s, &key, shared);
    s->tries = 0;
    warnings_keep(s, NULL);
    surface_placement *placement = &s->placements[d->slot];
    if (!before) {
        memset(&placement->way, 0, sizeof placement->way);
    }
    memcpy(placement->way.position, at.position, sizeof at.position);
    memcpy(placement->rest, at.rest, sizeof at.rest);
    keep_rotation(placement, &transform, at.quaternion);
}

void follow_remove(device *d, surface *s) {
    const knurl_surface_id id = s->ids[d->slot];
    if (id) {
        shapes_leave(s, d->slot);
        s->ids[d->slot] = 0;
        /* signals.c reports the end of a contact */
        (void)knurl_scene_remove_surface(knurl_session_get_scene(d->session), id);
    }
}

/* Finds the node's pose. Returns 0 if the surface must be added again, because its scale has changed or is zero. Most
 * moves keep the basis, and with it rotation and scale: splitting it would be a third of a move's cost. */
static int follow_node(surface_placement *placement, const gd_transform *transform, double position[3]) {
    knurl_session_pose at;
    int is_same = 1;
    for (int i = 0; i < 3; i++) {
        position[i] = (double)transform->origin[i];
        is_same = is_same && isfinite(position[i]);
        for (int j = 0; j < 3; j++) {
            is_same = is_same && placement->basis[i][j] == transform->basis[i][j];
        }
    }
    if (is_same) {
        return 1;
    }
    if (!transform_pose(transform, &at) || !knurl_session_same_rest(at.rest, placement->rest)) {
        return 0;
    }
    keep_rotation(placement, transform, at.quaternion);
    return 1;
}

static void move(device *d, surface *s) {
    surface_placement *placement = &s->placements[d->slot];
    gd_transform transform;
    double position[3];
    node_transform(s->base.object, &transform);
    if (!follow_node(placement, &transform, position)) {
        follow_put(d, s);
        return;
    }
    placement->way.clock = s->by_physics ? KNURL_SESSION_STEPS : KNURL_SESSION_FRAMES;
    if (knurl_session_move_surface(d->session, s->ids[d->slot], &placement->way, position, placement->quaternion)) {
        complain(d, s);
    }
}

static void set_material(device *d, surface *s) {
    knurl_material_desc material;
    grating_describe(s->grating, &material);
    if (knurl_scene_set_material(knurl_session_get_scene(d->session), s->ids[d->slot], &material)) {
        complain(d, s);
    }
}

static void apply_changes(device *d, surface *s) {
    const uint8_t bit = (uint8_t)(1u << d->slot);
    const uint8_t others = (uint8_t)~bit;
    const int is_anew = ((s->made_anew | (s->flat & s->moved)) & bit) != 0;
    s->made_anew &= others;
    if (s->is_leaving) {
        follow_remove(d, s);
    } else if (is_anew) {
        follow_put(d, s);
    }
    if (s->ids[d->slot] && s->grating && s->changed & bit) {
        set_material(d, s);
    }
    if (s->ids[d->slot] && s->moved & bit) {
        move(d, s);
    }
    s->changed &= others;
    s->moved &= others;
}

int follow_is_felt(const surface *s) {
    int is_felt = 0;
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        is_felt |= devices[i] && s->ids[i] != 0;
    }
    return is_felt;
}

static uint8_t running_slots(void) {
    unsigned running = 0;
    for (unsigned i = 0; i < DEVICE_SLOTS; i++) {
        running |= devices[i] ? 1u << i : 0u;
    }
    return (uint8_t)running;
}

void follow_all(device *d) {
    const uint8_t running = running_slots();
    for (surface *s = d->gratings_seen < grating_changes ? surfaces : NULL; s; s = s->next) {
        if (s->ids[d->slot] && s->grating && s->grating->changed_at > d->gratings_seen) {
            set_material(d, s);
        }
    }
    d->gratings_seen = grating_changes;
    for (surface *s = marked_surfaces, *next; s; s = next) {
        next = s->next_marked;
        apply_changes(d, s);
        if (s->is_leaving && !follow_is_felt(s)) {
            surface_unlist(s);
        } else if (!s->is_leaving && !((s->moved | s->changed | s->made_anew) & running)) {
            surface_unmark(s);
        }
    }
    follow_count_failures(d);
}
