/* The laboratory's runs. SPDX-License-Identifier: MIT */
#include "lab.h"

#include "lab_wall.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define APPROACH       0.25   /* s: duration of a stroke's descent */
#define HOVER          0.005  /* m above where a stroke starts */
#define REFERENCE_RATE 4000.0 /* Hz at least: the force is computed at the middle of a step, so the error is small */

/* Orders of magnitude, not measurements; common values, unverified except where "read" is noted. A fingertip has
 * some grams, some N s/m and 200 to 1300 N/m that grow with its force (Hajian and Howe 1997); in a pinch stiffness and
 * damping increase with the grip force, but the mass does not (Hasser and Cutkosky 2002: abstract read); a
 * stylus in a hand at the wrist is in between (Kuchenbecker, Park and Niemeyer 2003); a firm grip includes hand and
 * forearm (Speich, Shao and Goldfarb 2005; a whole arm: 0.55 kg, 6.5 N s/m and 135 N/m in one subject, van Beek et al.
 * 2015: figure read). "loose" is assumed: two fingers that barely hold the stylus. */
const lab_grip lab_grips[] = {{"none", 0.0, 0.0, 0.0},      {"loose", 100.0, 0.5, 0.005}, {"light", 250.0, 2.0, 0.01},
                              {"medium", 700.0, 5.0, 0.05}, {"firm", 2000.0, 15.0, 0.15}, {NULL, 0.0, 0.0, 0.0}};

const lab_grip *lab_grip_named(const char *name) {
    const lab_grip *grip = lab_grips;
    while (grip->name && strcmp(grip->name, name) != 0) {
        grip++;
    }
    return grip->name ? grip : NULL;
}

void lab_case_init(lab_case *c) {
    const lab_case defaults = {.device = "preset=touch",
                               .grip = &lab_grips[2],
                               .rate = 1000.0,
                               .settle = 0.25,
                               .seconds = 0.75,
                               .press = 1.0,
                               .approach = 0.05,
                               .stiffness = 400.0,
                               .period = 0.002,
                               .method = KNURL_METHOD_S2,
                               .without = KNURL_PROTECT_ALL};
    *c = defaults;
}

void lab_signals_free(lab_signals *s) {
    double *const arrays[] = {s->height,  s->measured,  s->motor,          s->written,
                              s->texture, s->reference, s->reference_force};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        free(arrays[i]);
    }
    free(s->event);
    free(s->flags);
    memset(s, 0, sizeof *s);
}

static int make_room(lab_signals *s, size_t count) {
    double **const arrays[] = {&s->height,  &s->measured,  &s->motor,          &s->written,
                               &s->texture, &s->reference, &s->reference_force};
    if (count > s->capacity) {
        lab_signals_free(s);
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
            *arrays[i] = malloc(count * sizeof **arrays[i]);
            s->capacity = *arrays[i] ? count : 0;
            if (!s->capacity) {
                lab_signals_free(s);
                return 1;
            }
        }
        s->event = malloc(count * sizeof *s->event);
        s->flags = malloc(count * sizeof *s->flags);
        if (!s->event || !s->flags) {
            lab_signals_free(s);
            return 1;
        }
    }
    s->count = count;
    return 0;
}

/* The descent of a stroke that crosses the surface, `depth` before its end, at `speed`: its path is a smooth step 3 u^2
 * - 2 u^3, so that (1 - u)^2 (1 + 2 u) of it is left at the surface, and the speed there is 6 u (1 - u) way/APPROACH.
 */
static double way_down(double depth, double speed) {
    double low = 0.5; /* it decelerates from the middle of the step on */
    double high = 1.0;
    for (int i = 0; i < 60; i++) {
        const double u = 0.5 * (low + high);
        const double way = depth / ((1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u));
        if (6.0 * u * (1.0 - u) * way / APPROACH < speed) {
            low = u;
        } else {
            high = u;
        }
    }
    return depth / ((1.0 - low) * (1.0 - low) * (1.0 + 2.0 * low));
}

/* The wall is at y = 0 on average, its normal up. A stroke starts HOVER above its centre and ends its depth below it,
 * so a centre above the wall makes the descent longer and faster. */
