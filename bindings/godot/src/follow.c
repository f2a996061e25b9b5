/* Surfaces follow their nodes into the scenes of running devices. SPDX-License-Identifier: MIT */
#include "mesh.h"
#include "world.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* m/s: what moves faster is put there, and not dragged through what it passes. */
#define FASTEST 10.0

/* s: the time that a first move takes; further ones take what lay between the last two. */
#define FIRST_MOVE (1.0 / 60.0)
#define LONGEST    0.1

static GDExtensionObjectPtr parent_of(const surface *s) {
    GDExtensionObjectPtr parent = NULL;
    gd_call(gd_method.Node_get_parent, s->base.object, NULL, &parent);
    return gd_cast(parent, "MeshInstance3D");
}

/* The parent's mesh in a Variant that holds it: to be ended. Null where there is none. */
static GDExtensionObjectPtr mesh_of(const surface *s, gd_variant *held) {
    const GDExtensionObjectPtr parent = parent_of(s);
    GDExtensionObjectPtr mesh = NULL;
    if (parent) {
        *held = gd_call_variant(gd_method.MeshInstance3D_get_mesh, parent, -1);
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&mesh, held);
    } else {
        gd.variant_new_nil(held);
    }
    return mesh;
}

static int pose_of(const surface *s, pose *out) {
    gd_transform transform;
    gd_call(gd_method.Node3D_get_global_transform, s->base.object, NULL, &transform);
    return pose_split(&transform, out);
}

static void complain(const surface *s) {
    char name[128];
    gd_node_name(s->base.object, name, sizeof name);
    gd_error("KnurlSurface", "KnurlSurface '%s': %s", name, knurl_error_message());
}

static knurl_result add(device *d, surface *s, const mesh_data *data, const pose *at, knurl_surface *id) {
    char name[128];
    knurl_surface_desc desc;
    knurl_mesh_desc mesh;
    knurl_material_desc material;
    gd_node_name(parent_of(s), name, sizeof name);
    knurl_surface_desc_init(&desc, sizeof desc);
    mesh_describe(data, &mesh);
    grating_describe(s->grating, &material);
    desc.name = name;
    desc.mesh = &mesh;
    desc.material = &material;
    desc.double_sided = s->double_sided;
    memcpy(desc.position, at->position, sizeof desc.position);
    memcpy(desc.rotation, at->quaternion, sizeof desc.rotation);
    float axis[3];
    for (int i = 0; i < 3; i++) { /* the axis is the mesh's: scaled like it */
        axis[i] = 0.0F;
        for (int j = 0; j < 3; j++) {
            axis[i] += (float)at->rest[3 * i + j] * s->axis[j];
        }
        desc.axis[i] = (double)axis[i];
    }
    return knurl_scene_add_surface(d->scene, &desc, id);
}

void follow_add(device *d, surface *s) {
    const uint8_t others = (uint8_t)~(1u << d->slot);
    gd_variant held;
    mesh_data data;
    pose at;
    s->moved &= others;
    s->changed &= others;
    s->made_anew &= others;
    const GDExtensionObjectPtr mesh = mesh_of(s, &held);
    s->flat = (uint8_t)(pose_of(s, &at) ? s->flat & others : s->flat | (1u << d->slot));
    if (mesh && s->enabled && s->grating && !(s->flat & ~others)) {
        knurl_surface id = 0;
        const int fits = mesh_read(mesh, at.rest, &data);
        const knurl_result result = !fits ? knurl_fail(KNURL_ERROR_MEMORY, "no memory to read its mesh with")
                                    : data.index_count == 0
                                        ? knurl_fail(KNURL_ERROR_ARGUMENT, "its mesh has no triangles")
                                        : add(d, s, &data, &at, &id);
        if (result) {
            complain(s);
        }
        s->ids[d->slot] = id;
        memcpy(s->rest[d->slot], at.rest, sizeof at.rest);
        memcpy(s->position[d->slot], at.position, sizeof at.position);
        mesh_end(&data);
    }
    gd.variant_destroy(&held);
}

void follow_remove(device *d, surface *s) {
    const knurl_surface id = s->ids[d->slot];
    if (id) {
        s->ids[d->slot] = 0;
        (void)knurl_scene_remove_surface(d->scene, id); /* what that ended is told by signals.c */
    }
}

static void move(device *d, surface *s, uint64_t tick) {
    const int slot = d->slot;
    pose at;
    if (!pose_of(s, &at)) {
        follow_remove(d, s);
        s->flat |= (uint8_t)(1u << slot);
        return;
    }
    if (!pose_same_rest(at.rest, s->rest[slot])) {
        follow_remove(d, s);
        follow_add(d, s);
        return;
    }
    double seconds = (double)(tick - s->moved_at[slot]) / d->rate; /* by ticks: the game's clock may run slow */
    double way = 0.0;
    seconds = seconds > LONGEST ? FIRST_MOVE : seconds;
    for (int i = 0; i < 3; i++) {
        way += (at.position[i] - s->position[slot][i]) * (at.position[i] - s->position[slot][i]);
    }
    seconds = sqrt(way) > FASTEST * fmax(seconds, FIRST_MOVE) ? 0.0 : seconds;
    s->moved_at[slot] = tick;
    memcpy(s->position[slot], at.position, sizeof at.position);
    if (knurl_scene_set_transform(d->scene, s->ids[slot], at.position, at.quaternion, seconds)) {
        complain(s);
    }
}

