/* Caches the part of a mesh that the searches of a tick visit. SPDX-License-Identifier: MIT */
#include "contact/mesh_search.h"

/* m: a larger search uses the whole mesh, and the part cached for smaller ones is kept. */
#define PART_SIZE_MAX 0.005

/* Margin of the box of listed triangles around the search, as a fraction of its size. */
#define LIST_MARGIN 0.5

/* m: minimum margin. Short searches would leave the next tick a box that is too narrow, and the visits of a tick do not
 * suffice to list the triangles of 32 meshes again. */
#define LIST_MARGIN_MIN 0.0002

/* `count` of a part whose triangles are not listed. */
#define NOT_LISTED UINT32_MAX

static const knurl_part all_of_mesh = {.node = 0, .count = NOT_LISTED};

static int is_within(const knurl_part *part, const double low[3], const double high[3]) {
    int within = 1;
    for (int axis = 0; axis < 3; axis++) {
        within &= part->low[axis] <= low[axis] && part->high[axis] >= high[axis];
    }
    return within;
}

static void begin_at_node(knurl_mesh_search *s, const knurl_mesh *mesh, uint32_t node, knurl_visits *visits) {
    s->mesh = mesh;
    s->visits = visits;
    s->listed = NULL;
    s->next = s->end = 0;
    s->nodes[0] = node;
    s->count = 1;
}

/* Lists the triangles in a box. If the list has room for all, the box becomes the part's. */
static void list_triangles(const knurl_mesh *mesh, const double low[3], const double high[3], knurl_visits *visits,
                           knurl_part *part) {
    knurl_mesh_search search;
    knurl_search_box box;
    uint32_t triangle, count = 0;
    knurl_search_box_set(low, high, &box);
    begin_at_node(&search, mesh, part->node, visits);
    part->count = NOT_LISTED;
    while (knurl_mesh_search_next(&search, &box, &triangle)) {
        if (count == KNURL_PART_TRIANGLES) {
            return;
        }
        part->triangles[count++] = triangle;
    }
    if (!visits || visits->left > 0) { /* otherwise some were not visited */
        part->count = count;
        vec3_copy(low, part->low);
        vec3_copy(high, part->high);
    }
}

/* Finds a part with a margin around a box: the next searches of this tick and the next are near it. */
static void find_anew(const knurl_mesh *mesh, const double low[3], const double high[3], double size,
                      knurl_visits *visits, knurl_part *part) {
    const double margin = knurl_max(LIST_MARGIN * size, LIST_MARGIN_MIN);
    const double wide = knurl_max(size, margin);
    uint32_t index = 0;
    double least[3], most[3];
    for (int axis = 0; axis < 3; axis++) {
        part->low[axis] = low[axis] - wide;
        part->high[axis] = high[axis] + wide;
        least[axis] = low[axis] - margin;
        most[axis] = high[axis] + margin;
    }
    while (mesh->nodes[index].count == 0 && knurl_visits_take(visits, 1)) {
        const uint32_t children[2] = {index + 1, mesh->nodes[index].first};
        const int meets[2] = {knurl_bvh_meets(&mesh->nodes[children[0]], part->low, part->high),
                              knurl_bvh_meets(&mesh->nodes[children[1]], part->low, part->high)};
        if (meets[0] == meets[1]) {
            break;
        }
        index = children[meets[1]];
    }
    part->node = index;
    list_triangles(mesh, least, most, visits, part);
}

const knurl_part *knurl_mesh_find_part(const knurl_mesh *mesh, const double low[3], const double high[3],
                                       knurl_visits *visits, knurl_part *part) {
    const double size = knurl_max(high[0] - low[0], knurl_max(high[1] - low[1], high[2] - low[2]));
    if (!part || size > PART_SIZE_MAX) {
        return &all_of_mesh;
    }
    if (!is_within(part, low, high)) {
        find_anew(mesh, low, high, size, visits, part);
    }
    return part;
}

void knurl_mesh_search_begin(knurl_mesh_search *s, const knurl_mesh *mesh, const double low[3], const double high[3],
                             knurl_visits *visits, knurl_part *part) {
    const knurl_part *near = knurl_mesh_find_part(mesh, low, high, visits, part);
    begin_at_node(s, mesh, near->node, visits);
    if (near->count != NOT_LISTED) {
        s->count = 0;
        s->listed = near->triangles;
        s->end = knurl_visits_take(visits, near->count / 4) ? near->count : 0; /* cheaper than a leaf's */
    }
}
