/* Smooth and flat solids that touch and intersect, against their closed forms: a HIP inside a solid is held, its proxy
 * is outside all solids, and its force has a bound. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "scene/smooth.h"
#include "support/poses.h"

#include <stdio.h>

#define K      400.0 /* N/m */
#define SOLIDS 5

/* Kinds of solids. A can has hard edges at its ends, a box has only those. */
enum { BALL, RING, CAN, BOX, KINDS };

typedef struct solid {
    int kind;
    pose at;
    double drift[3], axis[3]; /* m/s; unit: it turns about this */
    knurl_surface_id id;
} solid;

#define SPEED 0.03 /* m/s: of solids that move */
#define SPIN  0.4  /* rad/s */
#define FRAME 16   /* ticks between two moves */

static const double box_half[3] = {0.02, 0.015, 0.01};

/* m: depth of a point in a solid; below 0: outside. */
static double depth_in(const solid *s, const double p[3]) {
    const double back[4] = {-s->at.quaternion[0], -s->at.quaternion[1], -s->at.quaternion[2], s->at.quaternion[3]};
    double off[3], q[3];
    add3(p, -1.0, s->at.position, off);
    turn(back, off, q);
    const double across = sqrt(q[0] * q[0] + q[1] * q[1]);
    switch (s->kind) {
    case BALL:
        return 0.03 - length3(q);
    case RING:
        return 0.012 - hypot(across - 0.03, q[2]);
    case CAN:
        return fmin(0.02 - across, 0.05 - fabs(q[2]));
    default:
        return -box_distance(box_half, q);
    }
}

/* A cylinder with flat ends, which have vertices of their own. */
static smooth_mesh make_can(uint32_t triangles) {
    smooth_mesh side = smooth_make(&smooth_patches[0], triangles), can = {{0}, NULL};
    const uint32_t sides = side.s.vertex_count;
    uint32_t rows = 1, at = 0;
    while (side.s.positions[3 * rows + 2] > side.s.positions[3 * rows - 1]) {
        rows++;
    }
    const uint32_t around = sides / rows - 1;
    can.s = shape_new(sides + 2 * around, side.s.index_count + 6 * (around - 2), 0);
    can.normals = calloc(can.s.vertex_count, 3 * sizeof(float));
    memcpy(can.s.positions, side.s.positions, 3 * sides * sizeof(float));
    memcpy(can.normals, side.normals, 3 * sides * sizeof(float));
    memcpy(can.s.indices, side.s.indices, side.s.index_count * sizeof(uint32_t));
    at = side.s.index_count;
    for (uint32_t end = 0; end < 2; end++) {
        const uint32_t first = sides + end * around;
        for (uint32_t i = 0; i < around; i++) {
            const uint32_t from = i * rows + end * (rows - 1);
            memcpy(&can.s.positions[3 * (first + i)], &side.s.positions[3 * from], 3 * sizeof(float));
            can.normals[3 * (first + i) + 2] = end ? 1.0f : -1.0f;
            if (i >= 2) {
                can.s.indices[at++] = first;
                can.s.indices[at++] = first + i - end;
                can.s.indices[at++] = first + i - 1 + end;
            }
        }
    }
    smooth_free(&side);
    return can;
}

static smooth_mesh make_solid(int kind) {
    switch (kind) {
    case BALL:
        return smooth_make_sphere(3);
    case RING: {
        smooth_mesh m = smooth_make(&smooth_patches[1], 1300);
        free(m.s.uvs);
        m.s.uvs = NULL;
        return m;
    }
    case CAN:
        return make_can(1300);
    default:
        return smooth_make_flat(shape_box(box_half, 0));
    }
}

/* Two meshes as one; frees both. */
static smooth_mesh join(smooth_mesh *a, smooth_mesh *b) {
    smooth_mesh m;
    const size_t first = 3 * (size_t)a->s.vertex_count, second = 3 * (size_t)b->s.vertex_count;
    m.normals = calloc(first + second, sizeof(float));
    memcpy(m.normals, a->normals, first * sizeof(float));
    memcpy(m.normals + first, b->normals, second * sizeof(float));
    m.s = shape_join(&a->s, &b->s);
    smooth_free(a);
    smooth_free(b);
    return m;
}

typedef struct tally {
    long ticks, felt, lost, inside, unbounded, jumps, squeezed;
    double deepest, jump;
} tally;

typedef struct room {
    solid solids[SOLIDS];
    knurl_scene *scene;
    double bulge; /* m: the most of its surfaces */
    int moves;
    long tick;
} room;

/* m: the most that a point of a solid moves in a tick. */
#define TICK_WAY (0.001 * (SPEED + 0.07 * SPIN))

