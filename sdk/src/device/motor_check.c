/* Checks the motors' directions. Read end_block() first.
 *
 * A position alone cannot distinguish a backwards motor from a hand that presses: in both cases the handle moves
 * against the force. So the force is switched on and off in a pattern unknown to the hand. Motion in time with the
 * pattern is caused by the motors.
 * SPDX-License-Identifier: MIT */
#include "device/motor_check.h"

#include "base/vec3.h"

#include <string.h>

/* A block: on, off, off, on. Each part lasts QUARTER steps of 1 ms, the last one LAG steps longer, because positions
 * follow the force by about LAG steps: one transfer in each direction. */
#define STEP    0.001 /* s */
#define QUARTER 12
#define LAG     2
#define WINDOW  (4 * QUARTER) /* positions used, from step LAG on */
#define BLOCK   (WINDOW + LAG)

/* Bits: blocks that are inverted. The Barker code of length 13, so that no rhythm of the hand matches it. */
#define POLARITY   0x0a60u
#define POLARITIES 13

#define KNOWN       0.25 /* N: harmless in either direction */
#define LIMIT       1.0  /* N: of the first pulses: moves a free handle of 100 g by about 10 mm in two blocks */
#define RAMP_TIME   0.1  /* s from LIMIT to max_force */
#define SIGNIFICANT 0.5  /* an axis counts as pushed if it carries this share of the force */

/* Chosen by the study in tests/device/core/test_motor_check.c. */
#define SURE         4.0    /* standard errors required of a mean */
#define LEAST_NOISE  1.0    /* m/s^2 of a block's answer */
#define LEAST_BLOCKS 2      /* for a decision */
#define LEAST_ASIDE  4      /* for a verdict of "sideways", because hands also move sideways */
#define MOST_BLOCKS  12     /* then the limit is doubled */
#define TRAVEL       0.0005 /* m: if the handle moves less, for example at its stop, there is no result */
#define ASIDE        2.0    /* tangent of the angle to the force above which the handle moves sideways */

/* sum of weight * position = (acceleration with force - without), m/s^2 for steps of 1 ms. The least-squares fit of a
 * mass' path under the pulses; a cubic (the hand's own motion), the pulses (a spring) and their integral (a damper) are
 * fitted with it and so do not affect the sum. Symmetric: this is the first half. */
static const double weights[WINDOW / 2] = {6666.6824,  3812.7145,  1451.2996,  -417.56201, -1793.8705, -2677.6258,
                                           -3068.8279, -2967.4769, -2373.5726, -1287.1152, 291.89532,  2363.4591,
                                           -9010.0219, -6659.5814, -4522.8173, -2599.7296, -890.31837, 605.41649,
                                           1887.4749,  2955.857,   3810.5626,  4451.5919,  4878.9447,  5092.6211};

void knurl_motor_check_init(knurl_motor_check *check, double max_force) {
    memset(check, 0, sizeof *check);
    check->is_on = max_force > KNOWN;
    check->axes = 7;
    check->max_force = max_force;
    check->known = KNOWN;
    check->limit = check->ramp = LIMIT;
}

static void begin_answers(knurl_motor_check *check) {
    check->blocks = 0;
    check->spread = 0.0;
    memset(check->sum, 0, sizeof check->sum);
}

void knurl_motor_check_start(knurl_motor_check *check, double period) {
    check->stride = (uint32_t)fmax(1.0, STEP / period + 0.5);
    check->step = check->stride * period;
    check->ramp_step = check->max_force / RAMP_TIME * period;
    check->is_wanted = 0;
    begin_answers(check);
}

/* Bits: axes that carry the force. */
static uint32_t axes_of(const double force[3], double length) {
    uint32_t axes = 0;
    for (int axis = 0; axis < 3; axis++) {
        axes |= fabs(force[axis]) >= SIGNIFICANT * length ? 1u << axis : 0;
    }
    return axes;
}

void knurl_motor_check_shape(knurl_motor_check *check, double force[3]) {
    const double length = vec3_length(force);
    check->is_wanted = length > check->known && (axes_of(force, length) & check->axes) != 0;
    const double most = check->is_wanted ? check->limit : fmax(check->ramp, check->known);
    if (length > most) {
        vec3_scale(most / length, force, force);
    }
    if (check->is_wanted) {
        const uint32_t quarter = check->steps / QUARTER;
        const int is_inner = quarter == 1 || quarter == 2;
        vec3_copy(force, check->pulse);
        vec3_scale(is_inner == (check->is_inverse != 0) ? 1.0 : 0.0, force, force);
    }
}

