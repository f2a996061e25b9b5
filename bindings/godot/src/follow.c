/* Surfaces follow their nodes into the scenes of running devices. SPDX-License-Identifier: MIT */
#include "follow.h"

#include "mesh.h"

#include <stdio.h>
#include <string.h>

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

int follow_pose(GDExtensionObjectPtr node, knurl_session_pose *pose) {
    gd_transform transform;
    double matrix[12];
    gd_call(gd_method.Node3D_get_global_transform, node, NULL, &transform);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            matrix[4 * i + j] = (double)transform.basis[i][j];
        }
        matrix[4 * i + 3] = (double)transform.origin[i];
    }
    return (int)knurl_session_split_pose(matrix, pose);
}

static void complain(const surface *s) {
    char name[128];
    gd_node_name(s->base.object, name, sizeof name);
    gd_error("KnurlSurface", "KnurlSurface '%s': %s", name, knurl_error_message());
}

static knurl_result add(device *d, surface *s, const mesh_data *data, const knurl_session_pose *at,
                        knurl_surface_id *id) {
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
    return knurl_scene_add_surface(knurl_session_get_scene(d->session), &desc, id);
}

void follow_add(device *d, surface *s) {
    const uint8_t others = (uint8_t)~(1u << d->slot);
    gd_variant held;
    mesh_data data;
    knurl_session_pose at;
    s->moved &= others;
    s->changed &= others;
    s->made_anew &= others;
    const GDExtensionObjectPtr mesh = mesh_of(s, &held);
    s->flat = (uint8_t)(follow_pose(s->base.object, &at) ? s->flat & others : s->flat | (1u << d->slot));
    if (mesh && s->enabled && s->grating && !(s->flat & ~others)) {
        knurl_surface_id id = 0;
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
        memset(&s->ways[d->slot], 0, sizeof s->ways[d->slot]);
        memcpy(s->ways[d->slot].position, at.position, sizeof at.position);
        mesh_end(&data);
    }
    gd.variant_destroy(&held);
}

void follow_remove(device *d, surface *s) {
    const knurl_surface_id id = s->ids[d->slot];
    if (id) {
        s->ids[d->slot] = 0;
        /* what that ends is told by signals.c */
        (void)knurl_scene_remove_surface(knurl_session_get_scene(d->session), id);
    }
}

static void move(device *d, surface *s) {
    const int slot = d->slot;
    knurl_session_pose at;
    if (!follow_pose(s->base.object, &at)) {
        follow_remove(d, s);
        s->flat |= (uint8_t)(1u << slot);
        return;
    }
    if (!knurl_session_same_rest(at.rest, s->rest[slot])) {
        follow_remove(d, s);
        follow_add(d, s);
        return;
    }
    s->ways[slot].clock = s->by_physics ? KNURL_SESSION_STEPS : KNURL_SESSION_FRAMES;
    if (knurl_session_move_surface(d->session, s->ids[slot], &s->ways[slot], at.position, at.quaternion)) {
        complain(s);
    }
}

static void feel(device *d, surface *s) {
    knurl_material_desc material;
    grating_describe(s->grating, &material);
    if (knurl_scene_set_material(knurl_session_get_scene(d->session), s->ids[d->slot], &material)) {
        complain(s);
    }
}

static void tell(device *d, surface *s) {
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
        move(d, s);
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

void follow_all(device *d) {
    const uint8_t running = running_slots();
    for (surface *s = d->gratings_seen < grating_changes ? surfaces : NULL; s; s = s->next) {
        if (s->ids[d->slot] && s->grating && s->grating->changed_at > d->gratings_seen) {
            feel(d, s);
        }
    }
    d->gratings_seen = grating_changes;
    for (surface **at = &marked_surfaces; *at;) {
        surface *s = *at;
        tell(d, s);
        if ((s->moved | s->changed | s->made_anew) & running) {
            at = &s->next_marked;
        } else {
            *at = s->next_marked;
            s->is_marked = 0;
        }
    }
}

static void say(char *text, size_t size, const char *sentence) {
    const size_t length = strlen(text);
    const char *line = length > 0 && sentence[0] ? "\n" : "";
    (void)snprintf(text + length, size - length, "%s%s", line, sentence);
}

void follow_explain(const surface *s, char *text, size_t size) {
    uint8_t is_inside = 0;
    gd_variant held;
    knurl_session_pose at;
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
    if (is_inside && !follow_pose(s->base.object, &at)) {
        say(text, size, "It is scaled to nothing.");
    }
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i] && s->ids[i]) {
            char why[4096];
            knurl_session_explain(devices[i]->session, s->ids[i], why, sizeof why);
            say(text, size, why);
        }
    }
}
