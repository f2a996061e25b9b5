/* Contact with a bounded plane: z = 0, front towards +z. SPDX-License-Identifier: MIT */
#include "contact/plane.h"

#include "base/vec3.h"

#include <string.h>

void knurl_plane_set_stretch(knurl_plane *plane, double along) {
    for (int i = 0; i < 3; i++) {
        plane->facts.stretch[0][i] = along;
        plane->facts.stretch[1][i] = 1.0;
    }
}

/* An axis perpendicular to the plane is ignored: any direction will do. */
static void set_axis(const double axis[3], knurl_plane *plane) {
    const double along = hypot(axis[0], axis[1]);
    if (along > 1e-9) {
        for (int i = 0; i < 2; i++) {
            plane->x[i] = axis[i] / along;
            plane->map[0][i] = axis[i];
        }
        plane->map[1][0] = -plane->x[1];
        plane->map[1][1] = plane->x[0];
        knurl_plane_set_stretch(plane, along);
    }
}

void knurl_plane_from_rectangle(const double half_extents[2], const double axis[3], knurl_plane *plane) {
    memset(plane, 0, sizeof *plane);
    plane->half_extents[0] = half_extents[0];
    plane->half_extents[1] = half_extents[1];
    plane->x[0] = 1.0;
    plane->map[0][0] = plane->map[1][1] = 1.0;
    knurl_plane_set_stretch(plane, 1.0);
    plane->has_coordinates = 1;
    knurl_plane_set_seam(plane);
    if (axis) {
        set_axis(axis, plane);
    }
}

void knurl_plane_set_seam(knurl_plane *plane) {
    const double size =
        plane->half_extents[0] > plane->half_extents[1] ? plane->half_extents[0] : plane->half_extents[1];
    plane->facts.seam =
        plane->facts.error + (KNURL_SEAM > KNURL_SEAM_SHARE * size ? KNURL_SEAM : KNURL_SEAM_SHARE * size);
}

/* Counts the edges that a ray along x crosses: even outside, odd inside. An edge includes its lower end but not its
 * upper, so that a corner counts once. Free of branches, because the crossed edges change from tick to tick. */
static int within_outline(const knurl_plane *plane, const double p[2]) {
    const int band = knurl_plane_band(plane, p[1]);
    int inside = 0;
    for (uint32_t i = plane->bands[band]; i < plane->bands[band + 1]; i++) {
        const knurl_edge *edge = &plane->outline[plane->members[i]];
        const int spans = (edge->from[1] <= p[1]) ^ (edge->to[1] <= p[1]);
        inside ^= spans & (p[0] < edge->from[0] + (p[1] - edge->from[1]) * edge->slope);
    }
    return inside;
}

static inline int covers(const knurl_plane *plane, const double p[2]) {
    return knurl_plane_spans(plane, p) && (!plane->outline || within_outline(plane, p));
}

int knurl_plane_covers(const knurl_plane *plane, const double p[2]) {
    return covers(plane, p);
}

/* Vector from the edge's closest point to p; returns the squared distance. */
static double off_edge(const knurl_edge *edge, const double p[2], double off[2]) {
    const double along[2] = {edge->to[0] - edge->from[0], edge->to[1] - edge->from[1]};
    const double to[2] = {p[0] - edge->from[0], p[1] - edge->from[1]};
    const double share = (to[0] * along[0] + to[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
    const double t = share > 0.0 ? share < 1.0 ? share : 1.0 : 0.0; /* 0 for an edge without a length */
    off[0] = to[0] - t * along[0];
    off[1] = to[1] - t * along[1];
    return off[0] * off[0] + off[1] * off[1];
}

/* 1 inside the outline, or within the seam of one of its edges. */
static int is_within_seam(const knurl_plane *plane, const double p[2]) {
    for (int i = 0; i < 2; i++) {
        if (!(fabs(p[i]) <= plane->half_extents[i] + plane->facts.seam)) {
            return 0;
        }
    }
    if (!plane->outline || within_outline(plane, p)) {
        return 1;
    }
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        double off[2];
        if (off_edge(&plane->outline[i], p, off) <= plane->facts.seam * plane->facts.seam) {
            return 1;
        }
    }
    return 0;
}

void knurl_plane_closest(const knurl_plane *plane, const double p[3], double closest[3]) {
    closest[2] = 0.0;
    for (int i = 0; i < 2; i++) {
        const double h = plane->half_extents[i];
        closest[i] = plane->outline ? p[i] : p[i] < -h ? -h : p[i] > h ? h : p[i];
    }
    if (!plane->outline || covers(plane, closest)) {
        return;
    }
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < plane->edge_count; i++) {
        double off[2];
        const double square = off_edge(&plane->outline[i], p, off);
        if (square < least) {
            least = square;
            closest[0] = p[0] - off[0];
            closest[1] = p[1] - off[1];
        }
    }
}

