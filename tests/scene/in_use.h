/* A device inside a wall, a scene with that wall, and a loop of both. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_IN_USE_H
#define KNURL_TEST_IN_USE_H

#include "device/core/home.h"
#include "support/ledger.h"

#include <knurl/knurl.h>

#include <pthread.h>

/* A device, a scene with a wall around its position, and a loop. */
typedef struct set {
    home home;
    ledger books;
    knurl_device *device;
    knurl_scene *scene;
    knurl_loop *loop;
} set;

static set s; /* reset by each test */

/* Two HIPs in a wall of 400 N/m, 1 mm deep: 0.4 N. */
static knurl_scene *wall_scene(ledger *books) {
    surface_parts parts = surface_plane();
    memset(books, 0, sizeof *books);
    knurl_scene *scene = scene_with(books);
    (void)add_surface(scene, &parts);
    configure_plainly(scene, 0);
    configure_plainly(scene, 1);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

static knurl_result make_loop(knurl_device *device, knurl_scene *scene, uint32_t hip, knurl_loop **loop) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.scene = scene;
    desc.hip = hip;
    desc.watchdog_s = 0.0; /* a machine under load may set it off */
    return knurl_loop_create(&desc, loop);
}

static void set_up_without_loop(uint32_t blocking) {
    memset(&s, 0, sizeof s);
    s.device = home_open(&s.home, blocking);
    home_place(&s.home, 0.0, 0.0, -0.001);
    s.scene = wall_scene(&s.books);
}

static void set_up(uint32_t blocking) {
    set_up_without_loop(blocking);
    assert_int_equal(make_loop(s.device, s.scene, 0, &s.loop), KNURL_OK);
}

static double motor(void) {
    return knurl_load_double(&s.home.motor[2]);
}

static void start_and_push(void) {
    assert_int_equal(knurl_loop_start(s.loop), KNURL_OK);
    const int64_t until = now_ns() + INT64_C(10000000000);
    while (motor() < 0.39 && now_ns() < until) {
        sleep_ns(500000);
    }
    CHECK_CLOSE(motor(), 0.4, 0.01);
}

/* Nothing is left of the set, and the device heard of its end once and last. */
static void check_all_gone(void) {
    assert_int_equal(s.home.closes, 1);
    assert_true(s.home.close_order == s.home.order);
    assert_true(motor() == 0.0);
    assert_int_equal(s.books.blocks, 0);
}

static inline void end_device_and_scene(void) {
    knurl_device_close(s.device);
    knurl_scene_destroy(s.scene);
    check_all_gone();
}

/* Of a device that is closed. */
static inline void end_loop_and_scene(void) {
    knurl_loop_destroy(s.loop);
    knurl_scene_destroy(s.scene);
    check_all_gone();
}

#endif
