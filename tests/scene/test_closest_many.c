/* The closest point among many surfaces: the search through the hierarchy, from an earlier answer and in a batch gives
 * the result of a test of every surface, bit for bit. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#define SURFACES 120
#define POINTS   400
#define TAG      (UINT64_C(0xfffff) << 21) /* the bits of an id that name the scene */

static double hills(double x, double y) {
    return 0.01 * sin(90.0 * x) * cos(70.0 * y);
}

typedef struct crowd {
    knurl_scene *scene;
    knurl_surface_id ids[SURFACES];
} crowd;

static void put_at(surface_parts *parts, const pose *at) {
    memcpy(parts->desc.position, at->position, sizeof at->position);
    memcpy(parts->desc.rotation, at->quaternion, sizeof at->quaternion);
}

/* Planes, hilly sheets and balls. Is_indexed: the scene is committed, and then a third of them are moved, some removed
 * and some added again; else the same surfaces are in the same order without any index. */
static crowd make_crowd(int is_indexed, const shape *sheet, const shape *ball) {
    uint64_t seed = 77;
    crowd c = {.scene = empty_scene(1)};
    surface_parts kinds[3] = {surface_plane(), surface_mesh(sheet), surface_mesh(ball)};
    pose at[SURFACES], later[SURFACES];
    for (int i = 0; i < SURFACES; i++) {
        at[i] = random_pose(&seed);
        later[i] = random_pose(&seed);
        kinds[i % 3].desc.axis[0] = 1.0;
        put_at(&kinds[i % 3], is_indexed || i % 3 != i / 3 % 3 ? &at[i] : &later[i]);
        c.ids[i] = add_surface(c.scene, &kinds[i % 3]);
    }
    if (is_indexed) {
        (void)commit_plainly(c.scene);
        for (int i = 0; i < SURFACES; i++) {
            if (i % 3 == i / 3 % 3) {
                assert_int_equal(knurl_scene_set_transform(c.scene, c.ids[i], later[i].position, later[i].quaternion,
                                                           i % 2 ? 0.01 : 0.0),
                                 KNURL_OK);
            }
        }
        for (int tick = 0; tick < 50; tick++) {
            (void)tick_at(c.scene, 0.0, 0.0, 5.0);
        }
    }
    for (int i = SURFACES - 1; i > SURFACES - 10; i--) { /* their places are used anew, the last one's first */
        assert_int_equal(knurl_scene_remove_surface(c.scene, c.ids[i]), KNURL_OK);
    }
    for (int i = SURFACES - 9; i < SURFACES; i++) {
        put_at(&kinds[i % 3], &later[i]);
        c.ids[i] = add_surface(c.scene, &kinds[i % 3]);
    }
    return c;
}

static knurl_surface_point find(const knurl_scene *scene, const double p[3], double radius,
                                const knurl_surface_point *hint) {
    knurl_surface_point point;
    knurl_surface_point_init(&point, sizeof point);
    point = hint ? *hint : point;
    assert_int_equal(knurl_scene_find_closest(scene, p, radius, &point), KNURL_OK);
    return point;
}

static void walk_on(uint64_t *seed, double p[3]) {
    for (int axis = 0; axis < 3; axis++) {
        p[axis] += random_between(seed, -0.005, 0.005);
    }
}

typedef struct fixture {
    shape sheet, ball;
    crowd indexed, plain;
    double points[POINTS][3];
} fixture;

static void set_up(fixture *f) {
    static const double half[2] = {0.05, 0.04};
    uint64_t seed = 5;
    f->sheet = shape_sheet(12, 9, half, hills);
    f->ball = shape_sphere(0.03, 2);
    f->indexed = make_crowd(1, &f->sheet, &f->ball);
    f->plain = make_crowd(0, &f->sheet, &f->ball);
    for (int i = 0; i < POINTS; i++) {
        memcpy(f->points[i], f->points[i > 0 ? i - 1 : 0], sizeof f->points[i]);
        walk_on(&seed, f->points[i]);
        if (i % 100 == 0) {
            const pose p = random_pose(&seed);
            memcpy(f->points[i], p.position, sizeof p.position);
        }
    }
}

static void tear_down(fixture *f) {
    knurl_scene_destroy(f->indexed.scene);
    knurl_scene_destroy(f->plain.scene);
    shape_free(&f->sheet);
    shape_free(&f->ball);
}

#define SCOPED_FIXTURE __attribute__((cleanup(tear_down))) fixture

TEST(a_scenes_index_gives_the_point_that_looking_at_every_surface_gives) {
    SCOPED_FIXTURE f = {0};
    set_up(&f);
    for (int i = 0; i < POINTS; i++) {
        knurl_surface_point with = find(f.indexed.scene, f.points[i], 10.0, NULL);
        knurl_surface_point without = find(f.plain.scene, f.points[i], 10.0, NULL);
        assert_true(with.surface != 0 && with.distance > 0.0);
        with.surface &= ~TAG;
        without.surface &= ~TAG;
        assert_memory_equal(&with, &without, sizeof with);
    }
}