static void feel(device *d, surface *s) {
    knurl_material_desc material;
    grating_describe(s->grating, &material);
    if (knurl_scene_set_material(d->scene, s->ids[d->slot], &material)) {
        complain(s);
    }
}

static void tell(device *d, surface *s, uint64_t tick) {
    const uint8_t bit = (uint8_t)(1u << d->slot);
    const uint8_t others = (uint8_t)~bit;
    if ((s->made_anew | (s->flat & s->moved)) & bit) {
        follow_remove(d, s);
        follow_add(d, s);
    }
    if (s->ids[d->slot] && s->changed & bit) {
        feel(d, s);
    }
    if (s->ids[d->slot] && s->moved & bit) {
        move(d, s, tick);
    }
    s->changed &= others;
    s->moved &= others;
}

static uint8_t running_slots(void) {
    unsigned running = 0;
    for (unsigned i = 0; i < DEVICE_SLOTS; i++) {
        running |= devices[i] ? 1u << i : 0u;
    }
    return (uint8_t)running;
}

void follow_all(device *d, uint64_t tick) {
    const uint8_t running = running_slots();
    for (surface *s = d->gratings_seen < grating_changes ? surfaces : NULL; s; s = s->next) {
        if (s->ids[d->slot] && s->grating && s->grating->changed_at > d->gratings_seen) {
            feel(d, s);
        }
    }
    d->gratings_seen = grating_changes;
    for (surface **at = &marked_surfaces; *at;) {
        surface *s = *at;
        tell(d, s, tick);
        if ((s->moved | s->changed | s->made_anew) & running) {
            at = &s->next_marked;
        } else {
            *at = s->next_marked;
            s->is_marked = 0;
        }
    }
}

/* 1 where some of the surface lies where the device can go. */
static int is_in_reach(const device *d, const knurl_surface_info *info) {
    knurl_device_info limits;
    knurl_device_info_init(&limits, sizeof limits);
    if (knurl_device_get_info(d->device, &limits)) {
        return 1;
    }
    double least[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int corner = 0; corner < 8; corner++) {
        double at[3];
        for (int i = 0; i < 3; i++) {
            at[i] = corner >> i & 1 ? info->bounds_max[i] : info->bounds_min[i];
        }
        knurl_workspace_to_device(&d->workspace, at, at);
        for (int i = 0; i < 3; i++) {
            least[i] = fmin(least[i], at[i]);
            most[i] = fmax(most[i], at[i]);
        }
    }
    int is_near = 1;
    for (int i = 0; i < 3; i++) {
        is_near = is_near && least[i] <= limits.workspace_max[i] && most[i] >= limits.workspace_min[i];
    }
    return is_near;
}

static void say(char *text, size_t size, const char *sentence) {
    const size_t length = strlen(text);
    (void)snprintf(text + length, size - length, "%s%s", length > 0 ? "\n" : "", sentence);
}

static void explain_in(const device *d, const surface *s, char *text, size_t size) {
    knurl_surface_info info;
    knurl_surface_check check;
    const knurl_surface id = s->ids[d->slot];
    knurl_surface_info_init(&info, sizeof info);
    knurl_surface_check_init(&check, sizeof check);
    if (!id) {
        return;
    }
    if (!knurl_scene_surface_info(d->scene, id, &info) && !is_in_reach(d, &info)) {
        say(text, size,
            "It lies outside of the device's workspace: move the KnurlDevice there, or raise its workspace_scale.");
    }
    if (!knurl_scene_check_surface(d->scene, 0, id, &check) && check.exceeded) {
        check.message[sizeof check.message - 1] = '\0';
        say(text, size, check.message);
    }
}

void follow_explain(const surface *s, char *text, size_t size) {
    uint8_t is_inside = 0;
    gd_variant held;
    pose at;
    text[0] = '\0';
    gd_call(gd_method.Node_is_inside_tree, s->base.object, NULL, &is_inside);
    if (!parent_of(s)) {
        say(text, size, "Its parent is not a MeshInstance3D: there is no mesh to feel.");
    } else {
        if (!mesh_of(s, &held)) {
            say(text, size, "Its parent has no mesh.");
        }
        gd.variant_destroy(&held);
    }
    if (!s->grating) {
        say(text, size, "It has no grating: nothing says how it feels.");
    }
    if (is_inside && !pose_of(s, &at)) {
        say(text, size, "It is scaled to nothing.");
    }
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i]) {
            explain_in(devices[i], s, text, size);
        }
    }
}
