/* A tick allocates no memory, takes no lock, never waits and writes nothing. Linked with --wrap for the functions that
 * would (CMakeLists.txt), and then run under seccomp, which kills on a system call. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* fork(), syscall() */

#include "full_model.h"
#include "scene/ask.h"
#include "support/own.h"

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

#define TICKS    10000
#define SEGMENTS 20 /* of a stroke; edits, if a scene has any, come in between */

/* Calls of wrapped functions, by any thread. Volatile, because compilers assume that malloc() does not change it. */
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

/* Those that take any number of arguments, by the function that takes them as a list. */
#define WRAP_ANY(name, parameters, by_list)                                                                            \
    int __wrap_##name parameters;                                                                                      \
    int __wrap_##name parameters {                                                                                     \
        va_list arguments;                                                                                             \
        va_start(arguments, format);                                                                                   \
        count_call();                                                                                                  \
        const int written = by_list;                                                                                   \
        va_end(arguments);                                                                                             \
        return written;                                                                                                \
    }

WRAP_ANY(printf, (const char *format, ...), __real_vfprintf(stdout, format, arguments))
WRAP_ANY(fprintf, (FILE * file, const char *format, ...), __real_vfprintf(file, format, arguments))
WRAP_ANY(snprintf, (char *text, size_t size, const char *format, ...), __real_vsnprintf(text, size, format, arguments))

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
static void add_plane_and_mesh(knurl_scene *scene, int32_t method, double friction) {
    SCOPED_SHAPE mesh = shape_sheet(100, 50, (const double[2]){0.05, 0.05}, hills);
    surface_parts plane = surface_plane();
    surface_parts sheet = surface_mesh(&mesh);
    assert_int_equal(mesh.index_count / 3, 10000);
    plane.material.friction = sheet.material.friction = friction;
    add_touched(scene, &plane, method, 0.0);
    add_touched(scene, &sheet, method, 0.09);
}

/* The same, smooth and coarser. */
static void add_plane_and_smooth_mesh(knurl_scene *scene, int32_t method, double friction) {
    SCOPED_SHAPE mesh = shape_sheet(16, 12, (const double[2]){0.05, 0.05}, hills);
    float normals[3 * 17 * 13];
    surface_parts plane = surface_plane();
    surface_parts sheet = surface_mesh(&mesh);
    assert_int_equal(3 * mesh.vertex_count, COUNT_OF(normals));
    for (size_t i = 0; i < COUNT_OF(normals); i += 3) {
        const double x = (double)mesh.positions[i], y = (double)mesh.positions[i + 1];
        const double slopes[2] = {0.12 * cos(60.0 * x) * cos(45.0 * y), -0.09 * sin(60.0 * x) * sin(45.0 * y)};
        const double size = sqrt(1.0 + slopes[0] * slopes[0] + slopes[1] * slopes[1]);
        normals[i] = (float)(-slopes[0] / size);
        normals[i + 1] = (float)(-slopes[1] / size);
        normals[i + 2] = (float)(1.0 / size);
    }
    sheet.mesh.normals = normals;
    plane.material.friction = sheet.material.friction = friction;
    add_touched(scene, &plane, method, 0.0);
    add_touched(scene, &sheet, method, 0.09);
}

/* A floor of 40 x 50 tiles side by side: more than a HIP can keep in view, and one hands it over to the next. */
static void add_tiles(knurl_scene *scene, int32_t method, double friction) {
    surface_parts tile = surface_plane();
    tile.plane.half_extents[0] = tile.plane.half_extents[1] = 0.0025;
    tile.material.friction = friction;
    for (int i = 0; i < 2000; i++) {
        tile.desc.position[1] = -0.125 + 0.005 * (double)(i / 40);
        add_touched(scene, &tile, method, -0.0525 + 0.005 * (i % 40));
    }
}

