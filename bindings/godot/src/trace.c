/* KnurlDevice.play_trace(): forces for positions, as fast as the machine can, on the calling thread.
 * SPDX-License-Identifier: MIT */
#include "trace.h"

#include "device.h"

#include <stdlib.h>
#include <string.h>

/* The caller always frees *forces. */
static knurl_result play(device *d, const void *rows, int64_t ticks, double **forces, uint64_t *played) {
    if (d->runs) {
        return knurl_fail(KNURL_ERROR_STATE, "expected a device that is stopped, found one that runs");
    }
    if (ticks < 1 || ticks > 100000000) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "ticks: expected 1 to 1e8, found %lld", (long long)ticks);
    }
    int64_t size = 0;
    gd_builtin.PACKED_FLOAT64_ARRAY_size(gd_unconst(rows), NULL, &size, 0);
    if (size < 4 || size % 4 != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "rows: expected t, x, y, z of one tick or more, found %lld numbers",
                          (long long)size);
    }
    *forces = malloc((size_t)ticks * 3 * sizeof **forces);
    if (!*forces) {
        return knurl_fail(KNURL_ERROR_MEMORY, "no memory for %lld forces", (long long)ticks);
    }
    const knurl_result result = device_prepare(d);
    return result ? result
                  : knurl_session_play(d->session, gd.packed_float64_array_operator_index_const(rows, 0),
                                       (uint64_t)size / 4, (uint64_t)ticks, *forces, played);
}

static void give(const double *forces, uint64_t ticks, void *result) {
    int64_t ignored = 0;
    const int64_t size = 3 * (int64_t)ticks;
    const void *given[1] = {&size};
    gd_builtin.PACKED_FLOAT64_ARRAY_resize(result, given, &ignored, 1);
    if (size > 0) {
        memcpy(gd.packed_float64_array_operator_index(result, 0), forces, (size_t)size * sizeof *forces);
    }
}

void trace_play(void *self, const void *const *arguments, void *result) {
    device *d = self;
    double *forces = NULL;
    uint64_t played = 0;
    int64_t ticks;
    memcpy(&ticks, arguments[1], sizeof ticks);
    const knurl_result failed = play(d, arguments[0], ticks, &forces, &played);
    if (failed) {
        (void)device_fail("KnurlDevice.play_trace", failed);
    } else if (forces) {
        give(forces, played, result);
    }
    if (!d->runs) {
        device_release(d);
    }
    free(forces);
}