static knurl_stroke_desc stroke_of(const lab_case *c) {
    const lab_grip *grip = c->grip;
    const double depth = grip->stiffness > 0.0 ? c->press / grip->stiffness : 0.0;
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = c->speed > 0.0 ? KNURL_STROKE_LINE : KNURL_STROKE_REST;
    stroke.speed = c->speed;
    stroke.reach[0] = 1.0; /* no run reaches the turn */
    if (c->approach > 0.0 && depth > 0.0) {
        stroke.centre[1] = fmax(0.0, way_down(depth, c->approach) - depth - HOVER);
    }
    stroke.depth = depth + stroke.centre[1];
    return stroke;
}

static knurl_result open_device(const lab_case *c, double rate, const char *more, knurl_device **device) {
    char uri[512];
    const lab_grip *grip = c->grip;
    const knurl_stroke_desc stroke = stroke_of(c);
    const char *first = strncmp(c->device, "preset=", 7) == 0 ? c->device : "preset=touch";
    const size_t length = strcspn(first, "&");
    (void)snprintf(uri, sizeof uri,
                   "fake:?%.*s&width=4&tremor=0&exact=1&hand_stiffness=%.15g&hand_damping=%.15g&hand_mass=%.15g%s%s%s",
                   (int)length, first, grip->stiffness, grip->damping, grip->mass, first == c->device ? "" : "&",
                   first == c->device ? first + length : c->device, more);
    knurl_result result = knurl_device_open(uri, device);
    result = result ? result : knurl_fake_set_stroke(*device, &stroke);
    return result ? result : knurl_device_start(*device, rate);
}

static knurl_result add_wall(const lab_case *c, knurl_scene *scene) {
    knurl_surface_desc surface;
    knurl_material_desc material;
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_material_desc_init(&material, sizeof material);
    material.stiffness = c->stiffness;
    material.damping = c->damping;
    material.amplitude = c->amplitude;
    material.friction = 0.0;
    material.spatial_frequency[0] = c->amplitude > 0.0 ? 1.0 / c->period : 0.0;
    material.spatial_frequency[1] = 0.0;
    material.method = c->amplitude > 0.0 ? c->method : KNURL_METHOD_DEFAULT;
    surface.material = &material;
    return lab_wall_add(scene, c->wall, &surface);
}

static knurl_result add_effect(const lab_case *c, const knurl_device_info *info, knurl_scene *scene) {
    knurl_effect effect;
    if (knurl_effect_prepare(c->effect, &effect)) { /* its axis is up */
        return KNURL_ERROR_ARGUMENT;
    }
    effect.stiffness = c->stiffness;
    effect.damping = c->damping;
    effect.spacing = c->period;
    effect.max_force = info->max_force;
    return knurl_scene_set_effects(scene, 0, &effect, 1, 0.0);
}

static knurl_result make_scene(const lab_case *c, const knurl_device_info *info, knurl_scene **scene) {
    knurl_scene_desc desc;
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_scene_desc_init(&desc, sizeof desc);
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    desc.max_surfaces = 1;
    hip.update_rate_hz = c->rate;
    hip.workspace = &workspace;
    hip.resolution = info->resolution;
    hip.max_force = info->max_force;
    hip.continuous_force = info->continuous_force;
    hip.heat_time = info->heat_time;
    hip.viscous = info->viscous;
    hip.delay = info->delay;
    hip.max_stiffness = info->max_stiffness;
    hip.protections = KNURL_PROTECT_ALL & ~c->without;
    knurl_result result = knurl_scene_create(&desc, scene);
    result = result ? result : knurl_scene_configure_hip(*scene, 0, &hip);
    result = result ? result : c->effect ? add_effect(c, info, *scene) : add_wall(c, *scene);
    return result ? result : knurl_scene_commit(*scene);
}

/* The device, and the reference: a second device without delay, quantum and dry friction. */
typedef struct bench {
    const lab_case *c;
    knurl_scene *scene;
    knurl_device *device, *reference;
    int steps;        /* of the reference, per tick */
    double max_force; /* N */
    double last;      /* m: measured in the previous tick */
} bench;

static knurl_result build(const lab_case *c, bench *b) {
    knurl_device_info info;
    memset(b, 0, sizeof *b);
    b->c = c;
    b->steps = (int)fmax(1.0, ceil(REFERENCE_RATE / c->rate));
    knurl_device_info_init(&info, sizeof info);
    knurl_result result = open_device(c, c->rate, "", &b->device);
    result = result ? result : knurl_device_get_info(b->device, &info);
    result = result ? result : open_device(c, c->rate * b->steps, "&delay=0&resolution=0&coulomb=0", &b->reference);
    b->max_force = info.max_force;
    return result || c->bilateral ? result : make_scene(c, &info, &b->scene);
}

