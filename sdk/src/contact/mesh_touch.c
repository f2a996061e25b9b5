/* Tests each triangle against those with overlapping boxes. Most pairs are separated by a plane through a face or an
 * edge of one of the two.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_touch.h"

#include "base/vec3.h"
#include "contact/closest_point.h"
#include "contact/mesh_search.h"

#define GROUPS (KNURL_MESH_LEAF / 4) /* of four triangles of a leaf */

/* A triangle with its bounding planes: its own and one through each edge, facing outwards. */
typedef struct bounded {
    double corners[3][3];
    double normal[3];
    double sides[3][3]; /* sides[k]: at the edge opposite corner k */
    double margins[4];  /* the seam, times the length of each side and, last, of the normal */
    uint32_t triangle;
    int has_rim;
} bounded;

/* 1 if some edge does not have exactly one triangle beyond it. */
static int has_rim(const knurl_mesh *mesh, uint32_t triangle) {
    const uint32_t *opposite = &mesh->opposite[3 * (size_t)triangle];
    return (opposite[0] & 3) == 3 || (opposite[1] & 3) == 3 || (opposite[2] & 3) == 3;
}

static void bound(const knurl_mesh *mesh, uint32_t triangle, bounded *b) {
    double edges[3][3]; /* edges[k]: opposite corner k */
    b->triangle = triangle;
    b->has_rim = has_rim(mesh, triangle);
    knurl_mesh_corners(mesh, triangle, b->corners);
    for (int k = 0; k < 3; k++) {
        vec3_sub(b->corners[(k + 2) % 3], b->corners[(k + 1) % 3], edges[k]);
    }
    vec3_cross(edges[1], edges[2], b->normal);
    for (int k = 0; k < 3; k++) {
        vec3_cross(edges[k], b->normal, b->sides[k]);
        b->margins[k] = mesh->facts.seam * vec3_length(b->sides[k]);
    }
    b->margins[3] = mesh->facts.seam * vec3_length(b->normal);
}

/* 1 if all of `corners`, except the shared one (3: no corner is shared), are beyond one plane of the triangle. */
static int is_beyond(const bounded *b, const double corners[3][3], int shared) {
    int above = 1, below = 1, beside[3] = {1, 1, 1};
    for (int i = 0; i < 3; i++) {
        double to[3];
        if (i == shared) {
            continue;
        }
        vec3_sub(corners[i], b->corners[0], to); /* the first corner is on the edges opposite the others */
        const double height = vec3_dot(to, b->normal);
        above &= height > b->margins[3];
        below &= height < -b->margins[3];
        beside[1] &= vec3_dot(to, b->sides[1]) > b->margins[1];
        beside[2] &= vec3_dot(to, b->sides[2]) > b->margins[2];
        vec3_sub(corners[i], b->corners[1], to);
        beside[0] &= vec3_dot(to, b->sides[0]) > b->margins[0];
    }
    return above | below | beside[0] | beside[1] | beside[2];
}

/* Squared distance between two segments if it is between points inside both (Ericson 2005, section 5.1.9). If an end of
 * one is nearest, HUGE_VAL: ends are tested against the triangle. */
static double segments_distance2(const double a[3], const double b[3], const double c[3], const double d[3]) {
    double ab[3], cd[3], ca[3], off[3];
    vec3_sub(b, a, ab);
    vec3_sub(d, c, cd);
    vec3_sub(a, c, ca);
    const double ab2 = vec3_dot(ab, ab), cd2 = vec3_dot(cd, cd), dot = vec3_dot(ab, cd);
    const double ab_ca = vec3_dot(ab, ca), cd_ca = vec3_dot(cd, ca);
    const double s = (dot * cd_ca - ab_ca * cd2) / (ab2 * cd2 - dot * dot);
    const double t = (dot * s + cd_ca) / cd2;
    if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)) { /* or parallel */
        return HUGE_VAL;
    }
    vec3_madd(ca, s, ab, off);
    vec3_madd(off, -t, cd, off);
    return vec3_dot(off, off);
}

/* 1 if an edge comes within the seam of a triangle. */
static int edge_touches(const knurl_mesh *mesh, const double from[3], const double to[3], const bounded *b) {
    const double seam2 = mesh->facts.seam * mesh->facts.seam;
    knurl_closest_point closest;
    double heights[2], way[3], at[3];
    const double *const ends[2] = {from, to};
    for (int i = 0; i < 2; i++) {
        double offset[3];
        knurl_closest_on_triangle(mesh, b->triangle, ends[i], &closest);
        vec3_sub(ends[i], b->corners[0], offset);
        heights[i] = vec3_dot(offset, b->normal);
        if (closest.distance2 <= seam2) {
            return 1;
        }
    }
    for (int k = 0; k < 3; k++) {
        if (segments_distance2(from, to, b->corners[k], b->corners[(k + 1) % 3]) <= seam2) {
            return 1;
        }
    }
    if ((heights[0] > 0.0) == (heights[1] > 0.0)) {
        return 0;
    }
    vec3_sub(to, from, way);
    vec3_madd(from, heights[0] / (heights[0] - heights[1]), way, at);
    knurl_closest_on_triangle(mesh, b->triangle, at, &closest);
    return closest.distance2 <= seam2;
}

