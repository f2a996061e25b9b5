/* Meshes that become planes with an outline, and meshes that stay meshes, with the reason. Outlines against the drawn
 * ones. SPDX-License-Identifier: MIT */
#include "flat_outcome.h"

TEST(rectangular_sheet_becomes_a_rectangle_about_its_middle) {
    SCOPED_SHAPE s = DRAWING("########", "########", "########", "########");
    outcome o = decide(&s);
    assert_string_equal(o.why, "plane: a flat mesh, a rectangle");
    assert_null(o.plane->outline);
    assert_int_equal(o.plane->edge_count, 0);
    assert_int_equal(o.plane->triangle_count, 64);
    CHECK_CLOSE(o.plane->half_extents[0], 4.0 * CELL, 1e-12);
    CHECK_CLOSE(o.plane->half_extents[1], 2.0 * CELL, 1e-12);
    CHECK_CLOSE(o.plane->facts.error, 0.0, 1e-15);
    const double middle[3] = {4.0 * CELL, 2.0 * CELL, 0.0};
    CHECK_CLOSE(distance3(o.position, middle), 0.0, 1e-12);
    for (int i = 0; i < 9; i++) {
        CHECK_CLOSE(o.rotation[i], i % 4 == 0, 1e-12);
    }
    assert_true(o.plane->has_coordinates);
    CHECK_CLOSE(o.plane->map[0][0], 1.0, 1e-12);
    CHECK_CLOSE(o.plane->map[0][2], middle[0], 1e-12);
    CHECK_CLOSE(o.plane->map[1][1], 1.0, 1e-12);
    CHECK_CLOSE(o.plane->map[1][2], middle[1], 1e-12);
    forget(&o);
}

TEST(outline_is_what_was_drawn) {
    const double c = CELL;
    shape l = DRAWING("#...", "#...", "####");
    CHECK_OUTLINE(&l, 6, 6.0 * c * c, 14.0 * c);
    shape ring = DRAWING("#####", "#...#", "#...#", "#####");
    CHECK_OUTLINE(&ring, 8, 14.0 * c * c, 28.0 * c);
    shape islands = DRAWING("##..#", "##..#", "....#");
    CHECK_OUTLINE(&islands, 8, 7.0 * c * c, 16.0 * c);
    shape touching = DRAWING("##..", "##..", "..##", "..##"); /* in a corner */
    CHECK_OUTLINE(&touching, 8, 8.0 * c * c, 16.0 * c);
    shape island_in_hole = DRAWING("#######", "#.....#", "#..#..#", "#.....#", "#######");
    CHECK_OUTLINE(&island_in_hole, 12, 21.0 * c * c, 44.0 * c);
    shape holes_touch = DRAWING("#####", "#.###", "##.##", "#####");
    CHECK_OUTLINE(&holes_touch, 12, 18.0 * c * c, 26.0 * c);
    const double s = sin(PI / 5.0) * 0.05 * 0.02; /* twice the area of one of the star's triangles */
    const double edge = sqrt(0.05 * 0.05 + 0.02 * 0.02 - 2.0 * 0.05 * 0.02 * cos(PI / 5.0));
    shape star = flat_fan(10, 0.05, 0.02);
    CHECK_OUTLINE(&star, 10, 5.0 * s, 10.0 * edge);
}

TEST(single_triangle_is_a_plane_of_three_edges) {
    shape s = flat_fan(3, 0.05, 0.05);
    s.index_count = 3;
    const double a = 0.05 * sqrt(3.0); /* middle, corner, corner: angles of 30, 30 and 120 degrees */
    CHECK_OUTLINE(&s, 3, 0.5 * 0.05 * 0.05 * sin(2.0 * PI / 3.0), 0.1 + a);
}

