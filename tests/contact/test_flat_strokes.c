/* Strokes over flat meshes as planes and as meshes: the same contacts, within float rounding.
 * SPDX-License-Identifier: MIT */
#include "contact/plane_hold.h"
#include "support/flat.h"

/* A mesh both ways. */
typedef struct pair {
    probe mesh;
    probe plane;
    knurl_plane *made;
    const double *axis;
    double position[3];
    double rotation[9];
    double tolerance; /* m: 1e-7 and the flatness */
} pair;

static pair pair_of(const knurl_mesh_desc *desc, const double *axis) {
    pair p;
    const char *why = NULL;
    memset(&p, 0, sizeof p);
    knurl_heap_init(&p.mesh.heap, NULL);
    knurl_heap_init(&p.plane.heap, NULL);
    p.axis = axis;
    assert_int_equal(knurl_plane_from_mesh(&p.plane.heap, desc, axis, &p.made, p.position, p.rotation, &why), KNURL_OK);
    assert_int_equal(knurl_mesh_create(&p.mesh.heap, desc, &p.mesh.mesh), KNURL_OK);
    if (!p.made) {
        fail_msg("%s", why);
        return p;
    }
    p.plane.plane = *p.made;
    p.tolerance = 1e-7 + p.made->facts.error;
    return p;
}

static void pair_free(pair *p) {
    knurl_plane_destroy(&p->plane.heap, p->made);
    assert_int_equal(p->plane.heap.bytes, 0);
    probe_free(&p->mesh);
}

static void to_mesh(const pair *p, const double from[3], int is_point, double out[3]) {
    mat3_mul(p->rotation, from, out);
    add3(out, is_point ? 1.0 : 0.0, p->position, out);
}

/* The same proxy, normal, depth, x direction and coordinates. */
static void check_same(const pair *p) {
    const knurl_contact *flat = &p->plane.contact;
    const knurl_contact *c = &p->mesh.contact;
    double proxy[3];
    double normal[3];
    double x[3];
    double y[3];
    double mesh_x[3];
    double coordinates[2];
    double mesh_coordinates[2];
    to_mesh(p, flat->proxy, 1, proxy);
    to_mesh(p, flat->normal, 0, normal);
    knurl_plane_axes(&p->plane.plane, flat, x, y);
    knurl_plane_coordinates(&p->plane.plane, flat, coordinates);
    to_mesh(p, x, 0, x);
    flat_mesh_frame(p->mesh.mesh, p->axis, c, mesh_x, mesh_coordinates);
    CHECK_CLOSE(distance3(proxy, c->proxy), 0.0, p->tolerance);
    CHECK_CLOSE(flat->z, c->z, p->tolerance);
    CHECK_CLOSE(distance3(normal, c->normal), 0.0, p->made->facts.error > 1e-9 ? 2e-4 : 1e-7);
    CHECK_CLOSE(distance3(x, mesh_x), 0.0, p->made->facts.error > 1e-9 ? 1e-4 : 1e-7);
    /* a mesh's y turns with each triangle's own normal: by an axis, on the lever of the distance from its origin */
    const double turned = distance3(x, mesh_x) + distance3(normal, c->normal);
    const double lever = p->axis ? length3(c->proxy) * turned : 0.0;
    for (int i = 0; i < 2 && p->made->has_coordinates; i++) {
        CHECK_CLOSE(coordinates[i], mesh_coordinates[i], p->tolerance + lever);
    }
}

/* 1 if rounding may decide: the HIP, or its crossing of the plane, is on the outline, or it is in the plane.
 */
static int is_close_call(const pair *p, const double from[3], const double to[3]) {
    double through[3];
    const double reach = p->plane.query.reach;
    add3(to, -1.0, from, through);
    add3(from, from[2] != to[2] ? from[2] / (from[2] - to[2]) : 0.0, through, through);
    return fabs(to[2]) < 2.0 * p->tolerance || fabs(fabs(to[2]) - reach) < 2.0 * p->tolerance ||
           flat_to_outline(&p->plane.plane, to) < 1e-6 ||
           (from[2] * to[2] < 0.0 && flat_to_outline(&p->plane.plane, through) < 1e-6);
}

/* A walk of steps up to `step` m, four times as long sideways, that presses in, lifts off, and runs over edges, holes
 * and corners. */
