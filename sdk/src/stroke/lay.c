/* Plans strokes of the simulated hand over a scene's surfaces: straight on a flat surface, along a path on a curved
 * one. Game thread. SPDX-License-Identifier: MIT */
#include "scene/scene.h"
#include "stroke/walk.h"

#include "base/base.h"
#include "base/rule.h"

#include <knurl/stroke.h>

#include <stdlib.h>
#include <string.h>

#define HOVER     0.005  /* m above a surface that a stroke starts from */
#define STEP      0.0005 /* m of the device between a path's rows */
#define HALF_ROWS 400    /* of a path, in either direction from its start: 0.2 m */
#define SPREAD    0.9    /* share of the distance to a rim or the workspace's end: hands overshoot at the ends */
#define LONG      0.040  /* m: long enough for a path; longer ones are not preferred */
#define SHORT     0.001  /* m: shorter paths are not used */
#define LATITUDES 12     /* starting points tried on either side of the anchor */
#define LATITUDE  10     /* steps between them */
#define TURN_ROWS 128    /* of a circle */
#define PROBES    16     /* along a straight stroke */

/* A path in device axes: rows of a position and its normal. */
typedef struct path {
    double rows[2 * HALF_ROWS + 1][6];
    uint32_t count;
    double length;  /* m */
    double stretch; /* mean change of the grating's coordinate per metre of the path */
    int is_flat;
} path;

/* The inputs and the work space of a stroke's planning. */
typedef struct planner {
    const knurl_surface_data *surface;
    knurl_pose pose; /* of the shape's frame */
    knurl_workspace workspace;
    knurl_device_info limits;
    knurl_surface_info info;
    knurl_walker start; /* at the anchor */
    path paths[2];      /* the best so far, and the candidate */
    double side[HALF_ROWS][6];
} planner;

void knurl_stroke_report_init(knurl_stroke_report *report, uint32_t size) {
    const knurl_stroke_report defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, report, size);
}

/* The distance that a device position can move along both directions within the workspace; 0 outside of it. */
static double free_distance(const knurl_device_info *limits, const double from[3], const double direction[3]) {
    double reach = HUGE_VAL;
    for (int axis = 0; axis < 3; axis++) {
        const double space = fmin(limits->workspace_max[axis] - from[axis], from[axis] - limits->workspace_min[axis]);
        if (space <= 0.0) {
            return 0.0;
        }
        if (fabs(direction[axis]) > 1e-6) {
            reach = fmin(reach, space / fabs(direction[axis]));
        }
    }
    return reach;
}

/* A straight stroke about the anchor, as long as the surface's and the workspace's bounds allow. */
static void lay_straight(const planner *l, knurl_stroke_desc *desc) {
    double y[3];
    knurl_workspace_to_device(&l->workspace, l->info.anchor, desc->centre);
    knurl_workspace_vector_to_device(&l->workspace, l->info.anchor_x, desc->x);
    knurl_workspace_vector_to_device(&l->workspace, l->info.anchor_normal, desc->normal);
    vec3_cross(desc->normal, desc->x, y);
    const double *edge = l->info.anchor_reach;
    const double scale = l->workspace.scale;
    const double reach[2] = {fmin(edge[0], edge[1]) / scale, fmin(edge[2], edge[3]) / scale};
    desc->reach[0] = fmin(1.0, fmax(1e-4, SPREAD * fmin(reach[0], free_distance(&l->limits, desc->centre, desc->x))));
    desc->reach[1] = fmin(1.0, fmax(1e-4, SPREAD * fmin(reach[1], free_distance(&l->limits, desc->centre, y))));
}

/* 1 if a stroke through the anchor along x, y of its tangent plane stays on the surface for `reach` (scene, m). */
static int stays_on(const planner *l, const double x, const double y, double reach) {
    double direction[3];
    vec3_scale(x, l->start.x, direction);
    vec3_madd(direction, y, l->start.y, direction);
    for (int i = -PROBES; i <= PROBES; i++) {
        knurl_walker probe;
        double place[3];
        double off[3];
        vec3_madd(l->start.place, reach * i / PROBES, direction, place);
        if (!knurl_walker_begin(&probe, l->surface, l->start.step, place, l->start.normal)) {
            return 0;
        }
        vec3_sub(probe.place, place, off);
        if (vec3_length(off) > 1e-3 * l->start.step) {
            return 0;
        }
    }
    return 1;
}

