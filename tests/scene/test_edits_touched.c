/* Edits under a HIP: the next tick; and ten thousand of them. SPDX-License-Identifier: MIT */
#include "edits.h"
#include "scene/ask.h"

TEST(removing_what_is_touched_ends_the_contact_at_the_next_tick) {
    knurl_surface_id id;
    SCOPED_SCENE *scene = pressed_scene(&id);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    for (int k = 0; k < 3; k++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
        CHECK_VECTOR(out.proxy, 0.0, 0.0, -0.001, 0.0L);
        assert_true(out.surface == 0);
        assert_int_equal(out.contacts, 0);
        assert_int_equal(out.flags, 0);
    }
}

/* The place is reused; the contact is not. */
TEST(surface_in_the_place_of_one_that_was_touched_is_not_touched_from_afar) {
    surface_parts parts = surface_plane();
    knurl_surface_id id;
    SCOPED_SCENE *scene = pressed_scene(&id);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    parts.desc.position[2] = 0.0145; /* above the HIP, further than a first tick captures */
    const knurl_surface_id next = add_surface(scene, &parts);
    knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0L);
    assert_true(out.surface == 0);
    out = press(scene, 0.0, 0.0135);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
    assert_true(out.surface == next && next != id);
}

TEST(surface_that_comes_back_round_a_hip_is_not_touched_before_the_hip_comes_again) {
    for (int ticks = 1; ticks < 4; ticks++) { /* between taking it out and putting it back */
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = open_scene(1);
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
    }
}

TEST(below_a_surface_that_is_taken_out_the_next_one_holds) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = open_scene(1);
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
}

TEST(surface_added_under_a_hip_holds_it_when_it_comes_down) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = open_scene(1);
    for (int i = 0; i < 20; i++) {
        parts.desc.position[0] = 0.3 * i;
        (void)tick_at(scene, 0.3 * i, 0.0, 1e-5);
        const knurl_surface_id id = add_surface(scene, &parts);
        const knurl_tick_output out = tick_at(scene, 0.3 * i, 0.0, -0.001);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.001, TOL);
        assert_true(out.surface == id);
    }
}

/* 50 Hz at 1 kHz: events of 20 ticks. An event plays to its end with its initial amplitude and period; the stiffness
 * changes at once. */
static void change_in_mid_event(double new_fs, double new_amplitude) {
    surface_parts parts = surface_plane();
    knurl_vibration_event first;
    knurl_vibration_event next;
    const double at[3] = {0.0, 0.0, -0.002};
    const double velocity[3] = {0.05, 0.0, 0.0};
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0005);
    SCOPED_SCENE *scene = scene_of(&parts);
    assert_int_equal(knurl_vibration_event_prepare(20.0, 0.0005, &first), KNURL_OK);
    assert_int_equal(
        knurl_vibration_event_prepare(1000.0 / (0.05 * (new_fs > 0.0 ? new_fs : 1000.0)), new_amplitude, &next),
        KNURL_OK);
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
            set_grating(&parts, KNURL_METHOD_S2, new_fs, 0.0, new_amplitude);
            parts.material.stiffness = 800.0;
            assert_int_equal(knurl_scene_set_material(scene, out.surface, &parts.material), KNURL_OK);
        }
    }
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
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 0.0002);
    SCOPED_SCENE *scene = scene_of(&parts);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0008).contacts, 0);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 0.0008).contacts, 0);
    set_grating(&parts, KNURL_METHOD_S1, 100.0, 0.0, 0.0010);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    assert_int_equal(knurl_scene_set_material(scene, id, &parts.material), KNURL_OK);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0008);
    CHECK_VECTOR(out.force, 0.0, 0.0, K * 0.0002, TOL);
}

TEST(info_tells_what_an_edit_made_of_a_surface) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = open_scene(1);
    parts.desc.name = "lid";
    const knurl_surface_id id = add_surface(scene, &parts);
    set_stiffness(scene, id, 650.0);
    set_place(scene, id, 0.5, 0.0, 0.25);
    const knurl_surface_info info = info_of(scene, id);
    assert_string_equal(info.name, "lid");
    CHECK_SAME(material_of(scene, id).stiffness, 650.0);
    CHECK_VECTOR(info.anchor, 0.5, 0.0, 0.25, 1e-12);
    CHECK_VECTOR(info.bounds_min, 0.45, -0.05, 0.25, 1e-12);
    CHECK_VECTOR(info.bounds_max, 0.55, 0.05, 0.25, 1e-12);
    assert_string_equal(info.model, "plane");
    assert_true(info.why && info.why[0]);
    CHECK_SAME(info.model_error, 0.0);
}

/* --- many edits --- */

enum { MODEL_ROOM = 300, NAMES = 40 };

typedef struct plain_list {
    knurl_surface_id ids[MODEL_ROOM];
    int names[MODEL_ROOM];
    uint32_t count;
} plain_list;

static void compare_place(const knurl_scene *scene, const plain_list *list, uint32_t index) {
    char name[KNURL_NAME_SIZE];
    char expected[16];
    assert_true(knurl_scene_get_surface(scene, index) == list->ids[index]);
    assert_int_equal(knurl_scene_get_surface_name(scene, list->ids[index], name), KNURL_OK);
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
    SCOPED_SCENE *scene = open_scene(1);
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
        if (step % 3 == 0) { /* in between, ticks in contact */
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, random_between(&seed, -0.012, 0.012));
            char felt[KNURL_NAME_SIZE];
            assert_true(isfinite(length3(out.force)));
            assert_true(out.surface == 0 || knurl_scene_get_surface_name(scene, out.surface, felt) == KNURL_OK);
        }
    }
}
