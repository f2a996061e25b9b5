/* Replacing a surface by another shape: contact continues. SPDX-License-Identifier: MIT */
#include "proxy/contacts.h"
#include "scene/scene.h"

#include "scene/ask.h"
#include "support/ledger.h"
#include "support/poses.h"

#define K     400.0
#define DEPTH 0.001
#define TOL   1e-9L

/* A smooth box whose top is at z. */
static surface_parts box_below(const shape *box, double half, double z) {
    surface_parts parts = surface_along_x(box);
    parts.desc.position[2] = z - half;
    return parts;
}

static void replace(knurl_scene *scene, knurl_surface_id id, surface_parts *parts) {
    const knurl_result result = knurl_scene_replace_surface(scene, id, surface_ready(parts));
    if (result) {
        print_error("%s\n", knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
}

/* A HIP rests in a surface that is replaced repeatedly: boxes of all sizes, planes, and poses within a millimetre. */
TEST(a_pressed_surface_stays_pressed_when_replaced) {
    uint64_t seed = 3;
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    for (int i = 0; i < 500; i++) {
        const double size = random_between(&seed, 0.005, 0.2);
        const double top = random_between(&seed, -0.0005, 0.0015);
        const double half[3] = {size, size, size};
        SCOPED_SHAPE box = shape_box(half, 0);
        const int is_box = random_integer(&seed, 0, 2) > 0;
        parts = is_box ? box_below(&box, size, top) : surface_plane();
        parts.desc.position[2] = is_box ? parts.desc.position[2] : top;
        parts.desc.double_sided = random_integer(&seed, 0, 1) > 0;
        parts.material.stiffness = random_between(&seed, 100.0, 900.0);
        replace(scene, id, &parts);
        for (int k = 0; k < 3; k++) {
            const knurl_tick_output out = tick_at(scene, 0.001 * k, 0.0, -DEPTH);
            assert_int_equal(out.contacts, 1);
            assert_true(out.surface == id);
            CHECK_CLOSE(out.force[2], parts.material.stiffness * (DEPTH + top), 2e-5L); /* positions are floats */
        }
    }
}

/* With the protections: the wall that took the other's place is as hard at once, and not a wall that came up. */
TEST(the_depth_that_was_felt_goes_on) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.resolution = 0.0;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    for (int k = 0; k <= 100; k++) {
        (void)tick_at(scene, 0.0, 0.0, 0.001 - 2e-5 * k);
    }
    const double before = tick_at(scene, 0.0, 0.0, -DEPTH).force[2];
    CHECK_CLOSE(before, K * DEPTH, TOL);
    replace(scene, id, &parts);
    const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -DEPTH);
    CHECK_CLOSE(out.force[2], before, TOL);
    assert_int_equal(out.flags & KNURL_TICK_ENTRY, 0);
}

TEST(contact_ends_when_the_surface_shrinks_away) {
    const double large[3] = {0.05, 0.05, 0.05};
    const double small[3] = {0.01, 0.01, 0.01};
    shape boxes[2] = {shape_box(large, 0), shape_box(small, 0)};
    surface_parts parts = box_below(&boxes[0], 0.05, 0.0);
    SCOPED_SCENE *scene = scene_of(&parts);
    (void)tick_at(scene, 0.03, 0.0, 0.01);
    assert_int_equal(tick_at(scene, 0.03, 0.0, -DEPTH).contacts, 1);
    parts = box_below(&boxes[1], 0.01, 0.0);
    replace(scene, knurl_scene_get_surface(scene, 0), &parts);
    const knurl_tick_output out = tick_at(scene, 0.03, 0.0, -DEPTH);
    assert_int_equal(out.contacts, 0);
    CHECK_VECTOR(out.force, 0.0, 0.0, 0.0, 0.0);
    shape_free(&boxes[0]);
    shape_free(&boxes[1]);
}

