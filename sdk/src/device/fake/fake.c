/* The fake device's driver. SPDX-License-Identifier: MIT */
#include "device/driver.h"
#include "device/fake/counts.h"
#include "device/fake/fake_uri.h"
#include "device/fake/hand.h"
#include "device/fake/plant.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"
#include "base/vec3.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct fake {
    knurl_device base;
    knurl_fake_settings settings;
    knurl_stroke_desc stroke;
    knurl_hand_path path; /* of the stroke */
    knurl_hand_path used; /* in use since the start: the same, or of an earlier stroke */
    double *trace;        /* rows of t, x, y, z; null for a simulated hand */
    uint64_t trace_rows;
    double trace_resolution; /* m: the counts in which it was recorded; 0: exact */
    uint64_t trace_at;       /* the row before the present time */
    double dt;
    uint64_t ticks; /* reads since the start */
    int found;      /* 1: reopened since the start */
    knurl_plant plant;
    knurl_hand hand;
    double target[3];
    double target_velocity[3]; /* m/s, over the period that ends now */
} fake;

static fake *of(knurl_device *device) {
    return (fake *)(void *)device; /* first member */
}

static knurl_result fake_open(const char *options, knurl_device **device) {
    knurl_fake_settings settings;
    const knurl_result result = knurl_fake_parse(options, &settings);
    if (result) {
        return result;
    }
    fake *made = knurl_device_allocate(&knurl_fake_driver, sizeof *made);
    if (!made) {
        return KNURL_ERROR_MEMORY;
    }
    made->base.max_force = settings.max_force;
    made->base.max_speed = 0.0; /* traces may jump */
    made->settings = settings;
    knurl_stroke_desc_init(&made->stroke, sizeof made->stroke);
    (void)knurl_stroke_check(&made->stroke); /* cannot fail for the default; sets its speed */
    *device = &made->base;
    return knurl_device_start(*device, 1000.0);
}

/* Frees the last stroke's path, unless the hand follows it. */
static void drop_path(fake *f) {
    if (f->path.rows != f->used.rows) {
        knurl_hand_path_destroy(&f->path);
    }
}

static void fake_close(knurl_device *device) {
    drop_path(of(device));
    knurl_hand_path_destroy(&of(device)->used);
    free(of(device)->trace);
    knurl_device_free(device);
}

static void fake_info(const knurl_device *device, knurl_device_info *info) {
    const fake *f = (const fake *)(const void *)device;
    const knurl_fake_settings *s = &f->settings;
    const double size[3] = {s->width, s->height, s->depth};
    (void)snprintf(info->name, sizeof info->name, "fake (%s%s)",
                   f->trace ? "a trace" : knurl_fake_preset_name(s->preset), f->trace ? "" : " in a simulated hand");
    for (int axis = 0; axis < 3; axis++) {
        info->workspace_min[axis] = -0.5 * size[axis];
        info->workspace_max[axis] = 0.5 * size[axis];
    }
    info->resolution = f->trace && !s->resolution_named ? f->trace_resolution : s->resolution;
    info->max_force = s->max_force;
    info->delay = s->delay;
    info->continuous_force = s->continuous_force > 0.0 ? s->continuous_force : INFINITY;
    info->heat_time = s->heat_time;
    info->mass = s->mass;
    info->viscous = s->viscous;
    info->coulomb = s->coulomb;
    info->max_stiffness = s->max_stiffness > 0.0 ? s->max_stiffness : INFINITY;
}

