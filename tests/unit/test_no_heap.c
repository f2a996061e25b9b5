/* A tick asks for no memory and makes no system call. Linked with --wrap for the allocation functions, and then run
 * where the kernel kills whoever asks it for anything. SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1 /* fork(), syscall() */

#include "support/scenes.h"

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1
#else
#define SANITIZED 0
#endif

#define TICKS 10000

static uint64_t calls;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void __real_free(void *memory);
int __real_posix_memalign(void **memory, size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void __wrap_free(void *memory);
int __wrap_posix_memalign(void **memory, size_t alignment, size_t size);

void *__wrap_malloc(size_t size) {
    calls++;
    return __real_malloc(size);
}

void *__wrap_calloc(size_t count, size_t size) {
    calls++;
    return __real_calloc(count, size);
}

void *__wrap_realloc(void *memory, size_t size) {
    calls++;
    return __real_realloc(memory, size);
}

void __wrap_free(void *memory) {
    calls++;
    __real_free(memory);
}

int __wrap_posix_memalign(void **memory, size_t alignment, size_t size) {
    calls++;
    return __real_posix_memalign(memory, alignment, size);
}

static double hills(double x, double y) {
    return 0.002 * sin(60.0 * x) * cos(45.0 * y);
}

/* A plane and hills of 10,000 triangles side by side, both with the method, FOAW at the Touch's resolution. */
static knurl_scene *make_scene(int32_t method) {
    shape mesh = shape_sheet(100, 50, (const double[2]){0.05, 0.05}, hills);
    surface_parts parts[2] = {surface_plane(), surface_mesh(&mesh)};
    knurl_scene *scene = empty_scene(1);
    assert_int_equal(mesh.index_count / 3, 10000);
    for (int i = 0; i < 2; i++) {
        set_grating(&parts[i], method, 1000.0, 500.0, 0.0003);
        parts[i].material.damping = 0.5;
        parts[i].desc.position[0] = 0.09 * i; /* they overlap by 10 mm */
        (void)add_surface(scene, &parts[i]);
    }
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_workspace_init(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.velocity_method = KNURL_VELOCITY_FOAW;
    hip.workspace = &workspace;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    shape_free(&mesh);
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

TEST(ticks_ask_for_no_memory) {
    static const int32_t methods[] = {KNURL_S1, KNURL_S2};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        const uint64_t at_start = calls;
        knurl_scene *scene = make_scene(methods[i]);
        assert_true(calls > at_start + 10); /* the wrapping works */
        const uint64_t before = calls;
        (void)stroke(scene);
        assert_true(calls == before);
        check_counts(scene, methods[i]);
        knurl_scene_destroy(scene);
    }
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
    static const int32_t methods[] = {KNURL_S1, KNURL_S2};
    if (SANITIZED) {
        print_message("skipped: sanitizers make system calls of their own\n");
        skip();
    }
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        knurl_scene *scene = make_scene(methods[i]);
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
        cmocka_unit_test(ticks_ask_for_no_memory),
        cmocka_unit_test(ticks_make_no_system_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
