/* Many surfaces: a HIP that tests only those near it gets the same forces as one that tests all of them, with any edits
 * in between. SPDX-License-Identifier: MIT */
#include "full_model.h"
#include "support/poses.h"

#define SIDE  100  /* tiles along each side */
#define PITCH 0.01 /* m from tile to tile */
#define K     400.0

static knurl_scene *many_scene(uint32_t full_model, uint32_t hips) {
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 2 * SIDE * SIDE;
    desc.hip_count = hips;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    set_full_model(scene, full_model);
    for (uint32_t i = 0; i < hips; i++) {
        configure_plainly(scene, i);
    }
    return scene;
}

static double bowl(double x, double y) {
    return 20.0 * (x * x + y * y);
}

/* A tile of its own kind: overlapping its neighbours, tilted, bowls of a few triangles among them. */
static surface_parts tile(uint64_t *seed, const shape *s, double x, double y) {
    const int64_t kind = random_integer(seed, 0, 9);
    surface_parts parts = kind < 3 ? surface_mesh(s) : surface_plane();
    pose p = {{x, y, random_between(seed, -0.0005, 0.0005)}, {0.0, 0.0, 0.0, 1.0}};
    double axis[3] = {0.0, 0.0, 1.0};
    if (kind % 2) {
        random_direction(seed, axis);
    }
    turn_about(axis, random_between(seed, -0.3, 0.3), p.quaternion);
    place(&parts, &p);
    parts.plane.half_extents[0] = random_between(seed, 0.004, 0.007);
    parts.plane.half_extents[1] = random_between(seed, 0.004, 0.007);
    parts.desc.axis[0] = 1.0;
    parts.desc.double_sided = kind == 5;
    parts.material.stiffness = random_between(seed, 100.0, 1000.0);
    parts.material.friction = kind == 7 ? 0.4 : 0.0;
    parts.material.damping = kind == 8 ? 0.5 : 0.0;
    if (kind % 3 == 0) {
        set_grating(&parts, kind == 6 ? KNURL_METHOD_S1 : KNURL_METHOD_S2, 500.0, 200.0,
                    random_between(seed, 0.0, 0.0008));
    }
    return parts;
}

static void lay_tiles(knurl_scene *scene, uint64_t seed, const shape *s) {
    for (int i = 0; i < SIDE * SIDE; i++) {
        surface_parts parts = tile(&seed, s, PITCH * (i % SIDE), PITCH * (double)(i / SIDE));
        (void)add_surface(scene, &parts);
    }
}

/* One edit of a scene, the same in each for the same numbers; near (x, y), or from far away to there. */
static void edit(knurl_scene *scene, uint64_t seed, const shape *s, double x, double y) {
    const uint32_t count = knurl_scene_get_surface_count(scene);
    const int64_t kind = random_integer(&seed, 0, 9);
    const knurl_surface_id any = knurl_scene_get_surface(scene, (uint32_t)random_integer(&seed, 0, count - 1));
    const int column = (int)fmin(SIDE - 1.0, fmax(0.0, x / PITCH));
    const int row = (int)fmin(SIDE - 1.0, fmax(0.0, y / PITCH));
    const uint32_t here = (uint32_t)(row * SIDE + column); /* close by, as long as few were taken out */
    const knurl_surface_id near = knurl_scene_get_surface(scene, here < count ? here : 0);
    surface_parts parts = tile(&seed, s, x + random_between(&seed, -0.1, 0.1), y + random_between(&seed, -0.1, 0.1));
    pose p;
    memcpy(p.position, parts.desc.position, sizeof p.position);
    memcpy(p.quaternion, parts.desc.rotation, sizeof p.quaternion);
    switch (kind) {
    case 0:
    case 1:
        (void)add_surface(scene, &parts);
        break;
    case 2:
        assert_int_equal(knurl_scene_remove_surface(scene, near), KNURL_OK);
        break;
    case 3:
        assert_int_equal(knurl_scene_remove_surface(scene, any), KNURL_OK);
        break;
    case 4:
        move_to(scene, any, &p, 0.0);
        break;
    case 5: /* it comes at up to 50 m/s */
        move_to(scene, any, &p, random_between(&seed, 0.02, 0.2));
        break;
    case 6:
        move_to(scene, near, &p, random_between(&seed, 0.0, 0.05));
        break;
    case 7: /* away */
        p.position[0] += 0.5;
        move_to(scene, near, &p, random_between(&seed, 0.0, 0.5));
        break;
    default: /* higher crests, too */
        parts.material.method = KNURL_METHOD_S2;
        assert_int_equal(knurl_scene_set_material(scene, near, &parts.material), KNURL_OK);
        break;
    }
}

