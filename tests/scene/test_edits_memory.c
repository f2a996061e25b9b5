/* Memory of edits: every byte is accounted for and freed, a failed allocation leaves the scene unchanged, ticks
 * allocate nothing. SPDX-License-Identifier: MIT */
#include "support/ledger.h"
#include "support/poses.h"

#define K 400.0

static double slope(double x, double y) {
    return 2.0 * x * x + 0.1 * y; /* not flat: it stays a mesh */
}

/* A committed scene with a plane under HIP 0, pressed 1 mm deep. */
static knurl_scene *pressed_scene(ledger *books, knurl_surface_id *id) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = scene_with(books);
    configure_plainly(scene, 0);
    configure_plainly(scene, 1);
    *id = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    return scene;
}

static knurl_result set_stiffness(knurl_scene *scene, knurl_surface_id id, double stiffness) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = stiffness;
    return knurl_scene_set_material(scene, id, &material);
}

static knurl_result set_height(knurl_scene *scene, knurl_surface_id id, double z, double seconds) {
    const double position[3] = {0.0, 0.0, z};
    const double rotation[4] = {0.0, 0.0, 0.0, 1.0};
    return knurl_scene_set_transform(scene, id, position, rotation, seconds);
}

/* Adds 50 surfaces, meshes among them, edits and ticks, and takes all out again. */
static void busy_round(knurl_scene *scene, const ledger *books, knurl_surface_id first, shape *sheet) {
    knurl_surface_id ids[50];
    surface_parts parts[2] = {surface_plane(), surface_mesh(sheet)};
    for (int i = 0; i < 50; i++) {
        parts[i % 2].desc.name = i % 3 ? "a name of some length" : NULL;
        parts[i % 2].desc.position[0] = 0.01 * i;
        ids[i] = add_surface(scene, &parts[i % 2]);
        assert_int_equal(set_stiffness(scene, first, 300.0 + i), KNURL_OK);
        (void)tick_at(scene, 0.01 * i, 0.0, i % 4 ? -0.001 : 0.004);
        assert_true(knurl_scene_get_bytes(scene) == books->bytes);
    }
    for (int i = 0; i < 50; i++) {
        assert_int_equal(set_height(scene, ids[i], 0.001 * i, i % 2 ? 0.02 : 0.0), KNURL_OK);
        (void)tick_at(scene, 0.0, 0.0, -0.001);
    }
    for (int i = 49; i >= 0; i--) {
        assert_int_equal(knurl_scene_remove_surface(scene, ids[(i * 7) % 50]), KNURL_OK);
        (void)tick_at(scene, 0.0, 0.0, i % 2 ? -0.001 : 0.001);
        assert_true(knurl_scene_get_bytes(scene) == books->bytes);
    }
    assert_int_equal(set_stiffness(scene, first, K), KNURL_OK);
    assert_int_equal(set_height(scene, first, 0.0, 0.0), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, 0.01);
    knurl_scene_collect(scene);
}

TEST(bytes_return_to_where_they_were) {
    ledger books = {0, 0, 0, 0};
    knurl_surface_id id;
    SCOPED_SHAPE sheet = shape_sheet(5, 5, (const double[2]){0.02, 0.02}, slope);
    knurl_scene *scene = pressed_scene(&books, &id);
    for (int round = 0; round < 3; round++) { /* tables grow to a round's size, and keep it */
        busy_round(scene, &books, id, &sheet);
    }
    const uint64_t before = knurl_scene_get_bytes(scene);
    const int32_t blocks = books.blocks;
    for (int round = 0; round < 3; round++) {
        busy_round(scene, &books, id, &sheet);
        assert_true(knurl_scene_get_bytes(scene) == before && books.bytes == before);
        assert_int_equal(books.blocks, blocks);
    }
    end_with(scene, &books);
}

