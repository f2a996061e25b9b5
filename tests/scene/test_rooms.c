/* Random presses and strokes in random rooms, checked against the rooms' solids: a HIP inside one is held, its proxy is
 * outside of all of them, and its force is at most the stiffness times the proxy's distance. SPDX-License-Identifier:
 * MIT */
#include "scene/ask.h"
#include "scene/rooms.h"

#include <stdio.h>

#define K         400.0 /* N/m */
#define TICK      0.001 /* s */
#define REACH     0.008 /* m: a hand's largest distance from its proxy */
#define TOLERANCE 2e-6  /* m: rounding of corners to floats, on solids of 0.2 m, and seams */

/* Results of the presses. */
typedef struct tally {
    long presses, squeezed, ticks, limited, lost, inside, unbounded;
    long mixed;     /* rooms whose reversed triangle stays as it is */
    double deepest; /* m: a proxy in a solid */
    double ratio;   /* of a force to its bound */
    long corners[KNURL_CONTACTS_MAX + 1];
} tally;

/* Rooms whose ground is a field of heights: one mesh, or a mesh a triangle. Rooms of one mesh with one reversed
 * triangle. */
enum { TERRAIN = ROOM_FORMS, TERRAIN_PIECES, ONE_REVERSED };

/* The moving part of a room. */
enum { NOTHING, EVERYTHING, ONE_SOLID };

/* A hand in a room. */
typedef struct visit {
    knurl_scene *scene;
    const room *place;
    double amplitude;
    double at[3];
    double velocity[3];
    uint64_t seed, first_seed;
    int form;
    int moving;
    laid surfaces;
    double moved[3];         /* m: offset of the moving part, */
    double from[3], goal[3]; /* moving from one position to the next, */
    int phase;               /* so many ticks of FRAME */
    int squeezed;
    tally *sum;
} visit;

/* A game's frame: ticks from one place to the next. */
#define FRAME 8

/* One tick, then one step of the moving part. */
static knurl_tick_output tick_in(visit *v, const double at[3]) {
    if (v->moving != NOTHING && v->phase == 0) {
        memcpy(v->from, v->goal, sizeof v->from);
        for (int i = 0; i < 3; i++) {
            v->goal[i] = fmax(-0.005, fmin(0.005, v->from[i] + random_between(&v->seed, -0.0005, 0.0005)));
        }
        for (uint32_t i = 0; i < v->surfaces.count; i++) {
            pose p = v->surfaces.poses[i];
            add3(p.position, 1.0, v->goal, p.position);
            if (v->surfaces.moves[i]) {
                move_to(v->scene, knurl_scene_get_surface(v->scene, i), &p, FRAME * TICK);
            }
        }
    }
    const knurl_tick_output out = tick_at(v->scene, at[0], at[1], at[2]);
    if (v->moving != NOTHING) {
        v->phase = v->phase % FRAME + 1;
        for (int i = 0; i < 3; i++) {
            v->moved[i] = v->from[i] + v->phase * (v->goal[i] - v->from[i]) / FRAME;
        }
        v->phase %= FRAME;
    }
    v->squeezed |= (out.flags & KNURL_TICK_SQUEEZED) != 0;
    return out;
}

static void complain(const visit *v, const knurl_tick_output *out, const char *what, double value) {
    if (getenv("KNURL_ROOMS_TELL")) {
        (void)printf("room %llu form %d press %ld: %s %g at %.9g %.9g %.9g, proxy %.9g %.9g %.9g normal %.3g %.3g "
                     "%.3g, %u contacts\n",
                     (unsigned long long)v->first_seed, v->form, v->sum->presses, what, value, out->hip[0], out->hip[1],
                     out->hip[2], out->proxy[0], out->proxy[1], out->proxy[2], out->normal[0], out->normal[1],
                     out->normal[2], (unsigned)out->contacts);
    }
}