TEST(a_search_that_begins_at_any_earlier_answer_finds_the_same) {
    SCOPED_FIXTURE f = {0};
    set_up(&f);
    const knurl_surface_point foreign = find(f.plain.scene, f.points[0], 10.0, NULL);
    knurl_surface_point stale = find(f.indexed.scene, f.points[0], 10.0, NULL), last = foreign;
    knurl_surface_point beyond = stale;
    stale.surface ^= UINT64_C(1) << 41; /* its generation: a surface that is gone */
    beyond.hint = UINT32_MAX;
    for (int i = 0; i < POINTS; i++) {
        const double *p = f.points[i];
        const double radius = i % 3 ? 10.0 : 0.02; /* also with nothing in reach */
        const knurl_surface_point alone = find(f.indexed.scene, p, radius, NULL);
        const knurl_surface_point hints[] = {last, foreign, stale, beyond};
        for (size_t k = 0; k < sizeof hints / sizeof *hints; k++) {
            const knurl_surface_point found = find(f.indexed.scene, p, radius, &hints[k]);
            assert_memory_equal(&found, &alone, sizeof found);
        }
        last = alone.surface ? alone : last;
    }
}

TEST(a_surface_in_motion_is_found_where_it_is_now) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    (void)add_surface(scene, &parts);
    parts.desc.position[2] = 0.3;
    const knurl_surface_id lift = add_surface(scene, &parts);
    (void)commit_plainly(scene);
    parts.desc.position[2] = 0.1;
    assert_int_equal(knurl_scene_set_transform(scene, lift, parts.desc.position, parts.desc.rotation, 0.1), KNURL_OK);
    for (int tick = 0; tick < 50; tick++) {
        (void)tick_at(scene, 0.0, 0.0, 5.0);
    }
    const double p[3] = {0.01, 0.01, 0.25};
    const knurl_surface_point found = find(scene, p, 1.0, NULL);
    assert_true(found.surface == lift);
    CHECK_CLOSE(found.position[2], 0.2, 0.005L); /* half way; the motion begins within some ticks */
}

TEST(a_batch_is_its_searches_one_after_another) {
    SCOPED_FIXTURE f = {0};
    set_up(&f);
    knurl_surface_point found[POINTS];
    for (int i = 0; i < POINTS; i++) {
        knurl_surface_point_init(&found[i], sizeof found[i]);
    }
    assert_int_equal(knurl_scene_find_closest_batch(f.indexed.scene, &f.points[0][0], POINTS, 0.05, found), KNURL_OK);
    for (int i = 0; i < POINTS; i++) {
        const knurl_surface_point alone = find(f.indexed.scene, f.points[i], 0.05, NULL);
        assert_memory_equal(&found[i], &alone, sizeof alone);
    }
}

TEST(a_batch_with_one_bad_position_changes_no_point) {
    double positions[2][3] = {{0.0, 0.0, 0.1}, {0.0, (double)NAN, 0.0}};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_surface_point found[2];
    for (int i = 0; i < 2; i++) {
        knurl_surface_point_init(&found[i], sizeof found[i]);
    }
    CHECK_REFUSED(knurl_scene_find_closest_batch(scene, &positions[0][0], 2, 1.0, found), KNURL_ERROR_ARGUMENT, found);
    assert_int_equal(knurl_scene_find_closest_batch(scene, &positions[0][0], 0, 1.0, found), KNURL_OK);
}

TEST(a_batch_with_one_bad_size_changes_no_point) {
    const double positions[2][3] = {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.2}};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_surface_point found[2];
    knurl_surface_point_init(&found[0], sizeof found[0]);
    memset(&found[1], 0, sizeof found[1]);
    CHECK_REFUSED(knurl_scene_find_closest_batch(scene, &positions[0][0], 2, 1.0, found), KNURL_ERROR_ARGUMENT, found);
}

/* Two tiles share an edge: whichever the search begins at, the point on it is the earlier tile's. */
TEST(of_surfaces_equally_near_it_is_the_one_at_the_lower_place) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id first = add_surface(scene, &parts);
    parts.desc.position[0] = 0.1;
    const knurl_surface_id second = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    const double between[3] = {0.05, 0.01, 0.02}, right[3] = {0.07, 0.01, 0.02};
    const knurl_surface_point on_second = find(scene, right, 1.0, NULL);
    assert_true(on_second.surface == second);
    assert_true(find(scene, between, 1.0, NULL).surface == first);
    assert_true(find(scene, between, 1.0, &on_second).surface == first);
}