static knurl_result fake_start(knurl_device *device, double update_rate_hz) {
    fake *f = of(device);
    const knurl_fake_settings *s = &f->settings;
    const knurl_plant_config config = {
        s->mass + s->hand_mass, s->viscous,       s->coulomb,   s->hand_stiffness,
        s->hand_damping,        s->resolution,    s->max_force, {0.5 * s->width, 0.5 * s->height, 0.5 * s->depth},
        (int32_t)s->delay,      (int32_t)s->exact};
    const double still[3] = {0.0, 0.0, 0.0};
    f->dt = 1.0 / update_rate_hz;
    f->ticks = 0;
    f->found = 0;
    f->trace_at = 0;
    knurl_hand_init(&f->hand, &f->stroke, s->tremor, (uint64_t)s->seed);
    if (f->used.rows != f->path.rows) {
        knurl_hand_path_destroy(&f->used);
        f->used = f->path;
    }
    f->hand.way = f->used;
    knurl_hand_target(&f->hand, 0.0, f->dt, f->target);
    vec3_copy(still, f->target_velocity);
    knurl_plant_init(&f->plant, &config, f->target);
    return KNURL_OK;
}

/* The trace at the time of this tick, quantised only if the URI sets the resolution. */
static void play_trace(fake *f, double t, double position[3]) {
    while (f->trace_at + 1 < f->trace_rows && f->trace[4 * (f->trace_at + 1)] <= t) {
        f->trace_at++; /* a tick skips as many rows as its period holds; in total each row is visited once */
    }
    const double *row = &f->trace[4 * f->trace_at];
    vec3_copy(row + 1, position);
    if (f->trace_at + 1 < f->trace_rows && t > row[0]) {
        const double *next = row + 4;
        const double part = (t - row[0]) / (next[0] - row[0]);
        for (int axis = 0; axis < 3; axis++) {
            position[axis] += part * (next[axis + 1] - row[axis + 1]);
        }
    }
    if (f->settings.resolution_named) {
        vec3_copy(position, f->plant.position);
        knurl_plant_measure(&f->plant, position);
    }
}

static void move_hand(fake *f, double t, double position[3]) {
    double before[3];
    if (knurl_load_acquire(&f->base.halted)) {
        knurl_plant_zero_force(&f->plant);
    }
    if (f->ticks > 0) {
        vec3_copy(f->target, before);
        knurl_hand_target(&f->hand, t, f->dt, f->target);
        vec3_sub(f->target, before, f->target_velocity);
        vec3_scale(1.0 / f->dt, f->target_velocity, f->target_velocity);
        knurl_plant_step(&f->plant, f->dt, f->target, f->target_velocity);
    }
    knurl_plant_measure(&f->plant, position);
}

static knurl_result fake_read(knurl_device *device, knurl_device_sample *sample) {
    fake *f = of(device);
    const double t = (double)f->ticks * f->dt;
    if (f->settings.lose_at > 0.0 && !f->found && t >= f->settings.lose_at) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    memset(sample, 0, sizeof *sample);
    if (f->trace) {
        play_trace(f, t, sample->position);
    } else {
        move_hand(f, t, sample->position);
    }
    const double pressed_for = t - f->settings.press_at;
    sample->buttons = f->settings.press_at > 0.0 && pressed_for >= 0.0 && pressed_for < 0.1;
    f->ticks++;
    return KNURL_OK;
}

static knurl_result fake_write(knurl_device *device, const double force[3]) {
    fake *f = of(device);
    if (f->settings.lose_at > 0.0 && !f->found && (double)f->ticks * f->dt >= f->settings.lose_at) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    knurl_plant_write(&f->plant, force);
    return KNURL_OK;
}

knurl_result knurl_fake_get_truth(const knurl_device *device, knurl_fake_truth *truth) {
    KNURL_RULE(HAPTIC, device);
    const fake *f = (const fake *)(const void *)device;
    if (!KNURL_IS_HANDLE(device, DEVICE) || !truth) {
        return knurl_fail_static(KNURL_ERROR_ARGUMENT,
                                 "knurl_fake_get_truth: expected a device that is open and a truth, "
                                 "found null or an invalid handle");
    }
    if (device->driver != &knurl_fake_driver || f->trace) {
        return knurl_fail_static(KNURL_ERROR_UNSUPPORTED,
                                 "knurl_fake_get_truth: expected a fake device that plays no trace, found another");
    }
    vec3_copy(f->plant.position, truth->position);
    vec3_copy(f->plant.velocity, truth->velocity);
    knurl_plant_forces(&f->plant, f->target, f->target_velocity, truth->motor, truth->hand);
    return KNURL_OK;
}

