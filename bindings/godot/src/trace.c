/* KnurlDevice.play_trace(): forces for positions, as fast as the machine can, on the calling thread.
 * SPDX-License-Identifier: MIT */
#include "world.h"

#include <stdlib.h>
#include <string.h>

/* The rows in device coordinates; null where memory is short. */
static double *to_device(const device *d, const double *rows, uint64_t count) {
    double *made = malloc((size_t)count * 4 * sizeof *made);
    for (uint64_t i = 0; made && i < count; i++) {
        made[4 * i] = rows[4 * i];
        knurl_workspace_to_device(&d->workspace, rows + 4 * i + 1, made + 4 * i + 1);
    }
    return made;
}

static knurl_result lay(device *d, const void *rows, int64_t size) {
    if (size < 4 || size % 4 != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "rows: expected t, x, y, z of one tick or more, found %lld numbers",
                          (long long)size);
    }
    const uint64_t count = (uint64_t)size / 4;
    double *moved = to_device(d, gd.packed_float64_array_operator_index_const(rows, 0), count);
    const knurl_result result =
        moved ? knurl_fake_set_trace(d->device, moved, count) : knurl_fail(KNURL_ERROR_MEMORY, "no memory for a trace");
    free(moved);
    return result;
}

static knurl_result play(device *d, const void *rows, int64_t ticks) {
    int64_t size = 0;
    if (d->loop) {
        return knurl_fail(KNURL_ERROR_STATE, "expected a device that is stopped, found one that runs");
    }
    if (ticks < 1 || ticks > 100000000) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "ticks: expected 1 to 1e8, found %lld", (long long)ticks);
    }
    gd_builtin.PACKED_FLOAT64_ARRAY_size(gd_unconst(rows), NULL, &size, 0);
    knurl_result result = device_prepare(d);
    result = result ? result : lay(d, rows, size);
    result = result ? result : device_make_loop(d, 0.0);
    if (!result) {
        d->board->forces = malloc((size_t)ticks * 3 * sizeof *d->board->forces);
        d->board->force_capacity = d->board->forces ? (uint64_t)ticks : 0;
        result = d->board->forces ? knurl_loop_step(d->loop, (uint64_t)ticks)
                                  : knurl_fail(KNURL_ERROR_MEMORY, "no memory for %lld forces", (long long)ticks);
    }
    return result;
}

void trace_play(void *self, const void *const *arguments, void *result) {
    device *d = self;
    int64_t ticks;
    memcpy(&ticks, arguments[1], sizeof ticks);
    const int was_running = d->loop != NULL;
    const knurl_result failed = play(d, arguments[0], ticks);
    if (failed) {
        (void)device_fail("KnurlDevice.play_trace", failed);
    } else {
        int64_t ignored = 0;
        const int64_t size = 3 * (int64_t)d->board->force_count;
        const void *given[1] = {&size};
        gd_builtin.PACKED_FLOAT64_ARRAY_resize(result, given, &ignored, 1);
        if (size > 0) {
            memcpy(gd.packed_float64_array_operator_index(result, 0), d->board->forces,
                   (size_t)size * sizeof *d->board->forces);
        }
    }
    if (!was_running) {
        double *forces = d->board ? d->board->forces : NULL;
        device_release(d);
        free(forces);
    }
}