/* It is found at its new extent, and no more at its old place, also by HIPs that were far away. */
TEST(it_is_felt_where_it_is_now) {
    for (int committed = 0; committed < 2; committed++) {
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = empty_scene(1);
        const knurl_surface_id id = add_surface(scene, &parts);
        configure_plainly(scene, 0);
        if (committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
            (void)tick_at(scene, 0.3, 0.0, 0.01);
        }
        parts.plane.half_extents[0] = 0.4;
        parts.desc.name = "longer";
        replace(scene, id, &parts);
        if (!committed) {
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        char name[KNURL_NAME_SIZE] = "";
        assert_int_equal(knurl_scene_get_surface_name(scene, id, name), KNURL_OK);
        assert_string_equal(name, "longer");
        assert_int_equal(knurl_scene_get_surface_count(scene), 1);
        (void)tick_at(scene, 0.3, 0.0, 0.01);
        CHECK_CLOSE(tick_at(scene, 0.3, 0.0, -DEPTH).force[2], K * DEPTH, TOL);
        (void)tick_at(scene, 0.3, 0.0, 0.01);
        parts.desc.position[0] = 2.0;
        replace(scene, id, &parts);
        assert_int_equal(tick_at(scene, 0.3, 0.0, -DEPTH).contacts, 0);
        (void)tick_at(scene, 2.0, 0.0, 0.01);
        CHECK_CLOSE(tick_at(scene, 2.0, 0.0, -DEPTH).force[2], K * DEPTH, TOL);
    }
}

TEST(a_refused_replacement_leaves_the_old_one) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    parts.material.stiffness = -1.0;
    assert_int_equal(knurl_scene_replace_surface(scene, id, surface_ready(&parts)), KNURL_ERROR_ARGUMENT);
    check_message("stiffness");
    parts.material.stiffness = K;
    assert_int_equal(knurl_scene_replace_surface(scene, id + 1, surface_ready(&parts)), KNURL_ERROR_STALE_ID);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -DEPTH).force[2], K * DEPTH, TOL);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    assert_int_equal(knurl_scene_replace_surface(scene, id, surface_ready(&parts)), KNURL_ERROR_STALE_ID);
}

TEST(the_old_one_s_memory_comes_back) {
    ledger books = {0, 0, 0, 0};
    const double half[3] = {0.05, 0.05, 0.05};
    SCOPED_SHAPE box = shape_box(half, 0);
    surface_parts parts = box_below(&box, 0.05, 0.0);
    knurl_scene *scene = scene_with(&books);
    configure_plainly(scene, 0);
    const knurl_surface_id id = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    uint64_t before = 0;
    for (int i = 0; i < 100; i++) {
        replace(scene, id, &parts);
        (void)tick_at(scene, 0.0, 0.0, -DEPTH);
        knurl_scene_collect(scene);
        before = i == 50 ? knurl_scene_get_bytes(scene) : before;
    }
    assert_true(knurl_scene_get_bytes(scene) == before && books.bytes == before);
    knurl_scene_destroy(scene);
    assert_true(books.bytes == 0);
}

/* As seen by a tick: replaced by another surface, or removed. */
TEST(a_contact_with_what_is_no_longer_there_is_over) {
    for (int gone = 0; gone < 2; gone++) {
        static knurl_surface_data surface;
        static knurl_candidate candidate;
        memset(&candidate, 0, sizeof candidate);
        surface.generation = 7;
        candidate.generation = 3;
        candidate.in_contact = candidate.has_previous = 1;
        candidate.contact.inside = 1;
        candidate.wall.depth = candidate.wall.height = 0.001;
        knurl_candidate_note_change(&candidate, gone ? NULL : &surface);
        assert_false(candidate.in_contact || candidate.has_previous || candidate.contact.inside);
        assert_int_equal(candidate.generation, gone ? 3 : 7);
        CHECK_SAME(candidate.wall.depth + candidate.wall.height, 0.0);
    }
}

/* The plane lies round the origin; in the last tick it was a metre away. */
TEST(a_surface_is_near_in_the_tick_after_the_edit_that_brings_it) {
    static const float away[6] = {1.0F, 1.0F, 1.0F, 2.0F, 2.0F, 2.0F};
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_surface_data *surface = knurl_surfaces_at(&scene->surfaces, 0);
    const knurl_hip_clock clock = {0.005, 0.004, 0.001, 5};
    for (int is_edited = 0; is_edited <= 1; is_edited++) {
        knurl_candidate candidate;
        knurl_hip_path path;
        memset(&candidate, 0, sizeof candidate);
        memset(&path, 0, sizeof path);
        memcpy(candidate.swept, away, sizeof away);
        candidate.swept_tick = 4;
        candidate.swept_edits = surface->record->edits - (is_edited ? 1 : 0);
        assert_int_equal(knurl_candidate_is_swept_near(&candidate, surface, &clock, &path, 0.001), is_edited);
    }
}
