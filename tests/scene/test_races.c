/* Functions for any thread, against concurrent changes. ThreadSanitizer checks the accesses themselves; without it, no
 * reader may see a mix of two states. SPDX-License-Identifier: MIT */
#include "device/core/home.h"
#include "scene/ask.h"

#include <knurl/knurl.h>

#include <pthread.h>

#define LASTING 100000000 /* ns for which a test's threads go on */

static uint32_t over; /* atomic */

static int is_over(void) {
    return (int)knurl_load_acquire(&over);
}

/* Has `other` run on a thread of its own while `here` is called again and again. */
static void together(void *(*other)(void *), void (*here)(void *), void *user) {
    pthread_t thread;
    over = 0;
    assert_int_equal(pthread_create(&thread, NULL, other, user), 0);
    const int64_t until = now_ns() + LASTING;
    while (now_ns() < until) {
        here(user);
    }
    knurl_store_release(&over, 1u);
    assert_int_equal(pthread_join(thread, NULL), 0);
}

/* --- a HIP's snapshot, workspace and limits while it is reconfigured --- */

static uint64_t torn; /* atomic */

/* The force is a spring's at the depth, 400 N/m; before the first tick all is 0. */
static void *read_snapshots(void *user) {
    while (!is_over()) {
        knurl_tick_output out;
        knurl_hip_counts counts;
        if (knurl_scene_get_tick(user, 0, &out, &counts) != KNURL_OK || fabs(out.force[2] - 400.0 * out.depth) > 1e-9 ||
            (counts.ticks > 0) != (out.depth > 0.0) || (counts.ticks > 0 && out.tick != counts.ticks - 1)) {
            knurl_count_up(&torn);
        }
    }
    return NULL;
}

static void configure_and_tick(void *user) {
    static uint32_t number;
    configure_plainly(user, 0);
    for (int i = 0; i < 4; i++) {
        (void)tick_at(user, 0.0, 0.0, -0.0001 * (double)(1 + number++ % 10));
    }
}

TEST(a_snapshot_is_whole_while_its_hip_is_configured_anew) {
    SCOPED_SCENE *scene = scene_of_plane();
    torn = 0;
    together(read_snapshots, configure_and_tick, scene);
    assert_true(torn == 0);
}

/* The origin's three numbers are the same, and the scale goes with them. */
static void *read_workspace(void *user) {
    while (!is_over()) {
        knurl_workspace w;
        if (knurl_scene_get_workspace(user, 0, &w) != KNURL_OK || w.origin[0] != w.origin[1] ||
            w.origin[1] != w.origin[2] || w.scale != 1.0 + w.origin[0]) {
            knurl_count_up(&torn);
        }
    }
    return NULL;
}

static void configure_places(void *user) {
    static uint32_t number;
    knurl_workspace w;
    knurl_hip_desc desc;
    knurl_workspace_set_identity(&w);
    w.origin[0] = w.origin[1] = w.origin[2] = (double)(number++ % 8);
    w.scale = 1.0 + w.origin[0];
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.workspace = &w;
    assert_int_equal(knurl_scene_configure_hip(user, 0, &desc), KNURL_OK);
}

TEST(a_workspace_is_whole_while_its_hip_is_configured_anew) {
    SCOPED_SCENE *scene = empty_scene(1);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    configure_places(scene);
    torn = 0;
    together(read_workspace, configure_places, scene);
    assert_true(torn == 0);
}

/* --- a surface's name and report while it is replaced --- */

static knurl_surface_id renamed;

static void *read_names(void *user) {
    while (!is_over()) {
        char name[KNURL_NAME_SIZE];
        if (knurl_scene_get_surface_name(user, renamed, name) != KNURL_OK ||
            (strcmp(name, "a short name") != 0 && strcmp(name, "another name, which is longer") != 0)) {
            knurl_count_up(&torn);
        }
    }
    return NULL;
}

static void rename_surface(void *user) {
    static uint32_t number;
    surface_parts parts = surface_plane();
    parts.desc.name = number++ % 2 ? "a short name" : "another name, which is longer";
    assert_int_equal(knurl_scene_replace_surface(user, renamed, surface_ready(&parts)), KNURL_OK);
}

TEST(a_name_is_whole_while_its_surface_is_replaced) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    parts.desc.name = "a short name";
    renamed = add_surface(scene, &parts);
    torn = 0;
    together(read_names, rename_surface, scene);
    assert_true(torn == 0);
}

/* --- effects that are replaced while their HIP ticks --- */

/* Along x and z the same force: 0 to 4 effects of 0.1 N each. */
static void *tick_effects(void *user) {
    while (!is_over()) {
        const knurl_tick_input input = {.has_velocity = 1};
        knurl_tick_output out;
        if (knurl_scene_tick(user, 0, &input, &out) != KNURL_OK || fabs(out.force[0] - out.force[2]) > 1e-12 ||
            fabs(10.0 * out.force[0] - floor(10.0 * out.force[0] + 0.5)) > 1e-9) {
            knurl_count_up(&torn);
        }
    }
    return NULL;
}