TEST(outline_of_64_edges_is_a_plane_and_of_65_stays_a_mesh) {
    shape s = flat_fan(64, 0.05, 0.05);
    CHECK_OUTLINE(&s, 64, 32.0 * 0.05 * 0.05 * sin(2.0 * PI / 64.0), 128.0 * 0.05 * sin(PI / 64.0));
    shape more = flat_fan(65, 0.05, 0.05);
    CHECK_STAYS(&more, "mesh: its outline has more than 64 edges");
}

TEST(fine_grids_of_confetti_stay_meshes) {
    shape s = flat_fan(400, 0.05, 0.03);
    CHECK_STAYS(&s, "mesh: its outline has more than 64 edges");
    const char *const rows[] = {"#.#.#.#.#.#.#.#.#.#.", "....................", "#.#.#.#.#.#.#.#.#.#."};
    shape dots = flat_drawing(rows, 3);
    CHECK_STAYS(&dots, "mesh: its outline has more than 64 edges");
}

TEST(sheet_without_shared_vertices_has_the_same_outline) {
    shape s = DRAWING("#####", "#...#", "#...#", "#####");
    shape_unweld(&s);
    CHECK_OUTLINE(&s, 8, 14.0 * CELL * CELL, 28.0 * CELL);
}

TEST(sheet_without_indices_has_the_same_outline) {
    SCOPED_SHAPE s = DRAWING("#...", "#...", "####");
    shape_unweld(&s);
    knurl_mesh_desc desc = shape_desc(&s);
    desc.indices = NULL;
    desc.index_count = 0;
    outcome o = decide_with(&desc, NULL);
    double length;
    assert_int_equal(o.plane->edge_count, 6);
    CHECK_CLOSE(flat_area(o.plane, &length), 6.0 * CELL * CELL, 1e-12);
    forget(&o);
}

/* Rows of bricks: the long side of one is covered by two halves, by thirds, and by both. */
static shape bricks(const uint32_t *cuts, uint32_t rows) {
    shape s = shape_new(4 * 60 * rows, 6 * 60 * rows, 1);
    uint32_t v = 0;
    uint32_t at = 0;
    for (uint32_t j = 0; j < rows; j++) {
        for (uint32_t i = 0; i < cuts[j]; i++) {
            for (uint32_t k = 0; k < 4; k++) {
                const double x = 0.1 * (i + (k == 1 || k == 2)) / cuts[j];
                const double y = 0.01 * (j + (k >= 2));
                shape_set(&s, v + k, x, y, 0.0);
                s.uvs[2 * (v + k)] = (float)x;
                s.uvs[2 * (v + k) + 1] = (float)y;
            }
            at = shape_quad(&s, at, v, v + 1, v + 2, v + 3);
            v += 4;
        }
    }
    s.index_count = at;
    s.vertex_count = v;
    return s;
}

TEST(edges_covered_by_several_shorter_ones_are_inside) {
    const uint32_t cuts[] = {1, 2, 3, 6, 4, 1, 7, 5, 60, 59};
    for (uint32_t rows = 1; rows <= COUNT_OF(cuts); rows++) {
        shape s = bricks(cuts, rows);
        CHECK_OUTLINE(&s, 0, 0.1 * 0.01 * rows, 2.0 * (0.1 + 0.01 * rows));
    }
}

TEST(turned_edges_covered_by_several_shorter_ones_are_inside) {
    const uint32_t cuts[] = {1, 2, 3, 6, 4, 1, 7, 5, 60, 59};
    const double turned[4] = {0.1, -0.3, 0.5, sqrt(1.0 - 0.35)};
    shape s = bricks(cuts, 10);
    flat_move(&s, turned, (const double[3]){0.3, -0.2, 0.1});
    CHECK_OUTLINE(&s, 0, 0.01, 0.4);
}

