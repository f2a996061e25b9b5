/* A loop's device and HIP cannot be used by another one. SPDX-License-Identifier: MIT */
#include "in_use.h"

TEST(a_second_loop_on_a_device_is_refused_and_names_it) {
    struct {
        knurl_loop *loop;
    } second = {NULL};
    set_up(0);
    CHECK_REFUSED(make_loop(s.device, s.scene, 1, &second.loop), KNURL_ERROR_STATE, second);
    check_message("device");
    check_message("in use by another loop");
    knurl_loop_destroy(s.loop);
    assert_int_equal(make_loop(s.device, s.scene, 1, &second.loop), KNURL_OK); /* once that one is gone */
    knurl_loop_destroy(second.loop);
    end_device_and_scene();
}

TEST(a_second_loop_on_a_hip_is_refused_and_names_it) {
    struct {
        knurl_loop *loop;
    } second = {NULL};
    static home other;
    knurl_device *device = home_open(&other, 0);
    set_up(0);
    start_and_push();
    const uint64_t starts = other.starts;
    CHECK_REFUSED(make_loop(device, s.scene, 0, &second.loop), KNURL_ERROR_STATE, second);
    check_message("HIP 0");
    check_message("in use by another loop");
    assert_int_equal(other.starts, starts); /* nothing was started */
    CHECK_CLOSE(motor(), 0.4, 0.01);        /* and the first one continues */
    assert_int_equal(make_loop(device, s.scene, 1, &second.loop), KNURL_OK);
    knurl_loop_destroy(second.loop);
    knurl_loop_destroy(s.loop);
    knurl_device_close(s.device);
    knurl_device_close(device);
    knurl_scene_destroy(s.scene);
    check_all_gone();
}

TEST(a_loop_that_could_not_be_made_leaves_its_device_and_hip_to_others) {
    knurl_loop *loop = NULL;
    set_up_without_loop(0);
    assert_int_equal(make_loop(s.device, s.scene, 7, &loop), KNURL_ERROR_ARGUMENT); /* no such HIP */
    s.home.start_gives = KNURL_ERROR_DEVICE_LOST;
    assert_int_equal(make_loop(s.device, s.scene, 0, &loop), KNURL_ERROR_DEVICE_LOST);
    s.home.start_gives = KNURL_OK;
    assert_int_equal(make_loop(s.device, s.scene, 0, &loop), KNURL_OK);
    knurl_loop_destroy(loop);
    end_device_and_scene();
}

/* Threads that make a loop at the same moment. */
typedef struct rival {
    knurl_device *device;
    knurl_scene *scene;
    uint32_t *go; /* atomic */
    knurl_loop *loop;
    knurl_result result;
} rival;

static void *make_as_rival(void *user) {
    rival *r = user;
    while (!knurl_load_acquire(r->go)) {}
    r->result = make_loop(r->device, r->scene, 0, &r->loop);
    return NULL;
}

/* Two loops on HIP 0 at once, on one device or on two. Returns how many were made. */
static int race(knurl_device *first, knurl_device *second) {
    uint32_t go = 0;
    rival rivals[2] = {{first, s.scene, &go, NULL, KNURL_OK}, {second, s.scene, &go, NULL, KNURL_OK}};
    pthread_t threads[2];
    int made = 0;
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, make_as_rival, &rivals[i]), 0);
    }
    knurl_store_release(&go, 1u);
    for (size_t i = 0; i < 2; i++) {
        assert_int_equal(pthread_join(threads[i], NULL), 0);
        assert_true(rivals[i].result == KNURL_OK || rivals[i].result == KNURL_ERROR_STATE);
        made += rivals[i].result == KNURL_OK;
    }
    for (size_t i = 0; i < 2; i++) {
        knurl_loop_destroy(rivals[i].loop);
    }
    return made;
}

TEST(of_two_threads_that_make_a_loop_of_the_same_at_once_one_does) {
    static home other;
    knurl_device *device = home_open(&other, 0);
    set_up_without_loop(0);
    int turns_with_two = 0;
    for (int turn = 0; turn < 200; turn++) {
        turns_with_two += race(s.device, turn % 2 ? s.device : device) == 2;
    }
    /* (two may be made one after the other, if the first thread is late; never while both exist) */
    assert_int_equal(turns_with_two, 0);
    knurl_device_close(device);
    end_device_and_scene();
}

TEST(changes_of_a_device_or_hip_under_its_loop_are_refused) {
    knurl_hip_desc hip;
    knurl_stroke_desc stroke;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    const double row[4] = {0.0, 0.0, 0.0, 0.0};
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    assert_int_equal(knurl_device_open("fake", &device), KNURL_OK);
    s.scene = wall_scene(&s.books);
    assert_int_equal(make_loop(device, s.scene, 0, &loop), KNURL_OK);
    assert_int_equal(knurl_scene_configure_hip(s.scene, 0, &hip), KNURL_ERROR_STATE);
    check_message("HIP 0");
    assert_int_equal(knurl_scene_configure_hip(s.scene, 1, &hip), KNURL_OK); /* which is not in use */
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_STATE);
    check_message("in use");
    assert_int_equal(knurl_fake_set_trace(device, row, 1), KNURL_OK); /* a loop that is stepped ticks on this thread */
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_ERROR_STATE);
    assert_int_equal(knurl_fake_set_trace(device, row, 1), KNURL_ERROR_STATE);
    check_message("in use");
    const knurl_tick_input input = {.position = {0.0, 0.0, -0.001}};
    knurl_tick_output output;
    assert_int_equal(knurl_scene_tick(s.scene, 0, &input, &output), KNURL_ERROR_STATE);
    assert_true(output.force[2] == 0.0);
    knurl_loop_destroy(loop);
    assert_int_equal(knurl_scene_configure_hip(s.scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(knurl_fake_set_trace(device, row, 1), KNURL_OK);
    assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_OK);
    knurl_device_close(device);
    knurl_scene_destroy(s.scene);
}
