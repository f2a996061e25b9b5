/* Meshes from a caller's arrays: errors, the hierarchy over them, and its two queries against brute force.
 * SPDX-License-Identifier: MIT */
#include "support/probe.h"

#include "contact/bvh.h"
#include "contact/mesh_query.h"

static void check_box(const knurl_bvh_node *inner, const float min[3], const float max[3]) {
    for (int axis = 0; axis < 3; axis++) {
        assert_true(inner->min[axis] >= min[axis] && inner->max[axis] <= max[axis]);
        assert_true(inner->min[axis] <= inner->max[axis]);
    }
}

/* Counts each leaf's triangles and checks that they are in its box; returns the depth below a node. */
static uint32_t check_node(const knurl_mesh *mesh, uint32_t index, uint8_t *seen, uint32_t *nodes) {
    const knurl_bvh_node *node = &mesh->nodes[index];
    assert_true(index < mesh->node_count);
    (*nodes)++;
    if (node->count == 0) {
        const uint32_t children[2] = {index + 1, node->first};
        uint32_t depth = 0;
        for (int i = 0; i < 2; i++) {
            assert_true(children[i] > index && children[i] < mesh->node_count);
            check_box(&mesh->nodes[children[i]], node->min, node->max);
            const uint32_t below = check_node(mesh, children[i], seen, nodes);
            depth = below > depth ? below : depth;
        }
        return depth + 1;
    }
    assert_in_range(node->count, 1, 8); /* a handful: the work of a walk is bounded */
    for (uint32_t i = node->first; i < node->first + node->count; i++) {
        assert_true(i < mesh->triangle_count);
        seen[i]++;
        for (uint32_t k = 0; k < 3; k++) {
            const float *p = &mesh->positions[3 * (size_t)mesh->triangles[3 * (size_t)i + k]];
            for (int axis = 0; axis < 3; axis++) {
                assert_true(p[axis] >= node->min[axis] && p[axis] <= node->max[axis]);
            }
        }
    }
    return 1;
}

/* Every triangle in exactly one leaf, every node reached once, boxes within boxes, no deeper than a walk's stack. */
static void check_hierarchy(const knurl_mesh *mesh) {
    uint8_t *seen = calloc(mesh->triangle_count, 1);
    uint32_t nodes = 0;
    assert_true(check_node(mesh, 0, seen, &nodes) <= KNURL_BVH_DEPTH_MAX);
    assert_int_equal(nodes, mesh->node_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        assert_int_equal(seen[i], 1);
    }
    free(seen);
}

/* A sum over the corners of all triangles, independent of the order in a leaf and the numbering of vertices.
 */
static uint64_t sum_of_corners(const float *positions, const uint32_t *indices, size_t count) {
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i += 3) {
        uint64_t hash = 1;
        for (size_t k = 0; k < 9; k++) {
            uint32_t bits;
            memcpy(&bits, &positions[3 * (size_t)indices[i + k / 3] + k % 3], sizeof bits);
            hash = hash * 0x9e3779b97f4a7c15u + bits;
        }
        sum += hash * hash;
    }
    return sum;
}

static double bumps(double x, double y) {
    return 0.003 * sin(200.0 * x) * cos(130.0 * y);
}

TEST(hierarchy_holds_every_triangle_once) {
    static const uint32_t counts[] = {1, 2, 3, 4, 5, 6, 17, 100, 1000};
    for (size_t i = 0; i < COUNT_OF(counts); i++) {
        shape soup = shape_soup(100 + i, counts[i], 0.2);
        const uint64_t sum = sum_of_corners(soup.positions, soup.indices, soup.index_count);
        probe p = probe_shape(&soup);
        assert_int_equal(p.mesh->triangle_count, counts[i]);
        assert_true(sum_of_corners(p.mesh->positions, p.mesh->triangles, 3 * (size_t)counts[i]) == sum);
        check_hierarchy(p.mesh);
        probe_free(&p);
    }
}

TEST(hierarchy_of_1e5_triangles_is_sound) {
    const double half[2] = {0.1, 0.1};
    shape sheet = shape_sheet(250, 200, half, bumps);
    probe p = probe_shape(&sheet);
    assert_int_equal(p.mesh->triangle_count, 100000);
    check_hierarchy(p.mesh);
    probe_free(&p);
}

