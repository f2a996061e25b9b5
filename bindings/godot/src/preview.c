/* Warnings in the editor, without a running device: adds the surface to a scene of its own and checks it against a
 * simulated device with the real one's limits. SPDX-License-Identifier: MIT */
#include "preview.h"

#include "geometry.h"
#include "surface_node.h"
#include "warnings.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static uint64_t hash(uint64_t seed, const void *data, size_t size) { /* FNV-1a */
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) {
        seed = (seed ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return seed;
}

/* A hash of everything that an explanation depends on; not 0. */
static uint64_t key_of(const surface *s, const knurl_session_pose *at) {
    knurl_material_desc material;
    knurl_session_pose place;
    grating_describe(s->grating, &material);
    uint64_t key = hash(UINT64_C(0xcbf29ce484222325), at, sizeof *at);
    key = hash(key, &material, sizeof material);
    key = hash(key, s->axis, sizeof s->axis);
    key = hash(key, &s->layers, sizeof s->layers);
    key = hash(key, &s->double_sided, sizeof s->double_sided);
    key = hash(key, &s->box_coordinates, sizeof s->box_coordinates);
    key = hash(key, &s->smooth, sizeof s->smooth);
    key = hash(key, &s->meshes_seen, sizeof s->meshes_seen);
    for (const device *d = placed_devices; d; d = d->next_placed) {
        memset(&place, 0, sizeof place);
        (void)node_pose(d->base.object, &place);
        key = hash(key, &place, sizeof place);
        key = hash(key, &d->rate, sizeof d->rate);
        key = hash(key, &d->layers, sizeof d->layers);
        key = hash(key, &d->workspace_scale, sizeof d->workspace_scale);
        key = hash(key, d->uri ? d->uri : "", d->uri ? strlen(d->uri) : 0);
    }
    return key ? key : 1;
}

/* The URI of a simulated device with the same limits; null if they are unknown. */
static const char *preset_of(const device *d) {
    const char *uri = d->uri ? d->uri : "";
    if (strncmp(uri, "fake", 4) == 0) {
        return uri;
    }
    if (strncmp(uri, "touch", 5) == 0 || strncmp(uri, "auto", 4) == 0) {
        return "fake:?preset=touch";
    }
    return strncmp(uri, "falcon", 6) == 0 ? "fake:?preset=falcon" : NULL;
}

static knurl_result hold_against(const device *d, const char *preset, knurl_session *session) {
    static const double row[4] = {0.0, 0.0, 0.0, 0.0};
    double force[3];
    uint64_t played;
    knurl_session_pose place;
    knurl_session_desc desc;
    knurl_session_desc_init(&desc, sizeof desc);
    desc.device = preset;
    desc.update_rate_hz = d->rate;
    if (node_pose(d->base.object, &place)) {
        memcpy(desc.workspace.origin, place.position, sizeof place.position);
        memcpy(desc.workspace.rotation, place.rotation, sizeof place.rotation);
    }
    desc.workspace.scale = d->workspace_scale;
    const knurl_result result = knurl_session_open(session, &desc);
    return result ? result : knurl_session_play(session, row, 1, 1, force, &played);
}

/* device: may be null. Returns 0 if the surface cannot be felt at all. */
static int explain(surface *s, const knurl_session_pose *at, const device *d, char *text, size_t size) {
    char name[128];
    char why[2048] = "";
    knurl_session *session = NULL;
    knurl_surface_id id = 0;
    knurl_result result = knurl_session_create(&session);
    result = result ? result : surface_put(s, knurl_session_get_scene(session), at, 0, &id);
    if (result) {
        (void)snprintf(why, sizeof why, "It cannot be felt: %s.", knurl_error_message());
    } else if (d && !hold_against(d, preset_of(d), session)) {
        knurl_session_explain(session, id, why, sizeof why);
    }
    if (why[0] && d) {
        gd_node_name(d->base.object, name, sizeof name);
    }
    if (why[0]) {
        const size_t length = strlen(text);
        (void)snprintf(text + length, size - length, "%s%s%s%s", length > 0 ? "\n" : "", d ? name : "", d ? ": " : "",
                       why);
    }
    knurl_session_destroy(session);
    return !result;
}

void preview_surface(surface *s, const knurl_session_pose *at, char *text, size_t size) {
    const uint64_t key = key_of(s, at);
    text[0] = '\0';
    if (key == s->explained) {
        (void)snprintf(text, size, "%s", s->explanation);
        return;
    }
    int can_be_felt = explain(s, at, NULL, text, size);
    for (const device *d = placed_devices; d && can_be_felt; d = d->next_placed) {
        if (preset_of(d) && surface_is_on_layer_of(s, d)) {
            can_be_felt = explain(s, at, d, text, size);
        }
    }
    warnings_keep(s, text);
    const int may_change =
        !can_be_felt && geometry_is_made_later(surface_parent(s)); /* and there is no signal for it */
    s->explained = s->explanation && !may_change ? key : 0;
}

static double determinant_of(const double m[9]) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

void preview_uv_scale(surface *s, const knurl_session_pose *at, double scale[2]) {
    knurl_session *session = NULL;
    knurl_surface_id id = 0;
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    if (!knurl_session_create(&session) && !surface_put(s, knurl_session_get_scene(session), at, 0, &id)) {
        (void)knurl_scene_get_surface_info(knurl_session_get_scene(session), id, &info);
    }
    const double size = cbrt(fabs(determinant_of(at->rest))); /* which uvs were multiplied by (mesh.c) */
    scale[0] = size * info.uv_scale[0];
    scale[1] = size * info.uv_scale[1];
    knurl_session_destroy(session);
}
