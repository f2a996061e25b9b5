/* knurl study gratings: figure 6 and section III. SPDX-License-Identifier: MIT */
#include "gratings.h"

#include "study.h"

#include <string.h>

static void print_summary(const gratings_summary *s) {
    printf("gratings at %g Hz, no hand, ideal positions and velocities\n", GRATINGS_RATE);
    printf(
        "  directions  Eq. 11 crosses up to %.3f times Eq. 12 (at %.1f deg, 1000 x 1000 cycles/m); through the cells'\n"
        "              centres S1 plays %.0f cycles/m on the diagonal\n",
        s->map_over_path, s->angle_of_ratio, s->silent_diagonal);
    printf(
        "  S1          dropout %.0f %% at f_t = f_h; on 1000 x 1000 it loses up to %.0f %% of its cycles at 100 mm/s already,\n"
        "              where two edges fall into one tick\n",
        100.0 * s->s1_silent, 100.0 * s->grid_lost);
    printf(
        "  S2          drift %+.1f %% just below T = 3.5 ticks, %+.1f %% at it; %+.1f to %+.1f %% from 20 Hz to f_h/2\n",
        100.0 * s->drift_before, 100.0 * s->drift_at, 100.0 * s->drift_worst[0], 100.0 * s->drift_worst[1]);
    printf("              frozen for %.2f s from rest on a 2 mm grating: %.0f cycles crossed, one played\n",
           s->frozen_seconds, s->frozen_cycles);
    printf("  depth       no net force from %.3f A (3 ticks), %.3f A (mix) below the smooth surface\n",
           s->depth_needed[0], s->depth_needed[1]);
}

/* Writes all parts to two open files. */
static int write_all(FILE *csv, json_writer *json, void *user) {
    gratings_summary *summary = user;
    json_string(json, "study", "gratings");
    json_number(json, "update_rate_hz", GRATINGS_RATE);
    int done = gratings_directions(json, summary);
    done = done && gratings_map(csv, json);
    done = done && gratings_speeds(json, summary);
    done = done && gratings_strokes(json, summary);
    done = done && gratings_depths(json, summary);
    return !done;
}

int study_gratings(const char *folder) {
    gratings_summary summary;
    memset(&summary, 0, sizeof summary);
    const int failed = study_write(folder, "gratings", write_all, &summary);
    if (!failed) {
        print_summary(&summary);
    }
    return failed;
}