/* Counts the pairs of corners at the same position; shared: the corners of one such pair. */
static int shared_corners(const double a[3][3], const double b[3][3], int shared[2]) {
    int count = 0;
    shared[0] = shared[1] = 3;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const double *p = a[i], *q = b[k];
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) {
                shared[0] = i;
                shared[1] = k;
                count++;
            }
        }
    }
    return count;
}

/* 1 if an edge of `a` touches `b`, unless it ends in the shared corner. */
static int edges_touch(const knurl_mesh *mesh, const bounded *a, int shared, const bounded *b) {
    for (int k = 0; k < 3; k++) {
        const int from = (k + 1) % 3, to = (k + 2) % 3; /* the edge opposite k */
        if ((shared == 3 || shared == k) && edge_touches(mesh, a->corners[from], a->corners[to], b)) {
            return 1;
        }
    }
    return 0;
}

/* 1 if two triangles touch. The second one's planes are computed only if the first one's do not decide. */
static int touch(const knurl_mesh *mesh, const bounded *a, uint32_t triangle) {
    bounded b;
    double corners[3][3];
    int shared[2];
    knurl_mesh_corners(mesh, triangle, corners);
    if (is_beyond(a, (const double (*)[3])corners, 3)) { /* and so share no corner */
        return 0;
    }
    const int count = shared_corners((const double (*)[3])a->corners, (const double (*)[3])corners, shared);
    if (count > 1 || (count == 1 && !a->has_rim && !has_rim(mesh, triangle))) { /* share an edge or a closed fan */
        return 0;
    }
    bound(mesh, triangle, &b);
    if (count == 0) {
        return !is_beyond(&b, (const double (*)[3])a->corners, 3) &&
               (edges_touch(mesh, a, 3, &b) || edges_touch(mesh, &b, 3, a));
    }
    return (!is_beyond(a, (const double (*)[3])corners, shared[1]) && edges_touch(mesh, &b, shared[1], a)) ||
           (!is_beyond(&b, (const double (*)[3])a->corners, shared[0]) && edges_touch(mesh, a, shared[0], &b));
}

/* Triangles of a leaf, side by side, so that all are compared with another triangle at once. Bit k: triangle k. */
typedef struct leaf {
    uint32_t first, count;
    knurl_search_box box; /* around all, and the seam */
    bounded planes[KNURL_MESH_LEAF];
    knurl_float4 low[3][GROUPS], high[3][GROUPS]; /* the box of each, and the seam; no box after the last */
    knurl_mask4 vertices[3][GROUPS];
    uint32_t closed; /* bits of those without a rim */
} leaf;

static void add_to_leaf(const knurl_mesh *mesh, uint32_t k, leaf *l) {
    const uint32_t triangle = l->first + k;
    bounded *b = &l->planes[k];
    knurl_search_box box;
    double low[3], high[3];
    bound(mesh, triangle, b);
    for (int axis = 0; axis < 3; axis++) {
        const double p = b->corners[0][axis], q = b->corners[1][axis], r = b->corners[2][axis];
        low[axis] = knurl_min(p, knurl_min(q, r)) - mesh->facts.seam;
        high[axis] = knurl_max(p, knurl_max(q, r)) + mesh->facts.seam;
    }
    knurl_search_box_set(low, high, &box);
    for (int i = 0; i < 3; i++) {
        l->low[i][k / 4][k % 4] = box.low[i];
        l->high[i][k / 4][k % 4] = box.high[i];
        l->vertices[i][k / 4][k % 4] = (int32_t)mesh->triangles[3 * (size_t)triangle + (size_t)i];
    }
    l->closed |= (uint32_t)!b->has_rim << k;
}

static void read_leaf(const knurl_mesh *mesh, const knurl_bvh_node *node, leaf *l) {
    static const knurl_float4 none = {HUGE_VALF, HUGE_VALF, HUGE_VALF, HUGE_VALF};
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (double)node->min[axis] - mesh->facts.seam;
        high[axis] = (double)node->max[axis] + mesh->facts.seam;
        for (int group = 0; group < GROUPS; group++) {
            l->low[axis][group] = none;
        }
    }
    knurl_search_box_set(low, high, &l->box);
    l->first = node->first;
    l->count = node->count;
    l->closed = 0;
    for (uint32_t k = 0; k < l->count; k++) {
        add_to_leaf(mesh, k, l);
    }
}