/* With ticks, and (a paused game) without any. */
TEST(edits_that_are_replaced_do_not_pile_up) {
    for (int paused = 0; paused < 2; paused++) {
        ledger books = {0, 0, 0, 0};
        knurl_surface_id id;
        knurl_scene *scene = pressed_scene(&books, &id);
        const uint64_t before = knurl_scene_get_bytes(scene);
        for (int i = 0; i < 10000; i++) {
            assert_int_equal(i % 2 ? set_stiffness(scene, id, 400.0) : set_height(scene, id, 0.0, 0.01), KNURL_OK);
            if (!paused) {
                (void)tick_at(scene, 0.0, 0.0, -0.001);
            }
            assert_true(knurl_scene_get_bytes(scene) == books.bytes);
            assert_true(books.bytes < before + 16384);
        }
        end_with(scene, &books);
    }
}

/* A HIP that is configured and never ticks holds nothing up. */
TEST(hip_that_does_not_tick_holds_no_memory_back) {
    ledger books = {0, 0, 0, 0};
    knurl_surface_id id;
    SCOPED_SHAPE sheet = shape_sheet(30, 30, (const double[2]){0.05, 0.05}, slope);
    surface_parts parts = surface_mesh(&sheet);
    knurl_scene *scene = pressed_scene(&books, &id);
    knurl_surface_id mesh = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_remove_surface(scene, mesh), KNURL_OK);
    knurl_scene_collect(scene);
    const uint64_t before = knurl_scene_get_bytes(scene);
    mesh = add_surface(scene, &parts);
    assert_true(knurl_scene_get_bytes(scene) > before + 1800 * 12);
    (void)tick_at(scene, 0.0, 0.0, -0.001); /* HIP 0 touches it; HIP 1 never comes */
    assert_int_equal(knurl_scene_remove_surface(scene, mesh), KNURL_OK);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    (void)tick_at(scene, 0.0, 0.0, -0.001);
    knurl_scene_collect(scene);
    assert_true(knurl_scene_get_bytes(scene) == before && books.bytes == before);
    end_with(scene, &books);
}

TEST(scene_destroyed_in_the_midst_of_edits_gives_everything_back) {
    ledger books = {0, 0, 0, 0};
    knurl_surface_id id;
    surface_parts parts = surface_plane();
    knurl_scene *scene = pressed_scene(&books, &id);
    for (int i = 0; i < 20; i++) {
        (void)add_surface(scene, &parts);
        assert_int_equal(set_stiffness(scene, id, 500.0 + i), KNURL_OK);
        assert_int_equal(set_height(scene, id, 0.001, 1.0), KNURL_OK);
    }
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    end_with(scene, &books);
}

/* One edit of each kind; returns its result. */
static knurl_result edit(knurl_scene *scene, knurl_surface_id id, int kind, shape *sheet) {
    surface_parts parts = kind == 3 ? surface_mesh(sheet) : surface_plane();
    knurl_surface_id made = 77;
    knurl_result result;
    parts.desc.name = "added";
    parts.desc.position[2] = 0.0005;
    switch (kind) {
    case 0:
        return set_stiffness(scene, id, 800.0);
    case 1:
        return set_height(scene, id, 0.001, 0.0);
    case 2:
    case 3:
        result = knurl_scene_add_surface(scene, surface_ready(&parts), &made);
        assert_true((made != 77) == (result == KNURL_OK));
        return result;
    default:
        return knurl_scene_remove_surface(scene, id);
    }
}

/* The force that the edit makes, 1 mm deep in a plane at 0. */
static const double AFTER[5] = {0.8, 0.8, 0.6, 0.6, 0.0};