static void check_strokes(pair *p, double reach, int double_sided, double step, uint64_t seed) {
    const double *half = p->plane.plane.half_extents;
    const double range[3] = {1.2 * half[0], 1.2 * half[1], 0.002};
    double hip[3] = {0.0, 0.0, 0.0015};
    int held_ticks = 0;
    int over_edges = 0;
    p->mesh.query.reach = p->plane.query.reach = reach;
    p->mesh.query.double_sided = p->plane.query.double_sided = double_sided;
    probe_forget(&p->mesh);
    probe_forget(&p->plane);
    for (int k = 0; k < 20000; k++) {
        double next[3];
        double mesh_hip[3];
        do {
            for (int axis = 0; axis < 3; axis++) {
                next[axis] = hip[axis] + random_between(&seed, -step, step) * (axis == 2 ? 1.0 : 4.0);
                next[axis] = fabs(next[axis]) <= range[axis] ? next[axis] : hip[axis];
            }
        } while (is_close_call(p, hip, next));
        memcpy(hip, next, sizeof hip);
        to_mesh(p, hip, 1, mesh_hip);
        const int inside = p->plane.state.inside;
        const int held = probe_at(&p->plane, hip);
        if (probe_at(&p->mesh, mesh_hip) != held) {
            fail_msg("tick %d at (%g, %g, %g): plane %d", k, hip[0], hip[1], hip[2], held);
        }
        over_edges += inside && !held && hip[2] < 0.0;
        held_ticks += held;
        if (held) {
            check_same(p);
        }
    }
    assert_in_range(held_ticks, 100, 19000);
    assert_in_range(over_edges, 10, 4000);
}

static void check_all_strokes(const knurl_mesh_desc *desc, const double *axis, uint64_t seed) {
    pair p = pair_of(desc, axis);
    check_strokes(&p, 0.0, 0, 0.0005, seed);
    check_strokes(&p, 0.0005, 0, 0.0007, seed + 1);
    check_strokes(&p, 0.0, 1, 0.0007, seed + 2);
    check_strokes(&p, 0.0005, 1, 0.001, seed + 3);
    pair_free(&p);
}

/* A comb, a ring, concave corners, islands and a corner that touches. */
static shape drawn(void) {
    return DRAWING("##########", "#...#..#.#", "#...#..#.#", "#####....#", "..........", "##..##..##", "#####....#");
}

TEST(drawn_sheet_by_its_uvs_is_felt_as_its_mesh) {
    SCOPED_SHAPE s = drawn();
    const knurl_mesh_desc desc = shape_desc(&s);
    check_all_strokes(&desc, NULL, 10);
}

TEST(star_is_felt_as_its_mesh) {
    SCOPED_SHAPE s = flat_fan(10, 0.03, 0.012);
    const knurl_mesh_desc desc = shape_desc(&s);
    check_all_strokes(&desc, NULL, 20);
}

TEST(disc_of_64_edges_is_felt_as_its_mesh) {
    SCOPED_SHAPE s = flat_fan(64, 0.03, 0.03);
    const knurl_mesh_desc desc = shape_desc(&s);
    check_all_strokes(&desc, NULL, 30);
}

TEST(sheet_by_an_axis_is_felt_as_its_mesh) {
    const double axis[3] = {0.48, -0.6, 0.64};
    SCOPED_SHAPE s = drawn();
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        s.positions[3 * v + 2] = -0.125F;
    }
    const knurl_mesh_desc desc = shape_desc(&s);
    check_all_strokes(&desc, axis, 40);
}

/* u and v as any affine map; a determinant below 0 mirrors them. */
static void map_uvs(shape *s, const double map[2][3]) {
    for (uint32_t v = 0; v < s->vertex_count; v++) {
        double p[3];
        shape_get(s, v, p);
        for (int i = 0; i < 2; i++) {
            s->uvs[2 * v + (uint32_t)i] = (float)(map[i][0] * p[0] + map[i][1] * p[1] + map[i][2]);
        }
    }
}

TEST(turned_sheared_and_mirrored_uvs_are_felt_as_on_the_mesh) {
    static const double maps[4][2][3] = {{{8.0, 0.0, 0.5}, {0.0, -8.0, 1.0}}, /* glTF's v runs down the image */
                                         {{-8.0, 0.0, 0.5}, {0.0, 8.0, 0.25}},
                                         {{3.0, 4.0, 0.0}, {-8.0, 6.0, 0.0}},
                                         {{3.0, 4.0, 0.125}, {4.0, 1.0, -0.5}}};
    for (uint64_t i = 0; i < 4; i++) {
        SCOPED_SHAPE s = drawn();
        map_uvs(&s, maps[i]);
        const knurl_mesh_desc desc = shape_desc(&s);
        check_all_strokes(&desc, NULL, 50 + 10 * i);
    }
}