/* Both surfaces move for most of each segment; every fifth time one of them jumps. */
static void move_both(knurl_scene *scene, int segment) {
    for (uint32_t i = 0; i < 2; i++) {
        const double side = (segment + (int)i) % 2 ? 1.0 : -1.0;
        const double position[3] = {0.09 * i + 0.004 * side, 0.01 * side, 0.0005 * side};
        const double rotation[4] = {0.0, 0.02 * side, 0.1 * side, sqrt(1.0 - 0.0104)};
        const double seconds = segment % 5 == 4 && i == 0 ? 0.0 : 0.4;
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        assert_int_equal(knurl_scene_set_transform(scene, surface, position, rotation, seconds), KNURL_OK);
    }
}

/* A third surface crosses the others, every second time, then is taken out again. */
static void add_and_remove(knurl_scene *scene, int segment) {
    if (segment % 2 == 0) {
        surface_parts ramp = surface_plane();
        ramp.desc.rotation[1] = 0.02;
        ramp.desc.rotation[3] = sqrt(1.0 - 0.0004);
        add_touched(scene, &ramp, KNURL_METHOD_S2, 0.045);
    } else {
        assert_int_equal(knurl_scene_remove_surface(scene, knurl_scene_get_surface(scene, 2)), KNURL_OK);
    }
}

/* From grating to smooth and back, rough and slippery. */
static void change_materials(knurl_scene *scene, int segment) {
    for (uint32_t i = 0; i < 2; i++) {
        knurl_material_desc material;
        knurl_material_desc_init(&material, sizeof material);
        material.stiffness = 300.0 + 20.0 * segment;
        material.friction = segment % 3 == 1 ? 0.5 : 0.0;
        material.amplitude = segment % 4 == 3 ? 0.0 : 0.0002;
        material.spatial_frequency[0] = 800.0 + 50.0 * segment;
        const knurl_surface_id surface = knurl_scene_get_surface(scene, i);
        assert_int_equal(knurl_scene_set_material(scene, surface, &material), KNURL_OK);
    }
}

enum { OWN = KNURL_METHOD_BANDLIMITED + 1 }; /* the first that is added */

/* The stroked surfaces: from x = -0.05 to 0.14 m, at about z = 0. */
static const struct stroked {
    const char *name;
    void (*add)(knurl_scene *scene, int32_t method, double friction);
    void (*edit)(knurl_scene *scene, int segment); /* before each segment, or null */
    int32_t method;
    uint32_t full_model;
    double friction;
    int handovers; /* from one surface straight to another, at least */
} scenes[] = {
    {"plane and mesh, S1", add_plane_and_mesh, NULL, KNURL_METHOD_S1, 0, 0.0, 0},
    {"plane and mesh, S2", add_plane_and_mesh, NULL, KNURL_METHOD_S2, 0, 0.0, 0},
    {"plane and smooth mesh", add_plane_and_smooth_mesh, NULL, KNURL_METHOD_S1, 0, 0.0, 0},
    {"plane and smooth mesh that move, friction", add_plane_and_smooth_mesh, move_both, KNURL_METHOD_S2, 0, 0.4, 0},
    {"friction", add_plane_and_mesh, NULL, KNURL_METHOD_S2, 0, 0.4, 0},
    {"all that a scene can model", add_plane_and_mesh, NULL, KNURL_METHOD_S2, KNURL_FULL_ALL, 0.4, 0},
    {"surfaces that move", add_plane_and_mesh, move_both, KNURL_METHOD_S2, 0, 0.0, 0},
    {"surfaces that move, friction", add_plane_and_mesh, move_both, KNURL_METHOD_S2, 0, 0.4, 0},
    {"surfaces that come and go", add_plane_and_mesh, add_and_remove, KNURL_METHOD_S2, 0, 0.0, 0},
    {"materials that change", add_plane_and_mesh, change_materials, KNURL_METHOD_S2, 0, 0.0, 0},
    {"plane and mesh, an own method", add_plane_and_mesh, NULL, OWN, 0, 0.0, 0},
    {"tiles", add_tiles, NULL, KNURL_METHOD_S2, 0, 0.0, 100},
    {"tiles, friction", add_tiles, NULL, KNURL_METHOD_S1, 0, 0.4, 100},
    {"tiles, every one looked at in every tick", add_tiles, NULL, KNURL_METHOD_S2, KNURL_FULL_SEARCH, 0.0, 100},
};

