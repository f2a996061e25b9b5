/* The god-object's ways. SPDX-License-Identifier: MIT */
#include "scene/god_object.h"

/* m: edges and steps that are lower do not stop a proxy: less than a tenth of what devices' encoders tell apart, more
 * than what rounding and overlapping seams leave of even floors. */
#define HOP_HEIGHT 10e-6

/* Looks for what is in the way, from where it has got to, in a tick at most; and faces that are met in one of them.
 * What is left of a way then is gone in the next ticks: until then it is held where it is. */
#define PASSES 8
#define MEETS  5

/* m: nearer than this it is there. */
#define ARRIVED 1e-10

/* A hit as a constraint in the scene. */
static void set_face(const knurl_obstacles *obstacles, uint32_t obstacle, const knurl_cast_hit *hit,
                     knurl_active_face *face) {
    double point[3];
    const knurl_pose *pose = obstacles->list[obstacle].pose;
    knurl_pose_vector_to_parent(pose, hit->normal, face->normal);
    knurl_pose_to_parent(pose, hit->point, point);
    face->rest = obstacles->list[obstacle].surface->shape.seam;
    face->offset = vec3_dot(point, face->normal) + face->rest;
    face->press = 0.0;
    face->hit = *hit;
    face->obstacle = obstacle;
}

/* On the way to `goal`, as far as the height above the face that was hit at which it rests. */
static void stop_before(knurl_god_object *g, const knurl_active_face *face, const double goal[3]) {
    double way[3];
    vec3_sub(goal, g->at, way);
    const double above = face->hit.height - face->rest;
    const double falls = -vec3_dot(way, face->normal);
    if (above > 0.0 && falls > 0.0) {
        const double share = above / falls;
        vec3_madd(g->at, share < face->hit.share ? share : face->hit.share, way, g->at);
    }
}

/* One look at what is in the way. Returns 1 where it has got on. */
static int pass(knurl_god_object *g, const knurl_obstacles *obstacles, const double hip[3]) {
    double goal[3];
    const double start[3] = {g->at[0], g->at[1], g->at[2]};
    g->faces.count = 0;
    for (int i = 0; i < MEETS; i++) {
        knurl_cast_hit hit;
        knurl_active_face face;
        if (!knurl_active_faces_project(&g->faces, hip, goal) || vec3_distance2(goal, g->at) < ARRIVED * ARRIVED) {
            break;
        }
        const uint32_t obstacle = knurl_obstacles_cast(obstacles, g->at, goal, &hit);
        if (obstacle == KNURL_NO_OBSTACLE) {
            vec3_copy(goal, g->at);
            break;
        }
        set_face(obstacles, obstacle, &hit, &face);
        stop_before(g, &face, goal);
        knurl_active_faces_add(&g->faces, &face);
    }
    return vec3_distance2(start, g->at) > ARRIVED * ARRIVED;
}

/* A hop: up along one normal, across, down along another. */
static int can_hop(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                   const double to[3], const double to_normal[3], uint32_t except) {
    double up[3], down[3];
    vec3_madd(from, HOP_HEIGHT, from_normal, up);
    vec3_madd(to, HOP_HEIGHT, to_normal, down);
    return knurl_obstacles_are_clear(obstacles, up, down, except) &&
           knurl_obstacles_are_clear(obstacles, from, up, except) &&
           knurl_obstacles_are_clear(obstacles, down, to, except);
}

int knurl_god_object_can_go(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                            const double to[3], const double to_normal[3], uint32_t except) {
    return knurl_obstacles_are_clear_moving(obstacles, from, to, except) ||
           (!obstacles->moving && can_hop(obstacles, from, from_normal, to, to_normal, except));
}

/* Where several faces hold it: is one of them so low that it can hop over it? */
static int hop(knurl_god_object *g, const knurl_obstacles *obstacles, const double hip[3]) {
    double up[3];
    double goal[3];
    vec3_sub(g->at, hip, up);
    (void)vec3_normalise(up);
    for (uint32_t i = 0; i < g->faces.count && g->faces.count > 1; i++) {
        knurl_active_faces others = g->faces;
        others.list[i] = others.list[--others.count];
        if (g->faces.list[i].press > 0.0 && knurl_active_faces_project(&others, hip, goal) &&
            vec3_distance2(goal, hip) < vec3_distance2(g->at, hip) &&
            can_hop(obstacles, g->at, up, goal, up, KNURL_NO_OBSTACLE)) {
            vec3_copy(goal, g->at);
            return 1;
        }
    }
    return 0;
}

void knurl_god_object_follow(knurl_god_object *g, const knurl_obstacles *obstacles, const double hip[3]) {
    int hops = 0;
    for (int i = 0; i < PASSES; i++) {
        if (!pass(g, obstacles, hip) && (g->faces.count < 2 || hops++ > 1 || !hop(g, obstacles, hip))) {
            return;
        }
    }
    (void)pass(g, obstacles, hip);
}

void knurl_god_object_push(knurl_god_object *g, const knurl_obstacles *obstacles) {
    for (uint32_t i = 0; i < obstacles->count; i++) {
        const knurl_obstacle *o = &obstacles->list[i];
        knurl_cast_hit hit;
        double point[3];
        if (o->before == o->pose || !knurl_obstacle_is_hit(o, g->at, g->at, &hit)) {
            continue;
        }
        vec3_madd(hit.point, o->surface->shape.seam, hit.normal, point);
        knurl_pose_to_parent(o->pose, point, point);
        if (knurl_obstacles_are_clear(obstacles, g->at, point, i)) {
            vec3_copy(point, g->at);
        } else {
            g->squeezed = 1;
        }
    }
}

int knurl_god_object_step_down(knurl_god_object *g, const knurl_obstacles *obstacles, const double above[3],
                               const double normal[3], const double hip[3]) {
    double goal[3];
    double behind[3];
    knurl_cast_hit hit;
    knurl_active_face face;
    const uint32_t obstacle = knurl_obstacles_cast(obstacles, above, hip, &hit);
    if (obstacle == KNURL_NO_OBSTACLE) {
        return 0;
    }
    set_face(obstacles, obstacle, &hit, &face);
    vec3_copy(above, g->at);
    stop_before(g, &face, hip);
    vec3_madd(g->at, -3.0 * face.rest, face.normal, behind);
    /* who is in front of something on the way back is out in the open */
    if (vec3_dot(face.normal, normal) < 0.5 || !knurl_obstacles_are_clear(obstacles, hip, behind, KNURL_NO_OBSTACLE)) {
        vec3_copy(hip, g->at);
        return 0;
    }
    knurl_god_object on = *g;
    knurl_god_object_follow(&on, obstacles, hip);
    if (on.faces.count > 0) {
        *g = on;
        return 1;
    }
    knurl_active_faces_add(&g->faces, &face); /* the way on leads off a rim again: here it stays for this tick */
    return knurl_active_faces_project(&g->faces, hip, goal);
}