/* A hole, one side of which is a part of one long edge: its outline has to be split there. */
TEST(hole_beside_a_long_edge_has_an_outline_of_its_own) {
    shape s = shape_new(12, 18, 1);
    static const double places[12][2] = {{0, 0}, {6, 0}, {6, 1}, {0, 1}, {0, 1}, {2, 1},
                                         {2, 3}, {0, 3}, {3, 1}, {6, 1}, {6, 3}, {3, 3}};
    for (uint32_t v = 0; v < 12; v++) {
        shape_set(&s, v, CELL * places[v][0], CELL * places[v][1], 0.0);
        s.uvs[2 * v] = (float)places[v][0];
        s.uvs[2 * v + 1] = (float)places[v][1];
    }
    (void)shape_quad(&s, shape_quad(&s, shape_quad(&s, 0, 0, 1, 2, 3), 4, 5, 6, 7), 8, 9, 10, 11);
    CHECK_OUTLINE(&s, 8, 16.0 * CELL * CELL, 22.0 * CELL); /* a notch of 1 x 2 in 6 x 3 */
}

TEST(duplicates_slivers_and_unused_vertices_change_nothing) {
    SCOPED_SHAPE s = DRAWING("#...", "#...", "####");
    const uint32_t *t = s.indices;
    flat_add(&s, t[0], t[1], t[2]);
    t = s.indices;
    flat_add(&s, t[4], t[5], t[3]); /* turned round on itself */
    flat_add(&s, 0, 1, 2);          /* on one line */
    flat_add(&s, 3, 3, 7);
    shape_set(&s, 14, 1.0, 2.0, 3.0); /* above the notch: no triangle uses it */
    outcome o = decide(&s);
    double length;
    assert_non_null(o.plane);
    assert_int_equal(o.plane->edge_count, 6);
    assert_int_equal(o.plane->triangle_count, 12);
    assert_int_equal(o.plane->facts.dropped, 4);
    assert_int_equal(o.plane->facts.reversed_twins, 0);
    assert_int_equal(o.plane->double_sided, 0);
    assert_string_equal(o.why, "plane: a flat mesh with its outline");
    CHECK_CLOSE(flat_area(o.plane, &length), 6.0 * CELL * CELL, 1e-12);
    forget(&o);
}

static void add_twins(shape *s, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        flat_add(s, s->indices[3 * i], s->indices[3 * i + 2], s->indices[3 * i + 1]);
    }
}

TEST(sheet_of_reversed_twins_is_double_sided) {
    SCOPED_SHAPE s = DRAWING("#...", "#...", "####");
    add_twins(&s, 12);
    flat_add(&s, s.indices[0], s.indices[2], s.indices[1]); /* the twin once more */
    outcome o = decide(&s);
    assert_non_null(o.plane);
    assert_int_equal(o.plane->edge_count, 6);
    assert_int_equal(o.plane->triangle_count, 12);
    assert_int_equal(o.plane->facts.reversed_twins, 12);
    assert_int_equal(o.plane->facts.dropped, 1);
    assert_int_equal(o.plane->double_sided, 1);
    CHECK_CLOSE(o.rotation[8], 1.0, 1e-12); /* the first triangle determines the front */
    forget(&o);
}

TEST(twins_give_the_front_its_own_uvs_whichever_comes_first) {
    SCOPED_SHAPE s = DRAWING("##", "##");
    shape_unweld(&s);
    const uint32_t count = s.index_count;
    SCOPED_SHAPE both = shape_new(2 * count, 2 * count, 1);
    for (uint32_t i = 0; s.uvs && i < 2 * count;
         i++) { /* front, back, then back, front, and so on; the back is mirrored */
        const uint32_t pair = i / 6;
        const int is_back = (i / 3) % 2 != pair % 2;
        const uint32_t corner = is_back ? 2 - i % 3 : i % 3;
        const uint32_t from = 3 * pair + corner;
        memcpy(&both.positions[(size_t)3 * i], &s.positions[(size_t)3 * from], 3 * sizeof(float));
        both.uvs[2 * i] = is_back ? 1.0F - s.uvs[2 * from] : s.uvs[2 * from];
        both.uvs[2 * i + 1] = s.uvs[2 * from + 1];
        both.indices[i] = i;
    }
    outcome o = decide(&both);
    assert_non_null(o.plane);
    assert_int_equal(o.plane->facts.reversed_twins, 8);
    CHECK_CLOSE(o.plane->map[0][0], 1.0, 1e-9);
    CHECK_CLOSE(o.plane->map[0][2], CELL, 1e-9);
    forget(&o);
}