/* Triangles whose boxes all have the same centre: no plane parts them. */
TEST(hierarchy_of_triangles_with_one_centre_is_sound) {
    const uint32_t count = 20000;
    shape star = shape_new(3 * count, 3 * count, 0);
    for (uint32_t i = 0; i < count; i++) {
        const double r = 1.0 + i % 7;
        shape_set(&star, 3 * i, r, r, r);
        shape_set(&star, 3 * i + 1, -r, -r, -r);
        shape_set(&star, 3 * i + 2, r, -r, i % 2 ? r : -r);
        for (uint32_t k = 0; k < 3; k++) {
            star.indices[3 * i + k] = 3 * i + k;
        }
    }
    probe p = probe_shape(&star);
    check_hierarchy(p.mesh);
    probe_free(&p);
}

/* Triangles along each axis, each 8 times smaller and nearer than the one before, down to some nanometres: every split
 * can part off few only. */
TEST(hierarchy_of_ever_smaller_triangles_keeps_its_depth) {
    const uint32_t levels = 50;
    shape tail = shape_new(9 * levels, 9 * levels, 0);
    for (uint32_t i = 0; i < 3 * levels; i++) {
        const double size = ldexp(1.0, 120 - 3 * (int)(i / 3));
        double corners[3][3] = {{0.0}};
        for (uint32_t k = 0; k < 3; k++) {
            corners[k][i % 3] = k == 1 ? 1.25 * size : size;
            corners[k][(i + 1) % 3] = k == 2 ? 1e-3 * size : 0.0;
            shape_set(&tail, 3 * i + k, corners[k][0], corners[k][1], corners[k][2]);
            tail.indices[3 * i + k] = 3 * i + k;
        }
    }
    probe p = probe_shape(&tail);
    assert_int_equal(p.mesh->triangle_count, 3 * levels);
    check_hierarchy(p.mesh);
    probe_free(&p);
}

/* Flat except for rounding errors: extents whose inverse overflows a float. */
TEST(hierarchy_of_subnormal_noise_is_sound) {
    shape sheet = shape_sheet(20, 20, (const double[2]){0.05, 0.05}, NULL);
    uint64_t seed = 1;
    for (uint32_t v = 0; v < sheet.vertex_count; v++) {
        sheet.positions[3 * v + 2] = (float)random_between(&seed, -1e-40, 1e-40);
    }
    probe p = probe_shape(&sheet);
    check_hierarchy(p.mesh);
    (void)probe_to(&p, 0.01, 0.02, 0.001);
    assert_true(probe_to(&p, 0.01, 0.02, -0.001));
    CHECK_CLOSE(p.contact.z, -0.001, 1e-12);
    probe_free(&p);
}

/* The nearest of all triangles, for points in it, at its corners, on it, and outside; with a radius that just holds. */
static void compare_closest(shape *s, uint64_t seed, int points) {
    shape copy = shape_new(s->vertex_count, s->index_count, 0);
    memcpy(copy.positions, s->positions, s->vertex_count * 3 * sizeof(float));
    memcpy(copy.indices, s->indices, s->index_count * sizeof(uint32_t));
    probe p = probe_shape(s);
    for (int k = 0; k < points; k++) {
        knurl_contact found;
        double at[3];
        double direction[3];
        shape_get(&copy, (uint32_t)random_integer(&seed, 0, copy.vertex_count - 1), at);
        random_direction(&seed, direction);
        add3(at, k % 5 ? random_between(&seed, 0.0, k % 5 == 1 ? 1.5 : 0.1) : 0.0, direction, at);
        const double expected = shape_distance(&copy, at);
        assert_true(knurl_mesh_closest(p.mesh, at, expected + 1e-9, NULL, NULL, &found));
        CHECK_CLOSE(distance3(found.proxy, at), expected, 1e-9);
        knurl_triangle triangle;
        double again[3] = {0.0, 0.0, 0.0};
        knurl_mesh_triangle(p.mesh, found.triangle, &triangle);
        for (uint32_t i = 0; i < 3; i++) { /* weights and triangle give the same point */
            add3(again, found.weights[i], triangle.corners[i], again);
        }
        CHECK_CLOSE(distance3(again, found.proxy), 0.0, 1e-12);
        CHECK_CLOSE(found.weights[0] + found.weights[1] + found.weights[2], 1.0, 1e-12);
        assert_false(expected > 1e-6 && knurl_mesh_closest(p.mesh, at, expected - 1e-9, NULL, NULL, &found));
    }
    shape_free(&copy);
    probe_free(&p);
}

TEST(closest_point_matches_brute_force) {
    const double half[2] = {1.0, 1.0};
    for (uint64_t i = 0; i < 4; i++) {
        shape soup = shape_soup(200 + i, 150, i < 2 ? 0.05 : 0.5);
        compare_closest(&soup, 210 + i, 2500);
    }
    shape sphere = shape_sphere(1.0, 2);
    compare_closest(&sphere, 220, 1500);
    shape sheet = shape_sheet(10, 10, half, NULL);
    compare_closest(&sheet, 221, 1500);
}

