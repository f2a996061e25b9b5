/* Study `transitions`: events that are interrupted because the hand reverses, stops or lifts off, or surface or
 * material change: whole ticks of a scene, at 200 Hz, for each tick of an event. SPDX-License-Identifier: MIT */
#include "study.h"

#include "say.h"

#include <math.h>
#include <string.h>

#define FS        1000.0 /* cycles/m */
#define AMPLITUDE 1e-4   /* m */
#define STIFFNESS 700.0  /* N/m */
#define DEPTH     0.001  /* m: below every trough */
#define SPEED     0.2    /* m/s: 5 ticks per cycle */
#define FAST      0.47   /* m/s */
#define EDGE      0.02   /* m: start of the other surface */
#define BEFORE    100    /* ticks; and up to 9 more, so that the change occurs at any phase of an event */
#define PHASES    10
#define AFTER     45 /* ticks: before the HIP reaches the other surface */
#define QUANTUM   0.055e-3
#define METHODS   2

enum { REVERSAL, STOP, LIFT_OFF, OTHER_SURFACE, OTHER_MATERIAL, FLICKER, FASTER, TRANSITIONS };

static const char *const names[TRANSITIONS] = {"reversal",
                                               "stop",
                                               "lift-off for 5 ticks",
                                               "another surface",
                                               "another material",
                                               "rest on an edge, flickering",
                                               "20 ticks at 470 Hz"};

typedef struct outcome {
    double settled; /* ms until the height is final: 0 (S2), the position's (bandlimited) */
    double step;    /* the largest change of height in a tick in contact, A */
    double left;    /* the largest sum of a completed event, A ticks */
    double force;   /* N: of the first tick after lift-off */
} outcome;

/* The HIP's position at a tick. Events start at x = 0.75 of a cycle, and so on. */
static void place(int transition, int tick, int happens, double *x, double *z, double *speed) {
    const double step = SPEED / 1000.0;
    *speed = SPEED;
    *z = -DEPTH;
    *x = EDGE + step * (tick - happens) - (transition == OTHER_SURFACE ? 0.5 * step : 0.5 * EDGE);
    *x -= transition == FASTER ? 0.25 * EDGE : 0.0;
    if (tick < happens) {
        return;
    }
    if (transition == REVERSAL) {
        *speed = -SPEED;
        *x -= 2.0 * step * (tick - happens);
    } else if (transition == STOP) {
        *speed = 0.0;
        *x -= step * (tick - happens);
    } else if (transition == LIFT_OFF && tick < happens + 5) {
        *z = 0.005;
    } else if (transition == FASTER) {
        *speed = tick - happens < 20 ? FAST : SPEED;
        *x += (FAST - SPEED) / 1000.0 * (tick - happens < 20 ? tick - happens : 20);
    } else if (transition == FLICKER) { /* one quantum on each side of the edge at EDGE/2 + 1/4 cycle */
        *speed = 0.0;
        *x = 0.5 * EDGE + 0.25 / FS + QUANTUM * (tick % 2 ? 0.5 : -0.5);
    }
}

static knurl_result build(int32_t method, double fs_right, knurl_scene **scene, knurl_surface_id *left) {
    knurl_result result = knurl_scene_create(NULL, scene);
    for (int i = 0; i < 2 && !result; i++) {
        knurl_plane_desc plane;
        knurl_surface_desc desc;
        knurl_material_desc material;
        knurl_surface_id surface;
        knurl_plane_desc_init(&plane, sizeof plane);
        knurl_surface_desc_init(&desc, sizeof desc);
        knurl_material_desc_init(&material, sizeof material);
        plane.half_extents[0] = plane.half_extents[1] = 0.05;
        material.method = method;
        material.amplitude = AMPLITUDE;
        material.stiffness = STIFFNESS;
        material.spatial_frequency[0] = i == 0 ? FS : fs_right;
        desc.plane = &plane;
        desc.material = &material;
        desc.position[0] = EDGE + (i == 0 ? -0.05 : 0.05);
        desc.axis[0] = 1.0;
        result = knurl_scene_add_surface(*scene, &desc, &surface);
        *left = i == 0 ? surface : *left;
    }
    result = result ? result : knurl_scene_commit(*scene);
    knurl_hip_desc hip;
    knurl_workspace workspace;
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    hip.workspace = &workspace;
    return result ? result : knurl_scene_configure_hip(*scene, 0, &hip);
}

static knurl_result change_material(knurl_scene *scene, knurl_surface_id surface, int32_t method) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = method;
    material.amplitude = 0.6 * AMPLITUDE;
    material.stiffness = STIFFNESS;
    material.spatial_frequency[0] = 0.7 * FS;
    return knurl_scene_set_material(scene, surface, &material);
}