static void replace_effects(void *user) {
    static uint32_t number;
    knurl_effect effects[KNURL_EFFECTS_MAX];
    for (int i = 0; i < KNURL_EFFECTS_MAX; i++) {
        assert_int_equal(knurl_effect_prepare(KNURL_EFFECT_FORCE, &effects[i]), KNURL_OK);
        effects[i].axis[1] = 0.0;
        effects[i].axis[i % 2 ? 0 : 2] = 1.0;
        effects[i].max_force = 0.1;
    }
    assert_int_equal(knurl_scene_set_effects(user, 0, effects, 2 * (number++ % 5), 0.01), KNURL_OK);
}

TEST(a_tick_sees_all_effects_of_an_edit_or_none) {
    SCOPED_SCENE *scene = empty_scene(1);
    (void)commit_plainly(scene);
    torn = 0;
    together(tick_effects, replace_effects, scene);
    assert_true(torn == 0);
}

/* --- ticks that do not wait for the commit --- */

static void *tick_until_committed(void *user) {
    const knurl_tick_input input = {.position = {0.0, 0.0, -0.001}};
    knurl_tick_output out;
    knurl_result result;
    do {
        result = knurl_scene_tick(user, 0, &input, &out);
    } while (result == KNURL_ERROR_STATE);
    if (result != KNURL_OK || !(fabs(out.force[2] - 0.4) < 1e-9)) {
        knurl_count_up(&torn);
    }
    return NULL;
}

TEST(a_tick_sees_the_commit_and_all_that_came_before_it) {
    torn = 0;
    for (int turn = 0; turn < 100; turn++) {
        pthread_t thread;
        surface_parts parts = surface_plane();
        SCOPED_SCENE *scene = empty_scene(1);
        (void)add_surface(scene, &parts);
        configure_plainly(scene, 0);
        assert_int_equal(pthread_create(&thread, NULL, tick_until_committed, scene), 0);
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        assert_int_equal(pthread_join(thread, NULL), 0);
    }
    assert_true(torn == 0);
}

/* --- a device's information and a loop's, while the loop searches for the device --- */

static void *ask_device(void *user) {
    while (!is_over()) {
        knurl_device_info info;
        knurl_device_status status;
        knurl_device_event event;
        knurl_device_info_init(&info, sizeof info);
        knurl_device_status_init(&status, sizeof status);
        if (knurl_device_get_info(user, &info) || knurl_device_get_status(user, &status) ||
            info.max_force != HOME_FORCE) {
            knurl_count_up(&torn);
        }
        while (knurl_device_next_event(user, &event)) {}
        sleep_ns(200000);
    }
    return NULL;
}

static void no_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)sample;
    (void)user;
    force[0] = force[1] = force[2] = 0.0;
}

static void lose_and_find(uint32_t blocking) {
    static home h;
    pthread_t thread;
    knurl_loop_desc desc;
    knurl_loop *loop = NULL;
    SCOPED_DEVICE *device = home_open(&h, blocking);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = device;
    desc.force_callback = no_force;
    desc.reconnect = 1;
    desc.tick_limit = UINT64_MAX;
    desc.update_rate_hz = 10000.0; /* so fast that cycles are late, which is counted at the device */
    over = 0;
    torn = 0;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(pthread_create(&thread, NULL, ask_device, device), 0);
    assert_int_equal(knurl_loop_start(loop), KNURL_OK);
    home_inject(&h, DOUBLE_UNPLUG);
    wait_for_count(&h.reopens, 1);
    home_inject(&h, DOUBLE_WELL);
    wait_for_count(&h.reads, knurl_load_relaxed(&h.reads) + 50);
    knurl_store_release(&over, 1u);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_true(torn == 0);
    knurl_loop_destroy(loop);
}

TEST(a_device_can_be_asked_while_it_is_lost_and_found) {
    lose_and_find(0);
    lose_and_find(1);
}

/* --- a loop's statistics while it starts --- */

static void *read_stats(void *user) {
    while (!is_over()) {
        knurl_loop_stats stats;
        knurl_loop_stats_init(&stats, sizeof stats);
        if (knurl_loop_get_stats(user, &stats)) {
            knurl_count_up(&torn);
        }
    }
    return NULL;
}

TEST(a_loops_statistics_can_be_read_while_it_starts_and_ends) {
    for (int turn = 0; turn < 5; turn++) {
        static home h;
        pthread_t thread;
        knurl_loop_desc desc;
        knurl_loop *loop = NULL;
        SCOPED_DEVICE *device = home_open(&h, 0);
        knurl_loop_desc_init(&desc, sizeof desc);
        desc.device = device;
        desc.force_callback = no_force;
        desc.tick_limit = 30;
        desc.reconnect = 1;
        over = 0;
        torn = 0;
        assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
        assert_int_equal(pthread_create(&thread, NULL, read_stats, loop), 0);
        assert_int_equal(knurl_loop_start(loop), KNURL_OK);
        assert_int_equal(knurl_loop_wait(loop, 10.0), 1);
        knurl_store_release(&over, 1u);
        assert_int_equal(pthread_join(thread, NULL), 0);
        assert_true(torn == 0);
        knurl_loop_destroy(loop);
    }
}