/* Committed, FOAW at the Touch's resolution. */
static knurl_scene *make_scene(const struct stroked *what) {
    knurl_scene *scene = NULL;
    knurl_scene_desc desc;
    knurl_hip_desc hip = hip_in_scene_axes();
    knurl_scene_desc_init(&desc, sizeof desc);
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    set_full_model(scene, what->full_model);
    assert_int_equal(own_add("copy-of-S1", 1.0, own_s1, NULL), OWN);
    what->add(scene, what->method, what->friction);
    hip.viscous = 0.0; /* every protection has work to do: loose walls, warm motors, limits */
    hip.delay = 4.0;
    hip.heat_time = 0.5;
    hip.continuous_force = 0.2;
    hip.clamp = what->method == KNURL_METHOD_S1;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* Strokes over all of it, entering and leaving, over the outline as well. The HIP's position, and the result. */
typedef struct stroke {
    double x, z;
    double vx, vz; /* m a tick */
    int tick;
    knurl_surface_id latest; /* felt in the tick before, or 0 */
    int handovers;           /* ticks that feel another than the tick before */
    int dragged;             /* ticks of one contact whose force is not along its normal */
    uint64_t contact_ticks;
} stroke;

static const stroke at_start = {-0.06, 0.006, 0.00021, -0.00003, 0, 0, 0, 0, 0};

static void note(stroke *s, const knurl_tick_output *out) {
    double along = 0.0;
    double all = 0.0;
    for (int i = 0; i < 3; i++) {
        along += out->force[i] * out->normal[i];
        all += out->force[i] * out->force[i];
    }
    s->handovers += s->latest && out->surface && out->surface != s->latest;
    s->dragged += out->contacts == 1 && all - along * along > 1e-3 * all;
    s->latest = out->surface;
}

/* One segment; a NaN now and then. Plain sums for the path: nothing here may call anything either. */
static void stroke_on(knurl_scene *scene, stroke *s) {
    for (int k = 0; k < TICKS / SEGMENTS; k++, s->tick++) {
        s->x += s->vx;
        s->z += s->vz;
        s->vx = s->x > 0.15 || s->x < -0.06 ? -s->vx : s->vx;
        s->vz = s->z > 0.006 || s->z < -0.004 ? -s->vz : s->vz;
        knurl_tick_input input = {{s->x, 0.003 + 0.1 * s->z, s->z}, {0.0, 0.0, 0.0}, 0, 0, 0.0, 0, {0}};
        if (s->tick % 1000 == 999) {
            input.position[1] = (double)NAN;
        }
        knurl_tick_output out;
        knurl_hip_counts counts;
        (void)knurl_scene_tick(scene, 0, &input, &out);
        (void)knurl_scene_get_tick(scene, 0, &out, &counts);
        note(s, &out);
        s->contact_ticks = counts.contact_ticks;
    }
}

/* Checks that the stroke had its intended contacts. */
static void check_stroke(const knurl_scene *scene, const struct stroked *what, const stroke *s) {
    const knurl_hip_counts counts = counts_of(scene);
    assert_int_equal(counts.ticks, TICKS);
    assert_in_range(counts.contact_ticks, TICKS / 5, TICKS * 4 / 5);
    assert_int_equal(counts.non_finite_ticks, TICKS / 1000);
    assert_true(counts.heat_ticks + counts.entry_ticks + counts.slew_ticks + counts.passivity_ticks > 0);
    assert_true((counts.events > 100) == (what->method == KNURL_METHOD_S2));
    assert_true(s->handovers >= what->handovers);
    if (what->friction > 0.0) {
        assert_true(s->dragged > TICKS / 10);
    }
}

TEST(every_wrapped_call_is_noticed) {
    static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
    const struct timespec none = {0, 0};
    struct timespec now;
    uint64_t before = calls;
    void *volatile memory = malloc(1); /* otherwise both calls are optimised away */
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
    assert_true(calls >= before + 3); /* calls of these are counted, too */
    before = calls;
    (void)knurl_fail(KNURL_ERROR_STATE, "the library's calls are seen as well");
    assert_true(calls > before);
}

TEST(ticks_allocate_no_memory_and_never_wait) {
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        const struct stroked *what = &scenes[i];
        const uint64_t before_all = calls;
        SCOPED_SCENE *scene = make_scene(what);
        assert_true(calls > before_all + 10); /* the wrapping works */
        stroke s = at_start;
        for (int segment = 0; segment < SEGMENTS; segment++) {
            if (what->edit) {
                what->edit(scene, segment);
            }
            const uint64_t before = calls;
            stroke_on(scene, &s);
            if (calls != before) {
                fail_msg("%s: %u calls in segment %d", what->name, (unsigned)(calls - before), segment);
            }
        }
        check_stroke(scene, what, &s);
    }
}