/* One tick, checked against the solids. Returns 0 on failure. */
static int tick_and_check(visit *v, knurl_tick_output *out) {
    tally *t = v->sum;
    *out = tick_in(v, v->at);
    const double depth = -room_distance(v->place, v->at, v->moved);
    const double proxy = -room_distance(v->place, out->proxy, v->moved);
    const double force = length3(out->force);
    const double bound = out->contacts * K * (v->amplitude + distance3(out->hip, out->proxy) + TOLERANCE);
    /* between ridges each of up to three faces is felt a wave's height later */
    const double first_felt = 2.0 * TOLERANCE + 2.0 * v->amplitude;
    const int lost = depth > 2.0 * TOLERANCE &&
                     (out->contacts == 0 || (distance3(out->hip, out->proxy) > first_felt && !(force > 0.0)));
    const int inside = proxy > TOLERANCE && !lost;
    const int unbounded = !(force <= bound + 1e-12);
    t->unbounded += unbounded;
    if (v->squeezed && (lost || inside) && !unbounded) { /* reported: between two closing solids there is no exit */
        t->squeezed++;
        return 0;
    }
    t->ticks++;
    t->limited += (out->flags & KNURL_TICK_VISIT_LIMIT) != 0;
    t->corners[out->contacts]++;
    t->deepest = inside ? fmax(t->deepest, proxy) : t->deepest;
    t->ratio = bound > 0.0 ? fmax(t->ratio, force / bound) : t->ratio;
    t->lost += lost;
    t->inside += inside;
    if (lost || inside || unbounded) {
        complain(v, out,
                 lost     ? "lost, m deep"
                 : inside ? "proxy inside, m"
                          : "force, N",
                 lost     ? depth
                 : inside ? proxy
                          : force);
    }
    return !(lost || inside || unbounded);
}

/* Somewhere outside of everything. */
static void find_start(visit *v) {
    do {
        for (int i = 0; i < 3; i++) {
            v->at[i] = v->moved[i] + random_between(&v->seed, v->place->low[i], v->place->high[i]);
        }
    } while (room_distance(v->place, v->at, v->moved) < 0.001);
}

/* Without contact towards an edge of some solid, where most faults occur; in contact anywhere, preferably inwards. */
static void turn_at_random(visit *v, const knurl_tick_output *out, double speed) {
    const solid *s = &v->place->solids[random_integer(&v->seed, 0, v->place->count - 1)];
    const face *f = &s->faces[random_integer(&v->seed, 0, s->count - 1)];
    const int k = (int)random_integer(&v->seed, 0, f->count - 1);
    const double share = random_between(&v->seed, -0.1, 1.1);
    random_direction(&v->seed, v->velocity);
    if (out->contacts == 0) {
        double aim[3];
        for (int i = 0; i < 3; i++) {
            aim[i] = f->corners[k][i] + share * (f->corners[(k + 1) % f->count][i] - f->corners[k][i]) +
                     0.002 * v->velocity[i] - v->at[i];
        }
        add3(aim, 0.0, aim, v->velocity);
    } else {
        add3(v->velocity, -random_between(&v->seed, 0.0, 1.0), out->normal, v->velocity);
    }
    const double scale = speed / (length3(v->velocity) + 1e-9);
    for (int i = 0; i < 3; i++) {
        v->velocity[i] *= scale;
    }
}

/* From outside into something, then around in it, within a hand's distance of the proxy. */
static void press(visit *v) {
    knurl_tick_output out;
    v->sum->presses++;
    v->squeezed = 0;
    find_start(v);
    assert_int_equal(knurl_scene_configure_hip(v->scene, 0, NULL), KNURL_OK);
    configure_plainly(v->scene, 0);
    if (!tick_and_check(v, &out)) {
        return;
    }
    turn_at_random(v, &out, random_between(&v->seed, 0.3, 1.0));
    for (int k = 0; k < 80; k++) {
        if (k % 20 == 19) {
            turn_at_random(v, &out, random_between(&v->seed, 0.02, out.contacts ? 0.4 : 1.0));
        }
        double next[3];
        add3(v->at, TICK, v->velocity, next);
        if (distance3(next, out.proxy) > REACH && distance3(next, out.proxy) > distance3(v->at, out.proxy)) {
            turn_at_random(v, &out, 0.1);
            continue;
        }
        for (int i = 0; i < 3; i++) {
            v->at[i] = fmin(v->place->high[i], fmax(v->place->low[i], next[i]));
        }
        if (!tick_and_check(v, &out)) {
            return;
        }
    }
}

