/* A tick asks for no memory, takes no lock, waits for nothing and writes nothing. Linked with --wrap for the functions
 * that would (CMakeLists.txt), and then run where the kernel kills whoever asks it for anything.
 * SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* fork(), syscall() */

#include "support/scenes.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

#define TICKS 10000

/* Of anything that is wrapped, by whatever thread. Volatile: compilers know that malloc() changes nothing of ours. */
static volatile uint64_t calls;

static void count_call(void) {
    (void)__atomic_fetch_add(&calls, 1, __ATOMIC_RELAXED);
}

#define WRAP(type, name, parameters, arguments)                                                                        \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters {                                                                                    \
        count_call();                                                                                                  \
        return __real_##name arguments;                                                                                \
    }

WRAP(void *, malloc, (size_t size), (size))
WRAP(void *, calloc, (size_t count, size_t size), (count, size))
WRAP(void *, realloc, (void *memory, size_t size), (memory, size))
WRAP(int, posix_memalign, (void **memory, size_t alignment, size_t size), (memory, alignment, size))
WRAP(int, pthread_mutex_lock, (pthread_mutex_t * mutex), (mutex))
WRAP(int, pthread_mutex_trylock, (pthread_mutex_t * mutex), (mutex))
WRAP(int, pthread_mutex_unlock, (pthread_mutex_t * mutex), (mutex))
WRAP(int, pthread_cond_wait, (pthread_cond_t * condition, pthread_mutex_t *mutex), (condition, mutex))
WRAP(int, pthread_cond_signal, (pthread_cond_t * condition), (condition))
WRAP(int, pthread_cond_broadcast, (pthread_cond_t * condition), (condition))
WRAP(int, pthread_create, (pthread_t * thread, const pthread_attr_t *how, void *(*entry)(void *), void *argument),
     (thread, how, entry, argument))
WRAP(int, nanosleep, (const struct timespec *wanted, struct timespec *left), (wanted, left))
WRAP(int, clock_nanosleep, (clockid_t clock, int how, const struct timespec *wanted, struct timespec *left),
     (clock, how, wanted, left))
WRAP(int, clock_gettime, (clockid_t clock, struct timespec *now), (clock, now))
WRAP(FILE *, fopen, (const char *path, const char *mode), (path, mode))
WRAP(size_t, fwrite, (const void *data, size_t size, size_t count, FILE *file), (data, size, count, file))
WRAP(int, fputs, (const char *text, FILE *file), (text, file))
WRAP(int, vfprintf, (FILE * file, const char *format, va_list arguments), (file, format, arguments))
WRAP(int, vsnprintf, (char *text, size_t size, const char *format, va_list arguments), (text, size, format, arguments))

void __real_free(void *memory);
void __wrap_free(void *memory);
void __wrap_free(void *memory) {
    count_call();
    __real_free(memory);
}

/* Those that take any number of arguments. */
int __wrap_printf(const char *format, ...);
int __wrap_fprintf(FILE *file, const char *format, ...);
int __wrap_snprintf(char *text, size_t size, const char *format, ...);

int __wrap_printf(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    count_call();
    const int written = __real_vfprintf(stdout, format, arguments);
    va_end(arguments);
    return written;
}

int __wrap_fprintf(FILE *file, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    count_call();
    const int written = __real_vfprintf(file, format, arguments);
    va_end(arguments);
    return written;
}

int __wrap_snprintf(char *text, size_t size, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    count_call();
    const int written = __real_vsnprintf(text, size, format, arguments);
    va_end(arguments);
    return written;
}

static double hills(double x, double y) {
    return 0.002 * sin(60.0 * x) * cos(45.0 * y);
}

static void add_touched(knurl_scene *scene, surface_parts *parts, int32_t method, double x) {
    set_grating(parts, method, 1000.0, 500.0, 0.0003);
    parts->material.damping = 0.5;
    parts->desc.position[0] = x;
    (void)add_surface(scene, parts);
}

/* A plane and hills of 10,000 triangles side by side; they overlap by 10 mm. */
static void add_plane_and_mesh(knurl_scene *scene, int32_t method) {
    shape mesh = shape_sheet(100, 50, (const double[2]){0.05, 0.05}, hills);
    surface_parts plane = surface_plane();
    surface_parts sheet = surface_mesh(&mesh);
    assert_int_equal(mesh.index_count / 3, 10000);
    add_touched(scene, &plane, method, 0.0);
    add_touched(scene, &sheet, method, 0.09);
    shape_free(&mesh);
}

/* What is stroked: surfaces that reach from x = -0.05 to 0.14 m at z = 0, or thereabouts. */
static const struct stroked {
    const char *name;
    void (*add)(knurl_scene *scene, int32_t method);
    int32_t method;
} scenes[] = {
    {"plane and mesh, S1", add_plane_and_mesh, KNURL_S1},
    {"plane and mesh, S2", add_plane_and_mesh, KNURL_S2},
};

