/* Meshes from a caller's arrays: what is dropped, joined and refused. SPDX-License-Identifier: MIT */
#include "hierarchy.h"

#include "contact/mesh_query.h"

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
    assert_int_equal(mesh->facts.dropped, 4);
    assert_int_equal(mesh->facts.reversed_twins, 0);
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
            SCOPED_PROBE p = probe_shape(&s);
            assert_int_equal(p.mesh->facts.dropped, !is_felt);
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
        if (!is_crowded) {
            shape_free(&crowd);
        }
        SCOPED_PROBE p = probe_of(is_crowded ? shape_join(&sheet, &crowd) : sheet);
        assert_int_equal(knurl_mesh_exceeds_visits(p.mesh, 0.001, 1000), is_crowded);
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
    assert_int_equal(two.mesh->facts.dropped, 40);
    assert_int_equal(two.mesh->facts.reversed_twins, 40);
    assert_int_equal(two.mesh->double_sided, 1);
    check_hierarchy(two.mesh);
    probe_free(&two);
    SCOPED_PROBE one = probe_shape(&sheet);
    assert_int_equal(one.mesh->facts.dropped + one.mesh->facts.reversed_twins, 0);
    assert_int_equal(one.mesh->double_sided, 0);
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
    SCOPED_PROBE p = probe_shape(&sheet);
    uint32_t rims = 0;
    assert_int_equal(p.mesh->vertex_count, 9); /* of 24 */
    for (size_t i = 0; i < 24; i++) {
        rims += p.mesh->opposite[i] == KNURL_BOUNDARY;
    }
    assert_int_equal(rims, 8); /* the outer edges only: inside, the sheet hangs together */
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