/* A HIP that strokes, hovers, dives, and now and then is put down elsewhere (over the tiles, not through them: a path
 * that comes by hundreds in one tick is another test's). */
typedef struct wanderer {
    double at[3];
    double velocity[3];
    int leap; /* 2: lifted; 1: elsewhere */
} wanderer;

static void wander(wanderer *w, uint64_t *seed) {
    if (w->leap > 0 || random_integer(seed, 0, 900) == 0) {
        w->leap = w->leap > 0 ? w->leap - 1 : 2;
        w->at[0] = w->leap == 1 ? random_between(seed, 0.0, PITCH * SIDE) : w->at[0];
        w->at[1] = w->leap == 1 ? random_between(seed, 0.0, PITCH * SIDE) : w->at[1];
        w->at[2] = w->leap > 0 ? 0.03 : 0.006;
        return;
    }
    if (random_integer(seed, 0, 60) == 0) {
        const double speed = random_between(seed, 0.0, 1.0);
        const double heading = random_between(seed, -3.2, 3.2);
        w->velocity[0] = speed * cos(heading);
        w->velocity[1] = speed * sin(heading);
        w->velocity[2] = random_between(seed, -0.2, 0.2);
    }
    for (int i = 0; i < 3; i++) {
        const double low = i < 2 ? -0.02 : -0.004;
        const double high = i < 2 ? PITCH * SIDE : 0.006;
        w->at[i] += 0.001 * w->velocity[i];
        w->velocity[i] = w->at[i] < low || w->at[i] > high ? -w->velocity[i] : w->velocity[i];
        w->at[i] = fmax(low, fmin(high, w->at[i]));
    }
}

static void print_difference(int k, const knurl_tick_output *a, const knurl_tick_output *b) {
    print_error("tick %d: flags %u %u, contacts %u %u, surface %#llx %#llx, force %.9g %.9g %.9g, %.9g %.9g %.9g\n", k,
                (unsigned)a->flags, (unsigned)b->flags, (unsigned)a->contacts, (unsigned)b->contacts,
                (unsigned long long)a->surface, (unsigned long long)b->surface, a->force[0], a->force[1], a->force[2],
                b->force[0], b->force[1], b->force[2]);
}

/* Two scenes with different reductions, edited and stroked alike. Returns the ticks in contact. */
static int compare_models(uint32_t model, uint64_t seed, int ticks, int edit_every) {
    SCOPED_SHAPE s = shape_sheet(2, 2, (const double[2]){0.006, 0.005}, bowl);
    SCOPED_SCENE *reduced = many_scene(0, 1);
    SCOPED_SCENE *full = many_scene(model, 1);
    wanderer w = {{0.3, 0.4, 0.006}, {0.0, 0.0, -0.1}, 0};
    int touched = 0;
    lay_tiles(reduced, seed, &s);
    lay_tiles(full, seed, &s);
    assert_int_equal(knurl_scene_commit(reduced), KNURL_OK);
    assert_int_equal(knurl_scene_commit(full), KNURL_OK);
    for (int k = 0; k < ticks; k++) {
        if (edit_every > 0 && random_integer(&seed, 0, edit_every - 1) == 0) {
            const uint64_t which = random_bits(&seed);
            edit(reduced, which, &s, w.at[0], w.at[1]);
            edit(full, which, &s, w.at[0], w.at[1]);
        }
        wander(&w, &seed);
        const knurl_tick_output a = tick_moving(reduced, w.at, w.velocity);
        const knurl_tick_output b = tick_moving(full, w.at, w.velocity);
        if (a.flags != b.flags || a.contacts != b.contacts || distance3(a.force, b.force) > 0.0) {
            print_difference(k, &a, &b);
        }
        check_same_output(&a, &b);
        assert_true(isfinite(length3(a.force)) && a.contacts <= KNURL_CONTACTS_MAX);
        touched += a.contacts > 0;
    }
    return touched;
}