/* Committed, FOAW at the Touch's resolution. */
static knurl_scene *make_scene(const struct stroked *what) {
    knurl_scene *scene = empty_scene(1);
    knurl_workspace workspace;
    knurl_hip_desc hip;
    what->add(scene, what->method);
    knurl_workspace_init(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.velocity_method = KNURL_VELOCITY_FOAW;
    hip.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* Strokes over both surfaces, entering and leaving, over the outline as well; a NaN now and then. Plain sums for the
 * path: nothing here may call anything either. Returns the ticks in contact. */
static uint64_t stroke(knurl_scene *scene) {
    uint64_t contact_ticks = 0;
    double x = -0.06;
    double z = 0.006;
    double vx = 0.00021;
    double vz = -0.00003;
    for (int k = 0; k < TICKS; k++) {
        x += vx;
        z += vz;
        vx = x > 0.15 || x < -0.06 ? -vx : vx;
        vz = z > 0.006 || z < -0.004 ? -vz : vz;
        knurl_tick_input input = {{x, 0.003 + 0.1 * z, z}, {0.0, 0.0, 0.0}, 0, 0};
        if (k % 1000 == 999) {
            input.position[1] = (double)NAN;
        }
        knurl_tick_output out;
        knurl_hip_counts counts;
        (void)knurl_scene_tick(scene, 0, &input, &out);
        (void)knurl_scene_get_tick(scene, 0, &out, &counts);
        contact_ticks = counts.contact_ticks;
    }
    return contact_ticks;
}

static void check_counts(const knurl_scene *scene, int32_t method) {
    knurl_hip_counts counts;
    assert_int_equal(knurl_scene_get_tick(scene, 0, NULL, &counts), KNURL_OK);
    assert_in_range(counts.contact_ticks, TICKS / 5, TICKS * 4 / 5);
    assert_int_equal(counts.not_finite, TICKS / 1000);
    assert_true((counts.events > 100) == (method == KNURL_S2));
}

TEST(whatever_is_wrapped_is_noticed) {
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    const struct timespec none = {0, 0};
    struct timespec now;
    uint64_t before = calls;
    void *volatile memory = malloc(1); /* else neither call is made */
    free(memory);
    assert_true(calls == before + 2);
    before = calls;
    (void)pthread_mutex_lock(&mutex);
    (void)pthread_mutex_unlock(&mutex);
    assert_true(calls == before + 2);
    before = calls;
    (void)nanosleep(&none, NULL);
    (void)clock_nanosleep(CLOCK_MONOTONIC, 0, &none, NULL);
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    assert_true(calls == before + 3);
    before = calls;
    FILE *file = fopen("/dev/null", "w");
    if (file) {
        (void)fprintf(file, "%d", (int)(before % 10));
        (void)fwrite(&now, sizeof now, 1, file);
        (void)fclose(file);
    }
    assert_true(calls >= before + 3); /* what these ask for counts too */
    before = calls;
    (void)knurl_fail(KNURL_ERROR_STATE, "the library's calls are seen as well");
    assert_true(calls > before);
}

TEST(ticks_ask_for_no_memory_and_wait_for_nobody) {
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        const uint64_t at_start = calls;
        knurl_scene *scene = make_scene(&scenes[i]);
        assert_true(calls > at_start + 10); /* the wrapping works */
        const uint64_t before = calls;
        (void)stroke(scene);
        if (calls != before) {
            fail_msg("%s: %u calls", scenes[i].name, (unsigned)(calls - before));
        }
        check_counts(scene, scenes[i].method);
        knurl_scene_destroy(scene);
    }
}

TEST(estimators_and_gratings_ask_for_nothing) {
    knurl_velocity velocities[2];
    knurl_grating gratings[2] = {{{1000.0, 500.0}, 0.0003, 1000.0, KNURL_S1, 0},
                                 {{1000.0, 500.0}, 0.0003, 1000.0, KNURL_S2, 0}};
    knurl_grating_state states[2];
    memset(states, 0, sizeof states);
    assert_int_equal(knurl_velocity_init(KNURL_VELOCITY_FOAW, 0.055e-3, 1000.0, &velocities[0]), KNURL_OK);
    assert_int_equal(knurl_velocity_init(KNURL_VELOCITY_DIFFERENCE, 0.0, 1000.0, &velocities[1]), KNURL_OK);
    const uint64_t before = calls;
    for (int k = 0; k < TICKS; k++) {
        const double position[3] = {0.1 * sin(k * 0.01), 0.1 * cos(k * 0.007), 0.0};
        for (size_t i = 0; i < 2; i++) {
            knurl_grating_output output;
            double velocity[3];
            if (k % 500 == 499) {
                knurl_velocity_reset(&velocities[i]);
            }
            knurl_velocity_update(&velocities[i], position, velocity);
            knurl_grating_step(&gratings[i], &states[i], position, velocity, &output);
        }
    }
    assert_true(calls == before);
    assert_true(states[1].event_count > 100);
}

/* 0 where a child could do its strokes with no system call but its exit. */
static int run_strictly(knurl_scene *scene, int ask_for_something) {
    int status = -1;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const unsigned long strict = 1; /* SECCOMP_MODE_STRICT: read, write, exit; SIGKILL for anything else */
        if (prctl(PR_SET_SECCOMP, strict) != 0) {
            (void)syscall(SYS_exit, 77);
        }
        const uint64_t contact_ticks = stroke(scene);
        if (ask_for_something) {
            (void)syscall(SYS_getppid);
        }
        (void)syscall(SYS_exit, contact_ticks > TICKS / 5 ? 0 : 1);
    }
    assert_true(waitpid(child, &status, 0) == child);
    return status;
}

TEST(ticks_make_no_system_call) {
    if (SANITIZED) {
        print_message("skipped: sanitizers make system calls of their own\n");
        skip();
    }
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        knurl_scene *scene = make_scene(&scenes[i]);
        const int status = run_strictly(scene, 0);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
            knurl_scene_destroy(scene);
            print_message("skipped: this kernel refuses seccomp's strict mode\n");
            skip();
        }
        assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        assert_true(WIFSIGNALED(run_strictly(scene, 1))); /* a call would have been noticed */
        knurl_scene_destroy(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whatever_is_wrapped_is_noticed),
        cmocka_unit_test(ticks_ask_for_no_memory_and_wait_for_nobody),
        cmocka_unit_test(estimators_and_gratings_ask_for_nothing),
        cmocka_unit_test(ticks_make_no_system_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
