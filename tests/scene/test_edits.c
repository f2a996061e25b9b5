/* Edits before the commit and after it: what is felt at the next tick, which ids go stale, what is refused.
 * SPDX-License-Identifier: MIT */
#include "support/poses.h"

#include <stdio.h>

#define K   400.0 /* N/m, the default */
#define TOL 1e-9L

static const double UPRIGHT[4] = {0.0, 0.0, 0.0, 1.0};

static knurl_scene *open_scene(int committed) {
    knurl_scene *scene = empty_scene(1);
    configure_plainly(scene, 0);
    if (committed) {
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    }
    return scene;
}

static void set_stiffness(knurl_scene *scene, knurl_surface_id surface, double stiffness) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = stiffness;
    assert_int_equal(knurl_scene_set_material(scene, surface, &material), KNURL_OK);
}

static void set_place(knurl_scene *scene, knurl_surface_id surface, double x, double y, double z) {
    const double position[3] = {x, y, z};
    assert_int_equal(knurl_scene_set_transform(scene, surface, position, UPRIGHT, 0.0), KNURL_OK);
}

/* Presses HIP 0 from above to z at (x, 0): what a tick says then. */
static knurl_tick_output press(knurl_scene *scene, double x, double z) {
    (void)tick_at(scene, x, 0.0, 0.05);
    return tick_at(scene, x, 0.0, z);
}

TEST(every_edit_works_before_the_commit_and_after_it) {
    for (int committed = 0; committed < 2; committed++) {
        surface_parts parts = surface_plane();
        knurl_scene *scene = open_scene(committed);
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
        knurl_scene_destroy(scene);
    }
}

TEST(of_several_edits_the_newest_wins) {
    for (int committed = 0; committed < 2; committed++) {
        surface_parts parts = surface_plane();
        knurl_scene *scene = open_scene(committed);
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
        knurl_scene_destroy(scene);
    }
}

TEST(material_and_place_do_not_undo_each_other) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = open_scene(1);
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
            set_stiffness(scene, id, 250.0); /* on the way */
        }
    }
    knurl_scene_destroy(scene);
}

TEST(ids_stay_stale_for_ever) {
    enum { TURNS = 5000 };
    static knurl_surface_id ids[TURNS];
    surface_parts parts = surface_plane();
    knurl_scene *scene = open_scene(1);
    const knurl_surface_id kept = add_surface(scene, &parts);
    const char *name = "untouched";
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
        CHECK_REFUSED(knurl_scene_get_surface_name(scene, ids[i], &name), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_get_surface_info(scene, ids[i], &info), KNURL_ERROR_STALE_ID, info);
    }
    assert_int_equal(knurl_scene_get_surface_count(scene), 2);
    assert_int_equal(knurl_scene_remove_surface(scene, last), KNURL_OK);
    assert_int_equal(knurl_scene_remove_surface(scene, kept), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_count(scene), 0);
    knurl_scene_destroy(scene);
}

TEST(committed_scene_is_full_at_its_capacity_and_has_room_after_a_removal) {
    surface_parts parts = surface_plane();
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    knurl_surface_id ids[6];
    knurl_surface_id id = 77;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 6;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    configure_plainly(scene, 0);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
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
    knurl_scene_destroy(scene);
}

/* --- what is refused --- */

/* A scene whose one surface is pressed 1 mm deep. */
static knurl_scene *pressed_scene(knurl_surface_id *id) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = scene_of(&parts);
    *id = knurl_scene_get_surface(scene, 0);
    (void)press(scene, 0.0, -0.001);
    return scene;
}

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
    knurl_scene *scene = pressed_scene(&id);
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
    knurl_scene_destroy(scene);
}