TEST(estimators_and_gratings_ask_for_nothing) {
    knurl_velocity velocities[2];
    knurl_grating gratings[2] = {{KNURL_METHOD_S1, {0}, {1000.0, 500.0}, 0.0003, 1000.0, 0.0},
                                 {KNURL_METHOD_S2, {0}, {1000.0, 500.0}, 0.0003, 1000.0, 0.0}};
    knurl_grating_state states[2];
    memset(states, 0, sizeof states);
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_FOAW, 0.055e-3, 1000.0, &velocities[0]), KNURL_OK);
    assert_int_equal(knurl_velocity_prepare(KNURL_VELOCITY_DIFFERENCE, 0.0, 1000.0, &velocities[1]), KNURL_OK);
    const uint64_t before = calls;
    for (int k = 0; k < TICKS; k++) {
        const double position[3] = {0.1 * sin(k * 0.01), 0.1 * cos(k * 0.007), 0.0};
        for (size_t i = 0; i < 2; i++) {
            knurl_grating_output output;
            double velocity[3];
            knurl_velocity_update(&velocities[i], position, velocity);
            knurl_grating_step(&gratings[i], &states[i], position, velocity, &output);
        }
    }
    assert_true(calls == before);
    assert_true(states[1].event_count > 100);
}

#define REFUSED 77 /* a child's exit code if the kernel has no strict mode */

/* A child runs the next segment, without a system call but its exit. Its exit code is the number of ticks in contact,
 * modulo 64. */
static int run_strictly(knurl_scene *scene, const stroke *from, int ask_for_something) {
    int status = -1;
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const unsigned long strict = 1; /* SECCOMP_MODE_STRICT: read, write, exit; SIGKILL for anything else */
        stroke s = *from;
        if (prctl(PR_SET_SECCOMP, strict) != 0) {
            (void)syscall(SYS_exit, REFUSED);
        }
        stroke_on(scene, &s);
        if (ask_for_something) {
            (void)syscall(SYS_getppid);
        }
        (void)syscall(SYS_exit, (int)(s.contact_ticks % 64));
    }
    assert_true(waitpid(child, &status, 0) == child);
    return status;
}

static int kernel_is_strict(void) {
    SCOPED_SCENE *scene = make_scene(&scenes[0]);
    const int status = run_strictly(scene, &at_start, 0);
    return !WIFEXITED(status) || WEXITSTATUS(status) != REFUSED;
}

/* Edits are made here and may make system calls; then a child runs the ticks up to the next edit, and the same ticks
 * run here, to continue from. */
static void stroke_strictly(const struct stroked *what) {
    SCOPED_SCENE *scene = make_scene(what);
    stroke s = at_start;
    assert_true(WIFSIGNALED(run_strictly(scene, &s, 1))); /* a call would be noticed */
    for (int segment = 0; segment < SEGMENTS; segment++) {
        if (what->edit) {
            what->edit(scene, segment);
        }
        const int status = run_strictly(scene, &s, 0);
        stroke_on(scene, &s);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != (int)(s.contact_ticks % 64)) {
            fail_msg("%s: the kernel ended segment %d, status %#x", what->name, segment, (unsigned)status);
        }
    }
    check_stroke(scene, what, &s);
}

TEST(ticks_make_no_system_call) {
    if (SANITIZED) {
        print_message("skipped: sanitizers make system calls of their own\n");
        skip();
    }
    if (!kernel_is_strict()) {
        print_message("skipped: this kernel refuses seccomp's strict mode\n");
        skip();
    }
    for (size_t i = 0; i < COUNT_OF(scenes); i++) {
        stroke_strictly(&scenes[i]);
    }
}
