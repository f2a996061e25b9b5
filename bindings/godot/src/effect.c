/* KnurlEffect. SPDX-License-Identifier: MIT */
#include "effect.h"

#include "surface_node.h"

#include <knurl/effect.h>

#include <math.h>

typedef struct effect {
    gd_instance base;
    int64_t kind; /* KNURL_EFFECT_ */
    float axis[3];
    double stiffness, damping, spacing, max_force;
    uint8_t enabled;
    int64_t layers;
    struct effect *next; /* of those in a tree */
} effect;

/* In the order of entering, because the library knows them by their index. */
static effect *first;

/* The effects that each running device has. */
static struct {
    uint32_t count;
    knurl_effect list[KNURL_EFFECTS_MAX];
} given[DEVICE_SLOTS];

static int init(void *self) {
    effect *e = self;
    knurl_effect defaults;
    (void)knurl_effect_prepare(KNURL_EFFECT_SPRING, &defaults);
    e->kind = KNURL_EFFECT_SPRING;
    for (int i = 0; i < 3; i++) {
        e->axis[i] = (float)defaults.axis[i];
    }
    e->stiffness = defaults.stiffness;
    e->damping = defaults.damping;
    e->spacing = defaults.spacing;
    e->max_force = defaults.max_force;
    e->enabled = 1;
    e->layers = 1;
    return 1;
}

static void leave(effect *e) {
    effect **link = &first;
    while (*link && *link != e) {
        link = &(*link)->next;
    }
    if (*link) {
        *link = e->next;
    }
}

static void enter(effect *e) {
    effect **link = &first;
    leave(e);
    while (*link) {
        link = &(*link)->next;
    }
    e->next = NULL;
    *link = e;
}

static void finish(void *self) {
    leave(self);
}

static void notify(void *self, int32_t what) {
    if (what == GD_ENTER_TREE) {
        enter(self);
    } else if (what == GD_EXIT_TREE) {
        leave(self);
    }
}

static void describe(const effect *e, knurl_effect *to) {
    gd_transform at;
    node_transform(e->base.object, &at);
    (void)knurl_effect_prepare((int32_t)e->kind, to);
    for (int i = 0; i < 3; i++) {
        to->anchor[i] = (double)at.origin[i];
        to->axis[i] = 0.0;
        for (int j = 0; j < 3; j++) {
            to->axis[i] += (double)at.basis[i][j] * (double)e->axis[j];
        }
    }
    to->stiffness = e->stiffness;
    to->damping = e->damping;
    to->spacing = e->spacing;
    to->max_force = e->max_force;
}

static void warn_of_too_many(void) {
    static int is_warned;
    if (!is_warned) {
        is_warned = 1;
        gd_warning("KnurlEffect",
                   "KnurlEffect: expected at most %d that a device feels at once, found more; the last are "
                   "not felt: use enabled or layers",
                   KNURL_EFFECTS_MAX);
    }
}

void effects_follow(const device *d, double delta) {
    knurl_effect now[KNURL_EFFECTS_MAX];
    uint32_t count = 0;
    for (const effect *e = first; e; e = e->next) {
        if (!e->enabled || !(e->layers & d->layers)) {
            continue;
        }
        if (count == KNURL_EFFECTS_MAX) {
            warn_of_too_many();
            break;
        }
        describe(e, &now[count++]);
    }
    if (count == given[d->slot].count && memcmp(now, given[d->slot].list, count * sizeof *now) == 0) {
        return;
    }
    given[d->slot].count = count; /* also if they are refused: one error for each change is enough */
    memcpy(given[d->slot].list, now, count * sizeof *now);
    if (knurl_scene_set_effects(knurl_session_get_scene(d->session), 0, now, count, fmin(delta, 1.0))) {
        gd_error("KnurlEffect", "KnurlEffect: %s", knurl_error_message());
    }
}

void effects_take_off(const device *d) {
    if (given[d->slot].count > 0) {
        given[d->slot].count = 0;
        (void)knurl_scene_set_effects(knurl_session_get_scene(d->session), 0, NULL, 0, 0.0);
    }
}

#define NUMBER(name, least, most, step, hints)                                                                         \
    {#name, GDEXTENSION_VARIANT_TYPE_FLOAT, offsetof(effect, name), least, most, step, hints, 0, NULL, NULL, NULL}

static const gd_property properties[] = {
    {"kind", GDEXTENSION_VARIANT_TYPE_INT, offsetof(effect, kind), 1.0, 6.0, 1.0,
     "Spring:1,Detent:2,Damper:3,Line:4,Plane:5,Force:6", GD_HINT_ENUM, NULL, NULL, NULL},
    {.name = "axis", .type = GDEXTENSION_VARIANT_TYPE_VECTOR3, .offset = offsetof(effect, axis)},
    NUMBER(stiffness, 0.0, 1000.0, 1.0, "or_greater,suffix:N/m"),
    NUMBER(damping, 0.0, 20.0, 0.1, "or_greater,suffix:N s/m"),
    NUMBER(spacing, 0.001, 0.1, 0.001, "or_greater,suffix:m"),
    NUMBER(max_force, 0.01, 1000.0, 0.01, "suffix:N"),
    {.name = "enabled", .type = GDEXTENSION_VARIANT_TYPE_BOOL, .offset = offsetof(effect, enabled)},
    {"layers", GDEXTENSION_VARIANT_TYPE_INT, offsetof(effect, layers), 0.0, 255.0, 1.0, "1,2,3,4,5,6,7,8",
     GD_HINT_FLAGS, NULL, NULL, NULL},
};

static const gd_constant_row constants[] = {
    {"Kind", "KIND_SPRING", KNURL_EFFECT_SPRING}, {"Kind", "KIND_DETENT", KNURL_EFFECT_DETENT},
    {"Kind", "KIND_DAMPER", KNURL_EFFECT_DAMPER}, {"Kind", "KIND_LINE", KNURL_EFFECT_LINE},
    {"Kind", "KIND_PLANE", KNURL_EFFECT_PLANE},   {"Kind", "KIND_FORCE", KNURL_EFFECT_FORCE},
};

const gd_class effect_class = {
    .name = "KnurlEffect",
    .base = "Node3D",
    .size = sizeof(effect),
    .init = init,
    .finish = finish,
    .notify = notify,
    .properties = properties,
    .property_count = sizeof properties / sizeof *properties,
    .constants = constants,
    .constant_count = sizeof constants / sizeof *constants,
};