/* Edits with one allocation failing: returns 1 if the edit failed. */
static int edit_without(int32_t refused, int kind, int crowd, shape *sheet) {
    ledger books = {0, 0, 0, 0};
    knurl_surface_id id;
    surface_parts far_off = surface_plane();
    knurl_scene *scene = pressed_scene(&books, &id);
    far_off.desc.position[0] = 3.0;
    for (int i = 0; i < crowd; i++) {
        (void)add_surface(scene, &far_off);
    }
    const uint32_t count = knurl_scene_get_surface_count(scene);
    knurl_scene_collect(scene);
    books.refused = books.requests + refused;
    const knurl_result result = edit(scene, id, kind, sheet);
    books.refused = 0;
    assert_true(knurl_scene_get_bytes(scene) == books.bytes);
    if (result != KNURL_OK) {
        assert_int_equal(result, KNURL_ERROR_MEMORY);
        assert_non_null(strstr(knurl_error_message(), "memory"));
        assert_int_equal(knurl_scene_get_surface_count(scene), count);
        for (int k = 0; k < 3; k++) {
            const knurl_tick_output out = tick_at(scene, 0.0, 0.0, -0.001);
            CHECK_CLOSE(out.force[2], K * 0.001, 1e-12);
            assert_true(out.surface == id);
        }
        assert_int_equal(edit(scene, id, kind, sheet), KNURL_OK);
    }
    assert_int_equal(knurl_scene_get_surface_count(scene), count + (kind == 2 || kind == 3) - (kind == 4));
    (void)tick_at(scene, 0.0, 0.0, 0.010);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, -0.001).force[2], AFTER[kind], 1e-6); /* a sheet's floats */
    end_with(scene, &books);
    return result != KNURL_OK;
}

/* Crowds at which tables of powers of two are just full, and one more. */
TEST(edits_that_get_no_memory_leave_the_scene_as_it_was) {
    SCOPED_SHAPE sheet = shape_sheet(3, 3, (const double[2]){0.05, 0.05}, NULL);
    for (int kind = 0; kind < 5; kind++) {
        for (int crowd = 0; crowd <= 32; crowd += crowd < 8 ? 1 : 8) {
            int32_t refused = 1;
            while (edit_without(refused, kind, crowd, &sheet)) {
                refused++;
            }
            assert_true(refused < 60);
            assert_true((kind != 2 && kind != 3) || refused > 1); /* an added surface does take memory */
        }
    }
}

/* The commit allocates for sorting: if that fails, it returns an error and can be repeated. */
TEST(commit_that_gets_no_memory_can_be_made_again) {
    for (int32_t refused = 1; refused < 60; refused++) {
        ledger books = {0, 0, 0, 0};
        surface_parts parts = surface_plane();
        knurl_scene *scene = scene_with(&books);
        configure_plainly(scene, 0);
        for (int i = 0; i < 20; i++) {
            parts.desc.position[0] = 0.2 * i;
            (void)add_surface(scene, &parts);
        }
        books.refused = books.requests + refused;
        const knurl_result result = knurl_scene_commit(scene);
        books.refused = 0;
        if (result != KNURL_OK) {
            const knurl_tick_input input = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
            knurl_tick_output out;
            assert_int_equal(result, KNURL_ERROR_MEMORY);
            assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_ERROR_STATE);
            assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        }
        (void)tick_at(scene, 0.2, 0.0, 0.010);
        CHECK_CLOSE(tick_at(scene, 0.2, 0.0, -0.001).force[2], K * 0.001, 1e-12);
        end_with(scene, &books);
        if (result == KNURL_OK) {
            return;
        }
    }
    fail();
}

TEST(ticks_neither_ask_for_memory_nor_give_any_back) {
    ledger books = {0, 0, 0, 0};
    knurl_surface_id id;
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = pressed_scene(&books, &id);
    uint64_t seed = 8;
    for (int i = 0; i < 200; i++) {
        parts.desc.position[0] = 0.005 * i;
        const knurl_surface_id other = add_surface(scene, &parts);
        assert_int_equal(set_stiffness(scene, id, 400.0 + i), KNURL_OK);
        assert_int_equal(set_height(scene, other, 0.002, 0.01), KNURL_OK);
        if (i % 3 == 0) {
            assert_int_equal(knurl_scene_remove_surface(scene, other), KNURL_OK);
        }
        const ledger before = books;
        for (int k = 0; k < 20; k++) { /* at different positions, so that a HIP's list of nearby surfaces changes */
            (void)tick_at(scene, random_between(&seed, -0.05, 1.0), 0.0, random_between(&seed, -0.003, 0.01));
        }
        assert_memory_equal(&before, &books, sizeof books);
    }
}