TEST(sheet_with_a_twin_missing_stays_a_mesh) {
    shape s = DRAWING("#...", "#...", "####");
    add_twins(&s, 11);
    CHECK_STAYS(&s, "mesh: only some of its triangles have a reversed twin");
}

TEST(sheet_that_faces_both_ways_stays_a_mesh) {
    shape s = DRAWING("####", "####");
    const uint32_t b = s.indices[7];
    s.indices[7] = s.indices[8];
    s.indices[8] = b;
    CHECK_STAYS(&s, "mesh: its triangles face both ways");
}

static double bump;

static double bumped(double x, double y) {
    return x > 0.0 && y > 0.0 ? bump : 0.0;
}

TEST(sheet_is_flat_to_a_micrometre_and_to_1e5th_of_its_size) {
    const struct {
        double half;
        double height;
        int flat;
    } cases[] = {{0.25, 1.8e-6, 1}, {0.25, 2.4e-6, 0}, {0.01, 2e-7, 1}, {0.01, 1e-6, 0}, {0.25, 1e-3, 0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        bump = cases[i].height;
        shape s = shape_sheet(2, 2, (const double[2]){cases[i].half, cases[i].half}, bumped);
        if (cases[i].flat) {
            outcome o = decide(&s);
            assert_non_null(o.plane);
            assert_true(o.plane->facts.error >= 0.25 * bump && o.plane->facts.error <= 0.51 * bump);
            const double normal[3] = {o.rotation[2], o.rotation[5], o.rotation[8]};
            for (uint32_t v = 0; v < s.vertex_count; v++) { /* it is the bound that it is reported as */
                double p[3];
                shape_get(&s, v, p);
                add3(p, -1.0, o.position, p);
                assert_true(fabs(dot3(p, normal)) <= 1.0001 * o.plane->facts.error);
            }
            forget(&o);
            shape_free(&s);
        } else {
            CHECK_STAYS(&s, "mesh: not flat");
        }
    }
}

TEST(bump_that_the_samples_miss_keeps_a_mesh) {
    shape s = shape_sheet(100, 100, (const double[2]){0.05, 0.05}, NULL);
    s.positions[3 * 5050 + 2] = 0.001F;
    CHECK_STAYS(&s, "mesh: not flat");
}

TEST(solids_and_curved_sheets_stay_meshes) {
    shape box = shape_box((const double[3]){0.05, 0.05, 0.05}, 0);
    CHECK_STAYS(&box, "mesh: not flat");
    shape sphere = shape_sphere(0.05, 3);
    CHECK_STAYS(&sphere, "mesh: not flat");
    shape soup = shape_soup(7, 500, 0.1);
    CHECK_STAYS(&soup, "mesh: not flat");
}

TEST(wedge_narrower_than_the_tolerance_stays_a_mesh) {
    shape s = flat_fan(3, 0.02, 0.02);
    s.index_count = 3;
    shape_set(&s, 3, 0.0, 0.0, 0.0);
    shape_set(&s, 0, 0.05, 0.0, 0.0);
    shape_set(&s, 1, 0.05, 2e-7, 0.0);
    CHECK_STAYS(&s, "mesh: its outline is smaller than a plane's tolerance");
}

TEST(mesh_without_any_area_stays_one) {
    shape s = DRAWING("#");
    memset(s.positions, 0, s.vertex_count * 3 * sizeof(float));
    CHECK_STAYS(&s, "mesh: no triangle has an area");
}

TEST(overlapping_triangles_stay_a_mesh) {
    shape twice = DRAWING("###", "###"); /* a third triangle on an edge, above another */
    flat_add(&twice, 0, 1, 11);
    CHECK_STAYS(&twice, "mesh: its triangles overlap");

    shape thrice = DRAWING("###", "###"); /* the same between two others */
    flat_add(&thrice, 0, 5, 8);
    CHECK_STAYS(&thrice, "mesh: its triangles overlap");

    shape upon = DRAWING("#####.", "#####.", "#####.", "......"); /* an island within the sheet, on no edge of it */
    const uint32_t corners[3] = {4 * 7 - 1 - 7, 4 * 7 - 1, 5 * 7 - 1};
    shape_set(&upon, corners[0], 1.3 * CELL, 1.4 * CELL, 0.0);
    shape_set(&upon, corners[1], 3.3 * CELL, 1.4 * CELL, 0.0);
    shape_set(&upon, corners[2], 1.3 * CELL, 3.4 * CELL, 0.0);
    for (uint32_t k = 0; k < 3; k++) {
        upon.uvs[2 * corners[k]] = 8.0F * upon.positions[3 * corners[k]];
        upon.uvs[2 * corners[k] + 1] = 8.0F * upon.positions[3 * corners[k] + 1];
    }
    flat_add(&upon, corners[0], corners[1], corners[2]);
    CHECK_STAYS(&upon, "mesh: its triangles overlap");

    shape across = DRAWING("#..", "#..", "#.."); /* a strip, and another across it, off the middles of both */
    const double bar[4][2] = {{-1.0, 2.25}, {6.0, 2.25}, {6.0, 2.75}, {-1.0, 2.75}};
    const uint32_t free_ones[4] = {2, 3, 6, 7};
    for (uint32_t k = 0; k < 4; k++) {
        shape_set(&across, free_ones[k], bar[k][0] * CELL, bar[k][1] * CELL, 0.0);
        across.uvs[2 * free_ones[k]] = (float)(8.0 * CELL * bar[k][0]);
        across.uvs[2 * free_ones[k] + 1] = (float)(8.0 * CELL * bar[k][1]);
    }
    flat_add(&across, 2, 3, 6);
    flat_add(&across, 2, 6, 7);
    CHECK_STAYS(&across, "mesh: its triangles overlap");
}

/* A strip whose upper side is bowed by `bow` m: more corners than an outline may have, most of them next to a straight
 * line. The remaining ones are within the stated distance of all. */
static void check_bowed(double bow) {
    SCOPED_SHAPE s = shape_sheet(200, 1, (const double[2]){0.05, 0.01}, NULL);
    for (uint32_t v = 201; v < 402; v++) {
        const double x = (double)s.positions[3 * v];
        s.positions[3 * v + 1] += (float)(bow * (1.0 - x * x / 0.0025));
        s.uvs[2 * v + 1] = 50.0F * s.positions[3 * v + 1] + 0.5F;
    }
    outcome o = decide(&s);
    assert_non_null(o.plane);
    assert_in_range(o.plane->edge_count, 7, 20);
    assert_true(o.plane->facts.error > 1e-8 && o.plane->facts.error < 1e-6);
    for (uint32_t v = 201; v < 402; v++) {
        double p[3];
        shape_get(&s, v, p);
        add3(p, -1.0, o.position, p);
        const double turned[2] = {p[0] * o.rotation[0] + p[1] * o.rotation[3],
                                  p[0] * o.rotation[1] + p[1] * o.rotation[4]};
        assert_true(flat_to_outline(o.plane, turned) <= 1.0001 * o.plane->facts.error);
    }
    forget(&o);
}

TEST(corners_next_to_a_straight_line_are_left_out_and_told) {
    check_bowed(3e-5);
    check_bowed(-3e-5);
}

/* Two of four corners are neighbours within a tiny distance: the shape is almost a triangle, not a rectangle. */
TEST(triangle_with_a_corner_cut_off_is_no_rectangle) {
    SCOPED_SHAPE s = shape_new(4, 6, 1);
    const double places[4][2] = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5 - 0.9e-6}, {0.5 - 0.9e-6, 0.5}};
    for (uint32_t v = 0; v < 4; v++) {
        shape_set(&s, v, places[v][0], places[v][1], 0.0);
        s.uvs[2 * v] = (float)places[v][0];
        s.uvs[2 * v + 1] = (float)places[v][1];
    }
    (void)shape_quad(&s, 0, 0, 1, 2, 3);
    outcome o = decide(&s);
    double length;
    assert_non_null(o.plane);
    assert_in_range(o.plane->edge_count, 3, 4);
    CHECK_CLOSE(flat_area(o.plane, &length), 0.125, 1e-6);
    assert_false(knurl_plane_covers(o.plane, (const double[2]){-0.2, 0.2}));
    forget(&o);
}