int knurl_plane_cast(const knurl_plane *plane, const knurl_cast *cast, knurl_cast_hit *hit) {
    const double rise = cast->to[2] - cast->from[2];
    const int side = rise < 0.0 ? 1 : -1;
    hit->height = side * cast->from[2];
    if (rise == 0.0 || (side < 0 && !cast->double_sided) || hit->height < -KNURL_CAST_SLACK ||
        side * cast->to[2] >= 0.0) {
        return 0;
    }
    const double share = -cast->from[2] / rise;
    hit->share = share > 0.0 ? share : 0.0;
    for (int i = 0; i < 2; i++) {
        hit->point[i] = cast->from[i] + hit->share * (cast->to[i] - cast->from[i]);
        hit->normal[i] = 0.0;
    }
    hit->point[2] = 0.0;
    hit->normal[2] = hit->side = side;
    hit->triangle = 0;
    return is_within_seam(plane, hit->point);
}

void knurl_plane_rest(const knurl_cast_hit *hit, const double point[3], knurl_contact_state *state,
                      knurl_contact *contact) {
    state->inside = 1;
    state->side = hit->side;
    state->triangle = 0;
    contact->proxy[0] = point[0];
    contact->proxy[1] = point[1];
    contact->proxy[2] = 0.0;
}

/* Side that the HIP comes from, at any distance, or 0. *inside: set if it crossed the plane since the last tick.
 * *unsure: set if it crossed within the seam beside the outline, where another surface may continue. */
static int begin_side(const knurl_plane *plane, const knurl_contact_query *query, int32_t *inside, int32_t *unsure) {
    const double z = query->hip[2];
    const int behind_allowed = query->double_sided;
    if (query->has_previous && (query->previous[2] >= 0.0) != (z >= 0.0)) {
        const double t = query->previous[2] / (query->previous[2] - z);
        double crossing[3];
        vec3_sub(query->hip, query->previous, crossing);
        vec3_madd(query->previous, t, crossing, crossing);
        const int side = query->previous[2] >= 0.0 ? 1 : -1;
        if ((side > 0 || behind_allowed) && covers(plane, crossing)) {
            *inside = 1;
            return side;
        }
        *unsure = (side > 0 || behind_allowed) && is_within_seam(plane, crossing);
    }
    if (z >= 0.0) {
        return 1;
    }
    if (behind_allowed) { /* a double-sided plane has no inside to start in */
        return -1;
    }
    *inside = !query->has_previous && z >= -KNURL_CAPTURE_DEPTH;
    return *inside;
}

int knurl_plane_contact(const knurl_plane *plane, const knurl_contact_query *query, knurl_contact_state *state,
                        knurl_contact *contact) {
    const double *hip = query->hip;
    const double reach = query->reach > KNURL_ON_SURFACE ? query->reach : KNURL_ON_SURFACE;
    contact->unsure = 0;
    if (!state->inside) { /* a HIP in front may cross the plane at any tick */
        state->side = begin_side(plane, query, &state->inside, &contact->unsure);
    }
    const double z = hip[2] * state->side;
    if (state->side == 0 || z > reach || !covers(plane, hip)) {
        contact->unsure |= state->inside; /* inside before, and now beyond the rim */
        memset(state, 0, sizeof *state);
        return 0;
    }
    state->inside = z <= KNURL_ON_SURFACE;
    knurl_plane_set_contact(hip, z, state->side, contact);
    return 1;
}

void knurl_plane_destroy(knurl_heap *heap, knurl_plane *plane) {
    if (plane) {
        knurl_heap_free(heap, plane->outline);
        knurl_heap_free(heap, plane->members);
        knurl_heap_free(heap, plane);
    }
}

uint64_t knurl_plane_bytes(const knurl_plane *plane) {
    return knurl_heap_size(plane) + knurl_heap_size(plane->outline) + knurl_heap_size(plane->members);
}