/* A reversed triangle is flipped and reported, or only reported; other rooms report none. Returns 0 if it is not
 * flipped. */
static int check_winding(const visit *v) {
    const knurl_surface_info info = first_info(v->scene);
    const knurl_surface_check check = first_check(v->scene);
    const int reversed = v->surfaces.reversed > 0;
    assert_int_equal((check.exceeded & KNURL_LIMIT_WINDING) != 0, reversed);
    assert_in_range(info.turned_triangles, 0, reversed);
    v->sum->mixed += (uint32_t)reversed != info.turned_triangles;
    return (uint32_t)reversed == info.turned_triangles;
}

static void visit_room(uint64_t seed, int form, int moving, int presses, tally *sum) {
    uint64_t random = seed;
    room place = form == TERRAIN || form == TERRAIN_PIECES ? random_terrain(&random) : random_room(&random);
    for (int i = 0; i < place.count; i++) {
        place.solids[i].moves = moving == EVERYTHING || (moving == ONE_SOLID && i == place.count - 1);
    }
    const int library_form = form == TERRAIN || form == ONE_REVERSED ? ROOM_ONE_MESH
                             : form == TERRAIN_PIECES                ? ROOM_MESHES
                                                                     : form;
    visit v;
    memset(&v, 0, sizeof v);
    v.place = &place;
    v.seed = seed + 1;
    v.first_seed = seed;
    v.form = form;
    v.moving = moving;
    v.sum = sum;
    surface_parts parts = surface_plane();
    if (random_integer(&random, 0, 3) == 0) {
        v.amplitude = 0.0002;
        set_grating(&parts, KNURL_METHOD_S1, 500.0, 0.0, v.amplitude);
    }
    v.scene = empty_scene(1);
    v.surfaces.reversed = form == ONE_REVERSED ? (uint32_t)seed : 0;
    configure_plainly(v.scene, 0);
    put_room(&v.surfaces, v.scene, &random, &place, library_form, &parts.material);
    assert_int_equal(knurl_scene_commit(v.scene), KNURL_OK);
    const int turned = library_form == ROOM_ONE_MESH ? check_winding(&v) : 1;
    for (int i = 0; i < presses && turned; i++) {
        press(&v);
    }
    knurl_scene_destroy(v.scene);
}

static void tell(const tally *t, const char *what) {
    (void)printf(
        "%s: %ld presses (%ld ended squeezed), %ld ticks (%ld, %ld, %ld, %ld with 1 to 4 contacts, %ld at the limit of visits); %ld lost, %ld proxies inside by up "
        "to %g m, %ld forces beyond their bound, of which the greatest share was %.6f\n",
        what, t->presses, t->squeezed, t->ticks, t->corners[1], t->corners[2], t->corners[3], t->corners[4], t->limited,
        t->lost, t->inside, t->deepest, t->unbounded, t->ratio);
}

static tally check_rooms(int form, int moving, const char *what) {
    const char *longer = getenv("KNURL_LONG");
    const char *given = getenv("KNURL_ROOMS"); /* 5000 are a million presses on rooms at rest */
    const int rooms = given ? (int)strtol(given, NULL, 10) : longer ? 1000 : SUITE_SANITIZED ? 4 : 12;
    tally sum;
    memset(&sum, 0, sizeof sum);
    for (int i = 0; i < rooms; i++) {
        visit_room(1000 + 10 * (uint64_t)i, form, moving, 50, &sum);
    }
    tell(&sum, what);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.inside, 0);
    assert_int_equal(sum.unbounded, 0);
    return sum;
}

