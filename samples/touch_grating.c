/* The three gratings of the paper's experiment 3, side by side, on a 3D Systems Touch (or any other device), with a
 * live read-out: ridges 0.5, 1 and 2 mm apart, left to right, 0.7 N/mm. Their amplitude is 0.27 mm: the 2.7 mm in the
 * paper needs 3.78 N, which a Touch does not have. SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PLATES     3
#define HALF_WIDTH 0.017 /* m, along x: three of them are as wide as the fake device's stroke */

static const double periods_mm[PLATES] = {0.5, 1.0, 2.0};

static const char usage[] = "usage: touch_grating [--seconds N] [DEVICE]\n"
                            "  DEVICE: touch (the default), touch:NAME, fake, ... as knurl_device_open() has it\n"
                            "  --seconds N: stop by itself after N seconds; otherwise Ctrl-C stops\n";

static volatile sig_atomic_t interrupted;

static void on_interrupt(int number) {
    (void)number;
    interrupted = 1;
}

typedef struct sample {
    knurl_scene *scene;
    knurl_surface_id plates[PLATES];
    knurl_device *device;
    knurl_loop *loop;
} sample;

static knurl_result add_plate(sample *s, int which) {
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    plane.half_extents[0] = HALF_WIDTH;
    plane.half_extents[1] = 0.030;
    material.spatial_frequency[0] = 1000.0 / periods_mm[which];
    material.amplitude = 0.00027;
    material.stiffness = 700.0;
    surface.plane = &plane;
    surface.material = &material;
    surface.position[0] = 2.0 * HALF_WIDTH * (which - 1);
    surface.normal[1] = 1.0; /* the plate's front faces up */
    return knurl_scene_add_surface(s->scene, &surface, &s->plates[which]);
}

/* The plates are in device coordinates: the origin is at the centre of the middle one. */
static knurl_result build_scene(sample *s) {
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.workspace = &workspace;
    knurl_result result = knurl_scene_create(NULL, &s->scene);
    for (int i = 0; i < PLATES && !result; i++) {
        result = add_plate(s, i);
    }
    result = result ? result : knurl_scene_configure_hip(s->scene, 0, &hip);
    return result ? result : knurl_scene_commit(s->scene);
}

static knurl_result start(sample *s, const char *uri) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_result result = build_scene(s);
    result = result ? result : knurl_device_open(uri, &s->device);
    desc.scene = s->scene;
    desc.device = s->device;
    desc.reconnect = 1; /* a cable that was pulled may be plugged in again */
    result = result ? result : knurl_loop_create(&desc, &s->loop);
    return result ? result : knurl_loop_start(s->loop);
}

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_MONOTONIC, &t) ? 0.0 : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double length(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Without real-time scheduling there are many late ticks: those are only counted. */
static void show_faults(const sample *s) {
    knurl_device_event event;
    while (knurl_device_next_event(s->device, &event)) {
        if (event.code != KNURL_FAULT_OVERRUN) {
            const char *cause = knurl_fault_cause(event.code, event.value);
            printf("\n%s: %s%s%s\n", knurl_fault_name(event.code), knurl_fault_string(event.code), *cause ? ": " : "",
                   cause);
        }
    }
}

static void show(const sample *s) {
    static const char *const names[PLATES] = {"0.5 mm", "1 mm", "2 mm"};
    const int terminal = isatty(STDOUT_FILENO);
    const char *name = "none";
    knurl_tick_output now;
    knurl_hip_counts counts;
    knurl_loop_stats stats;
    knurl_loop_stats_init(&stats, sizeof stats);
    show_faults(s);
    if (knurl_loop_get_stats(s->loop, &stats) || knurl_scene_get_tick(s->scene, 0, &now, &counts)) {
        return; /* not one tick yet */
    }
    for (int i = 0; i < PLATES; i++) {
        name = now.surface == s->plates[i] ? names[i] : name;
    }
    printf("%sgrating %-6s  %4.0f mm/s  %4.0f Hz  force %4.2f N  half cycles %llu  late ticks %llu%s",
           terminal ? "\r" : "", name, 1e3 * length(now.hip_velocity), now.temporal_frequency, length(now.force),
           (unsigned long long)counts.half_cycles_played, (unsigned long long)stats.overruns, terminal ? "  " : "\n");
    (void)fflush(stdout);
}

int main(int argc, char **argv) {
    const char *uri = "touch";
    double seconds = 0.0;
    for (int i = 1; i < argc; i++) {
        char *end = "";
        if (strcmp(argv[i], "--help") == 0) {
            return fputs(usage, stdout) < 0;
        }
        if (strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
            seconds = strtod(argv[++i], &end);
        } else if (argv[i][0] != '-') {
            uri = argv[i];
            continue;
        }
        if (*end || !(seconds > 0.0 && seconds <= 86400.0)) {
            (void)knurl_fail(KNURL_ERROR_ARGUMENT, "cannot make sense of '%s'",
                             argv[i]); /* removes escapes for terminals */
            (void)fprintf(stderr, "touch_grating: %s\n%s", knurl_error_message(), usage);
            return 2;
        }
    }
    sample s = {0};
    (void)knurl_device_zero_on_exit(0); /* before the handler below: Ctrl-C ends with a ramp */
    (void)signal(SIGINT, on_interrupt);
    const int failed = start(&s, uri) != KNURL_OK;
    const double end = seconds > 0.0 ? now_s() + seconds : HUGE_VAL;
    while (!failed && !interrupted && now_s() < end && !knurl_loop_wait(s.loop, fmin(0.1, end - now_s()))) {
        show(&s);
    }
    (void)(failed ? fprintf(stderr, "touch_grating: %s\n", knurl_error_message()) : printf("\n"));
    knurl_loop_destroy(s.loop); /* ramps the force down first */
    knurl_device_close(s.device);
    knurl_scene_destroy(s.scene);
    return failed;
}