/* Bits of the leaf's triangles whose boxes overlap one from low to high. */
static uint32_t find_overlaps(const leaf *l, knurl_float4 low, knurl_float4 high) {
    uint32_t bits = 0;
    for (int group = 0; group < GROUPS; group++) {
        knurl_mask4 all = {-1, -1, -1, -1};
        for (int axis = 0; axis < 3; axis++) {
            all &= (l->low[axis][group] <= knurl_float4_all(high[axis])) &
                   (l->high[axis][group] >= knurl_float4_all(low[axis]));
        }
        bits |= knurl_mask4_bits(all) << 4 * group;
    }
    return bits;
}

/* Bits of the leaf's triangles that have one of three vertices. */
static uint32_t find_sharing(const leaf *l, const uint32_t vertices[3]) {
    uint32_t bits = 0;
    for (int group = 0; group < GROUPS; group++) {
        knurl_mask4 any = {0, 0, 0, 0};
        for (int i = 0; i < 3; i++) {
            const int32_t v = (int32_t)vertices[i];
            const knurl_mask4 vertex = {v, v, v, v};
            any |= (l->vertices[0][group] == vertex) | (l->vertices[1][group] == vertex) |
                   (l->vertices[2][group] == vertex);
        }
        bits |= knurl_mask4_bits(any) << 4 * group;
    }
    return bits;
}

/* Counts the touching pairs of `own` and a leaf's triangles with higher numbers. Most pairs with overlapping boxes
 * share a vertex in closed fans, and do not touch elsewhere. */
static uint32_t count_pairs(const knurl_mesh *mesh, const leaf *own, const knurl_bvh_node *node) {
    uint32_t pairs = 0;
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        const uint32_t *v = &mesh->triangles[3 * (size_t)i];
        const knurl_float4 a = knurl_float4_vertex(mesh, v[0]), b = knurl_float4_vertex(mesh, v[1]);
        const knurl_float4 c = knurl_float4_vertex(mesh, v[2]);
        const knurl_float4 low = knurl_float4_min(a, knurl_float4_min(b, c));
        const knurl_float4 high = knurl_float4_max(a, knurl_float4_max(b, c));
        if (knurl_mask4_any((own->box.low > high) | (own->box.high < low))) {
            continue;
        }
        uint32_t bits = find_overlaps(own, low, high);
        if (i - own->first < own->count) { /* one of its own: only with those before it */
            bits &= (1U << (i - own->first)) - 1U;
        }
        if (bits && !has_rim(mesh, i)) {
            bits &= ~(find_sharing(own, v) & own->closed);
        }
        for (; bits; bits &= bits - 1U) {
            pairs += (uint32_t)touch(mesh, &own->planes[__builtin_ctz(bits)], i);
        }
    }
    return pairs;
}

/* Boxes tested per triangle: a mesh that does not intersect itself needs fewer. If all triangles of a mesh intersect
 * each other, it would need as many as it has triangles. */
#define STEPS_A_TRIANGLE 96

/* Pairs counted per triangle: enough to show that the mesh is broken. */
#define PAIRS_A_TRIANGLE 4

/* Counts the touching pairs of a leaf and all leaves near it, until *steps runs out. */
static uint32_t count_of_leaf(const knurl_mesh *mesh, const knurl_bvh_node *from, uint64_t *steps) {
    uint32_t stack[KNURL_BVH_DEPTH_MAX];
    uint32_t top = 0;
    uint32_t pairs = 0;
    leaf own;
    read_leaf(mesh, from, &own);
    stack[top++] = 0;
    while (top > 0 && *steps > 0) {
        const uint32_t index = stack[--top];
        --*steps;
        const knurl_bvh_node *node = &mesh->nodes[index];
        if (!knurl_search_box_meets_node(&own.box, node)) {
            continue;
        }
        if (node->count == 0) {
            stack[top++] = node->first;
            if (&mesh->nodes[node->first] > from) { /* else all of its left child comes before the leaf */
                stack[top++] = index + 1;
            }
        } else if (node->first >= from->first) {
            const uint64_t tests = (uint64_t)own.count * node->count;
            *steps -= tests < *steps ? tests : *steps;
            pairs += count_pairs(mesh, &own, node);
        }
    }
    return pairs;
}

uint32_t knurl_mesh_count_touching(const knurl_mesh *mesh) {
    uint32_t pairs = 0;
    const uint32_t enough = PAIRS_A_TRIANGLE * mesh->triangle_count; /* cannot overflow: at most 2^26 triangles */
    uint64_t steps = (uint64_t)STEPS_A_TRIANGLE * mesh->triangle_count;
    for (uint32_t i = 0; i < mesh->node_count && steps > 0 && pairs < enough; i++) {
        if (mesh->nodes[i].count > 0) {
            pairs += count_of_leaf(mesh, &mesh->nodes[i], &steps);
        }
    }
    return pairs == 0 && steps == 0 ? 1 : pairs; /* stopped early: there may be some */
}
