/* Runs a number of ticks of one contender and nothing else, for counting instructions. usage: knurl_tick_row INDEX
 * TICKS.
 * SPDX-License-Identifier: MIT */
#include "contender.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    study_contender contender;
    study_rendering rendering;
    volatile double sink = 0.0;
    if (study_add_own() || argc != 3 || !study_contender_at(strtoul(argv[1], NULL, 10), &contender) ||
        study_rendering_start(&rendering, &contender, 137.0)) {
        fputs("usage: knurl_tick_row INDEX TICKS\n", stderr);
        return 2;
    }
    for (unsigned long i = strtoul(argv[2], NULL, 10); i > 0; i--) {
        sink = study_rendering_tick(&rendering);
    }
    (void)sink;
    return 0;
}
