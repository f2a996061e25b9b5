/* Shapes that surfaces share. SPDX-License-Identifier: MIT */
#include "shapes.h"

#include "geometry.h"
#include "surface_node.h"

#include <stdlib.h>
#include <string.h>

enum { BUCKETS = 4096 };

struct shape {
    struct shape *next; /* in its bucket */
    shape_key key;
    int is_expired;
    surface *users; /* linked by their placements; at least one */
};

static shape *buckets[BUCKETS];

static shape **bucket_of(const shape_key *key) {
    const unsigned char *bytes = (const unsigned char *)key;
    uint64_t hash = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
    for (size_t i = 0; i < sizeof *key; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return &buckets[(hash ^ hash >> 32) % BUCKETS];
}

shape_key shapes_key(const surface *s, const double rest[9], int slot) {
    shape_key key;
    gd_variant held;
    memset(&key, 0, sizeof key); /* its bytes are hashed */
    const GDExtensionObjectPtr mesh = geometry_mesh(surface_parent(s), &held);
    key.mesh = mesh ? gd.object_get_instance_id(mesh) : 0;
    gd.variant_destroy(&held);
    for (int i = 0; i < 9; i++) {
        key.rest[i] = (float)rest[i] + 0.0F; /* no -0 */
    }
    for (int i = 0; i < 3; i++) {
        key.axis[i] = s->axis[i] + 0.0F;
    }
    key.smooth = (int32_t)s->smooth;
    key.box_coordinates = s->box_coordinates;
    key.slot = (uint16_t)slot;
    return key;
}

static int is_same(const shape_key *a, const shape_key *b) {
    int same =
        a->mesh == b->mesh && a->smooth == b->smooth && a->box_coordinates == b->box_coordinates && a->slot == b->slot;
    for (int i = 0; i < 9; i++) {
        same = same && a->rest[i] == b->rest[i] && a->axis[i % 3] == b->axis[i % 3];
    }
    return same;
}

shape *shapes_find(const shape_key *key) {
    shape *found = key->mesh ? *bucket_of(key) : NULL;
    while (found && (found->is_expired || !is_same(&found->key, key))) {
        found = found->next;
    }
    return found;
}

void shapes_expire(const surface *s) {
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (s->placements[i].shape) {
            s->placements[i].shape->is_expired = 1;
        }
    }
}

knurl_surface_id shapes_user(const shape *shared) {
    return shared->users->ids[shared->key.slot];
}

static shape *add(const shape_key *key) {
    shape **bucket = bucket_of(key);
    shape *made = key->mesh ? calloc(1, sizeof *made) : NULL;
    if (made) { /* without memory it is not shared */
        made->key = *key;
        made->next = *bucket;
        *bucket = made;
    }
    return made;
}

void shapes_join(surface *s, const shape_key *key, shape *shared) {
    surface_placement *placement = &s->placements[key->slot];
    if (shared && placement->shape == shared) {
        return;
    }
    shapes_leave(s, key->slot);
    shared = shared ? shared : add(key);
    placement->shape = shared;
    placement->previous_user = NULL;
    placement->next_user = shared ? shared->users : NULL;
    if (placement->next_user) {
        placement->next_user->placements[key->slot].previous_user = s;
    }
    if (shared) {
        shared->users = s;
    }
}

static void end(shape *unused) {
    shape **at = bucket_of(&unused->key);
    while (*at != unused) {
        at = &(*at)->next;
    }
    *at = unused->next;
    free(unused);
}

void shapes_leave(surface *s, int slot) {
    surface_placement *placement = &s->placements[slot];
    shape *left = placement->shape;
    if (!left) {
        return;
    }
    if (placement->next_user) {
        placement->next_user->placements[slot].previous_user = placement->previous_user;
    }
    if (placement->previous_user) {
        placement->previous_user->placements[slot].next_user = placement->next_user;
    } else {
        left->users = placement->next_user;
    }
    placement->shape = NULL;
    placement->next_user = placement->previous_user = NULL;
    if (!left->users) {
        end(left);
    }
}
