/* Edits before the commit and after it: the next tick, stale ids, errors.
 * SPDX-License-Identifier: MIT */
#include "edits.h"
#include "scene/ask.h"

TEST(every_edit_works_before_the_commit_and_after_it) {
    for (int committed = 0; committed < 2; committed++) {
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = open_scene(committed);
        const knurl_surface_id kept = add_surface(scene, &parts);
        const knurl_surface_id removed = add_surface(scene, &parts);
        parts.desc.position[0] = 1.0;
        const knurl_surface_id other = add_surface(scene, &parts);
        set_stiffness(scene, kept, 800.0);
        set_place(scene, kept, 0.0, 0.0, 0.002);
        assert_int_equal(knurl_scene_remove_surface(scene, removed), KNURL_OK);
        if (!committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        assert_int_equal(knurl_scene_get_surface_count(scene), 2);
        assert_true(knurl_scene_get_surface(scene, 0) == kept && knurl_scene_get_surface(scene, 1) == other);
        knurl_tick_output out = press(scene, 0.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, 800.0 * 0.003, TOL);
        assert_true(out.surface == kept);
        assert_int_equal(out.contacts, 1);
        out = press(scene, 1.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
        assert_true(out.surface == other);
    }
}

TEST(of_several_edits_the_newest_wins) {
    for (int committed = 0; committed < 2; committed++) {
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = open_scene(committed);
        const knurl_surface_id id = add_surface(scene, &parts);
        for (int i = 0; i <= 50; i++) {
            set_stiffness(scene, id, 100.0 + 10.0 * i);
            set_place(scene, id, 0.0, 0.0, 1e-4 * i);
        }
        if (!committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        const knurl_tick_output out = press(scene, 0.0, 0.0);
        CHECK_VECTOR(out.force, 0.0, 0.0, 600.0 * 0.005, TOL);
    }
}

TEST(material_and_place_do_not_undo_each_other) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = open_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    set_place(scene, id, 0.0, 0.0, 0.004);
    set_stiffness(scene, id, 500.0);
    CHECK_CLOSE(press(scene, 0.0, 0.003).force[2], 0.5, TOL);
    const double target[3] = {0.0, 0.0, 0.006};
    assert_int_equal(knurl_scene_set_transform(scene, id, target, UPRIGHT, 0.01), KNURL_OK); /* 10 ticks */
    for (int k = 1; k <= 20; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.003);
        const double depth = 0.001 + 0.0002 * (k < 10 ? k : 10);
        CHECK_CLOSE(out.force[2], (k <= 5 ? 500.0 : 250.0) * depth, TOL);
        if (k == 5) {
            set_stiffness(scene, id, 250.0); /* meanwhile */
        }
    }
}

TEST(ids_stay_stale_for_ever) {
    enum { TURNS = 5000 };
    static knurl_surface_id ids[TURNS];
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = open_scene(1);
    const knurl_surface_id kept = add_surface(scene, &parts);
    char name[KNURL_NAME_SIZE] = "untouched";
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    for (int i = 0; i < TURNS; i++) {
        ids[i] = add_surface(scene, &parts);
        assert_int_equal(knurl_scene_remove_surface(scene, ids[i]), KNURL_OK);
    }
    const knurl_surface_id last = add_surface(scene, &parts);
    for (int i = 0; i < TURNS; i += i < 20 ? 1 : 97) {
        const double position[3] = {0.0, 0.0, 0.0};
        assert_true(ids[i] != last && ids[i] != kept);
        CHECK_REFUSED(knurl_scene_remove_surface(scene, ids[i]), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_set_material(scene, ids[i], &parts.material), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_set_transform(scene, ids[i], position, UPRIGHT, 0.0), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_get_surface_name(scene, ids[i], name), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_get_surface_info(scene, ids[i], &info), KNURL_ERROR_STALE_ID, info);
    }
    assert_int_equal(knurl_scene_get_surface_count(scene), 2);
    assert_int_equal(knurl_scene_remove_surface(scene, last), KNURL_OK);
    assert_int_equal(knurl_scene_remove_surface(scene, kept), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_count(scene), 0);
}

/* A HIP stays near a place whose surface goes and another comes, both never edited: it feels the new one's ridges. */
TEST(another_surface_in_the_same_place_has_its_own_ridges) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 1e-4);
    SCOPED_SCENE *scene = scene_of(&parts);
    knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    (void)tick_at(scene, 0.0, 0.0, 0.001);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).height, 1e-4, 1e-15);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    set_grating(&parts, KNURL_METHOD_S1, 50.0, 0.0, 2e-4);
    assert_int_equal(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.001);
    CHECK_CLOSE(tick_at(scene, 0.004, 0.0, -0.001).height, 2e-4, 1e-15); /* in a trough of the first one's */
}

TEST(committed_scene_is_full_at_its_capacity_and_has_room_after_a_removal) {
    surface_parts parts = surface_plane();
    knurl_scene_desc desc;
    SCOPED_SCENE *scene = NULL;
    knurl_surface_id ids[6];
    knurl_surface_id id = 77;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 6;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    (void)commit_plainly(scene);
    for (int i = 0; i < 6; i++) {
        ids[i] = add_surface(scene, &parts);
    }
    for (int turn = 0; turn < 100; turn++) {
        CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_ERROR_FULL, id);
        check_message("max_surfaces");
        if (turn % 3 == 0) {
            (void)press(scene, 0.0, -0.001); /* some of them touched */
        }
        assert_int_equal(knurl_scene_remove_surface(scene, ids[turn % 6]), KNURL_OK);
        ids[turn % 6] = add_surface(scene, &parts); /* at once, whether or not a tick came between */
    }
}