/* The first of all crossings, by brute force; 0 if one is too close to an edge or an end to decide. */
static int first_crossing(const shape *s, const double a[3], const double b[3], int double_sided, crossing *first) {
    first->side = 0;
    first->s = 2.0;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double corners[3][3];
        crossing c;
        shape_corners(s, i, corners);
        if (!cross_triangle((const double (*)[3])corners, a, b, &c) || (c.side < 0 && !double_sided)) {
            continue;
        }
        if (fabs(c.margin) < 1e-5 || c.s < 1e-5 || c.s > 1.0 - 1e-5 || fabs(c.s - first->s) < 1e-9) {
            return 0;
        }
        if (c.margin > 0.0 && c.s < first->s) {
            *first = c;
        }
    }
    return 1;
}

static void compare_cross(uint64_t seed, uint32_t triangles, double size, double stroke) {
    shape soup = shape_soup(seed, triangles, size);
    shape copy = shape_soup(seed, triangles, size);
    probe p = probe_shape(&soup);
    int hits = 0;
    for (int k = 0; k < 6000; k++) {
        double a[3];
        double b[3];
        double direction[3];
        crossing expected;
        uint32_t found = UINT32_MAX;
        random_direction(&seed, direction);
        for (int axis = 0; axis < 3; axis++) {
            a[axis] = random_between(&seed, -1.0, 1.0);
        }
        add3(a, stroke, direction, b);
        if (!first_crossing(&copy, a, b, k % 2, &expected)) {
            continue;
        }
        assert_int_equal(knurl_mesh_cross(p.mesh, a, b, k % 2, NULL, NULL, &found), expected.side);
        if (expected.side != 0) {
            knurl_triangle triangle;
            crossing c = {0.0, 0.0, 0};
            knurl_mesh_triangle(p.mesh, found, &triangle);
            assert_true(cross_triangle((const double (*)[3])triangle.corners, a, b, &c));
            CHECK_CLOSE(c.s, expected.s, 1e-9);
            hits++;
        }
    }
    assert_in_range(hits, 200, 6000);
    shape_free(&copy);
    probe_free(&p);
}

TEST(first_crossing_matches_brute_force) {
    compare_cross(301, 200, 0.3, 0.3);
    compare_cross(302, 200, 0.3, 2.0);
    compare_cross(303, 60, 0.5, 1.0);
}

/* Through every edge and corner of a closed body from outside to its middle: between two neighbours there is no gap. */
TEST(no_stroke_slips_between_neighbours) {
    shape sphere = shape_sphere(0.03, 3);
    shape copy = shape_sphere(0.03, 3);
    probe p = probe_shape(&sphere);
    for (uint32_t i = 0; i < copy.index_count; i++) {
        for (int k = 0; k <= 4; k++) { /* along the edge from corner i to the next: at its ends, and between */
            const double middle[3] = {0.0, 0.0, 0.0};
            double from[3];
            double to[3];
            uint32_t found;
            shape_get(&copy, copy.indices[i], from);
            shape_get(&copy, copy.indices[i % 3 == 2 ? i - 2 : i + 1], to);
            add3(to, -1.0, from, to);
            add3(from, 0.25 * k, to, from);
            add3(middle, 1.001, from, from);
            assert_int_equal(knurl_mesh_cross(p.mesh, from, middle, 0, NULL, NULL, &found), 1);
            assert_int_equal(knurl_mesh_cross(p.mesh, middle, from, 0, NULL, NULL, &found), 0);
            assert_int_equal(knurl_mesh_cross(p.mesh, middle, from, 1, NULL, NULL, &found), -1);
        }
    }
    shape_free(&copy);
    probe_free(&p);
}

TEST(triangles_without_area_are_dropped_and_counted) {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 1, 0, 0};
    const uint32_t indices[] = {0, 1, 2, 0, 0, 1, 0, 1, 3, 1, 4, 2, 1, 2, 0};
    const double inside[3] = {0.25, 0.25, -0.001};
    knurl_heap heap;
    knurl_mesh *mesh = NULL;
    knurl_mesh_desc desc;
    knurl_contact found;
    knurl_heap_init(&heap, NULL);
    knurl_mesh_desc_init(&desc, sizeof desc);
    desc.vertex_count = 5;
    desc.positions = positions;
    desc.indices = indices;
    desc.index_count = COUNT_OF(indices);
    assert_int_equal(knurl_mesh_create(&heap, &desc, &mesh), KNURL_OK);
    assert_int_equal(mesh->triangle_count,
                     1); /* a corner twice, three on a line, two in one place, a second one: gone */
    assert_int_equal(mesh->dropped, 4);
    assert_int_equal(mesh->reversed_twins, 0);
    check_hierarchy(mesh);
    assert_true(knurl_mesh_closest(mesh, inside, 0.01, NULL, NULL, &found));
    CHECK_CLOSE(found.proxy[2], 0.0, 1e-12);
    knurl_mesh_destroy(&heap, mesh);
    assert_int_equal(heap.bytes, 0);
}