/* Writes the walker's position as a row. Returns 0 if it, or a HIP above it, lies outside the workspace. */
static int write_row(const planner *l, const knurl_walker *walker, double row[6]) {
    double at[3];
    double above[3];
    knurl_pose_to_parent(&l->pose, walker->place, at);
    knurl_workspace_to_device(&l->workspace, at, row);
    knurl_pose_vector_to_parent(&l->pose, walker->normal, at);
    knurl_workspace_vector_to_device(&l->workspace, at, row + 3);
    vec3_madd(row, HOVER, row + 3, above);
    for (int axis = 0; axis < 3; axis++) {
        const double low = l->limits.workspace_min[axis];
        const double high = l->limits.workspace_max[axis];
        if (!(row[axis] >= low && row[axis] <= high && above[axis] >= low && above[axis] <= high)) {
            return 0;
        }
    }
    return 1;
}

/* Turns a direction along the grating's x, of either sign. Returns 0 if that turns it by over 60 degrees: another
 * island of uvs begins there. */
static int turn_along_x(const knurl_walker *walker, double direction[3]) {
    const double along = vec3_dot(walker->x, direction);
    vec3_scale(along < 0.0 ? -1.0 : 1.0, walker->x, direction);
    return fabs(along) >= 0.5;
}

/* Turns a direction into the surface's tangent plane. Returns 0 if it is nearly normal to it. */
static int turn_straight(const knurl_walker *walker, double direction[3]) {
    vec3_make_tangent(walker->normal, direction);
    const double length = vec3_length(direction);
    vec3_scale(length > 0.0 ? 1.0 / length : 0.0, direction, direction);
    return length > 0.5;
}

/* Walks at most `most` steps over the surface and writes a row for each. Returns how many; *is_closed: 1 if it came
 * back to its start. */
static uint32_t walk(const planner *l, knurl_walker walker, const double towards[3],
                     int (*turn)(const knurl_walker *walker, double direction[3]), uint32_t most, double (*rows)[6],
                     path *sum, int *is_closed) {
    double direction[3];
    double start[3];
    vec3_copy(towards, direction);
    vec3_copy(walker.place, start);
    *is_closed = 0;
    for (uint32_t i = 0; i < most; i++) {
        double back[3];
        if (!knurl_walker_go(&walker, direction) || !turn(&walker, direction) || !write_row(l, &walker, rows[i])) {
            return i;
        }
        sum->stretch += knurl_walker_stretch(&walker, direction);
        sum->is_flat &= vec3_dot(walker.normal, l->start.normal) > 1.0 - 1e-9;
        vec3_sub(walker.place, start, back);
        if (i >= 8 && vec3_length(back) < 0.75 * walker.step) {
            *is_closed = 1;
            return i + 1;
        }
    }
    return most;
}

static double length_of(const double (*rows)[6], uint32_t count) {
    double sum = 0.0;
    for (uint32_t i = 1; i < count; i++) {
        double way[3];
        vec3_sub(rows[i], rows[i - 1], way);
        sum += vec3_length(way);
    }
    return sum;
}

/* A path along the grating's x, both ways from a position, shortened by SPREAD unless it is closed; 0 rows if it cannot
 * start there. */
static void lay_along_x(planner *l, const knurl_walker *from, path *p) {
    double opposite[3];
    int is_closed;
    double first[6];
    memset(p, 0, sizeof *p);
    p->is_flat = vec3_dot(from->normal, l->start.normal) > 1.0 - 1e-9;
    if (!write_row(l, from, first)) {
        return;
    }
    vec3_scale(-1.0, from->x, opposite);
    uint32_t ahead = walk(l, *from, from->x, turn_along_x, HALF_ROWS, p->rows, p, &is_closed);
    uint32_t behind = is_closed ? ahead - ahead / 2 : HALF_ROWS;
    ahead = is_closed ? ahead / 2 : ahead;
    int is_closed_behind;
    behind = walk(l, *from, opposite, turn_along_x, behind, l->side, p, &is_closed_behind);
    const double steps = ahead + behind;
    p->stretch = steps > 0.0 ? p->stretch / steps : 1.0;
    if (!is_closed) {
        ahead = (uint32_t)(SPREAD * ahead);
        behind = (uint32_t)(SPREAD * behind);
    }
    memmove(p->rows[behind + 1], p->rows[0], ahead * sizeof p->rows[0]);
    memcpy(p->rows[behind], first, sizeof first);
    for (uint32_t i = 0; i < behind; i++) {
        memcpy(p->rows[behind - 1 - i], l->side[i], sizeof l->side[0]);
    }
    p->count = ahead + behind + 1;
    p->length = length_of((const double (*)[6])p->rows, p->count);
}