TEST(tangents_are_felt_as_on_the_mesh_with_uvs_and_without) {
    SCOPED_SHAPE s = drawn();
    float *tangents = calloc(s.vertex_count, 4 * sizeof(float));
    assert_non_null(tangents);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        const float length = 0.5F + 0.25F * (float)(v % 3); /* only their direction counts */
        tangents[4 * v] = -0.6F * length;
        tangents[4 * v + 1] = 0.8F * length;
        tangents[4 * v + 2] = 0.25F * (float)(v % 2);
    }
    knurl_mesh_desc desc = shape_desc(&s);
    desc.tangents = tangents;
    check_all_strokes(&desc, NULL, 90);
    desc.uvs = NULL;
    check_all_strokes(&desc, NULL, 100);
    free(tangents);
}

TEST(turned_sheet_far_from_the_origin_is_felt_as_its_mesh) {
    const double turned[4] = {0.1, -0.3, 0.5, sqrt(1.0 - 0.35)};
    static const double offsets[2][3] = {{0.01, 0.02, -0.03}, {1.5, -2.5, 0.75}};
    for (uint64_t i = 0; i < 2; i++) {
        SCOPED_SHAPE s = drawn();
        flat_move(&s, turned, offsets[i]);
        const knurl_mesh_desc desc = shape_desc(&s);
        const double axis[3] = {0.48, -0.6, 0.64};
        pair p = pair_of(&desc, axis);
        assert_true(p.made->facts.error > 1e-10);
        assert_int_equal(p.made->edge_count, 32);
        pair_free(&p);
        check_all_strokes(&desc, axis, 110 + 10 * i);
    }
}

TEST(turned_sheet_by_its_uvs_is_felt_as_its_mesh) {
    const double turned[4] = {0.1, -0.3, 0.5, sqrt(1.0 - 0.35)};
    SCOPED_SHAPE s = drawn();
    flat_move(&s, turned, (const double[3]){0.02, 0.0, -0.01});
    const knurl_mesh_desc desc = shape_desc(&s);
    check_all_strokes(&desc, NULL, 140);
}

/* Bricks, whose joints are not in line: a plane does not know of them. */
TEST(sheet_with_t_junctions_is_felt_as_its_mesh) {
    static const uint32_t cuts[] = {1, 2, 3, 7};
    SCOPED_SHAPE s = shape_new(52, 78, 1);
    uint32_t v = 0;
    uint32_t at = 0;
    for (uint32_t j = 0; j < COUNT_OF(cuts); j++) {
        for (uint32_t i = 0; i < cuts[j]; i++) {
            for (uint32_t k = 0; k < 4; k++) {
                shape_set(&s, v + k, 0.0625 * (i + (k == 1 || k == 2)) / cuts[j], 0.0078125 * (j + (k >= 2)), 0.0);
            }
            at = shape_quad(&s, at, v, v + 1, v + 2, v + 3);
            v += 4;
        }
    }
    map_uvs(&s, (const double[2][3]){{8.0, 0.0, 0.0}, {0.0, 8.0, 0.0}});
    const knurl_mesh_desc desc = shape_desc(&s);
    pair p = pair_of(&desc, NULL);
    assert_int_equal(p.made->edge_count, 0);
    pair_free(&p);
    check_all_strokes(&desc, NULL, 150);
}

/* The whole lattice of the corners, and halves of it: rays run through corners and along edges. */
TEST(points_in_line_with_corners_are_counted_once) {
    SCOPED_SHAPE s = drawn();
    const knurl_mesh_desc desc = shape_desc(&s);
    pair p = pair_of(&desc, NULL);
    static const char *const rows[] = {"##########", "#...#..#.#", "#...#..#.#", "#####....#",
                                       "..........", "##..##..##", "#####....#"};
    for (int j = 0; j < 7; j++) {
        for (int i = 0; i < 10; i++) {
            for (int k = 0; k < 25; k++) {
                const double at[3] = {CELL * (i + 0.125 * (k % 5 + 2)), CELL * (j + 0.125 * (k / 5 + 2)), 0.0};
                const double in_plane[2] = {at[0] - p.position[0], at[1] - p.position[1]};
                assert_int_equal(knurl_plane_covers(p.made, in_plane), rows[6 - j][i] == '#');
            }
        }
    }
    for (int j = -1; j <= 8; j++) { /* level with corners, in the middle between them, beside the sheet */
        for (int i = -1; i <= 10; i++) {
            const double in_plane[2] = {CELL * (i + 0.5) - p.position[0], CELL * j - p.position[1]};
            const int above = i >= 0 && i < 10 && j >= 0 && j < 7 && rows[6 - j][i] == '#';
            const int below = i >= 0 && i < 10 && j >= 1 && j <= 7 && rows[7 - j][i] == '#';
            if (above == below) {
                assert_int_equal(knurl_plane_covers(p.made, in_plane), above);
            }
        }
    }
    pair_free(&p);
}