static void begin_block(knurl_motor_check *check, const double position[3]) {
    memset(check->force, 0, sizeof check->force);
    memset(check->response, 0, sizeof check->response);
    vec3_copy(position, check->origin);
    if (check->blocks == 0) {
        vec3_copy(position, check->start);
    }
}

static void add_position(knurl_motor_check *check, const double position[3]) {
    if (check->steps == 0) {
        begin_block(check, position);
    }
    if (check->steps < LAG) {
        return;
    }
    const uint32_t at = check->steps - LAG;
    const double weight = weights[at < WINDOW / 2 ? at : WINDOW - 1 - at];
    for (int axis = 0; axis < 3; axis++) {
        check->response[axis] += weight * (position[axis] - check->origin[axis]);
        check->force[axis] += check->pulse[axis];
    }
}

static void add_answer(knurl_motor_check *check) {
    const double scale = (check->is_inverse ? -1.0 : 1.0) * (STEP * STEP) / (check->step * check->step);
    for (int axis = 0; axis < 3; axis++) {
        const double answer = scale * check->response[axis];
        const double change = check->blocks > 0 ? answer - check->latest[axis] : 0.0;
        check->sum[axis] += answer;
        check->spread += change * change;
        check->latest[axis] = answer;
    }
    check->blocks++;
}

/* No answer after many blocks: the handle is held too firmly, or does not move. Forces tried so far are harmless. */
static void try_harder(knurl_motor_check *check, double length) {
    if (length > 0.5 * check->limit) {
        check->known = check->limit;
        check->limit *= 2.0;
        check->axes = check->known < check->max_force ? check->axes : 0;
    }
    begin_answers(check);
}

/* The axis on which the direction of `sum` differs most from the unit vector `force`. */
static int worst_axis(const double force[3], const double sum[3]) {
    const double length = vec3_length(sum);
    int worst = 0;
    double most = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double off = fabs(sum[axis] - length * force[axis]);
        worst = off > most ? axis : worst;
        most = fmax(most, off);
    }
    return worst;
}

/* Compares the handle's motion with the force. The noise is estimated from differences of successive answers. */
static int end_block(knurl_motor_check *check) {
    double force[3];
    double beside[3];
    double moved[3];
    vec3_copy(check->force, force);
    const double length = vec3_normalise(force) / WINDOW;
    add_answer(check);
    check->is_inverse = POLARITY >> ++check->polarity % POLARITIES & 1u;
    const double along = vec3_dot(check->sum, force);
    vec3_scale(along, force, beside);
    vec3_sub(check->sum, beside, beside);
    vec3_sub(check->origin, check->start, moved);
    const double aside = vec3_length(beside);
    const double travel = vec3_dot(moved, force);
    if (check->blocks >= LEAST_BLOCKS) {
        const double noise = fmax(LEAST_NOISE, sqrt(check->spread / (2.0 * (check->blocks - 1))));
        const double root = sqrt((double)check->blocks);
        const double sure = SURE * noise * (root + 1.0 / root); /* few blocks give an uncertain noise, too */
        const int goes_aside = check->blocks >= LEAST_ASIDE && aside >= sure && aside > ASIDE * along;
        if ((along <= -sure && travel <= -TRAVEL) || (goes_aside && vec3_length(moved) >= TRAVEL)) {
            check->is_on = 0;
            return 1 + worst_axis(force, check->sum);
        }
        if (along >= sure && fabs(travel) >= TRAVEL && aside <= ASIDE * along) {
            check->axes &= ~axes_of(force, 1.0);
            begin_answers(check);
        }
    }
    if (check->blocks >= MOST_BLOCKS) {
        try_harder(check, length);
    }
    return 0;
}

int knurl_motor_check_step(knurl_motor_check *check, const double position[3]) {
    if (!check->is_wanted) {
        check->tick = check->steps = 0;
    } else {
        if (check->tick == 0) {
            add_position(check, position);
        }
        if (++check->tick == check->stride) {
            check->tick = 0;
            check->steps++;
        }
        if (check->steps == BLOCK) {
            check->steps = 0;
            const int found = end_block(check);
            if (found) {
                return found;
            }
        }
    }
    if (check->axes != 7 && check->ramp < check->max_force) {
        check->ramp += check->ramp_step;
    }
    check->is_on = check->axes || check->ramp < check->max_force;
    return 0;
}