static knurl_result check_fake(const knurl_device *device, const char *what) {
    if (device->driver != &knurl_fake_driver) {
        return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device: only the fake device takes a %s, found '%s'", what,
                          device->driver->uri);
    }
    return knurl_device_check_unused(device, KNURL_DEVICE_THREAD); /* the haptic thread reads it */
}

knurl_result knurl_fake_set_stroke(knurl_device *device, const knurl_stroke_desc *desc) {
    KNURL_RULE(GAME, device);
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_IS_NULL(desc)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_stroke_desc stroke;
    knurl_hand_path path;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    knurl_result result = check_fake(device, "stroke");
    result = result ? result : knurl_desc_read("knurl_stroke_desc", desc, &stroke, sizeof stroke);
    result = result ? result : knurl_stroke_check(&stroke);
    result = result ? result : knurl_hand_path_create(&stroke, &path);
    if (!result) {
        fake *f = of(device);
        free(f->trace);
        f->trace = NULL;
        drop_path(f);
        f->path = path;
        f->stroke = stroke;
        f->stroke.path = NULL; /* belongs to the caller, and was copied */
    }
    return result;
}

static knurl_result check_trace(const double *rows, uint64_t row_count) {
    if (row_count == 0 || row_count > UINT64_C(1) << 32) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "trace: expected 1 to 2^32 rows, found %llu",
                          (unsigned long long)row_count);
    }
    for (uint64_t i = 0; i < row_count; i++) {
        const double *row = &rows[4 * i];
        const unsigned long long number = i + 1;
        if (!knurl_is_finite(row[0]) || !vec3_finite(row + 1)) {
            return knurl_fail(KNURL_ERROR_ARGUMENT, "trace: row %llu: expected finite t, x, y, z, found %g, %g, %g, %g",
                              number, row[0], row[1], row[2], row[3]);
        }
        if (i > 0 && !(row[0] > row[-4])) {
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "trace: row %llu: expected t above the row before (%g s), found %g s", number, row[-4],
                              row[0]);
        }
    }
    return KNURL_OK;
}

knurl_result knurl_fake_set_trace(knurl_device *device, const double *rows, uint64_t row_count) {
    KNURL_RULE(GAME, device);
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_IS_NULL(rows)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = check_fake(device, "trace");
    result = result ? result : check_trace(rows, row_count);
    if (result) {
        return result;
    }
    double resolution = 0.0;
    result = of(device)->settings.resolution_named ? KNURL_OK : knurl_counts_find(rows, row_count, &resolution);
    if (result) {
        return result;
    }
    double *copy = malloc((size_t)row_count * 4 * sizeof *copy);
    if (!copy) {
        return knurl_fail(KNURL_ERROR_MEMORY, "trace: could not get memory for %llu rows",
                          (unsigned long long)row_count);
    }
    memcpy(copy, rows, (size_t)row_count * 4 * sizeof *copy);
    free(of(device)->trace);
    of(device)->trace = copy;
    of(device)->trace_rows = row_count;
    of(device)->trace_resolution = resolution;
    of(device)->trace_at = 0;
    return KNURL_OK;
}

/* Plugs the cable in again. */
static knurl_result fake_reopen(knurl_device *device) {
    of(device)->found = 1;
    return KNURL_OK;
}

static void fake_list(knurl_listings *listings) {
    knurl_listings_add(listings, "fake", "a simulated Touch in a simulated hand", "%s", "");
}

const knurl_driver knurl_fake_driver = {
    .uri = "fake",
    .list = fake_list,
    .open = fake_open,
    .close = fake_close,
    .get_info = fake_info,
    .start = fake_start,
    .read = fake_read,
    .write = fake_write,
    .reopen = fake_reopen,
};