/* Solids drift about, turning, and stay in the room. */
static void move_solids(room *r, uint64_t *seed) {
    for (int i = 0; i < SOLIDS; i++) {
        solid *s = &r->solids[i];
        pose next = s->at;
        double by[4];
        if (r->tick % FRAME == 0) {
            if (r->tick % (8 * FRAME) == 0) {
                random_direction(seed, s->drift);
                random_direction(seed, s->axis);
                add3(s->drift, -20.0, s->at.position, s->drift);
                const double scale = SPEED / (length3(s->drift) + 1e-9);
                for (int axis = 0; axis < 3; axis++) {
                    s->drift[axis] *= scale;
                }
            }
            add3(s->at.position, 0.001 * FRAME, s->drift, next.position);
            turn_about(s->axis, 0.001 * FRAME * SPIN, by);
            turn_after(by, s->at.quaternion, next.quaternion);
            move_to(r->scene, s->id, &next, 0.001 * FRAME);
        }
        const pose from = s->at;
        add3(from.position, 0.001, s->drift, s->at.position);
        turn_about(s->axis, 0.001 * SPIN, by);
        turn_after(by, from.quaternion, s->at.quaternion);
    }
    r->tick++;
}

static double depth_in_room(const room *r, const double p[3]) {
    double depth = -1.0;
    for (int i = 0; i < SOLIDS; i++) {
        depth = fmax(depth, depth_in(&r->solids[i], p));
    }
    return depth;
}

static void furnish(room *r, uint64_t *seed, int as_one, int is_smooth) {
    smooth_mesh all = {{0}, NULL};
    r->scene = empty_scene(1);
    r->bulge = 0.0;
    for (int i = 0; i < SOLIDS; i++) {
        solid *s = &r->solids[i];
        s->kind = (int)random_integer(seed, 0, KINDS - 1);
        smooth_mesh m = make_solid(s->kind);
        s->at = random_pose(seed);
        for (int axis = 0; axis < 3; axis++) {
            s->at.position[axis] = (double)(float)random_between(seed, -0.03, 0.03);
        }
        if (!r->moves) {
            turn_about((const double[3]){1.0, 0.0, 0.0}, 0.0, s->at.quaternion);
        }
        for (size_t k = 0; as_one && k < 3 * (size_t)m.s.vertex_count; k++) {
            m.s.positions[k] += (float)s->at.position[k % 3];
        }
        if (!as_one) {
            surface_parts parts = smooth_surface(&m, is_smooth);
            parts.material.stiffness = K;
            place(&parts, &s->at);
            s->id = add_surface(r->scene, &parts);
            smooth_free(&m);
        } else {
            all = i == 0 ? m : join(&all, &m);
        }
    }
    if (as_one) {
        surface_parts parts = smooth_surface(&all, is_smooth);
        parts.material.stiffness = K;
        (void)add_surface(r->scene, &parts);
        smooth_free(&all);
    }
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(r->scene); i++) {
        const knurl_surface_info info = info_of(r->scene, knurl_scene_get_surface(r->scene, i));
        assert_int_equal(info.bad_normals, 0);
        r->bulge = fmax(r->bulge, info.bulge);
    }
    (void)commit_plainly(r->scene);
}

/* m: a ring's mesh is this far off the ring. */
#define FORM 3e-5

/* A new direction for 20 ticks: towards a solid, or along and into the touched one. */
static void choose_velocity(const room *r, uint64_t *seed, const double at[3], const knurl_tick_output *last,
                            double velocity[3]) {
    random_direction(seed, velocity);
    if (last->contacts) {
        add3(velocity, -random_between(seed, 0.0, 1.0), last->normal, velocity);
    } else {
        const solid *s = &r->solids[random_integer(seed, 0, SOLIDS - 1)];
        double way[3];
        add3(s->at.position, -1.0, at, way);
        add3(velocity, 50.0, way, velocity);
    }
    const double scale = random_between(seed, 0.02, last->contacts ? 0.4 : 1.0) / (length3(velocity) + 1e-9);
    for (int i = 0; i < 3; i++) {
        velocity[i] *= scale;
    }
}