/* --- errors --- */

static void check_still_pressed(knurl_scene *scene, knurl_surface_id id) {
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
    assert_true(out.surface == id);
    assert_int_equal(knurl_scene_get_surface_count(scene), 1);
}

TEST(transforms_out_of_range_are_refused_by_name_and_change_nothing) {
    static const struct {
        double position[3];
        double rotation[4];
        double seconds;
        const char *word;
    } cases[] = {
        {{(double)NAN, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, 0.1, "position"},
        {{0.0, 0.0, (double)INFINITY}, {0.0, 0.0, 0.0, 1.0}, 0.0, "position"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 0.0}, 0.1, "rotation"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.1}, 0.1, "rotation"},
        {{0.0, 0.0, 0.1}, {0.0, (double)NAN, 0.0, 1.0}, 0.1, "rotation"},
        {{0.0, 0.0, 0.1}, {(double)INFINITY, 0.0, 0.0, 1.0}, 0.0, "rotation"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.0}, -1e-9, "seconds"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.0}, 10.001, "seconds"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.0}, (double)NAN, "seconds"},
        {{0.0, 0.0, 0.1}, {0.0, 0.0, 0.0, 1.0}, (double)INFINITY, "seconds"},
    };
    knurl_surface_id id;
    SCOPED_SCENE *scene = pressed_scene(&id);
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        CHECK_REFUSED(knurl_scene_set_transform(scene, id, cases[i].position, cases[i].rotation, cases[i].seconds),
                      KNURL_ERROR_ARGUMENT, id);
        check_message(cases[i].word);
        check_still_pressed(scene, id);
    }
    static const knurl_surface_id unknown[] = {0, UINT64_MAX, 2, UINT64_C(1) << 32};
    const double elsewhere[3] = {0.0, 0.0, 0.1};
    for (size_t i = 0; i < COUNT_OF(unknown); i++) {
        CHECK_REFUSED(knurl_scene_set_transform(scene, unknown[i], elsewhere, UPRIGHT, 0.1), KNURL_ERROR_STALE_ID, id);
        check_still_pressed(scene, id);
    }
}

/* Accepted or refused: in both cases the force stays finite. */
TEST(transforms_to_far_off_leave_the_force_finite) {
    static const double far_off[] = {1e9, 1.001e9, 1e300};
    for (size_t i = 0; i < COUNT_OF(far_off); i++) {
        knurl_surface_id id;
        SCOPED_SCENE *scene = pressed_scene(&id);
        const double there[3] = {far_off[i], -far_off[i], 0.0};
        const double back[3] = {-far_off[i], far_off[i], 0.0};
        const double home[3] = {0.0, 0.0, 0.0};
        (void)knurl_scene_set_transform(scene, id, there, UPRIGHT, 0.01);
        for (int k = 0; k < 30; k++) {
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
            assert_true(isfinite(length3(out.force)) && length3(out.force) <= K * 0.0011);
            if (k == 15) {
                (void)knurl_scene_set_transform(scene, id, back, UPRIGHT, 0.005);
            }
        }
        assert_int_equal(knurl_scene_set_transform(scene, id, home, UPRIGHT, 0.0), KNURL_OK);
        (void)press(scene, 0.0, 0.001);
        check_still_pressed(scene, id);
    }
}

TEST(materials_out_of_range_are_refused_after_the_commit_and_change_nothing) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = pressed_scene(&id);
    for (int i = 0; i < 6; i++) {
        knurl_material_desc bad;
        knurl_material_desc_init(&bad, sizeof bad);
        bad.stiffness = i == 0 ? 0.0 : i == 1 ? (double)NAN : 900.0;
        bad.damping = i == 2 ? -1.0 : 0.0;
        bad.friction = i == 3 ? -0.1 : i == 4 ? (double)INFINITY : 0.0;
        bad.amplitude = i == 5 ? (double)NAN : 0.0;
        CHECK_REFUSED(knurl_scene_set_material(scene, id, &bad), KNURL_ERROR_ARGUMENT, bad);
        check_message(i < 2 ? "stiffness" : i == 2 ? "damping" : i < 5 ? "friction" : "amplitude");
        check_still_pressed(scene, id);
    }
    knurl_material_desc unknown;
    knurl_material_desc_init(&unknown, sizeof unknown);
    unknown.method = 1000;
    CHECK_REFUSED(knurl_scene_set_material(scene, id, &unknown), KNURL_ERROR_UNKNOWN, unknown);
    check_still_pressed(scene, id);
}

TEST(surface_refused_after_the_commit_changes_nothing) {
    surface_parts bad = surface_plane();
    knurl_surface_id id;
    SCOPED_SCENE *scene = pressed_scene(&id);
    knurl_surface_id made = 77;
    bad.desc.position[2] = 0.001;
    bad.material.stiffness = -1.0;
    CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(&bad), &made), KNURL_ERROR_ARGUMENT, made);
    check_still_pressed(scene, id);
    bad.material.stiffness = 400.0;
    bad.desc.rotation[3] = 0.0;
    CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(&bad), &made), KNURL_ERROR_ARGUMENT, made);
    check_still_pressed(scene, id);
    CHECK_REFUSED(knurl_scene_commit(scene), KNURL_ERROR_STATE, made);
}
