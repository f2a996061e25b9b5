/* Half cycles: the scan, the impulses, their statistics. SPDX-License-Identifier: MIT */
#include "half_cycles.h"

#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LINE       0.0037 /* m: a y that no row of vertices lies on */
#define MAX_EVENTS 16384

/* State of a scan: sums of the present event, and all ended events. */
typedef struct scan {
    knurl_scene *scene;
    const wavy_sheet *sheet;
    int surface;
    double period, speed;
    double forces[512]; /* of the running event's ticks, less the wall's K d: N */
    int ticks;
    int64_t event;
    double halves[2][MAX_EVENTS]; /* N s, >= 0 as expected */
    double expected[MAX_EVENTS];  /* N s */
    size_t count;
    half_cycles *out;
} scan;

static knurl_result add_surface(knurl_scene *scene, const wavy_sheet *sheet, double period) {
    knurl_surface_id surface;
    knurl_surface_desc d;
    knurl_material_desc m;
    knurl_plane_desc plane;
    knurl_mesh_desc mesh;
    knurl_surface_desc_init(&d, sizeof d);
    knurl_material_desc_init(&m, sizeof m);
    knurl_plane_desc_init(&plane, sizeof plane);
    plane.half_extents[0] = SHEET_HALF_X;
    plane.half_extents[1] = SHEET_HALF_Y;
    if (sheet) {
        mesh = wavy_sheet_desc(sheet);
        d.mesh = &mesh;
    } else {
        d.plane = &plane;
    }
    m.method = KNURL_METHOD_S2;
    m.spatial_frequency[0] = 1.0 / period;
    m.amplitude = HALF_CYCLES_AMPLITUDE;
    m.stiffness = HALF_CYCLES_STIFFNESS;
    d.material = &m;
    return knurl_scene_add_surface(scene, &d, &surface);
}

/* A HIP without quantisation, device axes the scene's; new for every stroke. */
static knurl_result reset_hip(knurl_scene *scene) {
    knurl_hip_desc d;
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&d, sizeof d);
    d.update_rate_hz = HALF_CYCLES_RATE;
    d.resolution = 0.0;
    d.protections = 0; /* strokes start inside the wall */
    d.workspace = &workspace;
    return knurl_scene_configure_hip(scene, 0, &d);
}

/* The HIP's position at x: d below the plane, the facets or the smooth sheet. */
static void place(const scan *s, double x, double out[3]) {
    double normal[3] = {0.0, 0.0, 1.0};
    out[0] = x;
    out[1] = LINE;
    out[2] = 0.0;
    if (s->surface != HALF_CYCLES_PLANE) {
        wavy_sheet_point(x, LINE, out, normal);
    }
    for (int axis = 0; axis < 3; axis++) {
        out[axis] -= HALF_CYCLES_DEPTH * normal[axis];
    }
    for (int i = 0; i < 6 && s->surface == HALF_CYCLES_FACETS;
         i++) { /* slopes are small: each step reduces the error to 1/100 */
        out[2] -= HALF_CYCLES_DEPTH - wavy_sheet_distance(s->sheet, out, 0.25 * HALF_CYCLES_DEPTH);
    }
}

/* Stores a completed event: its halves, and the expectation of Eqs. 5 and 7 for its length. */
static void end_event(scan *s) {
    const int positive = (s->ticks + 1) / 2;
    const double tick = 1.0 / HALF_CYCLES_RATE;
    if (s->ticks < 2 || s->count == MAX_EVENTS) {
        return;
    }
    s->halves[0][s->count] = 0.0;
    s->halves[1][s->count] = 0.0;
    for (int i = 0; i < s->ticks; i++) {
        s->halves[i >= positive][s->count] += (i < positive ? tick : -tick) * s->forces[i];
    }
    s->expected[s->count] =
        HALF_CYCLES_STIFFNESS * HALF_CYCLES_AMPLITUDE * tick * sqrt((double)positive * (s->ticks - positive));
    s->out->ticks_min = fmin(s->out->ticks_min, s->ticks);
    s->out->ticks_max = fmax(s->out->ticks_max, s->ticks);
    s->count++;
}

