/* A search from triangle to triangle over shared edges finds which of them face the same way.
 * SPDX-License-Identifier: MIT */
#include "contact/mesh_winding.h"

#include "base/vec3.h"
#include "contact/corner.h"

/* Of each triangle. */
enum { NOT_SEEN, SAME, OTHER, TURNED };

/* 1 where neighbours face opposite ways, and it can only be their winding: solids that lie against one another in one
 * mesh have such neighbours, too, but also triangles that touch without sharing an edge, or share one with two others.
 */
static int is_mixed(const knurl_mesh *mesh) {
    int mixed = 0;
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        const uint32_t opposite = mesh->opposite[i];
        if ((opposite & KNURL_CORNER_MASK) == KNURL_NON_MANIFOLD_EDGE) {
            return 0;
        }
        mixed |= (opposite & KNURL_FLIPPED) != 0;
    }
    return mixed && mesh->reversed_twins == 0 && mesh->touching == 0;
}

/* A connected component: triangles that are reached from one another over shared edges. */
typedef struct component {
    uint32_t *found; /* room for all of the mesh */
    uint32_t count;
    double areas[2]; /* m^2, twice: of those that face as the first does, and of the others */
    int one_sided;   /* 1: it has one side only, as a Moebius strip */
} component;

/* Finds and marks the component of `first`. */
static void find_component(const knurl_mesh *mesh, uint32_t first, uint8_t *marks, component *c) {
    c->count = 1;
    c->found[0] = first;
    c->areas[0] = c->areas[1] = 0.0;
    c->one_sided = 0;
    marks[first] = SAME;
    for (uint32_t i = 0; i < c->count; i++) {
        const uint32_t t = c->found[i];
        knurl_triangle triangle;
        knurl_mesh_triangle(mesh, t, &triangle);
        c->areas[marks[t] == OTHER] += triangle.area2;
        for (size_t k = 0; k < 3; k++) {
            const uint32_t opposite = mesh->opposite[3 * (size_t)t + k];
            const uint32_t next = (opposite & KNURL_CORNER_MASK) >> 2;
            const uint8_t mark = opposite & KNURL_FLIPPED ? (uint8_t)(SAME + OTHER - marks[t]) : marks[t];
            if ((opposite & 3) == 3) {
                continue;
            }
            if (marks[next] == NOT_SEEN) {
                marks[next] = mark;
                c->found[c->count++] = next;
            }
            c->one_sided |= marks[next] != mark;
        }
    }
}

/* The corner in the place of an old one. */
static uint32_t moved_corner(const uint8_t *marks, uint32_t corner) {
    const uint32_t k = corner & 3;
    return marks[corner >> 2] == TURNED && k != 0 ? corner - k + 3 - k : corner;
}

static void swap(uint32_t *numbers, size_t triangle) {
    const uint32_t second = numbers[3 * triangle + 1];
    numbers[3 * triangle + 1] = numbers[3 * triangle + 2];
    numbers[3 * triangle + 2] = second;
}

/* Exchanges the second and third corner of marked triangles, and renames these corners wherever they are named. */
static void turn_over(knurl_mesh *mesh, const uint8_t *marks) {
    uint32_t listed = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (marks[t] == TURNED) {
            swap(mesh->triangles, t);
            swap(mesh->opposite, t);
            if (mesh->attributes) {
                swap(mesh->attributes, t);
            }
        }
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++) {
        const uint32_t opposite = mesh->opposite[i];
        const uint32_t corner = opposite & KNURL_CORNER_MASK;
        listed += (opposite & KNURL_NON_MANIFOLD) != 0;
        if ((corner & 3) != 3) {
            const int differ = (marks[i / 3] == TURNED) != (marks[corner >> 2] == TURNED);
            mesh->opposite[i] =
                ((opposite & ~KNURL_CORNER_MASK) ^ (differ ? KNURL_FLIPPED : 0)) | moved_corner(marks, corner);
        }
    }
    for (uint32_t i = 0; i < listed; i++) {
        mesh->non_manifold_corners[i] = moved_corner(marks, mesh->non_manifold_corners[i]);
    }
}

/* Of two areas that differ by less than this share neither is the front. */
#define UNDECIDED 0.01

/* Which of a component's triangles are to be turned over. */
static void choose_front(knurl_mesh *mesh, const component *c, uint8_t *marks) {
    const double most = fmax(c->areas[0], c->areas[1]);
    const uint8_t other = c->areas[0] < c->areas[1] ? SAME : OTHER;
    mesh->double_sided |= c->one_sided || fabs(c->areas[0] - c->areas[1]) < UNDECIDED * most;
    for (uint32_t i = 0; i < c->count; i++) {
        if (marks[c->found[i]] == other) {
            marks[c->found[i]] = TURNED;
            mesh->turned++;
        }
    }
}

knurl_result knurl_mesh_unify_winding(knurl_heap *heap, knurl_mesh *mesh) {
    component c;
    if (!is_mixed(mesh)) {
        return KNURL_OK;
    }
    uint8_t *marks = knurl_heap_alloc(heap, mesh->triangle_count, sizeof *marks);
    c.found = knurl_heap_alloc(heap, mesh->triangle_count, sizeof *c.found);
    const knurl_result result = marks && c.found ? KNURL_OK : KNURL_ERROR_MEMORY;
    for (uint32_t t = 0; !result && t < mesh->triangle_count; t++) {
        if (marks[t] == NOT_SEEN) {
            find_component(mesh, t, marks, &c);
            choose_front(mesh, &c, marks);
        }
    }
    if (!result && mesh->turned > 0) {
        turn_over(mesh, marks);
    }
    knurl_heap_free(heap, marks);
    knurl_heap_free(heap, c.found);
    return result;
}
