/* The headers' marks of threads: each rule broken ends the program with a sentence, and an allowed call does not.
 * SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "support/idle_device.h"
#include "support/own.h"
#include "support/scenes.h"

#include <knurl/knurl.h>

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

/* A scene and a device, and a deed for once within a tick of the one or the start of the other. */
typedef struct place {
    knurl_scene *scene;
    knurl_device *device;
    void (*then)(struct place *p);
    int is_ready, is_over; /* a new method is tried once, before the scene is there */
} place;

typedef void (*deed)(place *p);

static void do_once(place *p) {
    if (p->is_ready && !p->is_over) {
        p->is_over = 1;
        p->then(p);
    }
}

static double act_in_tick(const knurl_method_input *input, double *memory, void *user) KNURL_NONBLOCKING {
    (void)input, (void)memory;
    do_once(user); /* NOLINT(clang-diagnostic-function-effects): the rules are broken on purpose */
    return 1.0;
}

static knurl_result act_in_start(void *user, double rate) {
    (void)rate;
    do_once(user);
    return KNURL_OK;
}

static void open_place(place *p) {
    surface_parts parts = surface_plane();
    knurl_device_functions functions = idle_functions();
    functions.user = p;
    functions.start = act_in_start;
    set_grating(&parts, own_add("acts", 1.0, act_in_tick, p), 1000.0, 0.0, 0.001);
    p->scene = empty_scene(2);
    (void)add_surface(p->scene, &parts);
    configure_plainly(p->scene, 0);
    configure_plainly(p->scene, 1);
    assert_int_equal(knurl_scene_commit(p->scene), KNURL_OK);
    assert_int_equal(knurl_device_open_functions(&functions, &p->device), KNURL_OK);
    p->is_ready = 1;
}

typedef struct job {
    deed what;
    place *where;
} job;

static void *run(void *user) {
    const job *given = user;
    given->what(given->where);
    return NULL;
}

static void elsewhere(place *p, deed what) {
    pthread_t thread;
    job given = {what, p};
    assert_int_equal(pthread_create(&thread, NULL, run, &given), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
}

static void tick(place *p) {
    (void)tick_at(p->scene, 0.0, 0.0, -0.001);
}
static void tick_other_hip(place *p) {
    const knurl_tick_input input = {.position = {0.0, 0.0, -0.001}};
    knurl_tick_output output;
    (void)knurl_scene_tick(p->scene, 1, &input, &output);
}
static void start(place *p) {
    (void)knurl_device_start(p->device, 1000.0);
}
static void close_device(place *p) {
    knurl_device_close(p->device);
}
static void destroy(place *p) {
    knurl_scene_destroy(p->scene);
}
static void collect(place *p) {
    knurl_scene_collect(p->scene);
}
static void configure(place *p) {
    configure_plainly(p->scene, 0);
}
static void configure_other_hip(place *p) {
    configure_plainly(p->scene, 1);
}
static void ask(place *p) {
    (void)knurl_scene_get_workspace(p->scene, 0, &(knurl_workspace){.scale = 1.0});
}
static void list(place *p) {
    (void)p;
    (void)knurl_device_list(NULL, 0);
}

static void call_back(const knurl_tick_output *output, void *user) {
    (void)output;
    ((place *)user)->is_ready = 1;
    do_once(user);
}

static void step_a_loop(place *p) {
    knurl_loop_desc desc;
    knurl_loop *loop;
    knurl_loop_desc_init(&desc, sizeof desc);
    p->is_ready = 0; /* until the callback: not in the device's start */
    desc.scene = p->scene;
    desc.device = p->device;
    desc.tick_callback = call_back;
    desc.user = p;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_step(loop, 3), KNURL_OK);
    knurl_loop_destroy(loop);
}

#define THERE(name, what)                                                                                              \
    static void name(place *p) {                                                                                       \
        elsewhere(p, what);                                                                                            \
    }
THERE(tick_there, tick)
THERE(tick_other_hip_there, tick_other_hip)
THERE(start_there, start)
THERE(close_there, close_device)
THERE(destroy_there, destroy)
THERE(collect_there, collect)
THERE(configure_there, configure)
THERE(configure_other_hip_there, configure_other_hip)

/* The standard error of a process that does `outer`, and `inner` within it. Returns its signal, or 0. */
static int signal_of(deed outer, deed inner, char *said, size_t size) {
    int ends[2], status;
    size_t length = 0;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        place p = {.then = inner};
        (void)dup2(ends[1], STDERR_FILENO);
        (void)signal(SIGABRT, SIG_DFL); /* not the suite's */
        open_place(&p);
        outer(&p);
        _exit(p.is_over ? 0 : 1);
    }
    (void)close(ends[1]);
    for (ssize_t got; (got = read(ends[0], said + length, size - 1 - length)) > 0;) {
        length += (size_t)got;
    }
    said[length] = 0;
    (void)close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

static void check_ends(deed outer, deed inner, const char *function, const char *rule, const char *with) {
    char said[1024], expected[160];
    const int found = signal_of(outer, inner, said, sizeof said);
    (void)snprintf(expected, sizeof expected, "knurl: %s() is for %s", function, rule);
    if (found != SIGABRT || !strstr(said, expected) || !strstr(said, with)) {
        fail_msg("expected the end with '%s' and '%s', found signal %d and '%s'", expected, with, found, said);
    }
}

static void check_goes_on(deed outer, deed inner) {
    char said[1024];
    assert_int_equal(signal_of(outer, inner, said, sizeof said), 0);
    assert_string_equal(said, "");
}

TEST(within_a_tick_nothing_may_wait) {
    check_ends(tick, collect, "knurl_scene_collect", "any thread but the haptic", "within knurl_scene_tick()");
    check_ends(tick, list, "knurl_device_list", "the game thread", "within knurl_scene_tick()");
    check_ends(step_a_loop, ask, "knurl_scene_get_workspace", "any thread but the haptic", "within knurl_loop_tick()");
}

TEST(a_hip_is_ticked_by_one_thread_at_a_time) {
    check_ends(tick, tick_there, "knurl_scene_tick", "the haptic thread", "another thread's knurl_scene_tick()");
    check_goes_on(tick, tick_other_hip_there);
}

TEST(a_hip_is_not_configured_while_it_is_ticked) {
    check_ends(tick, configure_there, "knurl_scene_configure_hip", "the game thread",
               "another thread's knurl_scene_tick()");
    check_goes_on(tick, configure_other_hip_there);
}

TEST(of_the_game_threads_calls_one_runs_at_a_time) {
    check_ends(start, start_there, "knurl_device_start", "the game thread", "another thread's knurl_device_start()");
    check_goes_on(start, configure_there); /* of another object */
}

TEST(nothing_is_destroyed_while_it_is_used) {
    check_ends(start, close_there, "knurl_device_close", "a time in which", "another thread's knurl_device_start()");
    check_ends(tick, destroy_there, "knurl_scene_destroy", "a time in which", "another thread's knurl_scene_tick()");
}

TEST(edits_go_on_while_a_hip_is_ticked) {
    check_goes_on(tick, collect_there);
}
