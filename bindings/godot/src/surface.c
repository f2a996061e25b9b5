/* KnurlSurface: a mesh that can be felt. SPDX-License-Identifier: MIT */
#include "explain.h"
#include "follow.h"
#include "geometry.h"
#include "preview.h"
#include "serve.h"
#include "shapes.h"
#include "signals.h"
#include "surface_node.h"
#include "warnings.h"
#include "watch.h"

#include <stdlib.h>
#include <string.h>

static int init(void *self) {
    surface *s = self;
    s->enabled = 1;
    s->layers = 1;
    gd.variant_new_nil(&s->held);
    gd.variant_new_nil(&s->watched);
    return 1;
}

static void finish(void *self) {
    surface *s = self;
    gd.variant_destroy(&s->held);
    gd.variant_destroy(&s->watched);
    free(s->explanation);
}

static void make_anew(void *self) {
    surface *s = self;
    s->made_anew = ALL_SLOTS;
    s->tries = 0;
    surface_mark(s);
    if (gd_is_in_editor()) {
        warnings_refresh(&s->base);
    }
}

static void get_grating(void *self, void *result) {
    const surface *s = self;
    if (s->grating) {
        gd.ref_set_object(result, s->grating->base.object);
    }
}

/* In the editor its warnings change with its grating. */
static void follow_grating(const surface *s, const grating *given) {
    if (s->grating && s->grating != given) {
        gd_disconnect(s->grating->base.object, "changed", s->base.object, "update_configuration_warnings");
    }
    if (given && s->grating != given) {
        gd_connect(given->base.object, "changed", s->base.object, "update_configuration_warnings");
    }
}

static void set_grating(void *self, const void *value) {
    surface *s = self;
    GDExtensionObjectPtr object;
    memcpy(&object, value, sizeof object);
    grating *given = gd_instance_of(object, &grating_class);
    if (object && !given) {
        gd_error("KnurlSurface", "KnurlSurface.grating: expected a KnurlGrating, found another object");
        return;
    }
    if (gd_is_in_editor()) {
        follow_grating(s, given);
    }
    gd.variant_destroy(&s->held);
    if (object) {
        s->held = gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &object);
    } else {
        gd.variant_new_nil(&s->held);
    }
    if (!s->grating != !given) {
        s->made_anew = ALL_SLOTS;
    }
    s->grating = given;
    s->changed = ALL_SLOTS;
    surface_mark(s);
    warnings_refresh(&s->base);
}

/* For the first device that feels it. */
static void get_triangle_count(void *self, const void *const *arguments, void *result) {
    const surface *s = self;
    int64_t count = 0;
    knurl_surface_info info;
    (void)arguments;
    knurl_surface_info_init(&info, sizeof info);
    for (int i = 0; i < DEVICE_SLOTS && count == 0; i++) {
        if (devices[i] && s->ids[i] &&
            !knurl_scene_get_surface_info(knurl_session_get_scene(devices[i]->session), s->ids[i], &info)) {
            count = (int64_t)info.triangle_count;
        }
    }
    memcpy(result, &count, sizeof count);
}

/* Metres for each unit of u and v, for the overlay, which draws the ridges. */
static void get_uv_scale(void *self, const void *const *arguments, void *result) {
    surface *s = self;
    float found[2] = {0.0F, 0.0F};
    char refusal[512];
    uint8_t is_inside = 0;
    knurl_session_pose at;
    (void)arguments;
    gd_call(gd_method.Node_is_inside_tree, s->base.object, NULL, &is_inside);
    geometry_refuse(surface_parent(s), refusal, sizeof refusal);
    if (s->grating && is_inside && !refusal[0] && node_pose(s->base.object, &at)) {
        double scale[2];
        preview_uv_scale(s, &at, scale);
        found[0] = (float)scale[0];
        found[1] = (float)scale[1];
    }
    memcpy(result, found, sizeof found);
}

static void get_warnings(void *self, const void *const *arguments, void *result) {
    static char text[8192];
    (void)arguments;
    explain_surface(self, NULL, text, sizeof text);
    warnings_append(text, result);
}

static void is_touched(void *self, const void *const *arguments, void *result) {
    const surface *s = self;
    uint8_t touched = 0;
    (void)arguments;
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i] && s->ids[i] && devices[i]->touched == s->ids[i]) {
            touched = 1;
        }
    }
    memcpy(result, &touched, sizeof touched);
}

static void update_mesh(void *self, const void *const *arguments, void *result) {
    surface *s = self;
    (void)arguments;
    (void)result;
    unwatch_mesh(s); /* the parent may have changed */
    s->meshes_seen++;
    shapes_expire(s);
    if (gd_is_in_editor()) {
        watch_mesh(s);
    }
    make_anew(s);
}

/* Whether the first node upwards with a process mode of its own is disabled. The engine's bodies ask the same. */
static uint8_t is_in_disabled_branch(GDExtensionObjectPtr node) {
    enum { INHERIT = 0, DISABLED = 4 };
    int64_t mode = INHERIT;
    while (node && mode == INHERIT) {
        gd_call(gd_method.Node_get_process_mode, node, NULL, &mode);
        GDExtensionObjectPtr parent = NULL;
        gd_call(gd_method.Node_get_parent, node, NULL, &parent);
        node = parent;
    }
    return mode == DISABLED;
}

static void disable(surface *s, uint8_t is_disabled) {
    s->is_disabled = is_disabled;
    make_anew(s);
}

