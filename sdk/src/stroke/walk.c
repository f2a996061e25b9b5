/* Paths over a surface, step by step. SPDX-License-Identifier: MIT */
#include "stroke/walk.h"

#include <string.h>

/* Cosine of the angle by which a surface may turn within a step: a finger stops at sharper edges. */
#define SHARPEST 0.5

/* A step that moves the finger by less than this share of it has met a rim or a wall. */
#define LEAST 0.5

static int press(knurl_walker *w, const double from[3], const double hip[3]) {
    double coordinates[2];
    knurl_contact_query query;
    memset(&query, 0, sizeof query);
    vec3_copy(from, query.previous);
    vec3_copy(hip, query.hip);
    query.has_previous = 1;
    query.double_sided = w->surface->double_sided;
    if (!knurl_shape_contact(&w->surface->shape, &query, &w->state, &w->contact) || w->contact.z > 0.0) {
        return 0;
    }
    vec3_copy(hip, w->hip);
    vec3_copy(w->contact.proxy, w->place);
    vec3_copy(w->contact.normal, w->normal);
    knurl_surface_frame(w->surface, w->surface->record, &w->contact, w->x, w->y, coordinates);
    return 1;
}

int knurl_walker_begin(knurl_walker *walker, const knurl_surface_data *surface, double step, const double place[3],
                       const double normal[3]) {
    double above[3];
    double below[3];
    memset(walker, 0, sizeof *walker);
    walker->surface = surface;
    walker->step = step;
    vec3_madd(place, step, normal, above);
    vec3_madd(place, -step, normal, below);
    return press(walker, above, below);
}

int knurl_walker_go(knurl_walker *walker, const double direction[3]) {
    knurl_walker next = *walker;
    double hip[3];
    double way[3];
    vec3_madd(walker->place, walker->step, direction, hip);
    vec3_madd(hip, -walker->step, walker->normal, hip);
    if (!press(&next, walker->hip, hip)) {
        return 0;
    }
    vec3_sub(next.place, walker->place, way);
    const double length = vec3_length(way);
    if (length < LEAST * walker->step || length > 2.0 * walker->step || vec3_dot(way, direction) <= 0.0 ||
        vec3_dot(next.normal, walker->normal) < SHARPEST) {
        return 0;
    }
    *walker = next;
    return 1;
}

double knurl_walker_stretch(const knurl_walker *walker, const double direction[3]) {
    double rates[2];
    return walker->surface->shape.has_coordinates &&
                   knurl_surface_rates(walker->surface, walker->surface->record, &walker->contact, direction, rates)
               ? fabs(rates[0])
               : 1.0;
}
