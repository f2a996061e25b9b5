/* Detects swings in and out of a wall that neither a hand nor a texture causes. SPDX-License-Identifier: MIT */
#include "guard/passivity.h"

#include <math.h>
#include <string.h>

/* A runaway: the HIP swings in and out of a wall, faster than hands do, repeatedly and as far each time,
 * and not because of a texture. Energy cannot decide it: near the limit, the energy
 * that a sampled wall generates equals that absorbed by friction and the hand, which is unknown.
 *
 * Tuned in the stability laboratory on flat walls and gratings within the limits of the presets touch and falcon.
 * test_protection_grids.c counts, of 4528 cells: all 92 flat walls that run away (at 12 to 25 Hz) are stopped, and of
 * 208 gratings that run away 197; of 4013 calm cells 12 are softened, which swing by up to 0.42 mm more than they
 * should, and of 49 that shake by 0.5 to 1.3 mm 27. */
#define LEAST   0.7e-3 /* m: a smaller swing ends a series; runaways swing by at least 0.84 mm, arrivals soon by less */
#define PERIOD  0.12   /* s: a slower swing ends a series; hands tap and shake on purpose at up to 8 Hz */
#define FORGETS 0.985  /* decay of the largest swing, per swing: a bounce that dies out does not count */
#define AGAIN   0.9    /* of the largest: a quantum of 0.06 mm is a tenth of the smallest swing */
#define ROW     4      /* swings: as many may be the arrival of a hand */
#define ENOUGH  24e-6  /* m^2: 4 swings of 2.5 mm, 17 of 1.2 mm */

/* A swing is caused by a texture if the texture moves more than this share of it, and crosses 0 no more often than a
 * HIP that bounces on every other ridge: twice, or four times in and out again. */
#define TEXTURE_SHARE 0.25
#define TEXTURE_SLOW  2

/* The square of a swing that a texture caused is subtracted so many times: in a runaway at a quarter of the texture's
 * frequency one in six is taken for such a one. 1.5 to 3 stop the same runaways; without this, or at 5, two are missed.
 */
#define AGAINST 2.0

/* An alarm: the wall keeps this share of the passive stiffness, is softened within this time (s; in a millisecond it
 * would be a blow), and is restored when the HIP has been off all walls for this long (s), longer than between bounces.
 */
#define SOFT_SHARE     0.8
#define SOFTENING_TIME 0.02
#define OFF_TIME       0.5

/* N s/m: damping of the hand that the controller assumes: a loose grip. Less than KNURL_LIGHTEST_HAND, because a check
 * at load should not warn too often, and a controller should not miss a case. */
#define LOOSE_HAND 0.5

void knurl_passivity_init(knurl_passivity *p, const knurl_hip_facts *facts) {
    memset(p, 0, sizeof *p);
    p->direction = -1.0;
    p->longest = (int32_t)(PERIOD * facts->rate);
    p->softening = 1.0 / (1.0 + SOFTENING_TIME * facts->rate);
    p->off_most = OFF_TIME * facts->rate;
}

/* Walls up to `safe` are stable: the device's and the hand's damping absorb the energy of a delayed spring (Colgate and
 * Schenkel 1997). Dry friction is not counted on: it helps a hand at rest, but hardly one that slides. */
void knurl_passivity_set_scale(knurl_passivity *p, int watches, const knurl_hip_facts *facts, double scale) {
    p->safe = watches ? (facts->viscous + LOOSE_HAND) * facts->rate / ((0.5 + facts->delay) * scale) : HUGE_VAL;
    p->unit = scale;
    p->reversal = KNURL_PASSIVITY_REVERSAL * scale;
}

/* A swing ends when the depth reverses. Friction's spring, along the wall and of the same stiffness, is not watched: it
 * slips beyond friction times the depth, which bounds its swing; an alarm softens it with its wall. */
void knurl_passivity_end_swing(knurl_passivity *p) {
    const double swing = fabs(p->farthest - p->extreme);
    const int slow = p->crossings <= TEXTURE_SLOW && p->crossings + p->crossed <= 2 * TEXTURE_SLOW;
    const int by_texture = slow && p->moved > TEXTURE_SHARE * swing;
    if (swing < LEAST * p->unit || p->ticks + p->before > p->longest) {
        knurl_passivity_end_row(p);
    } else if (by_texture) {
        p->squares -= AGAINST * swing * swing;
        if (p->squares <= 0.0) {
            knurl_passivity_end_row(p);
        }
    } else {
        const double largest = FORGETS * p->largest;
        p->largest = swing > largest ? swing : largest;
        if (swing < AGAIN * p->largest) { /* start again, but keep half: the small swing may be chance */
            p->squares *= 0.5;
            p->row = 0;
        }
        p->squares += swing * swing;
        p->alarmed = ++p->row >= ROW && p->squares > ENOUGH * p->unit * p->unit;
        p->off = 0.0;
    }
    p->extreme = p->farthest;
    p->farthest = p->depth;
    p->direction = -p->direction;
    p->before = p->ticks;
    p->crossed = p->crossings;
    p->ticks = 0;
    p->crossings = 0;
    p->moved = 0.0;
}

/* Advances an alarm by one tick. */
void knurl_passivity_go_on(knurl_passivity *p) {
    p->crossings = 0;
    p->soft += p->softening * (1.0 - p->soft);
    p->off += 1.0;
    if (p->off > p->off_most) {
        knurl_passivity_end_row(p);
        p->soft = 0.0;
        p->alarmed = 0;
    }
}

void knurl_passivity_soften(knurl_passivity *p, knurl_wall *wall) {
    const double most = SOFT_SHARE * p->safe;
    p->off = 0.0;
    wall->damping *= 1.0 - p->soft;
    if (wall->stiffness > most) { /* the texture weakens too: full steps would throw a hand off a soft wall */
        wall->stiffness += p->soft * (most - wall->stiffness);
    }
}
