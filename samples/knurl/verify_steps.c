/* knurl verify: the table of its steps, and a run of them. SPDX-License-Identifier: MIT */
#include "verify.h"

#include "say.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define WAKE_S 1.5
#define WAKE_N 0.55 /* N along each axis: above what a driver sends without a check of the motors */

const verify_step verify_steps[] = {{"rate", "Update rate and lateness", 0, verify_rate},
                                    {"noise", "Position at rest", 0, verify_noise},
                                    {"axes", "Axes, workspace and resolution", 0, verify_axes},
                                    {"buttons", "Buttons", 0, verify_buttons},
                                    {"orientation", "Orientation", 0, verify_orientation},
                                    {"signs", "Signs of the force", 1, verify_signs},
                                    {"scale", "Scale of the force", 1, verify_scale},
                                    {"friction", "Friction", 1, verify_friction},
                                    {"latency", "Latency", 1, verify_latency},
                                    {"wall", "Stiffest wall", 1, verify_wall},
                                    {"response", "Response, 20 to 500 Hz", 1, verify_response},
                                    {"faults", "Faults on purpose", 1, verify_faults},
                                    {NULL, NULL, 0, NULL}};

/* The rest of a list after its first name, or null. */
static const char *next_name(const char *names) {
    const char *comma = strchr(names, ',');
    return comma ? comma + 1 : NULL;
}

static int is_first(const char *names, const char *name) {
    return strcspn(names, ",") == strlen(name) && strncmp(names, name, strlen(name)) == 0;
}

static int is_listed(const char *names, const char *name) {
    while (names && !is_first(names, name)) {
        names = next_name(names);
    }
    return names != NULL;
}

static int is_wanted(const verify *v, const verify_step *s) {
    return (!v->only || is_listed(v->only, s->name)) && !is_listed(v->skip, s->name);
}

int verify_is_empty(const verify *v) {
    const verify_step *s = verify_steps;
    while (s->name && !is_wanted(v, s)) {
        s++;
    }
    return s->name == NULL;
}

const char *verify_unknown(const char *names) {
    const verify_step *s = verify_steps;
    for (; names && s->name; names = s->name ? next_name(names) : names) {
        for (s = verify_steps; s->name && !is_first(names, s->name); s++) {}
    }
    return names;
}

/* Pushes along all axes, so that a driver that checks its motors' directions has done so. */
static void wake(verify *v, uint64_t tick, double force[3]) {
    (void)v;
    (void)tick;
    force[0] = force[1] = force[2] = WAKE_N;
}

static const char *wake_up(verify *v) {
    const char *why =
        verify_ask(v, VERIFY_HOLD, "Hold the grip loosely in the middle of its workspace: its motors are checked");
    why = why ? why : verify_play(v, WAKE_S, wake);
    v->is_awake = why == NULL;
    return why;
}

static const char *run_if_able(verify *v, const verify_step *s) {
    const char *why = *v->interrupted                ? "stopped"
                      : s->has_force && v->is_wrong  ? v->is_wrong
                      : s->has_force && !v->is_awake ? wake_up(v)
                                                     : NULL;
    return why ? why : s->run(v);
}

static void run_step(verify *v, const verify_step *s) {
    v->fault = 0;
    v->step = s;
    if (v->stream) {
        say(v->stream, "%s\n", s->title);
    }
    const char *why = run_if_able(v, s);
    if (v->fault) {
        (void)verify_find(v, "faults meanwhile", 1.0, "", 0.0, 0.0, "a device that is well has none", "%s: %s",
                          knurl_fault_name(v->fault), knurl_fault_string(v->fault));
    } else if (why) {
        (void)verify_find(v, s->name, NAN, "", NAN, NAN, "", "%s", *v->interrupted ? "stopped" : why);
    }
}

int verify_run(verify *v) {
    knurl_device_info_init(&v->info, sizeof v->info);
    v->rows = calloc(VERIFY_ROWS, sizeof *v->rows);
    if (!v->rows || knurl_device_get_info(v->device, &v->info)) {
        free(v->rows);
        return 1;
    }
    v->newtons = v->limit = fmin(VERIFY_FORCE, fmin(v->info.max_force, v->info.continuous_force));
    v->scale = 1.0;
    for (const verify_step *s = verify_steps; s->name; s++) {
        if (is_wanted(v, s)) {
            run_step(v, s);
        }
    }
    free(v->rows);
    v->rows = NULL;
    return 0;
}