TEST(ten_thousand_tiles_feel_as_if_all_were_looked_at) {
    assert_true(compare_models(KNURL_FULL_SEARCH, 41, 3000, 0) > 500);
}

TEST(the_same_while_tiles_move_come_and_go) {
    for (uint64_t seed = 1; seed <= 3; seed++) {
        assert_true(compare_models(KNURL_FULL_SEARCH, seed, 1500, 1 + (int)(seed * seed)) > 50);
    }
}

TEST(smooth_surfaces_need_no_grating_stage) {
    assert_true(compare_models(KNURL_FULL_GRATING, 17, 3000, 7) > 300);
}

TEST(surfaces_far_off_are_never_felt) {
    uint64_t seed = 3;
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.006;
    SCOPED_SCENE *scene = many_scene(0, 1);
    for (int i = 0; i < SIDE * SIDE; i++) {
        parts.desc.position[0] = PITCH * (i % SIDE);
        parts.desc.position[1] = PITCH * (double)(i / SIDE);
        (void)add_surface(scene, &parts);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    wanderer w = {{0.3, 0.4, 0.003}, {0.0, 0.0, 0.0}, 0};
    for (int k = 0; k < 20000; k++) { /* 1 mm and more above all of them */
        wander(&w, &seed);
        const knurl_tick_output out = tick_at(scene, w.at[0], w.at[1], w.at[2] + 0.005);
        assert_int_equal(out.contacts, 0);
        assert_int_equal(out.flags, 0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
    }
}

/* 50 mm deep off a rim and back onto it within the 5 ms in which that is one contact, for any position of the last
 * query. */
TEST(a_hip_far_below_a_rim_is_held_again_as_if_all_were_looked_at) {
    static const double beside[3] = {1e-4, 2e-3, 2e-2}; /* m: how far off the rim */
    surface_parts parts = surface_plane();
    parts.plane.half_extents[0] = 0.04;
    for (int i = 0; i < 30; i++) {
        const double start = 0.04 - 1e-3 * (i / 3);
        const double way[5][2] = {
            {start, 1e-3}, {start, -0.05}, {0.0399, -0.05}, {0.04 + beside[i % 3], -0.05}, {0.0399, -0.05}};
        knurl_scene *reduced = many_scene(0, 1), *full = many_scene(KNURL_FULL_SEARCH, 1);
        (void)add_surface(reduced, &parts);
        (void)add_surface(full, &parts);
        assert_int_equal(knurl_scene_commit(reduced), KNURL_OK);
        assert_int_equal(knurl_scene_commit(full), KNURL_OK);
        for (size_t k = 0; k < COUNT_OF(way); k++) {
            const knurl_tick_output a = tick_at(reduced, way[k][0], 0.0, way[k][1]);
            const knurl_tick_output b = tick_at(full, way[k][0], 0.0, way[k][1]);
            check_same_output(&a, &b);
            assert_int_equal(a.contacts, k == 1 || k == 2 || k == 4);
        }
        knurl_scene_destroy(reduced);
        knurl_scene_destroy(full);
    }
}

/* --- crowds --- */

static knurl_scene *pile(uint32_t full_model, int count, double step) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = many_scene(full_model, 1);
    for (int i = 0; i < count; i++) {
        parts.desc.position[2] = step * i;
        (void)add_surface(scene, &parts);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

TEST(more_surfaces_in_one_place_than_a_hip_looks_at_are_flagged) {
    for (int full = 0; full < 2; full++) {
        SCOPED_SCENE *scene = pile(full ? KNURL_FULL_SEARCH : 0, 200, 0.0);
        uint32_t flags = 0;
        for (int k = 0; k <= 100; k++) {
            const double z = 0.005 - 1e-4 * k + 3e-5;
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, z);
            CHECK_CLOSE(out.force[2], z < 0.0 ? K * -z : 0.0, 1e-9L); /* the first that is met holds it */
            assert_int_equal(out.contacts, z < 0.0 ? 1 : 0);
            flags |= out.flags;
        }
        assert_int_equal(flags, KNURL_TICK_CONTACT | KNURL_TICK_CONTACTS_FULL);
        (void)tick_at(scene, 0.0, 0.0, 0.05);
        assert_int_equal(tick_at(scene, 0.0, 0.0, 0.05).flags, 0); /* far from them all is forgotten */
    }
}

/* From above, 1 mm into a floor at z = 0: the floor alone holds the HIP. */
static void press_on(knurl_scene *scene, knurl_surface_id floor_id) {
    (void)tick_at(scene, 0.0, 0.0, 0.005);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, 1e-12L);
    assert_true(out.surface == floor_id);
    assert_int_equal(out.flags, KNURL_TICK_CONTACT);
}

/* 60 were here and are gone, before a HIP came by or under it: they take no room among those near it. */
TEST(surfaces_taken_out_are_no_longer_near) {
    for (int committed = 0; committed < 2; committed++) {
        knurl_surface_id gone[60];
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = many_scene(0, 1);
        if (committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        for (int i = 0; i < 60; i++) {
            gone[i] = add_surface(scene, &parts);
        }
        const knurl_surface_id floor_id = add_surface(scene, &parts);
        if (!committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        for (int i = 0; i < 60; i++) {
            assert_int_equal(knurl_scene_remove_surface(scene, gone[i]), KNURL_OK);
        }
        press_on(scene, floor_id);
    }
}

/* 60 surfaces have passed here and are far away: the floor is still felt. */
TEST(surfaces_that_went_by_are_no_longer_near) {
    knurl_surface_id passers[60];
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = many_scene(0, 1);
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.01;
    for (int i = 0; i < 60; i++) {
        const pose start = {{-1.0, -0.3 + 0.01 * i, 0.02}, {0.0, 0.0, 0.0, 1.0}};
        place(&parts, &start);
        passers[i] = add_surface(scene, &parts);
    }
    surface_parts floor_parts = surface_plane();
    const knurl_surface_id floor_id = add_surface(scene, &floor_parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.1);
    for (int i = 0; i < 60; i++) {
        const pose end = {{1.0, 0.3 - 0.01 * i, -0.02}, {0.0, 0.0, 0.0, 1.0}};
        move_to(scene, passers[i], &end, 0.1);
    }
    for (int k = 0; k < 500; k++) {
        (void)tick_at(scene, 0.0, 0.0, 0.1);
    }
    for (int k = 0; k < 10; k++) {
        press_on(scene, floor_id);
    }
}

TEST(each_of_many_moved_surfaces_is_felt_where_it_went_next) {
    knurl_surface_id movers[40];
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = many_scene(0, 1);
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.01;
    for (int i = 0; i < 40; i++) {
        const pose start = {{0.03 * i, -1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
        place(&parts, &start);
        movers[i] = add_surface(scene, &parts);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int i = 0; i < 40; i++) {
        const pose first = {{0.03 * i, -1.1, 0.0}, {0.0, 0.0, 0.0, 1.0}};
        move_to(scene, movers[i], &first, 0.0);
    }
    for (int i = 0; i < 40; i++) {
        const pose next = {{-0.5, 0.05 * i, 0.0}, {0.0, 0.0, 0.0, 1.0}};
        move_to(scene, movers[i], &next, 0.0);
        (void)tick_at(scene, -0.5, 0.05 * i, 0.0005);
        const knurl_tick_output out = tick_at(scene, -0.5, 0.05 * i, -0.0005);
        assert_int_equal(out.surface, movers[i]);
    }
}

/* One tick across the whole scene comes by thousands; the next ones are ordinary again, and miss nothing. */
TEST(after_a_leap_across_everything_all_is_felt_again) {
    for (int full = 0; full < 2; full++) {
        uint64_t seed = 12;
        surface_parts parts = surface_plane();
        parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.5 * PITCH;
        SCOPED_SCENE *scene = many_scene(full ? KNURL_FULL_SEARCH : 0, 1);
        for (int i = 0; i < SIDE * SIDE; i++) {
            parts.desc.position[0] = PITCH * (i % SIDE);
            parts.desc.position[1] = PITCH * (double)(i / SIDE);
            (void)add_surface(scene, &parts);
        }
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        for (int leap = 0; leap < 20; leap++) {
            (void)tick_at(scene, 0.0, 0.0, -0.02);
            (void)tick_at(scene, 1.0, 1.0, 0.005); /* through them all */
            for (int k = 0; k < 5; k++) {
                const double x = PITCH * (double)random_integer(&seed, 0, SIDE - 1);
                const double y = PITCH * (double)random_integer(&seed, 0, SIDE - 1);
                (void)tick_at(scene, x, y, 0.005); /* above them, then down on the middle of one */
                const knurl_tick_output above = tick_at(scene, x, y, 0.001);
                const knurl_tick_output out = tick_at(scene, x, y, -0.001);
                assert_int_equal(above.flags, 0);
                CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, 1e-12L);
                assert_int_equal(out.flags, KNURL_TICK_CONTACT);
                (void)tick_at(scene, x, y, 0.005);
            }
        }
    }
}

/* 100 planes, 0.3 mm apart: whichever is on top is met first, however many are near. */
TEST(of_a_stack_the_topmost_is_met_first) {
    for (int full = 0; full < 2; full++) {
        SCOPED_SCENE *scene = pile(full ? KNURL_FULL_SEARCH : 0, 100, 0.0003);
        const double top = 0.0003 * 99;
        for (int k = 0; k <= 200; k++) {
            const double z = top + 0.005 - 4e-5 * k - 1e-5; /* 3 mm deep in the end */
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, z);
            const double depth = z < top ? top - z : 0.0;
            assert_int_equal(out.contacts, z < top);
            CHECK_CLOSE(out.force[2], K * depth, 1e-9L);
            CHECK_CLOSE(out.depth, depth, 1e-12L);
        }
    }
}

TEST(eight_hips_feel_each_what_one_alone_feels) {
    enum { HIPS = 8 };
    SCOPED_SHAPE s = shape_sheet(2, 2, (const double[2]){0.006, 0.005}, bowl);
    knurl_scene *together = many_scene(0, HIPS);
    wanderer w[HIPS];
    lay_tiles(together, 55, &s);
    assert_int_equal(knurl_scene_commit(together), KNURL_OK);
    static knurl_tick_output told[HIPS][600];
    for (uint32_t i = 0; i < HIPS; i++) {
        const wanderer start = {{0.1 * i, 0.5, 0.004}, {0.0, 0.0, -0.1}, 0};
        w[i] = start;
    }
    uint64_t seeds[HIPS];
    for (uint32_t i = 0; i < HIPS; i++) {
        seeds[i] = 100 + i;
    }
    for (int k = 0; k < 600; k++) {
        for (uint32_t i = 0; i < HIPS; i++) {
            knurl_tick_input input = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1, 0, 0.0, 0, {0}};
            wander(&w[i], &seeds[i]);
            memcpy(input.position, w[i].at, sizeof input.position);
            memcpy(input.velocity, w[i].velocity, sizeof input.velocity);
            assert_int_equal(knurl_scene_tick(together, i, &input, &told[i][k]), KNURL_OK);
        }
    }
    knurl_scene_destroy(together);
    for (uint32_t i = 0; i < HIPS; i += 3) {
        SCOPED_SCENE *alone = many_scene(0, 1);
        wanderer v = {{0.1 * i, 0.5, 0.004}, {0.0, 0.0, -0.1}, 0};
        uint64_t seed = 100 + i;
        lay_tiles(alone, 55, &s);
        assert_int_equal(knurl_scene_commit(alone), KNURL_OK);
        for (int k = 0; k < 600; k++) {
            wander(&v, &seed);
            const knurl_tick_output out = tick_moving(alone, v.at, v.velocity);
            check_same_output(&out, &told[i][k]);
        }
    }
}