/* State between ticks. */
typedef struct watch {
    double height, sum;
    int64_t event;
    uint32_t contacts;
    knurl_surface_id surface; /* a change of surface counts as a lift-off */
} watch;

/* BANDLIMITED counts ridges, most of which are not events with a zero sum: counts_ridges skips the sums. */
static void judge(const knurl_tick_output *out, int since, int counts_ridges, watch *w, outcome *o) {
    if (out->contacts && w->contacts) {
        o->step = fmax(o->step, fabs(out->height - w->height) / AMPLITUDE);
        if (!counts_ridges && out->surface == w->surface && out->event != w->event && w->event != KNURL_NO_EVENT) {
            o->left = fmax(o->left, fabs(w->sum) / AMPLITUDE);
        }
    }
    w->sum = out->event == w->event && out->contacts ? w->sum + out->height : out->height;
    if (since == 0 && !out->contacts) {
        o->force = sqrt(out->force[0] * out->force[0] + out->force[1] * out->force[1] + out->force[2] * out->force[2]);
    }
    if (since > 0 && fabs(out->height - w->height) > 1e-9 * AMPLITUDE) {
        o->settled = fmax(o->settled, since);
    }
    w->height = out->height;
    w->event = out->event;
    w->contacts = out->contacts;
    w->surface = out->surface;
}

/* One method, one transition, started in one tick of an event; one outcome collects the worst of several. */
static knurl_result run(int32_t method, int transition, int phase, FILE *csv, outcome *o) {
    knurl_scene *scene = NULL;
    knurl_surface_id left = 0;
    const int happens = BEFORE + phase;
    watch w = {0.0, 0.0, KNURL_NO_EVENT, 0, 0};
    knurl_result result = build(method, 0.5 * FS, &scene, &left);
    for (int tick = 0; tick < happens + AFTER && !result; tick++) {
        knurl_tick_input input;
        knurl_tick_output out;
        memset(&input, 0, sizeof input);
        place(transition, tick, happens, &input.position[0], &input.position[2], &input.velocity[0]);
        input.has_velocity = 1;
        result = transition == OTHER_MATERIAL && tick == happens ? change_material(scene, left, method) : KNURL_OK;
        result = result ? result : knurl_scene_tick(scene, 0, &input, &out);
        judge(&out, tick - happens, method == KNURL_METHOD_BANDLIMITED, &w, o);
        if (phase == 3 && tick >= happens - 20 && tick < happens + 40) {
            fprintf(csv, "%s,\"%s\",%d,", knurl_method_name(method), names[transition], tick - happens);
            out_number(csv, out.contacts ? out.height / AMPLITUDE : 0.0);
            fputc('\n', csv);
        }
    }
    knurl_scene_destroy(scene);
    return result;
}

static void print_row(json_writer *json, int32_t method, int transition, const outcome *o) {
    const int rests = transition == STOP || transition == FLICKER;
    say(stdout, "| %s | %s |", names[transition], knurl_method_name(method));
    if (rests) {
        printf(" %g ms", o->settled);
    }
    printf(" | %.3f A | %.0e |", o->step, o->left);
    if (transition == LIFT_OFF) {
        printf(" %g N", o->force);
    }
    printf(" |\n");
    json_open(json, NULL, '{');
    json_string(json, "transition", names[transition]);
    json_string(json, "method", knurl_method_name(method));
    json_number(json, "settled_ms", rests ? o->settled : NAN);
    json_number(json, "largest_step", o->step);
    json_number(json, "left", o->left);
    json_number(json, "force", transition == LIFT_OFF ? o->force : NAN);
    json_close(json, '}');
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    static const int32_t methods[METHODS] = {KNURL_METHOD_S2, KNURL_METHOD_BANDLIMITED};
    (void)user;
    fputs("method,transition,tick,height\n", csv);
    json_string(json, "study", "transitions");
    json_string(json, "table", "transitions.csv");
    json_open(json, "rows", '[');
    printf(
        "| what happens in an event | method | the height rests after | largest step | left of events played to their end (A ticks) | force after |\n"
        "|---|---|---|---|---|---|\n");
    for (int i = 0; i < METHODS * TRANSITIONS; i++) {
        outcome o = {0.0, 0.0, 0.0, 0.0};
        for (int phase = 0; phase < PHASES; phase++) {
            if (run(methods[i % METHODS], i / METHODS, phase, csv, &o)) {
                return tool_error(2, "study: transitions: %s", knurl_error_message());
            }
        }
        print_row(json, methods[i % METHODS], i / METHODS, &o);
    }
    json_close(json, ']');
    return 0;
}

int study_transitions(const char *folder) {
    return study_write(folder, "transitions", write_all, NULL);
}
