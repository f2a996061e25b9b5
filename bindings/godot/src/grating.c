/* KnurlGrating. SPDX-License-Identifier: MIT */
#include "grating.h"

uint64_t grating_changes;

static int init(void *self) {
    grating *g = self;
    g->spatial_frequency[0] = 1000.0F;
    g->amplitude = 0.0002;
    g->stiffness = 400.0;
    return 1;
}

static void finish(void *self) {
    (void)self;
}

static void changed(void *self) {
    grating *g = self;
    g->changed_at = ++grating_changes;
    gd_call(gd_method.Resource_emit_changed, g->base.object, NULL, NULL);
}

void grating_describe(const grating *g, knurl_material_desc *material) {
    knurl_material_desc_init(material, sizeof *material);
    material->method = (int32_t)g->method;
    material->spatial_frequency[0] = (double)g->spatial_frequency[0];
    material->spatial_frequency[1] = (double)g->spatial_frequency[1];
    material->amplitude = g->amplitude;
    material->stiffness = g->stiffness;
    material->damping = g->damping;
    material->friction = g->friction;
    material->orientation = g->orientation;
}

#define NUMBER(name, least, most, step, hints)                                                                         \
    {#name, GDEXTENSION_VARIANT_TYPE_FLOAT, offsetof(grating, name), least, most, step, hints, 0, NULL, NULL, changed}

static const gd_property properties[] = {
    {"spatial_frequency", GDEXTENSION_VARIANT_TYPE_VECTOR2, offsetof(grating, spatial_frequency), 0.0, 5000.0, 1.0,
     "or_greater,suffix:1/m", 0, NULL, NULL, changed},
    NUMBER(amplitude, 0.0, 0.002, 0.00001, "or_greater,suffix:m"),
    NUMBER(stiffness, 1.0, 2000.0, 1.0, "or_greater,suffix:N/m"),
    NUMBER(damping, 0.0, 10.0, 0.01, "or_greater,suffix:N s/m"),
    NUMBER(friction, 0.0, 2.0, 0.01, "or_greater"),
    NUMBER(orientation, -360.0, 360.0, 0.1, "radians_as_degrees"),
    {"method", GDEXTENSION_VARIANT_TYPE_INT, offsetof(grating, method), 0.0, 3.0, 1.0, "Default,S1,S2,Bandlimited",
     GD_HINT_ENUM, NULL, NULL, changed},
};

static const gd_constant_row constants[] = {
    {"Method", "METHOD_DEFAULT", KNURL_METHOD_DEFAULT},
    {"Method", "METHOD_S1", KNURL_METHOD_S1},
    {"Method", "METHOD_S2", KNURL_METHOD_S2},
    {"Method", "METHOD_BANDLIMITED", KNURL_METHOD_BANDLIMITED},
};

const gd_class grating_class = {
    .name = "KnurlGrating",
    .base = "Resource",
    .size = sizeof(grating),
    .init = init,
    .finish = finish,
    .properties = properties,
    .property_count = sizeof properties / sizeof *properties,
    .constants = constants,
    .constant_count = sizeof constants / sizeof *constants,
};