/* Judges a tick. Returns 0 if the press ends: the HIP is lost, or caught between two solids. */
static int judge(const room *r, const knurl_tick_output *last, const knurl_tick_output *out, double depth,
                 double tolerance, tally *t) {
    const double force = length3(out->force), moved = r->moves ? 2.0 * TICK_WAY : 0.0;
    const double bound = out->contacts * K * (distance3(out->hip, out->proxy) + r->bulge + tolerance);
    const double proxy = depth_in_room(r, out->proxy);
    const int is_lost = depth > tolerance && !(force > 0.0);
    if (out->flags & KNURL_TICK_SQUEEZED) {
        t->squeezed++;
        return 0;
    }
    t->ticks++;
    t->felt += force > 0.0;
    t->lost += is_lost;
    t->inside += out->contacts > 0 && proxy > tolerance;
    t->deepest = out->contacts > 0 ? fmax(t->deepest, proxy) : t->deepest;
    t->unbounded += !(force <= bound + 1e-12);
    const double jump = distance3(out->force, last->force) / (K * (distance3(out->hip, last->hip) + moved) + 1e-9);
    t->jumps += jump > 3.0;
    t->jump = fmax(t->jump, jump);
    return !is_lost;
}

static void press(room *r, uint64_t *seed, double tolerance, tally *t) {
    double at[3], velocity[3] = {0.0, 0.0, 0.0};
    do {
        for (int i = 0; i < 3; i++) {
            at[i] = random_between(seed, -0.08, 0.08);
        }
    } while (depth_in_room(r, at) > -0.001);
    configure_plainly(r->scene, 0);
    knurl_tick_output last = tick_at(r->scene, at[0], at[1], at[2]);
    for (int k = 0, goes_on = 1; k < 400 && goes_on; k++) {
        if (k % 20 == 0) {
            choose_velocity(r, seed, at, &last, velocity);
        }
        double next[3];
        add3(at, 0.001, velocity, next);
        if (r->moves && last.contacts &&
            distance3(at, last.proxy) > 0.003) { /* the hand yields to a solid that pushes it */
            add3(last.proxy, -1.0, at, velocity);
            add3(at, 0.05, velocity, next);
        }
        if (distance3(next, last.proxy) > 0.004 && distance3(next, last.proxy) > distance3(at, last.proxy)) {
            random_direction(seed, velocity);
            add3(velocity, 1.0, last.normal, velocity);
            for (int i = 0; i < 3; i++) {
                velocity[i] *= 0.1;
            }
            add3(at, 0.001, velocity, next);
        }
        memcpy(at, next, sizeof at);
        if (r->moves) {
            move_solids(r, seed);
        }
        const knurl_tick_output out = tick_at(r->scene, at[0], at[1], at[2]);
        goes_on = judge(r, &last, &out, depth_in_room(r, at), tolerance, t);
        last = out;
    }
}

static tally check_rooms(int as_one, int is_smooth, int moves, const char *what) {
    tally t = {0};
    const int rooms = getenv("KNURL_LONG") ? 200 : SUITE_SANITIZED ? 4 : 12;
    for (int i = 0; i < rooms; i++) {
        uint64_t seed = 100 + (uint64_t)i;
        room r;
        r.moves = moves;
        r.tick = 0;
        furnish(&r, &seed, as_one, is_smooth);
        for (int k = 0; k < 50; k++) {
            press(&r, &seed, FORM + r.bulge + (is_smooth ? 0.0 : 5e-4) + (moves ? TICK_WAY : 0.0), &t);
        }
        knurl_scene_destroy(r.scene);
    }
    (void)printf(
        "%s: %ld ticks, %ld felt; %ld lost, %ld proxies inside, by up to %.6f m; %ld forces beyond their bound; "
        "%ld jumps, up to %.1f; %ld squeezed\n",
        what, t.ticks, t.felt, t.lost, t.inside, t.deepest, t.unbounded, t.jumps, t.jump, t.squeezed);
    assert_int_equal(t.lost, 0);
    assert_int_equal(t.inside, 0);
    assert_int_equal(t.unbounded, 0);
    return t;
}

/* The force jumps by more than three times K times the way: at facets of a flat mesh, and where the proxy passes the
 * edges of boxes and cans or comes from one solid to the next, smooth or not. */
static void check_jumps(const tally *flat, const tally *smooth, long fewer) {
    assert_true(fewer * smooth->jumps <= flat->jumps);
}

TEST(rooms_of_smooth_solids_hold) {
    const tally flat = check_rooms(0, 0, 0, "flat"), smooth = check_rooms(0, 1, 0, "smooth");
    check_jumps(&flat, &smooth, 5);
}

TEST(rooms_of_one_smooth_mesh_hold) {
    const tally flat = check_rooms(1, 0, 0, "one flat mesh"), smooth = check_rooms(1, 1, 0, "one smooth mesh");
    check_jumps(&flat, &smooth, 5);
}

TEST(rooms_of_smooth_solids_that_move_and_turn_hold) {
    const tally flat = check_rooms(0, 0, 1, "flat, moving"), smooth = check_rooms(0, 1, 1, "smooth, moving");
    check_jumps(&flat, &smooth, 2); /* in K times the way of both */
}