/* A ring cut open whose turns overlap: every edge has at most one neighbour, and the area of the triangles
 * equals the signed area of the outline. */
TEST(spiral_that_passes_over_itself_stays_a_mesh) {
    const uint32_t steps = 30; /* of 24 that make a turn */
    shape s = shape_new(2 * (steps + 1), 6 * steps, 1);
    uint32_t at = 0;
    for (uint32_t i = 0; i <= steps; i++) {
        for (uint32_t k = 0; k < 2; k++) {
            const double angle = 2.0 * PI * i / 24.0;
            const double radius = 0.03 + 0.02 * k + 0.0004 * i; /* 0.0096 a turn: narrower than the band */
            const uint32_t v = 2 * i + k;
            shape_set(&s, v, radius * cos(angle), radius * sin(angle), 0.0);
            s.uvs[2 * v] = s.positions[3 * v];
            s.uvs[2 * v + 1] = s.positions[3 * v + 1];
        }
        at = i < steps ? shape_quad(&s, at, 2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) : at;
    }
    CHECK_STAYS(&s, "mesh: its triangles overlap");
}

/* Memory of which the n-th request is refused. */
static int requests;
static int refused;

static void *take(size_t size, size_t alignment, void *user) {
    (void)user;
    (void)alignment;
    return ++requests == refused ? NULL : malloc(size);
}