/* Finite numbers whose sums overflow: refused, or stood there; either way nobody is thrown about. */
TEST(transforms_at_the_edge_of_doubles_leave_the_force_finite) {
    static const double far_off[] = {1e150, 1e300, 1.7e308};
    for (size_t i = 0; i < COUNT_OF(far_off); i++) {
        knurl_surface_id id;
        knurl_scene *scene = pressed_scene(&id);
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
        knurl_scene_destroy(scene);
    }
}

TEST(materials_out_of_range_are_refused_after_the_commit_and_change_nothing) {
    knurl_surface_id id;
    knurl_scene *scene = pressed_scene(&id);
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
    unknown.method = KNURL_AREA + 1;
    CHECK_REFUSED(knurl_scene_set_material(scene, id, &unknown), KNURL_ERROR_UNKNOWN, unknown);
    check_still_pressed(scene, id);
    knurl_scene_destroy(scene);
}

TEST(surface_refused_after_the_commit_changes_nothing) {
    surface_parts bad = surface_plane();
    knurl_surface_id id;
    knurl_scene *scene = pressed_scene(&id);
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
    knurl_scene_destroy(scene);
}

/* --- edits under a HIP --- */

TEST(removing_what_is_touched_ends_the_contact_at_the_next_tick) {
    knurl_surface_id id;
    knurl_scene *scene = pressed_scene(&id);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    for (int k = 0; k < 3; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.proxy, 0.0, 0.0, -0.001, 0.0L);
        assert_true(out.surface == 0);
        assert_int_equal(out.contacts, 0);
        assert_int_equal(out.flags, 0);
    }
    knurl_scene_destroy(scene);
}

/* The place is reused; the contact is not. */
TEST(surface_in_the_place_of_one_that_was_touched_is_not_touched_from_afar) {
    surface_parts parts = surface_plane();
    knurl_surface_id id;
    knurl_scene *scene = pressed_scene(&id);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    parts.desc.position[2] = 0.0145; /* above the HIP, further than a first tick captures */
    const knurl_surface_id next = add_surface(scene, &parts);
    knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
    assert_true(out.surface == 0);
    out = press(scene, 0.0, 0.0135);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
    assert_true(out.surface == next && next != id);
    knurl_scene_destroy(scene);
}

TEST(surface_that_comes_back_round_a_hip_is_not_touched_before_the_hip_comes_again) {
    for (int ticks = 1; ticks < 4; ticks++) { /* between taking it out and putting it back */
        surface_parts parts = surface_plane();
        knurl_scene *scene = open_scene(1);
        const knurl_surface_id id = add_surface(scene, &parts);
        assert_true(press(scene, 0.0, -0.001).force[2] > 0.1);
        assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
        for (int i = 0; i < ticks; i++) {
            assert_int_equal(tick_at(scene, 0.0, 0.0, -0.001).contacts, 0);
        }
        (void)add_surface(scene, &parts);
        for (int i = 0; i < 20; i++) {
            assert_int_equal(tick_at(scene, 0.0, 0.0, -0.001).contacts, 0);
        }
        assert_true(press(scene, 0.0, -0.001).force[2] > 0.1);
        knurl_scene_destroy(scene);
    }
}

TEST(below_a_surface_that_is_taken_out_the_next_one_holds) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = open_scene(1);
    const knurl_surface_id lower = add_surface(scene, &parts);
    parts.desc.position[2] = 0.001;
    parts.material.stiffness = 300.0;
    const knurl_surface_id upper = add_surface(scene, &parts);
    knurl_tick_output out = press(scene, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, 300.0 * 0.002, TOL); /* the upper one holds it off the lower one */
    assert_true(out.surface == upper);
    assert_int_equal(knurl_scene_remove_surface(scene, upper), KNURL_OK);
    out = tick_at(scene, 0.0, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, 400.0 * 0.001, TOL);
    assert_true(out.surface == lower);
    assert_int_equal(out.contacts, 1);
    knurl_scene_destroy(scene);
}