/* Strokes from one start phase; returns the cycles crossed during whole events. */
static double stroke(scan *s, double start) {
    const int ticks = (int)(HALF_CYCLES_STROKE / s->speed * HALF_CYCLES_RATE);
    const size_t before = s->count;
    knurl_tick_input input;
    int last_start = 0;
    memset(&input, 0, sizeof input);
    input.has_velocity = 1;
    s->event = 0;
    s->ticks = 0;
    double last[3];
    place(s, start - s->speed / HALF_CYCLES_RATE, last);
    for (int i = 0; i < ticks; i++) {
        knurl_tick_output output;
        place(s, start + s->speed * i / HALF_CYCLES_RATE, input.position);
        for (int axis = 0; axis < 3; axis++) {
            input.velocity[axis] = (input.position[axis] - last[axis]) * HALF_CYCLES_RATE;
            last[axis] = input.position[axis];
        }
        (void)knurl_scene_tick(s->scene, 0, &input, &output);
        if (output.event != s->event) {
            end_event(s);
            s->event = output.event;
            s->ticks = 0;
            last_start = i;
        }
        const double *f = output.force;
        const double size = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]); /* no friction: the force is all normal */
        if (s->ticks < (int)(sizeof s->forces / sizeof *s->forces)) {
            s->forces[s->ticks++] = size - HALF_CYCLES_STIFFNESS * HALF_CYCLES_DEPTH;
        }
    }
    s->out->played_per_crossed += (double)(s->count - before);
    return s->speed * last_start / HALF_CYCLES_RATE / s->period;
}

static double median_half(const scan *s, double *room) {
    memcpy(room, s->halves[0], s->count * sizeof *room);
    memcpy(room + s->count, s->halves[1], s->count * sizeof *room);
    return quantile(room, 2 * s->count, 0.5);
}

/* Standard deviation over mean of the events' impulses (the mean of both halves), divided by `unit` unless that is
 * null. */
static double spread(const scan *s, const double *unit) {
    double sum = 0.0;
    double squares = 0.0;
    for (size_t i = 0; i < s->count; i++) {
        sum += 0.5 * (s->halves[0][i] + s->halves[1][i]) / (unit ? unit[i] : 1.0);
    }
    const double mean = sum / (double)s->count;
    for (size_t i = 0; i < s->count; i++) {
        const double value = 0.5 * (s->halves[0][i] + s->halves[1][i]) / (unit ? unit[i] : 1.0);
        squares += (value - mean) * (value - mean);
    }
    return sqrt(squares / (double)s->count) / mean;
}

static void judge(scan *s, double *room) {
    half_cycles *out = s->out;
    const double least = 0.1 * median_half(s, room);
    for (size_t i = 0; i < s->count; i++) {
        out->lost += s->halves[0][i] < least || s->halves[1][i] < least;
        for (int half = 0; half < 2; half++) {
            out->worst_half = fmax(out->worst_half, fabs(s->halves[half][i] / s->expected[i] - 1.0));
        }
    }
    out->events = (double)s->count;
    out->lost /= out->events;
    out->cv = spread(s, s->expected);
    out->raw_cv = spread(s, NULL);
}

static knurl_result perform(scan *s) {
    double crossed = 0.0;
    knurl_result result = knurl_scene_create(NULL, &s->scene);
    result = result ? result : add_surface(s->scene, s->sheet, s->period);
    result = result ? result : knurl_scene_commit(s->scene);
    for (int phase = 0; phase < HALF_CYCLES_PHASES && !result; phase++) {
        result = reset_hip(s->scene);
        crossed += stroke(s, s->period * phase / HALF_CYCLES_PHASES - 0.5 * HALF_CYCLES_STROKE);
    }
    s->out->played_per_crossed /= crossed;
    return result;
}

int half_cycles_measure(int surface, const wavy_sheet *sheet, double period, double speed, half_cycles *out) {
    scan *s = calloc(1, sizeof *s);
    double *room = calloc(2 * MAX_EVENTS, sizeof *room);
    half_cycles found = {.ticks_min = INFINITY};
    knurl_result result = KNURL_ERROR_MEMORY;
    if (s && room) {
        s->surface = surface;
        s->sheet = sheet;
        s->period = period;
        s->speed = speed;
        s->out = &found;
        result = perform(s);
        knurl_scene_destroy(s->scene);
    } else {
        (void)knurl_fail(KNURL_ERROR_MEMORY, "half cycles: no memory for %d events", MAX_EVENTS);
    }
    if (!result) {
        judge(s, room);
        *out = found;
    }
    free(s);
    free(room);
    return result != KNURL_OK;
}