static void enter(surface *s) {
    const uint8_t notify = 1;
    s->is_disabled = is_in_disabled_branch(s->base.object);
    s->is_leaving = 0;
    if (!s->is_listed) {
        surface_list(s);
    }
    if (gd_is_in_editor()) {
        watch_mesh(s);
    }
    make_anew(s);
    gd_call(gd_method.Node3D_set_notify_transform, s->base.object, &notify, NULL);
}

/* Removes it from all scenes and from the list; the ends of contacts are emitted later. */
static void remove_now(surface *s) {
    const GDObjectInstanceID id = gd.object_get_instance_id(s->base.object);
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i]) {
            follow_remove(devices[i], s);
        }
        if (devices[i] && devices[i]->touched_node == id) {
            signals_end_contact(devices[i]);
            signals_tell_later(0);
        }
    }
    surface_unlist(s);
}

/* A surface that is reparented leaves the tree and enters it again within a frame, so it is removed in the next frame,
 * or immediately if it is being freed. */
static void leave(surface *s) {
    unwatch_mesh(s);
    if (s->is_dying || !follow_is_felt(s)) {
        remove_now(s);
    } else {
        s->is_leaving = 1;
        surface_mark(s);
    }
}

static void notify(void *self, int32_t what) {
    surface *s = self;
    switch (what) {
    case GD_ENTER_TREE:
        enter(s);
        break;
    case GD_TRANSFORM_CHANGED:
        if (gd_is_in_editor()) {
            warnings_refresh(&s->base);
        }
        s->moved = ALL_SLOTS;
        gd_call(gd_method.Engine_is_in_physics_frame, gd_engine, NULL, &s->by_physics);
        surface_mark(s);
        break;
    case GD_DISABLED:
    case GD_ENABLED:
        disable(s, what == GD_DISABLED);
        break;
    case GD_EXIT_TREE:
        leave(s);
        break;
    case GD_PREDELETE:
        s->is_dying = 1;
        remove_now(s);
        break;
    default:
        break;
    }
}

static const gd_property properties[] = {
    {.name = "grating",
     .type = GDEXTENSION_VARIANT_TYPE_OBJECT,
     .hint = GD_HINT_RESOURCE_TYPE,
     .hints = "KnurlGrating",
     .get = get_grating,
     .set = set_grating},
    {.name = "double_sided",
     .type = GDEXTENSION_VARIANT_TYPE_BOOL,
     .offset = offsetof(surface, double_sided),
     .changed = make_anew},
    {.name = "axis", .type = GDEXTENSION_VARIANT_TYPE_VECTOR3, .offset = offsetof(surface, axis), .changed = make_anew},
    {.name = "box_coordinates",
     .type = GDEXTENSION_VARIANT_TYPE_BOOL,
     .offset = offsetof(surface, box_coordinates),
     .changed = make_anew},
    {"smooth", GDEXTENSION_VARIANT_TYPE_INT, offsetof(surface, smooth), 0.0, 2.0, 1.0, "Auto,Off,On", GD_HINT_ENUM,
     NULL, NULL, make_anew},
    {.name = "enabled",
     .type = GDEXTENSION_VARIANT_TYPE_BOOL,
     .offset = offsetof(surface, enabled),
     .changed = make_anew},
    {"layers", GDEXTENSION_VARIANT_TYPE_INT, offsetof(surface, layers), 0.0, 255.0, 1.0, "1,2,3,4,5,6,7,8",
     GD_HINT_FLAGS, NULL, NULL, make_anew},
    {.name = "reaction", .type = GDEXTENSION_VARIANT_TYPE_BOOL, .offset = offsetof(surface, reaction)},
};

static const gd_method_row methods[] = {
    {"get_triangle_count", GDEXTENSION_VARIANT_TYPE_INT, NULL, get_triangle_count, 0, {{0}}},
    {"get_uv_scale", GDEXTENSION_VARIANT_TYPE_VECTOR2, NULL, get_uv_scale, 0, {{0}}},
    {"get_warnings", GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, NULL, get_warnings, 0, {{0}}},
    {"update_mesh", GDEXTENSION_VARIANT_TYPE_NIL, NULL, update_mesh, 0, {{0}}},
    {"is_touched", GDEXTENSION_VARIANT_TYPE_BOOL, NULL, is_touched, 0, {{0}}},
};

static const gd_signal_row signals[] = {
    {"touched", 1, {{"device", GDEXTENSION_VARIANT_TYPE_OBJECT, "KnurlDevice"}}},
    {"released", 1, {{"device", GDEXTENSION_VARIANT_TYPE_OBJECT, "KnurlDevice"}}},
    {"ridges_passed",
     2,
     {{"device", GDEXTENSION_VARIANT_TYPE_OBJECT, "KnurlDevice"}, {"count", GDEXTENSION_VARIANT_TYPE_INT, NULL}}},
};

static const gd_constant_row constants[] = {
    {"Smooth", "SMOOTH_AUTO", KNURL_SMOOTH_AUTO},
    {"Smooth", "SMOOTH_OFF", KNURL_SMOOTH_OFF},
    {"Smooth", "SMOOTH_ON", KNURL_SMOOTH_ON},
};

const gd_class surface_class = {
    .name = "KnurlSurface",
    .base = "Node3D",
    .size = sizeof(surface),
    .init = init,
    .finish = finish,
    .notify = notify,
    .warnings = get_warnings,
    .properties = properties,
    .property_count = sizeof properties / sizeof *properties,
    .methods = methods,
    .method_count = sizeof methods / sizeof *methods,
    .constants = constants,
    .constant_count = sizeof constants / sizeof *constants,
    .signals = signals,
    .signal_count = sizeof signals / sizeof *signals,
};
