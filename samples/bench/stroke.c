/* The HIP's position in a case, tick by tick. SPDX-License-Identifier: MIT */
#include "bench.h"

#include "sheet.h"

#include <math.h>
#include <string.h>

#define LINE 0.0027 /* m: a y without rows of vertices or seams of tiles; each further HIP is one line further */

/* From just outside, within reach of the crests, into all planes; along the edge of two, to and fro in the corner of
 * three. */
static void place_in_corner(const bench_case *c, double seconds, double out[3]) {
    const double swing = sin(BENCH_PEAK_SPEED / BENCH_REACH * seconds);
    const double depth = seconds > 0.0 ? BENCH_DEPTH : -0.5 * BENCH_AMPLITUDE;
    out[0] = c->triangles == 2 ? BENCH_REACH * swing : -depth * (1.0 + 0.5 * swing);
    out[1] = out[2] = -depth;
}

static void place(const bench_case *c, uint32_t hip, double seconds, double out[3]) {
    const double x = BENCH_REACH * sin(BENCH_PEAK_SPEED / BENCH_REACH * seconds);
    const double y = LINE * (1.0 + hip);
    double normal[3] = {0.0, 0.0, 1.0};
    if (bench_is_worst(c->shape)) {
        bench_worst_place(seconds, out);
        return;
    }
    if (c->shape == BENCH_CORNER) {
        place_in_corner(c, seconds, out);
        return;
    }
    out[0] = x;
    out[1] = y;
    out[2] = 0.0;
    if (c->shape == BENCH_MESH || c->shape == BENCH_CURVED) {
        wavy_sheet_point(x, y, out, normal);
    }
    for (int axis = 0; axis < 3; axis++) {
        out[axis] -= BENCH_DEPTH * normal[axis];
    }
}

void bench_stroke(const bench_case *c, uint32_t hip, uint64_t tick, knurl_tick_input *input) {
    double last[3];
    memset(input, 0, sizeof *input);
    place(c, hip, ((double)tick - 1.0) / BENCH_RATE, last);
    place(c, hip, (double)tick / BENCH_RATE, input->position);
    for (int axis = 0; axis < 3; axis++) {
        input->velocity[axis] = (input->position[axis] - last[axis]) * BENCH_RATE;
    }
    input->has_velocity = !c->estimates;
    for (int axis = 0; axis < 3 && c->estimates; axis++) { /* FOAW needs an encoder's counts */
        input->position[axis] = floor(input->position[axis] / BENCH_RESOLUTION + 0.5) * BENCH_RESOLUTION;
    }
}