/* A triangle of 0.1 m and of so many millionths of it in height, whichever of its edges is the longest. */
TEST(triangles_thinner_than_a_millionth_of_their_longest_edge_are_dropped) {
    for (int way = 0; way < 3; way++) {
        for (int is_felt = 0; is_felt < 2; is_felt++) {
            const double corners[3][2] = {{0.0, 0.0}, {0.1, 0.0}, {0.05, is_felt ? 1.1e-7 : 0.9e-7}};
            shape s = shape_new(6, 6, 0);
            for (uint32_t v = 0; v < 6; v++) {
                const double *at = corners[(v + (uint32_t)way) % 3];
                shape_set(&s, v, at[0], at[1] * (v < 3 ? 1.0 : 1e5), 0.0);
                s.indices[v] = v;
            }
            probe p = probe_shape(&s);
            assert_int_equal(p.mesh->dropped, !is_felt);
            probe_free(&p);
        }
    }
}

/* A corner of a sheet covered by many small triangles is found, although the rest is not crowded. */
TEST(visits_are_exceeded_where_triangles_crowd) {
    static const double half[2] = {0.05, 0.05};
    for (int is_crowded = 0; is_crowded < 2; is_crowded++) {
        shape sheet = shape_sheet(10, 10, half, NULL);
        shape crowd = shape_soup(5, 300, 0.9);
        for (uint32_t v = 0; v < crowd.vertex_count; v++) {
            for (size_t axis = 0; axis < 3; axis++) {
                float *at = &crowd.positions[3 * (size_t)v + axis];
                *at = *at * 0.0005f + (axis < 2 ? 0.045f : 0.0f);
            }
        }
        shape both = is_crowded ? shape_join(&sheet, &crowd) : sheet;
        if (!is_crowded) {
            shape_free(&crowd);
        }
        probe p = probe_shape(&both);
        assert_int_equal(knurl_mesh_exceeds_visits(p.mesh, 0.001, 1000), is_crowded);
        probe_free(&p);
    }
}

/* A sheet, its duplicate turned in the list by one corner, and its back, each with vertices of its own. */
TEST(twins_are_dropped_and_reversed_ones_make_it_double_sided) {
    const double half[2] = {0.02, 0.015};
    shape sheet = shape_sheet(5, 4, half, NULL);
    shape layers = shape_new(3 * sheet.vertex_count, 3 * sheet.index_count, 0);
    for (uint32_t layer = 0; layer < 3; layer++) {
        memcpy(&layers.positions[(size_t)layer * 3 * sheet.vertex_count], sheet.positions,
               sheet.vertex_count * 3 * sizeof(float));
        for (uint32_t i = 0; i < sheet.index_count; i++) {
            const uint32_t k = layer == 1 ? (i + 1) % 3 : layer == 2 ? 2 - i % 3 : i % 3;
            layers.indices[layer * sheet.index_count + i] = layer * sheet.vertex_count + sheet.indices[i - i % 3 + k];
        }
    }
    probe two = probe_shape(&layers);
    assert_int_equal(two.mesh->triangle_count, 40);
    assert_int_equal(two.mesh->vertex_count, 30);
    assert_int_equal(two.mesh->dropped, 40);
    assert_int_equal(two.mesh->reversed_twins, 40);
    assert_int_equal(two.mesh->double_sided, 1);
    check_hierarchy(two.mesh);
    probe_free(&two);
    probe one = probe_shape(&sheet);
    assert_int_equal(one.mesh->dropped + one.mesh->reversed_twins, 0);
    assert_int_equal(one.mesh->double_sided, 0);
    probe_free(&one);
}