static void give_back(void *memory, size_t size, void *user) {
    (void)size;
    (void)user;
    free(memory);
}

TEST(refused_memory_leaves_nothing_behind) {
    SCOPED_SHAPE s = DRAWING("#####", "#...#", "#...#", "#####");
    const knurl_mesh_desc desc = shape_desc(&s);
    const knurl_allocator allocator = {take, give_back, NULL};
    knurl_plane *plane = NULL;
    double position[3] = {1.0, 2.0, 3.0};
    double rotation[9] = {4.0};
    const char *why = "untouched";
    knurl_heap heap;
    knurl_result result = KNURL_ERROR_MEMORY;
    knurl_heap_init(&heap, &allocator);
    for (refused = 1; result == KNURL_ERROR_MEMORY; refused++) {
        requests = 0;
        result = knurl_plane_from_mesh(&heap, &desc, NULL, &plane, position, rotation, &why);
        if (result) {
            assert_int_equal(result, KNURL_ERROR_MEMORY);
            assert_int_equal(heap.bytes, 0);
            assert_null(plane);
            assert_string_equal(why, "untouched");
            assert_true(position[2] == 3.0 && rotation[0] == 4.0);
        }
    }
    assert_int_equal(result, KNURL_OK);
    assert_in_range(refused, 8, 40);
    knurl_plane_destroy(&heap, plane);
    assert_int_equal(heap.bytes, 0);
}
