/* Wraps the caller's device functions: the judge sees every write, and faults are injected that the device itself need
 * not have. SPDX-License-Identifier: MIT */
#include "device.h"
#include "trial.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { WELL, LOST, SILENT, NOT_FINITE, JUMP, FAULTS = JUMP };

/* s without a position, after which the last one is no longer valid. */
#define PATIENCE 0.01

static struct {
    knurl_device_functions inner;
    judge *j;
    int fault;
    int is_off;    /* the position is off by a jump */
    double period; /* s */
    uint64_t without, cycles_read;
    int is_closed;
    int is_limp; /* the last force was zero */
} f;

/* An I/O thread's writes belong to no tick. The ticks' forces are judged by their outputs; here, each write by itself.
 */
static int is_threaded(void) {
    return f.inner.blocking != 0;
}

static void breaks(int promise) {
    if (judge_try(f.j)) {
        judge_breaks(f.j, promise, 0.0);
        judge_leave(f.j);
    }
}

static void get_info(void *user, knurl_device_info *info) {
    f.inner.get_info(user, info);
}

static knurl_result start(void *user, double update_rate_hz) {
    f.period = 1.0 / update_rate_hz;
    return f.inner.start ? f.inner.start(user, update_rate_hz) : KNURL_OK;
}

/* Checks the result and position of the caller's read(). */
static void check_answer(knurl_result result, const knurl_device_sample *sample) {
    const double *q = sample->orientation;
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const int may = result == KNURL_OK || result == KNURL_ERROR_DEVICE_NOT_READY || result == KNURL_ERROR_DEVICE_LOST;
    const int is_place =
        isfinite(sample->position[0]) && isfinite(sample->position[1]) && isfinite(sample->position[2]);
    if (!may || (result == KNURL_OK && (!is_place || !(square == 0.0 || fabs(square - 1.0) < 0.02)))) {
        breaks(JUDGE_ANSWERS);
    }
}

/* 1: this read gave no valid position, so that the force must be zero. */
static int spoil(knurl_device_sample *sample, int fault) {
    const int jumps = (fault == JUMP) != f.is_off;
    f.is_off = fault == JUMP;
    sample->position[0] += f.is_off ? 0.05 : 0.0;
    if (fault == NOT_FINITE) {
        sample->position[1] = (double)NAN;
    }
    return jumps || fault == NOT_FINITE;
}

static knurl_result read(void *user, knurl_device_sample *sample) {
    const int fault = __atomic_load_n(&f.fault, __ATOMIC_ACQUIRE);
    knurl_result result = fault == LOST ? KNURL_ERROR_DEVICE_LOST : KNURL_ERROR_DEVICE_NOT_READY;
    f.cycles_read++;
    if (fault != LOST && fault != SILENT) {
        result = f.inner.read(user, sample);
        check_answer(result, sample);
    }
    f.without = result ? f.without + 1 : 0;
    const int is_absent = result ? (double)f.without * f.period > PATIENCE + 0.5 * f.period : spoil(sample, fault);
    if (!is_threaded()) {
        f.j->absent = is_absent;
        if (result == KNURL_ERROR_DEVICE_LOST) {
            judge_miss(f.j, 1);
        }
    }
    return result;
}

static knurl_result write(void *user, const double force[3]) {
    if (f.is_closed) {
        breaks(JUDGE_CLOSED);
    }
    if (!is_threaded()) {
        judge_write(f.j, force);
    } else if (judge_try(f.j)) {
        judge_look(f.j, force);
        judge_leave(f.j);
    }
    __atomic_store_n(&f.is_limp, force[0] == 0.0 && force[1] == 0.0 && force[2] == 0.0, __ATOMIC_RELEASE);
    const knurl_result result = f.inner.write(user, force);
    if (result != KNURL_OK && result != KNURL_ERROR_DEVICE_LOST) {
        breaks(JUDGE_ANSWERS);
    }
    return result;
}

static knurl_result reopen(void *user) {
    if (__atomic_load_n(&f.fault, __ATOMIC_ACQUIRE) == LOST) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    f.is_off = 0;
    return f.inner.reopen ? f.inner.reopen(user) : KNURL_OK; /* it was never lost */
}

static void close_it(void *user) {
    if (f.inner.close) {
        f.inner.close(user);
    }
    f.is_closed = 1;
}

static knurl_device *open_it(uint64_t seed, judge *j) {
    knurl_device *device = NULL;
    memset(&f, 0, sizeof f);
    f.j = j;
    knurl_device_functions_init(&f.inner, sizeof f.inner);
    conform_device(&f.inner, seed);
    knurl_device_functions watched = f.inner;
    watched.get_info = f.inner.get_info ? get_info : NULL;
    watched.start = start;
    watched.read = f.inner.read ? read : NULL;
    watched.write = f.inner.write ? write : NULL;
    watched.reopen = reopen;
    watched.close = close_it;
    j->sees_writes = !is_threaded();
    f.is_limp = 1;
    return knurl_device_open_functions(&watched, &device) ? NULL : device;
}

static int inject(int which) {
    __atomic_store_n(&f.fault, which, __ATOMIC_RELEASE);
    return which == SILENT || which == NOT_FINITE; /* a lost device gets no force; after a jump it continues */
}

static void closed(void) {
    if (!f.is_closed) {
        breaks(JUDGE_CLOSED);
    }
}

static uint64_t read_cycles(void) {
    const uint64_t cycles = f.cycles_read;
    f.cycles_read = 0;
    return cycles;
}

/* An I/O thread sends zero with its next write: within some milliseconds. */
static int is_limp(void) {
    const clock_t until = clock() + CLOCKS_PER_SEC / 50;
    while (is_threaded() && !__atomic_load_n(&f.is_limp, __ATOMIC_ACQUIRE) && clock() < until) {}
    return __atomic_load_n(&f.is_limp, __ATOMIC_ACQUIRE);
}

const subject functions_subject = {open_it, inject, FAULTS, is_limp, knurl_device_close, closed, read_cycles, 0.0};
