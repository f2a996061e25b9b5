/* Checks materials and prepares them for ticks. SPDX-License-Identifier: MIT */
#include "surface/record.h"

#include "base/base.h"
#include "base/number.h"
#include "grating/method.h"

void knurl_material_desc_init(knurl_material_desc *desc, uint32_t size) {
    const knurl_material_desc defaults = {.stiffness = 400.0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

/* Limits of textures that a tick can play. Stiffness has none here: a force that overflows is set to 0. */
static const knurl_field fields[] = {
    {"spatial_frequency[0]", offsetof(knurl_material_desc, spatial_frequency[0]), {0.0, 1e9, "cycles/m", 0}},
    {"spatial_frequency[1]", offsetof(knurl_material_desc, spatial_frequency[1]), {0.0, 1e9, "cycles/m", 0}},
    {"amplitude", offsetof(knurl_material_desc, amplitude), {0.0, 1e6, "m", 0}},
};

static knurl_result check_number(const char *key, const char *unit, double value, int zero_allowed) {
    if (!(knurl_is_finite(value) && (value > 0.0 || (zero_allowed && value == 0.0)))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a finite number %s 0 (%s), found %g", key,
                          zero_allowed ? ">=" : ">", unit, value);
    }
    return KNURL_OK;
}

static knurl_result check_material(knurl_material_desc *m) {
    knurl_grating grating = {.method = m->method,
                             .spatial_frequency = {m->spatial_frequency[0], m->spatial_frequency[1]},
                             .amplitude = m->amplitude,
                             .update_rate_hz = 1000.0};
    knurl_result result = knurl_grating_check(&grating);
    m->method = grating.method;
    result = result ? result : knurl_fields_check("knurl_material_desc", fields, sizeof fields / sizeof *fields, m);
    result = result ? result : check_number("stiffness", "N/m", m->stiffness, 0);
    result = result ? result : check_number("damping", "N s/m", m->damping, 1);
    result = result ? result : check_number("friction", "coefficient", m->friction, 1);
    if (!result && !knurl_is_finite(m->orientation)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "orientation: expected a finite number (rad), found %g",
                          m->orientation);
    }
    return result;
}

knurl_result knurl_record_set_material(knurl_record *record, const knurl_shape *shape, const knurl_material_desc *desc,
                                       uint32_t full_model) {
    knurl_material_desc m;
    knurl_material_desc_init(&m, sizeof m);
    knurl_result result = knurl_desc_read("knurl_material_desc", desc, &m, sizeof m);
    result = result ? result : check_material(&m);
    if (result) {
        return result;
    }
    const int smooth = m.amplitude == 0.0 || (m.spatial_frequency[0] == 0.0 && m.spatial_frequency[1] == 0.0);
    if (knurl_methods[m.method].needs_position && !smooth && !shape->has_coordinates) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "method: %s needs surface coordinates: expected uvs or an axis, found neither",
                          knurl_method_name(m.method));
    }
    record->material = m;
    record->method = &knurl_methods[m.method];
    record->cos_sin[0] = cos(m.orientation);
    record->cos_sin[1] = sin(m.orientation);
    record->amplitude = smooth ? 0.0 : m.amplitude;
    record->crest = record->amplitude * knurl_methods[m.method].crest;
    record->reach = record->crest + shape->bulge;
    record->is_oriented = record->cos_sin[1] != 0.0 || record->cos_sin[0] != 1.0;
    record->has_grating = !smooth || (full_model & KNURL_FULL_GRATING) != 0;
    return KNURL_OK;
}

static void release(knurl_heap *heap, knurl_retired *record) {
    knurl_heap_free(heap, record);
}

knurl_record *knurl_record_copy(knurl_heap *heap, const knurl_record *record) {
    knurl_record *made = knurl_heap_alloc(heap, 1, sizeof *made);
    if (made) {
        if (record) {
            *made = *record;
        }
        made->edits++;
        made->retired.next = NULL;
        made->retired.release = release;
    }
    return made;
}
