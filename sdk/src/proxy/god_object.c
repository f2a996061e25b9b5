/* Motion of the god-object. SPDX-License-Identifier: MIT */
#include "proxy/god_object.h"

/* m: lower edges and steps do not stop a proxy. This is less than a tenth of encoders' resolution, and more than the
 * unevenness that rounding and overlapping seams leave on an even floor. */
#define HOP_HEIGHT 10e-6

/* Passes in a tick, and faces that one pass may meet. If the object has not arrived after them, it stays and continues
 * in the next tick. */
#define PASSES 8
#define MEETS  5

/* m: distance at which the object has arrived. */
#define ARRIVED 1e-10

/* Turns a hit into a constraint in the scene. */
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

/* Moves towards `goal`, down to the rest height above the face that was hit. */
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

/* Squared sine below which two faces count as parallel: 1e-6 rad. */
#define PARALLEL 1e-12

/* 1 if `face` is opposite a face that holds the object, across a crack that their seams bridge: flush faces of two
 * solids. Nothing rests between them, so the object moves out of the crack, by their seams at most, to the rest height
 * of the face that holds it. */
static int leave_crack(knurl_god_object *g, const knurl_active_face *face) {
    for (uint32_t i = 0; i < g->faces.count; i++) {
        const knurl_active_face *other = &g->faces.list[i];
        const double overlap = face->offset + other->offset;
        double across[3];
        vec3_cross(face->normal, other->normal, across);
        if (vec3_dot(across, across) <= PARALLEL && vec3_dot(face->normal, other->normal) < 0.0 && overlap > 0.0 &&
            overlap <= 2.0 * (face->rest + other->rest)) {
            vec3_madd(g->at, other->offset - vec3_dot(g->at, other->normal), other->normal, g->at);
            return 1;
        }
    }
    return 0;
}

/* One pass towards the HIP, up to the faces in between. Returns 1 if the object has moved. If the visits run out before
 * a face is met, the last pass's faces keep holding it. */
static int pass(knurl_god_object *g, const knurl_obstacles *obstacles, const double hip[3]) {
    double goal[3];
    const double start[3] = {g->at[0], g->at[1], g->at[2]};
    const uint32_t last_count = g->faces.count;
    g->faces.count = 0;
    for (int i = 0; i < MEETS; i++) {
        knurl_cast_hit hit;
        knurl_active_face face;
        if (!knurl_active_faces_project(&g->faces, hip, goal) || vec3_distance2(goal, g->at) < ARRIVED * ARRIVED) {
            break;
        }
        const knurl_segment way = {g->at, goal, 0, KNURL_NO_OBSTACLE};
        const uint32_t obstacle = knurl_obstacles_cast(obstacles, &way, &hit);
        if (knurl_obstacles_are_unknown(obstacles)) {
            g->faces.count = g->faces.count > 0 ? g->faces.count : last_count;
            return 0;
        }
        if (obstacle == KNURL_NO_OBSTACLE) {
            vec3_copy(goal, g->at);
            break;
        }
        set_face(obstacles, obstacle, &hit, &face);
        stop_before(g, &face, goal);
        if (!leave_crack(g, &face)) {
            knurl_active_faces_add(&g->faces, &face);
        }
    }
    return vec3_distance2(start, g->at) > ARRIVED * ARRIVED;
}

/* A hop: up along one normal, across, down along another. */
static int can_hop(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                   const double to[3], const double to_normal[3], uint32_t except) {
    double up[3], down[3];
    vec3_madd(from, HOP_HEIGHT, from_normal, up);
    vec3_madd(to, HOP_HEIGHT, to_normal, down);
    const knurl_segment ways[3] = {{up, down, 0, except}, {from, up, 0, except}, {down, to, 0, except}};
    return knurl_obstacles_are_clear(obstacles, &ways[0]) && knurl_obstacles_are_clear(obstacles, &ways[1]) &&
           knurl_obstacles_are_clear(obstacles, &ways[2]);
}

int knurl_god_object_can_go(const knurl_obstacles *obstacles, const double from[3], const double from_normal[3],
                            const double to[3], const double to_normal[3], uint32_t except) {
    const knurl_segment way = {from, to, 1, except};
    return knurl_obstacles_are_clear(obstacles, &way) ||
           (!obstacles->moving && can_hop(obstacles, from, from_normal, to, to_normal, except));
}

/* Hops over one of several faces that hold the object, if that one is low enough. */
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

