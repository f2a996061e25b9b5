/* The rules of [game thread] (knurl/base.h): threads with their own scenes, devices and loops need no order; threads
 * that share them take turns, in any order. SPDX-License-Identifier: MIT */
#include "support/scenes.h"

#include "base/system.h"

#include <knurl/knurl.h>

enum { GAMES = 3, ROUNDS = 8, TICKS = 50 };

typedef struct game {
    surface_parts parts;
    uint64_t ticks; /* run; fewer if a call failed, for assertions are the main thread's */
} game;

static uint64_t play(const game *g) {
    knurl_loop_desc desc;
    knurl_loop_stats stats;
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_loop_stats_init(&stats, sizeof stats);
    stats.ticks = 0;
    if (!knurl_scene_create(NULL, &scene) && !knurl_scene_add_surface(scene, &g->parts.desc, NULL) &&
        !knurl_scene_commit(scene) && !knurl_device_open("fake", &device)) {
        desc.scene = scene;
        desc.device = device;
        if (!knurl_loop_create(&desc, &loop) && !knurl_loop_step(loop, TICKS)) {
            (void)knurl_loop_get_stats(loop, &stats);
        }
    }
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return stats.ticks;
}

static void play_rounds(void *self) {
    game *g = self;
    for (int i = 0; i < ROUNDS; i++) {
        g->ticks += play(g);
    }
}

TEST(games_with_objects_of_their_own_run_at_once) {
    knurl_thread *threads[GAMES];
    game games[GAMES];
    for (int i = 0; i < GAMES; i++) {
        games[i].parts = surface_plane();
        (void)surface_ready(&games[i].parts);
        games[i].ticks = 0;
    }
    for (int i = 0; i < GAMES; i++) {
        threads[i] = knurl_system_start_thread(play_rounds, &games[i], (size_t)1 << 20);
        assert_non_null(threads[i]);
    }
    for (int i = 0; i < GAMES; i++) {
        knurl_system_join_thread(threads[i]);
    }
    for (int i = 0; i < GAMES; i++) {
        assert_int_equal(games[i].ticks, ROUNDS * TICKS);
    }
}

static void step(void *loop) {
    (void)knurl_loop_step(loop, TICKS);
}

TEST(a_game_may_move_from_thread_to_thread) {
    surface_parts parts = surface_plane();
    knurl_loop_desc desc;
    knurl_loop_stats stats;
    knurl_scene *scene;
    knurl_device *device;
    knurl_loop *loop;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_int_equal(knurl_device_open("fake", &device), KNURL_OK);
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_loop_stats_init(&stats, sizeof stats);
    desc.scene = scene;
    desc.device = device;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    for (int i = 0; i < GAMES; i++) {
        knurl_thread *thread = knurl_system_start_thread(step, loop, (size_t)1 << 20);
        assert_non_null(thread);
        knurl_system_join_thread(thread);
    }
    assert_int_equal(knurl_loop_get_stats(loop, &stats), KNURL_OK);
    assert_int_equal(stats.ticks, GAMES * TICKS);
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
}
