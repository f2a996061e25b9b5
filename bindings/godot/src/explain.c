/* Warnings of surfaces that cannot be felt, or differ from their settings. SPDX-License-Identifier: MIT */
#include "explain.h"

#include "geometry.h"
#include "preview.h"
#include "surface_node.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Limits on surfaces checked and warnings printed when a device starts. */
enum { MOST_LOOKED_AT = 1000, MOST_WARNINGS = 8 };

/* Start of knurl_session_explain()'s line for a surface out of reach (common/move.c). */
#define OUT_OF_REACH "It lies outside of the device's workspace"

static void say(char *text, size_t size, const char *sentence) {
    const size_t length = strlen(text);
    const char *line = length > 0 && sentence[0] ? "\n" : "";
    (void)snprintf(text + length, size - length, "%s%s", line, sentence);
}

/* The object that a getter returns, for comparisons only: it may be freed already. */
static GDExtensionObjectPtr result_of(GDExtensionObjectPtr object, const char *method) {
    GDExtensionObjectPtr found = NULL;
    gd_variant held = gd_call_named(object, method, NULL, 0);
    if (gd.variant_get_type(&held) == GDEXTENSION_VARIANT_TYPE_OBJECT) {
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&found, &held);
    }
    gd.variant_destroy(&held);
    return found;
}

static void say_bends(GDExtensionObjectPtr parent, char *text, size_t size) {
    int64_t shapes = 0;
    if (gd_cast(parent, "SoftBody3D")) {
        say(text, size, "Its parent is a SoftBody3D: it is felt at rest, however it is drawn.");
    } else if (gd_cast(parent, "MeshInstance3D")) {
        gd_variant count = gd_call_named(parent, "get_blend_shape_count", NULL, 0);
        gd_types[GDEXTENSION_VARIANT_TYPE_INT].from_variant(&shapes, &count);
        if (result_of(parent, "get_skin") || shapes > 0) {
            say(text, size, "Its mesh has a skin or blend shapes: it is felt at rest, however it is drawn.");
        }
    }
}

/* Reports the distance, rotation and scale between a surface and the node that is drawn. */
static void say_away(const surface *s, char *text, size_t size) {
    gd_transform t;
    char sentence[192];
    float off = 0.0F;
    float turned = 0.0F;
    gd_call(gd_method.Node3D_get_transform, s->base.object, NULL, &t);
    for (int i = 0; i < 3; i++) {
        off += t.origin[i] * t.origin[i];
        for (int j = 0; j < 3; j++) {
            turned = fmaxf(turned, fabsf(t.basis[i][j] - (i == j ? 1.0F : 0.0F)));
        }
    }
    if (off > 1e-10F || turned > 1e-5F) {
        (void)snprintf(sentence, sizeof sentence,
                       "It stands %.3g mm off its parent%s: it is felt there, not where the mesh is drawn.",
                       1e3 * sqrt((double)off), turned > 1e-5F ? ", turned or scaled" : "");
        say(text, size, sentence);
    }
}

static void say_scale(const knurl_session_pose *at, char *text, size_t size) {
    double length[3];
    char sentence[192];
    for (int j = 0; j < 3; j++) {
        length[j] =
            sqrt(at->rest[j] * at->rest[j] + at->rest[3 + j] * at->rest[3 + j] + at->rest[6 + j] * at->rest[6 + j]);
    }
    const double most = fmax(length[0], fmax(length[1], length[2]));
    const double least = fmin(length[0], fmin(length[1], length[2]));
    if (most > 1.01 * least) {
        (void)snprintf(sentence, sizeof sentence,
                       "It is scaled unevenly (%.3g, %.3g, %.3g): textures are drawn stretched, while its ridges are "
                       "as far apart as asked for on average.",
                       length[0], length[1], length[2]);
        say(text, size, sentence);
    }
}

static void say_world(const surface *s, const device *d, char *text, size_t size) {
    char name[128];
    char sentence[256];
    if (result_of(s->base.object, "get_world_3d") != result_of(d->base.object, "get_world_3d")) {
        gd_node_name(d->base.object, name, sizeof name);
        (void)snprintf(sentence, sizeof sentence,
                       "It is in another World3D than '%s', which feels it all the same (own_world_3d).", name);
        say(text, size, sentence);
    }
}

static void say_layers(const surface *s, char *text, size_t size) {
    int is_on_any = placed_devices == NULL;
    for (const device *d = placed_devices; d; d = d->next_placed) {
        is_on_any |= surface_is_on_layer_of(s, d);
    }
    if (!is_on_any) {
        say(text, size, "No KnurlDevice in the scene has one of its layers.");
    }
}

static void say_hidden(GDExtensionObjectPtr parent, char *text, size_t size) {
    uint8_t is_visible = 1;
    gd_variant found = gd_call_named(parent, "is_visible_in_tree", NULL, 0);
    gd_types[GDEXTENSION_VARIANT_TYPE_BOOL].from_variant(&is_visible, &found);
    gd.variant_destroy(&found);
    if (!is_visible) {
        say(text, size,
            "Its parent is hidden, and felt all the same: an invisible wall, unless enabled is off as well.");
    }
}

/* Warnings that follow from its nodes. */
static void say_facts(const surface *s, const knurl_session_pose *at, char *text, size_t size) {
    if (s->enabled && !s->is_disabled) {
        say_hidden(surface_parent(s), text, size);
    }
    say_away(s, text, size);
    say_layers(s, text, size);
    say_bends(surface_parent(s), text, size);
    say_scale(at, text, size);
    for (const device *d = placed_devices; d; d = d->next_placed) {
        say_world(s, d, text, size);
    }
}