/* Limit on a surface's push, as a multiple of its own movement. Two surfaces that close at an angle a push the object
 * by 1 / tan(a) times that, so the limit is at 11 degrees; a real wedge of 11 degrees does not push its contents out
 * either, from a friction coefficient of tan(11 degrees / 2) = 0.1 on. */
#define PUSH_RATIO 5.0

/* m: a push by rounding, if nothing moves. */
#define PUSH_ROUNDING 1e-6

/* m: longest push in this tick. */
static double longest_push(const knurl_god_object *g, const knurl_obstacles *obstacles) {
    double longest = 0.0;
    for (uint32_t i = 0; i < obstacles->count; i++) {
        const knurl_obstacle *o = &obstacles->list[i];
        double moved[3];
        knurl_pose_to_own(o->before, g->at, moved);
        knurl_pose_to_parent(o->pose, moved, moved);
        longest = knurl_max(longest, vec3_distance2(g->at, moved));
    }
    return PUSH_ROUNDING + PUSH_RATIO * sqrt(longest);
}

/* Moves the object in front of each face that has moved over it, by the shortest displacement. */
static int move_before_faces(knurl_god_object *g, const knurl_obstacles *obstacles) {
    const double longest = longest_push(g, obstacles);
    double goal[3];
    g->faces.count = 0;
    vec3_copy(g->at, goal);
    for (int i = 0; i < MEETS; i++) {
        const knurl_segment way = {g->at, goal, 1, KNURL_NO_OBSTACLE};
        knurl_cast_hit hit;
        knurl_active_face face;
        const uint32_t obstacle = knurl_obstacles_cast(obstacles, &way, &hit);
        if (knurl_obstacles_are_unknown(obstacles)) {
            return 0;
        }
        if (obstacle == KNURL_NO_OBSTACLE) {
            vec3_copy(goal, g->at);
            return 1;
        }
        set_face(obstacles, obstacle, &hit, &face);
        knurl_active_faces_add(&g->faces, &face);
        if (!knurl_active_faces_project(&g->faces, g->at, goal) || vec3_distance2(g->at, goal) > longest * longest) {
            return 0;
        }
    }
    return 0;
}

/* Carries the object along with one of the obstacles, if its path is clear. */
static int move_along(knurl_god_object *g, const knurl_obstacles *obstacles) {
    for (uint32_t i = 0; i < obstacles->count; i++) {
        const knurl_obstacle *o = &obstacles->list[i];
        double goal[3];
        if (o->before != o->pose) {
            knurl_pose_to_own(o->before, g->at, goal);
            knurl_pose_to_parent(o->pose, goal, goal);
            const knurl_segment way = {g->at, goal, 1, KNURL_NO_OBSTACLE};
            if (knurl_obstacles_are_clear(obstacles, &way)) {
                vec3_copy(goal, g->at);
                return 1;
            }
        }
    }
    return 0;
}

void knurl_god_object_push(knurl_god_object *g, const knurl_obstacles *obstacles) {
    g->squeezed = obstacles->moving && !move_before_faces(g, obstacles) && !move_along(g, obstacles) &&
                  !knurl_obstacles_are_unknown(obstacles);
}

int knurl_god_object_step_down(knurl_god_object *g, const knurl_obstacles *obstacles, const double above[3],
                               const double normal[3], const double hip[3]) {
    double goal[3];
    double behind[3];
    knurl_cast_hit hit;
    knurl_active_face face;
    const knurl_segment down = {above, hip, 0, KNURL_NO_OBSTACLE};
    const uint32_t obstacle = knurl_obstacles_cast(obstacles, &down, &hit);
    if (obstacle == KNURL_NO_OBSTACLE || knurl_obstacles_are_unknown(obstacles)) {
        return 0;
    }
    set_face(obstacles, obstacle, &hit, &face);
    vec3_copy(above, g->at);
    stop_before(g, &face, hip);
    vec3_madd(g->at, -3.0 * face.rest, face.normal, behind);
    /* If a face of another surface is in between, the HIP is in front of it, and so outside. */
    const knurl_segment back = {hip, behind, 0, KNURL_NO_OBSTACLE};
    if (vec3_dot(face.normal, normal) < 0.5 || !knurl_obstacles_are_clear(obstacles, &back)) {
        vec3_copy(hip, g->at);
        return 0;
    }
    knurl_god_object on = *g;
    knurl_god_object_follow(&on, obstacles, hip);
    if (on.faces.count > 0) {
        *g = on;
        return 1;
    }
    knurl_active_faces_add(&g->faces, &face); /* going on leads off a rim again: stay here for this tick */
    return knurl_active_faces_project(&g->faces, hip, goal);
}