/* Rates a path: its length, up to LONG; a quarter of that if the grating is stretched by over KNURL_STRETCH_MAX. */
static double rate(const path *p) {
    const int is_even = p->stretch <= KNURL_STRETCH_MAX && p->stretch * KNURL_STRETCH_MAX >= 1.0;
    return (is_even ? 1.0 : 0.25) * fmin(p->length, LONG);
}

/* Plans a path from a position and keeps the better of it and the best so far. Returns 1 once that is long enough. */
static int try_path(planner *l, const knurl_walker *from) {
    lay_along_x(l, from, &l->paths[1]);
    if (rate(&l->paths[1]) > rate(&l->paths[0])) {
        l->paths[0] = l->paths[1];
    }
    return rate(&l->paths[0]) >= LONG;
}

/* Tries starting points along y. At a sphere's pole the grating's x runs round in a tiny ring; rings further along y
 * are longer. */
static void find_path(planner *l) {
    knurl_walker at[2] = {l->start, l->start};
    double towards[2][3];
    int goes[2] = {1, 1};
    vec3_copy(l->start.y, towards[0]);
    vec3_scale(-1.0, l->start.y, towards[1]);
    for (int latitude = 0; latitude < LATITUDES && (goes[0] || goes[1]); latitude++) {
        for (int side = 0; side < 2; side++) {
            for (int i = 0; i < LATITUDE && goes[side]; i++) {
                goes[side] = knurl_walker_go(&at[side], towards[side]) && turn_straight(&at[side], towards[side]);
            }
            if (goes[side] && try_path(l, &at[side])) {
                return;
            }
        }
    }
}

/* A stroke back and forth. Returns 0 for flat surfaces, which are stroked straight. */
static int lay_line(planner *l, knurl_stroke_desc *desc) {
    const int is_long = try_path(l, &l->start);
    if (l->paths[1].is_flat && stays_on(l, 1.0, 0.0, desc->reach[0] * l->workspace.scale)) {
        return 0;
    }
    if (!is_long) {
        find_path(l);
    }
    desc->path = l->paths[0].rows[0];
    desc->path_rows = l->paths[0].count;
    return l->paths[0].length >= SHORT;
}

/* A circle round the anchor, reached by a spiral of one turn. Its radius is the shortest distance that a straight walk
 * from the anchor can go. */
static int lay_circle(planner *l, knurl_stroke_desc *desc) {
    path *p = &l->paths[0];
    path *walks = &l->paths[1];
    uint32_t least = HALF_ROWS / 4;
    const double flat_radius = fmin(desc->reach[0], desc->reach[1]) * l->workspace.scale;
    int is_closed;
    memset(p, 0, sizeof *p);
    walks->is_flat = 1;
    for (uint32_t pass = 0; pass < 2; pass++) { /* first the radius, then the rows */
        for (uint32_t i = 0; i <= TURN_ROWS; i++) {
            const double angle = 6.283185307179586 * i / TURN_ROWS;
            double direction[3];
            vec3_scale(sin(angle), l->start.x, direction);
            vec3_madd(direction, -cos(angle), l->start.y, direction);
            const uint32_t steps = walk(l, l->start, direction, turn_straight, least, walks->rows, walks, &is_closed);
            if (pass == 0) {
                least = steps < least ? steps : least;
                continue;
            }
            const uint32_t grown = least * i / TURN_ROWS;
            if (grown == 0) {
                (void)write_row(l, &l->start, p->rows[i]);
            } else {
                memcpy(p->rows[i], walks->rows[grown - 1], sizeof p->rows[i]);
            }
            if (steps > 0) {
                memcpy(p->rows[TURN_ROWS + i], walks->rows[steps - 1], sizeof p->rows[i]);
            }
        }
        if (pass == 0 && walks->is_flat && stays_on(l, 1.0, 0.0, flat_radius) && stays_on(l, 0.0, 1.0, flat_radius)) {
            return 0;
        }
        least = pass == 0 ? (uint32_t)(SPREAD * least) : least;
        if (least < 2) {
            return 0;
        }
    }
    p->count = 2 * TURN_ROWS + 1;
    p->length = length_of((const double (*)[6]) & p->rows[TURN_ROWS], TURN_ROWS + 1);
    desc->path = p->rows[0];
    desc->path_rows = p->count;
    desc->path_loop = TURN_ROWS;
    return 1;
}