static void say_of_running(const surface *s, const device *only, char *text, size_t size) {
    char why[4096];
    int is_felt = 0;
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (!devices[i] || !s->ids[i] || (only && devices[i] != only)) {
            continue;
        }
        knurl_session_explain(devices[i]->session, s->ids[i], why, sizeof why);
        say(text, size, why);
        is_felt = 1;
    }
    if (!is_felt && s->explanation) {
        say(text, size, s->explanation);
    }
}

void explain_surface(surface *s, const device *only, char *text, size_t size) {
    char why[4096];
    uint8_t is_inside = 0;
    knurl_session_pose at;
    geometry_refuse(surface_parent(s), text, size);
    const int has_shape = text[0] == '\0';
    gd_call(gd_method.Node_is_inside_tree, s->base.object, NULL, &is_inside);
    if (!s->grating) {
        say(text, size, "It has no grating: nothing says how it feels.");
    }
    if (!is_inside) {
        return;
    }
    if (!node_pose(s->base.object, &at)) {
        say(text, size, "It is scaled to nothing.");
        return;
    }
    if (s->is_disabled) {
        say(text, size, "Its branch has the process mode Disabled: it is not felt, as bodies there have no physics.");
    }
    if (has_shape) {
        say_facts(s, &at, text, size);
    }
    if (!gd_is_in_editor()) {
        say_of_running(s, only, text, size);
    } else if (has_shape && s->grating && s->enabled) {
        preview_surface(s, &at, why, sizeof why);
        say(text, size, why);
    }
}

void explain_device(const device *d, char *text, size_t size) {
    static const char *const known[] = {"auto",   "fake", "touch",    "falcon", "rawhid",
                                        "serial", "dhd",  "inverse3", "mouse"};
    const char *uri = d->uri ? d->uri : "";
    uint8_t is_inside = 0;
    knurl_session_pose at;
    int is_known = 0;
    text[0] = '\0';
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const size_t length = strlen(known[i]);
        is_known |= strncmp(uri, known[i], length) == 0 && (uri[length] == '\0' || uri[length] == ':');
    }
    if (!is_known) {
        (void)snprintf(
            text, size,
            "Its device is '%s': expected auto, fake, touch, falcon, rawhid, serial, dhd, inverse3 or mouse.", uri);
    }
    gd_call(gd_method.Node_is_inside_tree, d->base.object, NULL, &is_inside);
    if (is_inside && !node_pose(d->base.object, &at)) {
        say(text, size, "It is scaled to nothing: its workspace has no axes.");
    } else if (is_inside && fabs(at.rest[0] - 1.0) + fabs(at.rest[4] - 1.0) + fabs(at.rest[8] - 1.0) > 1e-3) {
        say(text, size, "Its node is scaled, which does not count: its workspace goes by workspace_scale.");
    }
}

/* 1 the first time that a line is reported for a node of that name. After 512 lines always 0. */
static int is_new(const char *name, const char *line, int length) {
    static uint64_t told[512];
    static int count;
    char text[1280];
    uint64_t key = UINT64_C(0xcbf29ce484222325); /* FNV-1a */
    (void)snprintf(text, sizeof text, "%s: %.*s", name, length, line);
    for (const char *c = text; *c; c++) {
        key = (key ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    }
    for (int i = 0; i < count; i++) {
        if (told[i] == key) {
            return 0;
        }
    }
    if (count == (int)(sizeof told / sizeof *told)) {
        return 0;
    }
    told[count++] = key;
    return 1;
}

/* Warns of one surface. Returns 1 if it is out of the device's reach. */
static int warn_of(surface *s, const device *d, uint32_t *told) {
    static char text[8192];
    char name[128];
    int is_out = 0;
    explain_surface(s, d, text, sizeof text);
    gd_node_name(surface_parent(s), name, sizeof name);
    for (char *line = text, *end; *line; line = end) {
        end = line + strcspn(line, "\n");
        const int length = (int)(end - line);
        end += *end == '\n';
        if (strncmp(line, OUT_OF_REACH, strlen(OUT_OF_REACH)) == 0) {
            is_out = 1;
        } else if (is_new(name, line, length) && (*told)++ < MOST_WARNINGS) {
            gd_warning("KnurlSurface", "KnurlSurface of '%s': %.*s", name, length, line);
        }
    }
    return is_out;
}

void explain_start(const device *d) {
    static const char none[] = "none of the surfaces lies in its workspace: move it there, or raise its "
                               "workspace_scale";
    char name[128];
    uint32_t told = 0;
    uint32_t felt = 0;
    uint32_t out = 0;
    uint32_t looked_at = 0;
    for (surface *s = surfaces; s && looked_at < MOST_LOOKED_AT; s = s->next, looked_at++) {
        if (s->enabled) {
            felt += s->ids[d->slot] != 0;
            out += (uint32_t)warn_of(s, d, &told);
        }
    }
    gd_node_name(d->base.object, name, sizeof name);
    if (out > 0 && out == felt && is_new(name, none, (int)strlen(none))) {
        gd_warning("KnurlDevice", "KnurlDevice '%s': %s", name, none);
    }
    if (told > MOST_WARNINGS) {
        gd_warning("KnurlSurface", "KnurlSurface: %u further warnings: see get_warnings()",
                   (unsigned)(told - MOST_WARNINGS));
    }
}
