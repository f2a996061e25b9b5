/* Two real loops, each on its own fake device, tick one scene while another thread, like a game, edits it a thousand
 * times per second. KNURL_STRESS_SECONDS: duration. SPDX-License-Identifier: MIT */
#include "support/fake.h"
#include "support/geometry.h"
#include "support/ledger.h"
#include "support/wait.h"

#include "base/system.h"

#include <knurl/knurl.h>

#include <stdlib.h>

enum { HIPS = 2 };

#define MS 1000000

/* z up in the surface becomes y up in the scene, as the fake device's hand has it. */
static const double lying[4] = {-0.70710678118654752, 0.0, 0.0, 0.70710678118654752};

static surface_parts lying_plane(void) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0001);
    memcpy(parts.desc.rotation, lying, sizeof lying);
    return parts;
}

/* One edit of each kind in turn; comes: a surface that is added and taken out again. */
static void edit(knurl_scene *scene, knurl_surface_id floor, uint64_t number, knurl_surface_id *comes) {
    surface_parts parts = lying_plane();
    const double position[3] = {0.0, 0.0002 * (double)(number / 4 % 5), 0.0};
    switch (number % 4) {
    case 0:
        parts.material.stiffness = 300.0 + (double)(number % 300);
        parts.material.friction = number % 8 == 0 ? 0.3 : 0.0;
        assert_int_equal(knurl_scene_set_material(scene, floor, &parts.material), KNURL_OK);
        break;
    case 1:
        assert_int_equal(knurl_scene_set_transform(scene, floor, position, lying, 0.004), KNURL_OK);
        break;
    case 2:
        parts.desc.position[0] = 0.001 * (double)(number % 50);
        *comes = add_surface(scene, &parts);
        break;
    default:
        if (*comes) {
            assert_int_equal(knurl_scene_remove_surface(scene, *comes), KNURL_OK);
            *comes = 0;
        }
    }
}

static knurl_loop *start_loop(knurl_scene *scene, uint32_t hip, knurl_device *device) {
    knurl_loop_desc desc;
    knurl_loop *loop = NULL;
    stand(device);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.scene = scene;
    desc.device = device;
    desc.hip = hip;
    desc.watchdog_s = 0.0; /* a sanitizer, or a busy machine, may stop the world for longer */
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    return loop;
}

/* The last tick feels the newest material only: F = K (H + depth), without friction. */
static void check_felt(const knurl_scene *scene, uint32_t hip, double stiffness) {
    knurl_tick_output out;
    knurl_hip_counts counts;
    assert_int_equal(knurl_scene_get_tick(scene, hip, &out, &counts), KNURL_OK);
    assert_int_equal(out.contacts, 1);
    assert_int_equal(counts.non_finite_ticks, 0);
    assert_true(counts.contact_ticks > 0);
    CHECK_CLOSE(length3(out.force), stiffness * (out.height + out.depth), 1e-9);
}

TEST(two_loops_tick_while_a_thread_edits) {
    const char *given = getenv("KNURL_STRESS_SECONDS");
    const double seconds = given ? strtod(given, NULL) : 1.0;
    ledger books = {0, 0, 0, 0};
    knurl_scene *scene = scene_with(&books);
    surface_parts parts = lying_plane();
    const knurl_surface_id floor = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    knurl_device *devices[HIPS];
    knurl_loop *loops[HIPS];
    for (uint32_t i = 0; i < HIPS; i++) {
        devices[i] = open_device("fake");
        loops[i] = start_loop(scene, i, devices[i]);
    }
    knurl_surface_id comes = 0;
    const int64_t start = knurl_system_now_ns();
    uint64_t number = 0;
    for (; knurl_system_now_ns() - start < (int64_t)(seconds * 1e9); number++) {
        edit(scene, floor, number, &comes);
        knurl_system_sleep_until_ns(start + (int64_t)number * MS);
    }
    if (comes) {
        assert_int_equal(knurl_scene_remove_surface(scene, comes), KNURL_OK);
    }
    parts.material.stiffness = 777.0;
    assert_int_equal(knurl_scene_set_material(scene, floor, &parts.material), KNURL_OK);
    for (uint32_t i = 0; i < HIPS; i++) {
        const uint64_t ticks = loop_stats(loops[i]).ticks;
        WAIT_FOR(loop_stats(loops[i]).ticks >= ticks + 100);
        assert_int_equal(knurl_loop_wait(loops[i], 0.0), 0); /* alive */
        check_felt(scene, i, 777.0);
        knurl_loop_destroy(loops[i]);
        knurl_device_close(devices[i]);
    }
    print_message("%llu edits in %g s\n", (unsigned long long)number, seconds);
    knurl_scene_collect(scene);
    assert_true(knurl_scene_get_bytes(scene) == books.bytes);
    knurl_scene_destroy(scene);
    assert_int_equal(books.blocks, 0);
}
