/* Devices and loops when memory runs out: over stand-ins of makers' libraries, over the real libusb, hidapi and
 * libwebsockets if these are installed. SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* setenv() */

#include "device/port.h"
#include "memory/failing.h"
#include "support/idle_device.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static knurl_device *device;
static knurl_scene *scene;
static knurl_loop *loop;

/* --- opening --- */

static knurl_result open_uri(const char *uri) {
    return knurl_device_open(uri, &device);
}

static void close_device(void) {
    knurl_device_close(device);
    device = NULL;
}

static void no_device(char *text, size_t size) {
    (void)snprintf(text, size, "%s", device ? "a device" : "none");
}

static knurl_result open_fake(void) {
    return open_uri("fake:?preset=touch&seed=3");
}

static knurl_result open_wrong_key(void) {
    return open_uri("fake:?colour=red");
}

static knurl_result open_unknown(void) {
    return open_uri("glove");
}

static knurl_result open_touch(void) {
    return open_uri("touch:?library=" KNURL_TEST_STUB);
}

static knurl_result open_touch_without_library(void) {
    return open_uri("touch:?library=/nowhere/libHD.so");
}

static knurl_result open_dhd(void) {
    return open_uri("dhd:?library=" KNURL_TEST_STUB_DHD);
}

static knurl_result open_falcon(void) {
    return open_uri("falcon");
}

static knurl_result open_rawhid(void) {
    return open_uri("rawhid:?geometry=" KNURL_TEST_ASSETS "/devices/woodenhaptics.ini");
}

static knurl_result open_serial(void) {
    return open_uri("serial:/dev/null");
}

static knurl_result open_own(uint32_t blocking) {
    knurl_device_functions functions = idle_functions();
    functions.blocking = blocking;
    return knurl_device_open_functions(&functions, &device);
}

static knurl_result open_functions(void) {
    return open_own(0);
}

static knurl_result open_blocking_functions(void) {
    return open_own(1);
}

static knurl_result list(void) {
    static knurl_device_listing found[16];
    return knurl_device_list(found, 16) > 0 ? KNURL_OK : knurl_fail(KNURL_ERROR_STATE, "nothing was listed");
}

TEST(a_device_is_open_or_is_not_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_device_open(fake)", NULL, open_fake, close_device, no_device, 0, 0},
        {"... of a wrong key", NULL, open_wrong_key, NULL, no_device, 1, 0},
        {"... of an unknown kind", NULL, open_unknown, NULL, no_device, 1, 0},
        {"... of a Touch", NULL, open_touch, close_device, no_device, 0, 0},
        {"... of a Touch without its library", NULL, open_touch_without_library, NULL, no_device, 1, 0},
        {"... of Force Dimension's", NULL, open_dhd, close_device, no_device, 0, 0},
        {"... of a Falcon that is not there", NULL, open_falcon, NULL, no_device, 1, 1},
        {"... of a raw HID device that is not there", NULL, open_rawhid, NULL, no_device, 1, 0},
        {"... of a serial port that is none", NULL, open_serial, NULL, no_device, 1, 0},
        {"knurl_device_open_functions()", NULL, open_functions, close_device, no_device, 0, 0},
        {"... that block", NULL, open_blocking_functions, close_device, no_device, 0, 0},
        {"knurl_device_list()", NULL, list, NULL, NULL, 0, 1},
    };
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    assert_int_equal(setenv("KNURL_DHD_LIBRARY", KNURL_TEST_STUB_DHD, 1), 0);
    failing_run(calls, COUNT_OF(calls));
}

/* --- using --- */

static void make_device(void) {
    failing_need(open_uri("fake"));
}

static void make_running_device(void) {
    make_device();
    failing_need(knurl_device_start(device, 1000.0));
}

static knurl_result start_device(void) {
    return knurl_device_start(device, 1000.0);
}

static knurl_result use_device(void) {
    const double force[3] = {0.0, 0.1, 0.0};
    knurl_device_sample sample;
    knurl_device_event event;
    knurl_device_info info;
    knurl_device_status status;
    knurl_fake_truth truth;
    int32_t stroke = 0;
    knurl_device_info_init(&info, sizeof info);
    knurl_device_status_init(&status, sizeof status);
    (void)knurl_device_get_info(device, &info);
    (void)knurl_device_get_status(device, &status);
    (void)knurl_fault_name(KNURL_FAULT_LOST);
    (void)knurl_fault_string(KNURL_FAULT_LOST);
    (void)knurl_fault_unit(KNURL_FAULT_LOST);
    (void)knurl_fault_cause(KNURL_FAULT_FORCE_OFF, 0.0);
    (void)knurl_fake_keys();
    (void)knurl_stroke_from_name("line", &stroke);
    (void)knurl_stroke_from_name("zigzag", &stroke);
    (void)knurl_fake_get_truth(device, &truth);
    (void)knurl_device_read(device, &sample);
    const knurl_result result = knurl_device_write(device, force);
    knurl_device_halt(device);
    (void)knurl_port_is_halted(device);
    knurl_port_release_halt(device);
    (void)knurl_device_next_event(device, &event);
    return result ? result : knurl_device_zero_on_exit(0);
}

