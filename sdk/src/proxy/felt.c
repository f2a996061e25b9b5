/* SPDX-License-Identifier: MIT */
#include "proxy/felt.h"

#include "contact/mesh_feel.h"

#include <string.h>

void knurl_felt_add_part(const knurl_mesh *mesh, uint32_t triangle, const double push[3], int is_most,
                         knurl_felt_parts *parts) {
    uint32_t i = 0;
    while (i < parts->count && !knurl_mesh_continues(mesh, parts->list[i].triangle, triangle)) {
        i++;
    }
    if (i == parts->count) {
        parts->list[i] = (knurl_felt_part){triangle, {0.0, 0.0, 0.0}};
        parts->count++;
    }
    knurl_felt_part part = parts->list[i];
    vec3_madd(part.push, 1.0, push, part.push);
    part.triangle = is_most ? triangle : part.triangle;
    parts->list[i] = parts->list[is_most ? 0 : i];
    parts->list[is_most ? 0 : i] = part;
}

/* A part's own contact: of a HIP that it alone pushes to the proxy. */
static void feel_part(const knurl_mesh *mesh, int32_t side, const knurl_felt_part *part, knurl_contact *c,
                      knurl_facet *facet) {
    knurl_closest_point closest;
    knurl_closest_on_triangle(mesh, part->triangle, c->proxy, &closest);
    vec3_copy(closest.weights, c->weights);
    vec3_copy(part->push, c->normal);
    c->z = -vec3_normalise(c->normal);
    c->triangle = part->triangle;
    knurl_mesh_feel(mesh, side, c, facet);
}

/* The sum of all parts' pushes, at the first part's point. */
static void feel_parts(const knurl_mesh *mesh, int32_t side, const knurl_felt_parts *parts, knurl_contact *c,
                       knurl_facet *facet) {
    const double deepest = c->z - mesh->facts.bulge;
    const knurl_contact whole = *c;
    double sum[3] = {0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < parts->count; i++) {
        knurl_facet unused;
        knurl_contact part = whole;
        feel_part(mesh, side, &parts->list[i], &part, i == 0 ? facet : &unused);
        vec3_madd(sum, knurl_max(0.0, -part.z), part.normal, sum);
        *c = i == 0 ? part : *c;
    }
    const double depth = vec3_normalise(sum);
    if (depth > 0.0) {
        c->z = -depth;
        vec3_copy(sum, c->normal);
    }
    c->z = knurl_max(c->z, deepest);
}

int knurl_felt_find(knurl_active_contact *a) {
    knurl_candidate *candidate = a->candidate;
    const knurl_mesh *mesh = a->surface->shape.mesh;
    knurl_contact *c = &a->contact;
    if (a->felt.parts.count > 0) {
        feel_parts(mesh, candidate->contact.side, &a->felt.parts, c, &a->felt.facet);
    } else {
        knurl_mesh_feel(mesh, candidate->contact.side, c, &a->felt.facet);
    }
    a->is_unfelt = c->z > knurl_max(a->record->crest, KNURL_ON_SURFACE);
    a->begins |= (int32_t)candidate->is_unfelt;
    candidate->is_unfelt = (uint32_t)a->is_unfelt;
    if (a->is_unfelt) { /* felt as without contact, until it begins */
        memset(&candidate->grating, 0, sizeof candidate->grating);
        if (!a->begins) {
            knurl_wall_end(&candidate->wall);
        }
        return 0;
    }
    knurl_pose_vector_to_parent(a->pose, c->normal, a->felt.normal);
    a->normal = a->felt.normal;
    return 1;
}
