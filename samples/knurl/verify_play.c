/* knurl verify: plays and records a step, on the device and on a simulation of it. SPDX-License-Identifier: MIT
 */
#include "verify.h"
#include "watch.h"

#include <knurl/fake.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MASS 0.1 /* kg: of a prediction, if the device's is not known */

double verify_length(const double vector[3]) {
    return hypot(hypot(vector[0], vector[1]), vector[2]);
}

int verify_largest(const double vector[3]) {
    const int most = fabs(vector[0]) > fabs(vector[1]) ? 0 : 1;
    return fabs(vector[2]) > fabs(vector[most]) ? 2 : most;
}

/* The limit of everything that is sent. */
static void limit(double force[3], double newtons) {
    const double length = verify_length(force);
    const double share = length <= newtons ? 1.0 : length <= HUGE_VAL ? newtons / length : 0.0;
    for (int axis = 0; axis < 3; axis++) {
        force[axis] = share > 0.0 ? share * force[axis] : 0.0;
    }
}

static void on_tick(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    verify *v = user;
    knurl_device_sample s = *sample;
    const double now = v->seconds ? v->seconds() : 0.0;
    v->times[0] = v->count == 0 ? now : v->times[0];
    v->times[1] = now;
    if (v->person && v->person->move) {
        v->person->move(v, &s);
    }
    if (v->count < VERIFY_ROWS) {
        verify_row *row = &v->rows[v->count++];
        memcpy(row->position, s.position, sizeof row->position);
        memcpy(row->orientation, s.orientation, sizeof row->orientation);
        row->buttons = s.buttons;
    }
    memset(force, 0, 3 * sizeof *force);
    if (v->shape) {
        v->shape(v, tick, force);
        limit(force, v->limit);
    }
    if (v->person && v->person->push) {
        v->person->push(v, force);
    }
}

static const char *why_not(const verify *v, knurl_result failed) {
    if (*v->interrupted) {
        return "stopped";
    }
    if (failed) {
        return knurl_error_message();
    }
    if (v->fault || v->stats.state == KNURL_LOOP_LOST) {
        return knurl_fault_string(v->fault ? v->fault : KNURL_FAULT_LOST);
    }
    return v->stats.ticks == 0 || v->count == 0 ? "no position came" : NULL;
}

const char *verify_play(verify *v, double seconds, verify_shape *shape) {
    knurl_device_event old;
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_loop_stats_init(&v->stats, sizeof v->stats);
    desc.device = v->device;
    desc.force_callback = on_tick;
    desc.protections |= KNURL_PROTECT_SLEW;
    desc.user = v;
    desc.update_rate_hz = VERIFY_RATE;
    desc.tick_limit = (uint64_t)(seconds * VERIFY_RATE);
    v->shape = shape;
    v->count = 0;
    v->fault = 0;
    memset(v->state, 0, sizeof v->state);
    while (knurl_device_next_event(v->device, &old)) {} /* of an earlier step */
    v->loop = NULL;
    if (*v->interrupted) {
        return "stopped";
    }
    knurl_result failed = knurl_loop_create(&desc, &v->loop);
    failed = failed || v->simulated ? failed : knurl_loop_start(v->loop);
    if (!failed) {
        v->fault =
            watch_loop(v->loop, v->device, desc.tick_limit, VERIFY_RATE, v->simulated, v->interrupted, &v->stats);
        if (v->fault >= KNURL_FAULT_BACKWARDS_X && v->fault <= KNURL_FAULT_BACKWARDS_Z) {
            v->is_wrong = "a motor is backwards, so that it gets no force until the device is opened again";
        }
    }
    v->why = why_not(v, failed);
    knurl_loop_destroy(v->loop);
    v->loop = NULL;
    return v->why;
}

knurl_result verify_open(const char *uri, knurl_device **device) {
    knurl_stroke_desc still;
    knurl_stroke_desc_init(&still, sizeof still);
    still.stroke = KNURL_STROKE_REST;
    still.depth = -0.005; /* it stays at the start of a stroke */
    const knurl_result failed = knurl_device_open(uri, device);
    return failed || strncmp(uri, "fake", 4) != 0 ? failed : knurl_fake_set_stroke(*device, &still);
}

double verify_predict(const verify *v, double (*measure)(verify *v)) {
    char uri[256];
    double result = NAN;
    const knurl_device_info *i = &v->info;
    verify *model = calloc(1, sizeof *model);
    (void)snprintf(uri, sizeof uri,
                   "fake:?mass=%.9g&viscous=%.9g&coulomb=%.9g&resolution=%.9g&max_force=%.9g&continuous_force=%.9g&"
                   "delay=%.0f&tremor=0",
                   i->mass > 0.0 ? i->mass : MASS, i->viscous, i->coulomb, i->resolution, i->max_force,
                   isfinite(i->continuous_force) ? i->continuous_force : 0.0, i->delay);
    if (model && verify_open(uri, &model->device) == KNURL_OK) {
        model->rows = calloc(VERIFY_ROWS, sizeof *model->rows);
        model->info = v->info;
        model->newtons = model->limit = v->newtons;
        model->scale = 1.0;
        model->simulated = 1;
        model->interrupted = v->interrupted;
        result = model->rows ? measure(model) : result;
        free(model->rows);
        knurl_device_close(model->device);
    }
    free(model);
    return result;
}

const char *verify_compare(verify *v, const char *why, double (*measure)(verify *v), double *measured,
                           double *expected) {
    *measured = why ? NAN : measure(v);
    const int axis = v->axis;
    if (isnan(*measured)) {
        return why ? why : v->why ? v->why : "the grip hardly moved, or positions were missing";
    }
    *expected = verify_predict(v, measure);
    v->axis = axis;
    return isnan(*expected) ? "a simulation with its data failed" : NULL;
}