TEST(indices_may_be_left_out) {
    SCOPED_SHAPE soup = shape_soup(5, 50, 0.3);
    knurl_mesh_desc desc = shape_desc(&soup);
    knurl_heap heap;
    knurl_mesh *mesh = NULL;
    knurl_heap_init(&heap, NULL);
    desc.indices = NULL;
    desc.index_count = 0;
    assert_int_equal(knurl_mesh_create(&heap, &desc, &mesh), KNURL_OK);
    assert_int_equal(mesh->triangle_count, 50);
    assert_true(sum_of_corners(mesh->positions, mesh->triangles, 150) ==
                sum_of_corners(soup.positions, soup.indices, 150));
    knurl_mesh_destroy(&heap, mesh);
}

TEST(doubled_vertices_are_welded_by_place) {
    shape sheet = shape_sheet(2, 2, (const double[2]){0.02, 0.015}, NULL);
    shape_unweld(&sheet);
    for (uint32_t v = 0; v < sheet.vertex_count; v += 2) { /* 0 and -0 are one place */
        for (uint32_t axis = 0; axis < 3; axis++) {
            float *value = &sheet.positions[3 * v + axis];
            *value = *value != 0.0f ? *value : -0.0f;
        }
    }
    probe p = probe_shape(&sheet);
    uint32_t rims = 0;
    assert_int_equal(p.mesh->vertex_count, 9); /* of 24 */
    for (size_t i = 0; i < 24; i++) {
        rims += p.mesh->opposite[i] == KNURL_BOUNDARY;
    }
    assert_int_equal(rims, 8); /* the outer edges only: inside, the sheet hangs together */
    probe_free(&p);
}

/* One field of a good mesh made bad; the message has to hold each of the words. */
static void check_bad(const knurl_mesh_desc *desc, const char *first, const char *second) {
    knurl_heap heap;
    knurl_mesh *mesh = NULL;
    knurl_heap_init(&heap, NULL);
    CHECK_REFUSED(knurl_mesh_check(desc) ? KNURL_ERROR_ARGUMENT : knurl_mesh_create(&heap, desc, &mesh),
                  KNURL_ERROR_ARGUMENT, mesh);
    if (!strstr(knurl_error_message(), first) || !strstr(knurl_error_message(), second)) {
        print_error("\"%s\" lacks \"%s\" or \"%s\"\n", knurl_error_message(), first, second);
        fail();
    }
    assert_int_equal(heap.bytes, 0);
}

TEST(bad_counts_and_indices_are_named) {
    SCOPED_SHAPE soup = shape_soup(6, 4, 0.3);
    const knurl_mesh_desc good = shape_desc(&soup);
    knurl_mesh_desc bad = good;
    bad.vertex_count = 2;
    check_bad(&bad, "vertex_count", "found 2");
    bad.vertex_count = (1u << 28) + 1;
    check_bad(&bad, "vertex_count", "268435457");
    bad = good;
    bad.positions = NULL;
    check_bad(&bad, "positions", "null");
    bad = good;
    bad.index_count = 11;
    check_bad(&bad, "multiple of 3", "found 11");
    bad.index_count = 0;
    check_bad(&bad, "multiple of 3", "found 0");
    bad.index_count = ((uint64_t)3 << 26) + 3;
    check_bad(&bad, "multiple of 3", "found 201326595");
    bad = good;
    bad.indices = NULL;
    bad.index_count = 0;
    bad.vertex_count = 11;
    check_bad(&bad, "multiple of 3", "found 11");
    bad = good;
    soup.indices[7] = 12;
    check_bad(&bad, "indices[7]", "found 12");
}

TEST(numbers_that_are_not_finite_are_named) {
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    SCOPED_SHAPE sheet = shape_sheet(2, 2, (const double[2]){1.0, 1.0}, NULL);
    float tangents[9 * 4] = {0};
    knurl_mesh_desc desc = shape_desc(&sheet);
    desc.tangents = tangents;
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        sheet.positions[3 * 4 + 1] = wrong[i];
        check_bad(&desc, "positions", "vertex 4");
        sheet.positions[3 * 4 + 1] = 0.0f;
        sheet.uvs[2 * 8 + 1] = wrong[i];
        check_bad(&desc, "uvs", "vertex 8");
        sheet.uvs[2 * 8 + 1] = 1.0f;
        tangents[4 * 3 + 2] = wrong[i];
        check_bad(&desc, "tangents", "vertex 3");
        tangents[4 * 3 + 2] = 0.0f;
    }
}

TEST(mesh_without_any_area_is_refused) {
    SCOPED_SHAPE sheet = shape_sheet(3, 3, (const double[2]){1.0, 1.0}, NULL);
    const knurl_mesh_desc desc = shape_desc(&sheet);
    for (uint32_t v = 0; v < sheet.vertex_count; v++) {
        sheet.positions[3 * v + 1] = sheet.positions[3 * v];
    }
    check_bad(&desc, "area", "18");
}