/* If all moves as one, nothing squeezes a HIP. */
static void check_rooms_that_move(int form, const char *what) {
    const tally sum = check_rooms(form, EVERYTHING, what);
    assert_int_equal(sum.squeezed, 0);
}

TEST(rooms_of_meshes_hold) {
    (void)check_rooms(ROOM_MESHES, NOTHING, "meshes");
}

TEST(rooms_of_one_mesh_hold) {
    (void)check_rooms(ROOM_ONE_MESH, NOTHING, "one mesh");
}

TEST(rooms_of_planes_hold) {
    (void)check_rooms(ROOM_PLANES, NOTHING, "planes");
}

TEST(rooms_of_planes_and_meshes_hold) {
    (void)check_rooms(ROOM_MIXED, NOTHING, "planes and meshes");
}

TEST(terrains_hold) {
    (void)check_rooms(TERRAIN, NOTHING, "terrains");
    (void)check_rooms(TERRAIN_PIECES, NOTHING, "terrains in pieces");
    check_rooms_that_move(TERRAIN, "terrains that move");
    check_rooms_that_move(TERRAIN_PIECES, "terrains in pieces that move");
}

TEST(rooms_that_move_hold) {
    check_rooms_that_move(ROOM_MESHES, "meshes that all move");
    check_rooms_that_move(ROOM_ONE_MESH, "one mesh that moves");
    check_rooms_that_move(ROOM_PLANES, "planes that all move");
    check_rooms_that_move(ROOM_MIXED, "planes and meshes that all move");
}

/* A proxy on the top of one of two flush boxes slid into the seams between them, and was held there by the one's wall
 * alone. */
TEST(a_press_onto_a_seam_between_flush_solids_holds) {
    tally sum;
    memset(&sum, 0, sizeof sum);
    visit_room(15170, ROOM_MESHES, ONE_SOLID, 50, &sum);
    assert_int_equal(sum.lost, 0);
}

/* A HIP that left one of two wedges which go through each other felt a crest at a place inside the other. */
TEST(a_crest_is_felt_outside_of_solids_that_intersect) {
    tally sum;
    memset(&sum, 0, sizeof sum);
    visit_room(28900, ROOM_ONE_MESH, EVERYTHING, 50, &sum);
    assert_int_equal(sum.inside, 0);
}

/* Their triangles seem to have mixed winding if edges of two solids coincide. */
TEST(solids_that_touch_in_one_mesh_are_not_turned_over) {
    tally sum;
    memset(&sum, 0, sizeof sum);
    visit_room(1200, ROOM_ONE_MESH, NOTHING, 50, &sum);
    visit_room(1330, ROOM_ONE_MESH, NOTHING, 50, &sum);
    visit_room(3120, ROOM_ONE_MESH, NOTHING, 50, &sum);
    assert_int_equal(sum.lost, 0);
}

/* T-junctions and touching solids everywhere: if too little is left beside a triangle, it stays reversed and is
 * reported. */
TEST(rooms_of_which_one_triangle_faces_the_other_way_hold) {
    tally sum;
    memset(&sum, 0, sizeof sum);
    const uint64_t rooms = getenv("KNURL_LONG") ? 3000 : 40;
    for (uint64_t i = 0; i < rooms; i++) {
        visit_room(1000 + 10 * i, ONE_REVERSED, NOTHING, 10, &sum);
    }
    printf("%lu of %lu rooms with a reversed triangle are warned of\n", (unsigned long)sum.mixed, (unsigned long)rooms);
    assert_int_equal(sum.lost, 0);
    assert_int_equal(sum.inside, 0);
    assert_in_range(sum.mixed, 0, rooms / 10);
}

TEST(rooms_in_which_one_solid_moves_hold) {
    (void)check_rooms(ROOM_MESHES, ONE_SOLID, "meshes, one of which moves");
    (void)check_rooms(ROOM_PLANES, ONE_SOLID, "planes, some of which move");
    (void)check_rooms(ROOM_MIXED, ONE_SOLID, "planes and meshes, some of which move");
}