TEST(surface_added_under_a_hip_holds_it_when_it_comes_down) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = open_scene(1);
    for (int i = 0; i < 20; i++) {
        parts.desc.position[0] = 0.3 * i;
        (void)tick_at(scene, 0.3 * i, 0.0, 1e-5);
        const knurl_surface_id id = add_surface(scene, &parts);
        const knurl_tick_output out = tick_at(scene, 0.3 * i, 0.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
        assert_true(out.surface == id);
    }
    knurl_scene_destroy(scene);
}

/* 50 Hz at 1 kHz: events of 20 ticks. What plays is played to its end with the amplitude and period it began with; the
 * stiffness is the new one at once. */
static void change_in_mid_event(double new_fs, double new_amplitude) {
    surface_parts parts = surface_plane();
    knurl_vibration_event first;
    knurl_vibration_event next;
    const double at[3] = {0.0, 0.0, -0.002};
    const double velocity[3] = {0.05, 0.0, 0.0};
    set_grating(&parts, KNURL_S2, 1000.0, 0.0, 0.0005);
    knurl_scene *scene = scene_of(&parts);
    assert_int_equal(knurl_vibration_event_init(20.0, 0.0005, &first), KNURL_OK);
    assert_int_equal(
        knurl_vibration_event_init(1000.0 / (0.05 * (new_fs > 0.0 ? new_fs : 1000.0)), new_amplitude, &next), KNURL_OK);
    for (int k = 0; k < 60; k++) {
        const knurl_tick_output out = tick_moving(scene, at, velocity);
        const int old = k < 40; /* the change comes within the second event */
        const double height = old            ? knurl_vibration_event_height(&first, k % first.length)
                              : new_fs > 0.0 ? knurl_vibration_event_height(&next, (k - 40) % next.length)
                                             : 0.0;
        CHECK_CLOSE(out.height, height, 1e-15L);
        CHECK_VECTOR(out.force, 0.0, 0.0, (k <= 25 ? 400.0 : 800.0) * (height + 0.002), TOL);
        if (old) {
            assert_int_equal(out.event, k / 20);
        }
        if (k == 25) {
            set_grating(&parts, KNURL_S2, new_fs, 0.0, new_amplitude);
            parts.material.stiffness = 800.0;
            assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
        }
    }
    knurl_scene_destroy(scene);
}

TEST(material_changes_at_the_next_tick_and_the_event_plays_on) {
    change_in_mid_event(1000.0, 0.0003);
    change_in_mid_event(2000.0, 0.0005);
    change_in_mid_event(500.0, 0.0001);
}

TEST(event_plays_to_its_end_on_a_surface_turned_smooth) {
    change_in_mid_event(0.0, 0.0);
}

/* A crest that grows under a HIP that hovers: in reach at the next tick. */
TEST(material_with_higher_crests_reaches_further_at_the_next_tick) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_S1, 100.0, 0.0, 0.0002);
    knurl_scene *scene = scene_of(&parts);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0008).contacts, 0);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0008).contacts, 0);
    set_grating(&parts, KNURL_S1, 100.0, 0.0, 0.0010);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    assert_int_equal(knurl_scene_set_material(scene, id, &parts.material), KNURL_OK);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0008);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.0002, TOL);
    knurl_scene_destroy(scene);
}

TEST(info_tells_what_an_edit_made_of_a_surface) {
    surface_parts parts = surface_plane();
    knurl_surface_info info;
    knurl_scene *scene = open_scene(1);
    parts.desc.name = "lid";
    const knurl_surface_id id = add_surface(scene, &parts);
    set_stiffness(scene, id, 650.0);
    set_place(scene, id, 0.5, 0.0, 0.25);
    knurl_surface_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_get_surface_info(scene, id, &info), KNURL_OK);
    assert_string_equal(info.name, "lid");
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    assert_int_equal(knurl_scene_get_material(scene, id, &material), KNURL_OK);
    CHECK_SAME(material.stiffness, 650.0);
    CHECK_VECTOR(info.anchor, 0.5, 0.0, 0.25, 1e-12);
    CHECK_VECTOR(info.bounds_min, 0.45, -0.05, 0.25, 1e-12);
    CHECK_VECTOR(info.bounds_max, 0.55, 0.05, 0.25, 1e-12);
    assert_string_equal(info.model, "plane");
    assert_true(info.why && info.why[0]);
    CHECK_SAME(info.model_error, 0.0);
    knurl_scene_destroy(scene);
}