/* Starts a walker beside a tip. At the tip itself many faces meet: pressed in against one, it would leave through
 * another. */
static int begin_beside(planner *l, double step, const double place[3], const double normal[3]) {
    double x[3];
    double y[3];
    vec3_any_tangent(normal, x);
    vec3_cross(normal, x, y);
    for (int i = 0; i < 32; i++) { /* in eight directions, 2, 4, 8 and 16 steps away */
        const double away = step * (2 << i / 8);
        const double angle = 0.7853981633974483 * (i % 8);
        double beside[3];
        vec3_madd(place, away * cos(angle), x, beside);
        vec3_madd(beside, away * sin(angle), y, beside);
        if (knurl_walker_begin(&l->start, l->surface, step, beside, normal)) {
            return 1;
        }
    }
    return 0;
}

/* Places the walker on the anchor. Its steps are small beside the device's workspace and the surface. */
static int begin(planner *l) {
    double place[3];
    double normal[3];
    double size[3];
    vec3_sub(l->info.bounds_max, l->info.bounds_min, size);
    const double step = fmin(STEP * l->workspace.scale, 0.005 * vec3_length(size));
    knurl_pose_to_own(&l->pose, l->info.anchor, place);
    knurl_pose_vector_to_own(&l->pose, l->info.anchor_normal, normal);
    return step > 0.0 &&
           (knurl_walker_begin(&l->start, l->surface, step, place, normal) || begin_beside(l, step, place, normal));
}

/* Returns 1 if the stroke follows a path. */
static int lay_path(planner *l, knurl_stroke_desc *desc) {
    const int is_circle = desc->stroke == KNURL_STROKE_CIRCLE;
    const int moves = is_circle || desc->stroke == KNURL_STROKE_LINE || desc->stroke == KNURL_STROKE_SWEEP;
    const int found = moves && begin(l) && (is_circle ? lay_circle(l, desc) : lay_line(l, desc));
    if (!found) {
        desc->path = NULL;
        desc->path_rows = desc->path_loop = 0;
    }
    return found;
}

static knurl_result lay(planner *l, const knurl_scene *scene, knurl_surface_id id, int32_t stroke, knurl_device *device,
                        knurl_stroke_report *report) {
    knurl_stroke_desc desc;
    knurl_stroke_desc_init(&desc, sizeof desc);
    desc.stroke = stroke;
    lay_straight(l, &desc);
    knurl_scene_lock(scene);
    l->surface = knurl_surfaces_get(&scene->surfaces, id);
    if (!l->surface) {
        knurl_scene_unlock(scene);
        return KNURL_ERROR_STALE_ID;
    }
    knurl_motion_at(&l->surface->record->motion, knurl_scene_time(scene), &l->pose);
    report->follows = (uint32_t)lay_path(l, &desc);
    knurl_scene_unlock(scene);
    report->is_outside = free_distance(&l->limits, desc.centre, desc.normal) <= 0.0;
    if (stroke == KNURL_STROKE_LINE || stroke == KNURL_STROKE_SWEEP) {
        report->length = report->follows ? l->paths[0].length : 2.0 * desc.reach[0];
    } else if (stroke == KNURL_STROKE_CIRCLE) {
        report->length = report->follows ? l->paths[0].length : 6.283185307179586 * fmin(desc.reach[0], desc.reach[1]);
    }
    return knurl_fake_set_stroke(device, &desc);
}

knurl_result knurl_fake_lay_stroke(knurl_device *device, const knurl_scene *scene, uint32_t hip,
                                   knurl_surface_id surface, int32_t stroke, knurl_stroke_report *report) {
    KNURL_RULE(GAME, device);
    if (KNURL_BAD_HANDLE(device, DEVICE) || KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_stroke_report made = {0};
    planner *l = calloc(1, sizeof *l);
    if (!l) {
        return knurl_fail(KNURL_ERROR_MEMORY, "stroke: could not get %u bytes", (unsigned)sizeof *l);
    }
    knurl_surface_info_init(&l->info, sizeof l->info);
    knurl_device_info_init(&l->limits, sizeof l->limits);
    knurl_result result = knurl_scene_get_surface_info(scene, surface, &l->info);
    result = result ? result : knurl_device_get_info(device, &l->limits);
    result = result ? result : knurl_scene_get_workspace(scene, hip, &l->workspace);
    result = result ? result : lay(l, scene, surface, stroke, device, &made);
    free(l);
    return result || !report ? result : knurl_desc_return("knurl_stroke_report", &made, sizeof made, report);
}