/* Computes the tick's force, and records the texture's signals. */
static void render(bench *b, const knurl_device_sample *sample, lab_signals *s, size_t i, double force[3]) {
    const lab_case *c = b->c;
    memset(force, 0, 3 * sizeof *force);
    s->texture[i] = 0.0;
    s->event[i] = KNURL_NO_EVENT;
    s->flags[i] = 0;
    if (c->bilateral) {
        force[1] = -c->stiffness * sample->position[1] - c->damping * (sample->position[1] - b->last) * c->rate;
    } else {
        knurl_tick_input input;
        knurl_tick_output output;
        memset(&input, 0, sizeof input);
        memcpy(input.position, sample->position, sizeof input.position);
        (void)knurl_scene_tick(b->scene, 0, &input, &output);
        memcpy(force, output.device_force, sizeof output.device_force);
        s->texture[i] = output.height;
        s->event[i] = output.event;
        s->flags[i] = output.flags;
    }
    b->last = sample->position[1];
}

/* m: of the spring at a height. */
static double stretch(const lab_case *c, double height) {
    const double turn = 2.0 * 3.14159265358979323846 / c->period;
    return c->effect == KNURL_EFFECT_DETENT ? sin(turn * height) / turn : height;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Advances the reference over one tick, with the tick's H. It extrapolates by half a step, to compensate for holding
 * its force over the step. */
static void follow(bench *b, double texture, lab_signals *s, size_t i) {
    const lab_case *c = b->c;
    const double dt = 1.0 / (c->rate * b->steps);
    knurl_device_sample sample;
    knurl_fake_truth truth;
    for (int step = 0; step < b->steps; step++) {
        (void)knurl_device_read(b->reference, &sample);
        (void)knurl_fake_get_truth(b->reference, &truth);
        double normal[3], force[3];
        const double height = lab_wall_distance(c->wall, truth.position, normal);
        const double outwards = dot(truth.velocity, normal);
        if (step == 0) {
            s->reference[i] = height;
            s->reference_force[i] = dot(truth.motor, normal);
        }
        const double ahead = height + 0.5 * dt * outwards;
        double size = c->stiffness * (texture - stretch(c, ahead)) - c->damping * outwards;
        if (!c->bilateral && !c->effect && (ahead > texture || size < 0.0)) {
            size = 0.0;
        }
        for (int axis = 0; axis < 3; axis++) {
            force[axis] = size * normal[axis];
        }
        (void)knurl_device_write(b->reference, force);
    }
}

static void perform(bench *b, lab_signals *s) {
    const lab_case *c = b->c;
    for (size_t i = 0; i < s->count; i++) {
        knurl_device_sample sample;
        knurl_fake_truth truth;
        double force[3], normal[3];
        (void)knurl_device_read(b->device, &sample);
        (void)knurl_fake_get_truth(b->device, &truth);
        s->measured[i] = lab_wall_distance(c->wall, sample.position, normal);
        s->height[i] = lab_wall_distance(c->wall, truth.position, normal);
        s->motor[i] = dot(truth.motor, normal);
        b->last = i > 0 ? b->last : sample.position[1];
        render(b, &sample, s, i, force);
        s->written[i] = dot(force, normal);
        (void)knurl_device_write(b->device, force);
        follow(b, s->texture[i], s, i);
    }
}

int lab_run(const lab_case *c, lab_signals *signals, lab_result *result) {
    bench b;
    const double start = APPROACH + c->settle;
    knurl_result failed = build(c, &b);
    if (!failed && make_room(signals, (size_t)((start + c->seconds) * c->rate))) {
        failed = knurl_fail(KNURL_ERROR_MEMORY, "lab: no memory for %g s at %g Hz", start + c->seconds, c->rate);
    }
    if (!failed) {
        signals->judged = (size_t)(start * c->rate);
        perform(&b, signals);
        memset(result, 0, sizeof *result);
        if (lab_judge(c, signals, b.max_force, result)) {
            failed = knurl_fail(KNURL_ERROR_MEMORY, "lab: no memory for a spectrum");
        }
    }
    knurl_scene_destroy(b.scene);
    knurl_device_close(b.device);
    knurl_device_close(b.reference);
    return failed != KNURL_OK;
}