static knurl_result set_trace(void) {
    const double rows[8] = {0.0, 0.0, 0.0, 0.0, 0.1, 0.01, 0.0, 0.0};
    return knurl_fake_set_trace(device, rows, 2);
}

static knurl_result set_stroke(void) {
    const double path[12] = {0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.01, 0.0, 0.0, 0.0, 1.0, 0.0};
    knurl_stroke_desc desc;
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.path = path;
    desc.path_rows = 2;
    return knurl_fake_set_stroke(device, &desc);
}

/* --- loops --- */

static void make_scene(void) {
    knurl_scene_desc desc;
    knurl_surface_desc surface;
    knurl_material_desc material;
    knurl_plane_desc plane;
    knurl_scene_desc_init(&desc, sizeof desc);
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_material_desc_init(&material, sizeof material);
    knurl_plane_desc_init(&plane, sizeof plane);
    material.stiffness = 400.0;
    surface.material = &material;
    surface.plane = &plane;
    failing_need(knurl_scene_create(&desc, &scene));
    failing_need(knurl_scene_add_surface(scene, &surface, NULL));
    failing_need(knurl_scene_commit(scene));
    make_device();
}

static knurl_result create_loop(void) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.scene = scene;
    desc.ramp_s = 0.001;
    return knurl_loop_create(&desc, &loop);
}

static void make_loop(void) {
    make_scene();
    failing_need(create_loop());
}

static void make_started_loop(void) {
    make_loop();
    failing_need(knurl_loop_start(loop));
}

static void free_loop(void) {
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    loop = NULL;
    device = NULL;
    scene = NULL;
}

static void loop_state(char *text, size_t size) {
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    if (loop) {
        (void)knurl_loop_get_stats(loop, &stats);
    }
    (void)snprintf(text, size, "%s, %d, %llu ticks", loop ? "a loop" : "none", (int)stats.state,
                   (unsigned long long)stats.ticks);
}

static knurl_result start_loop(void) {
    return knurl_loop_start(loop);
}

static knurl_result step_loop(void) {
    return knurl_loop_step(loop, 20);
}

static knurl_result steer_loop(void) {
    const double force[3] = {0.0, 0.1, 0.0};
    knurl_loop_pause(loop);
    knurl_loop_resume(loop);
    knurl_loop_heartbeat(loop);
    knurl_result result = knurl_loop_set_gain(loop, 0.5);
    result = result ? result : knurl_loop_set_force(loop, force);
    result = result ? result : knurl_loop_vibrate(loop, KNURL_WAVE_T3, 100.0, 0.1, force, 0.1);
    (void)knurl_loop_wait(loop, 0.001);
    knurl_loop_request_stop(loop);
    return result;
}

/* The device's and the scene's ends, too: while a loop uses them, they are freed with it. */
static knurl_result end_loop(void) {
    if (loop) {
        knurl_loop_stop(loop);
        knurl_device_close(device);
        knurl_scene_destroy(scene);
        knurl_loop_destroy(loop);
    }
    loop = NULL;
    device = NULL;
    scene = NULL;
    return KNURL_OK;
}

static knurl_result lay_stroke(void) {
    knurl_stroke_report report;
    knurl_stroke_report_init(&report, sizeof report);
    return knurl_fake_lay_stroke(device, scene, 0, knurl_scene_get_surface(scene, 0), KNURL_STROKE_LINE, &report);
}

TEST(devices_and_loops_go_on_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_device_start()", make_device, start_device, close_device, NULL, 0, 0},
        {"knurl_device_read(), _write(), _halt(), ...", make_running_device, use_device, close_device, NULL, 0, 0},
        {"knurl_fake_set_trace()", make_device, set_trace, close_device, NULL, 0, 0},
        {"knurl_fake_set_stroke()", make_device, set_stroke, close_device, NULL, 0, 0},
        {"knurl_fake_lay_stroke()", make_scene, lay_stroke, free_loop, NULL, 0, 0},
        {"knurl_loop_create()", make_scene, create_loop, free_loop, loop_state, 0, 0},
        {"knurl_loop_start()", make_loop, start_loop, free_loop, loop_state, 0, 0},
        {"knurl_loop_step()", make_loop, step_loop, free_loop, NULL, 0, 0},
        {"knurl_loop_pause(), _set_force(), ...", make_started_loop, steer_loop, free_loop, NULL, 0, 0},
        {"knurl_loop_stop(), _destroy()", make_started_loop, end_loop, free_loop, NULL, 0, 0},
    };
    failing_run(calls, COUNT_OF(calls));
}