/* --- many edits --- */

enum { MODEL_ROOM = 300, NAMES = 40 };

typedef struct plain_list {
    knurl_surface_id ids[MODEL_ROOM];
    int names[MODEL_ROOM];
    uint32_t count;
} plain_list;

static void compare_place(const knurl_scene *scene, const plain_list *list, uint32_t index) {
    const char *name = NULL;
    char expected[16];
    assert_true(knurl_scene_get_surface(scene, index) == list->ids[index]);
    assert_int_equal(knurl_scene_get_surface_name(scene, list->ids[index], &name), KNURL_OK);
    (void)snprintf(expected, sizeof expected, "n%d", list->names[index]);
    assert_string_equal(name, expected);
}

static void compare_find(const knurl_scene *scene, const plain_list *list, int number) {
    char name[16];
    knurl_surface_id found = 77;
    uint32_t first = 0;
    (void)snprintf(name, sizeof name, "n%d", number);
    while (first < list->count && list->names[first] != number) {
        first++;
    }
    const knurl_result result = knurl_scene_find_surface(scene, name, &found);
    assert_int_equal(result, first < list->count ? KNURL_OK : KNURL_ERROR_UNKNOWN);
    assert_true(found == (first < list->count ? list->ids[first] : 77));
}

TEST(ten_thousand_adds_and_removes_agree_with_a_plain_list) {
    static plain_list list;
    uint64_t seed = 4;
    surface_parts parts = surface_plane();
    knurl_scene *scene = open_scene(1);
    for (int step = 0; step < 10000; step++) {
        const int filling = step / 1000 % 2 == 0; /* waves, so that tables grow and places are reused */
        const int add = list.count == 0 || (list.count < MODEL_ROOM && random_integer(&seed, 0, 9) < (filling ? 7 : 3));
        if (add) {
            char name[16];
            list.names[list.count] = (int)random_integer(&seed, 0, NAMES - 1);
            (void)snprintf(name, sizeof name, "n%d", list.names[list.count]);
            parts.desc.name = name;
            parts.desc.position[2] = random_between(&seed, -0.01, 0.01);
            list.ids[list.count++] = add_surface(scene, &parts);
        } else {
            const uint32_t index = (uint32_t)random_integer(&seed, 0, list.count - 1);
            assert_int_equal(knurl_scene_remove_surface(scene, list.ids[index]), KNURL_OK);
            list.count--;
            memmove(&list.ids[index], &list.ids[index + 1], (list.count - index) * sizeof list.ids[0]);
            memmove(&list.names[index], &list.names[index + 1], (list.count - index) * sizeof list.names[0]);
        }
        assert_int_equal(knurl_scene_get_surface_count(scene), list.count);
        assert_true(knurl_scene_get_surface(scene, list.count) == 0);
        compare_find(scene, &list, (int)random_integer(&seed, 0, NAMES - 1));
        for (uint32_t i = 0; i < list.count; i += step % 500 == 0 ? 1 : 37) {
            compare_place(scene, &list, i);
        }
        if (step % 3 == 0) { /* among all that, ticks that touch what they come by */
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, random_between(&seed, -0.012, 0.012));
            const char *felt = NULL;
            assert_true(isfinite(length3(out.force)));
            assert_true(out.surface == 0 || knurl_scene_get_surface_name(scene, out.surface, &felt) == KNURL_OK);
        }
    }
    knurl_scene_destroy(scene);
}
