/* Motion of the god-object. SPDX-License-Identifier: MIT */
#include "proxy/god_object.h"

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

/* The sine squared below which two faces count as parallel: 1e-6 rad. */
#define PARALLEL 1e-12

/* 1 where `face` looks at a face that holds the object, across a crack that their seams bridge: faces of two solids
 * that are flush. Nothing rests between them, so the object is moved out of the crack, by their seams at most, to where
 * the face that holds it lets it be. */
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

/* One look at what is in the way. Returns 1 where it has got on. Where the visits are used up before a face is met, the
 * faces of the last look hold the object on. */
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

/* A surface may push the object at most this many times its own movement. Two surfaces that close at an angle a push it
 * by 1 / tan(a) times that, so the limit is at 11 degrees; a real wedge of 11 degrees does not push out what is in it
 * either, from a friction coefficient of tan(11 degrees / 2) = 0.1 on. */
#define PUSH_RATIO 5.0

/* m: a push by rounding, where nothing moves. */
#define PUSH_ROUNDING 1e-6

/* m: how far the object may be pushed in the tick. */
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

/* In front of each face that has moved over it, as near as can be to where it was. */
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

/* Along with one of the obstacles, to the place where it was on that one. */
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
    /* A HIP that is in front of another face on the way back to this one is outside. */
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
    knurl_active_faces_add(&g->faces, &face); /* the way on leads off a rim again: here it stays for this tick */
    return knurl_active_faces_project(&g->faces, hip, goal);
}
