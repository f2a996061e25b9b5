/* Properties of a Touch, as far as HD reports them. SPDX-License-Identifier: MIT */
#include "device/touch/touch_device.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A number from HD times `unit`, or `otherwise` if it is not plausible. */
static double ask(touch *t, hd_enum what, double unit, double least, double most, double otherwise) {
    double value = NAN;
    t->hd->get_doubles(what, &value);
    value *= unit;
    return value >= least && value <= most ? value : otherwise;
}

static void ask_workspace(touch *t) {
    static const double half[3] = {0.080, 0.060, 0.035}; /* data sheet of the Phantom Omni, as it is quoted */
    double mm[6] = {NAN, NAN, NAN, NAN, NAN, NAN};
    int believable = 1;
    t->hd->get_doubles(HD_USABLE_WORKSPACE, mm);
    for (int axis = 0; axis < 3; axis++) {
        believable = believable && mm[axis] < mm[axis + 3] && fabs(mm[axis]) < 1e4 && fabs(mm[axis + 3]) < 1e4;
    }
    for (int axis = 0; axis < 3; axis++) {
        t->info.workspace_min[axis] = believable ? 1e-3 * mm[axis] : -half[axis];
        t->info.workspace_max[axis] = believable ? 1e-3 * mm[axis + 3] : half[axis];
    }
}

static const char *ask_string(touch *t, hd_enum what, const char *otherwise) {
    const char *answer = t->hd->get_string(what);
    return answer && answer[0] ? answer : otherwise;
}

void knurl_touch_ask_info(touch *t) {
    knurl_device_info *info = &t->info;
    knurl_device_info_init(info, sizeof *info);
    const char *model = ask_string(t, HD_MODEL, "unknown model");
    (void)snprintf(info->name, sizeof info->name, "3D Systems Touch (%.40s)", model);
    (void)snprintf(t->title, sizeof t->title, "3D Systems Touch (%.40s, ", model);
    const size_t used = strlen(t->title);
    (void)snprintf(t->title + used, sizeof t->title - used, "HD %.24s, driver %.24s)",
                   ask_string(t, HD_VERSION, "unknown"), ask_string(t, HD_DRIVER_VERSION, "unknown"));
    ask_workspace(t);
    info->max_force = ask(t, HD_MAX_FORCE, 1.0, 0.1, 100.0, 3.3); /* default: the paper and the data sheet */
    info->continuous_force =                                      /* default: the sheet */
        ask(t, HD_CONTINUOUS_FORCE, 1.0, 0.01, info->max_force, fmin(0.88, info->max_force));
    info->max_stiffness = ask(t, HD_MAX_STIFFNESS, 1e3, 1.0, 1e5, 1020.0); /* default: the sheet's minimum, of z */
    info->resolution = 0.055e-3;                                           /* the paper, data sheet */
    info->mass = 0.045;                                                    /* data sheet: apparent, at the tip */
    info->coulomb = 0.26;                                                  /* data sheet: backdrive friction */
    info->viscous = 0.5;                                                   /* assumed, see the preset in fake_uri.h */
    info->heat_time = 60.0;                                                /* assumed, see there */
    info->delay = 1.0;       /* assumed: the force is played in the scheduler's next turn */
    info->native_rate = 0.0; /* one frame per tick */
}
