/* HIPs pressed into bodies and dragged over them, compared with the oracle tick by tick: no contact is missed, the
 * proxy is on the mesh and the nearest point of its neighbourhood, and within a factor of the globally nearest point. A
 * proxy is local on purpose: the globally nearest point jumps from the front of a thin wall to its back, and over an
 * edge to the nearer face, independent of the face by which the HIP entered. SPDX-License-Identifier: MIT */
#include "contact/moon.h"
#include "contact/oracle.h"
#include "support/probe.h"

static int64_t total_ticks;

typedef struct outcome {
    int64_t ticks, held, further;
    double worst_ratio;  /* of the depth to the oracle's, if that is 0.1 mm or more */
    double worst_excess; /* of the depth over the oracle's, m */
} outcome;

/* Checks for any tick with contact, on any mesh. */
static void check_proxy(const probe *p, oracle *o, outcome *out) {
    const double distance = distance3(p->contact.proxy, p->query.hip);
    const double depth = -p->contact.z;
    CHECK_CLOSE(fabs(depth), distance, distance < 1e-6 ? 1e-6 : 1e-12); /* so near, the face's normal is used */
    CHECK_CLOSE(oracle_distance(o, p->contact.proxy), 0.0, 1e-12);
    CHECK_CLOSE(oracle_distance_round(o, p->contact.proxy, p->query.hip), distance, 1e-12);
    if (depth > 0.0) {
        const double least = oracle_distance(o, p->query.hip);
        assert_true(distance >= least - 1e-12);
        out->held++;
        out->further += depth > least + 1e-9;
        out->worst_excess = fmax(out->worst_excess, depth - least);
        out->worst_ratio = least >= 1e-4 ? fmax(out->worst_ratio, depth / least) : out->worst_ratio;
    }
}

static void say(const char *what, const outcome *out) {
    printf("%s: %lld ticks, %lld held, %.2f %% of them not by the nearest facet of all, depth at most %.3f times the "
           "oracle's (%.3g mm more)\n",
           what, (long long)out->ticks, (long long)out->held, 100.0 * (double)out->further / (double)(out->held + 1),
           out->worst_ratio, 1e3 * out->worst_excess);
    total_ticks += out->ticks;
}

/* At random over a closed body from outside, pushed outwards if deeper than `depth`. */
static outcome wander(shape *s, const double start[3], double depth, double step, int ticks, uint64_t seed) {
    SCOPED_SHAPE copy = body_copy(s);
    oracle o = oracle_make(&copy);
    SCOPED_PROBE p = probe_shape(s);
    outcome out = {ticks, 0, 0, 0.0, 0.0};
    double drift[3];
    double from[3] = {start[0], start[1], start[2]};
    int held = 0;
    while (oracle_distance(&o, from) > 0.0008) { /* down to the body */
        from[2] -= 0.0001;
    }
    (void)probe_at(&p, from);
    random_direction(&seed, drift);
    for (int k = 0; k < ticks; k++) {
        double to[3];
        double move[3];
        random_direction(&seed, move);
        add3(move, 0.7, drift, move);
        add3(p.query.hip, step * random_between(&seed, 0.0, 0.58), move, to);
        if (held && -p.contact.z > depth) {
            add3(p.query.hip, step, p.contact.normal, to);
        }
        const double distance = oracle_distance(&o, to);
        const int inside = oracle_inside(&o, to);
        if (!inside && distance > 0.001) {
            random_direction(&seed, drift);
            continue;
        }
        held = probe_at(&p, to);
        if (inside && distance > 1e-9 && !(held && p.contact.z < 0.0)) {
            print_error("tick %d: %.3g m inside at %.9g %.9g %.9g, and not held\n", k, distance, to[0], to[1], to[2]);
            fail();
        }
        if (held) {
            check_proxy(&p, &o, &out);
        }
    }
    assert_in_range(out.held, ticks / 10, ticks);
    oracle_free(&o);
    return out;
}

static void wander_at_all_speeds(shape (*make)(void), const char *name, const double start[3], double depth) {
    static const double steps[] = {0.0001, 0.0005, 0.002};
    outcome all = {0, 0, 0, 0.0, 0.0};
    for (size_t i = 0; i < COUNT_OF(steps); i++) {
        shape s = make();
        const outcome one = wander(&s, start, depth, steps[i], 15000, 61 + i);
        all.ticks += one.ticks;
        all.held += one.held;
        all.further += one.further;
        all.worst_excess = fmax(all.worst_excess, one.worst_excess);
        all.worst_ratio = fmax(all.worst_ratio, one.worst_ratio);
    }
    say(name, &all);
}

static shape make_sphere(void) {
    return shape_sphere(0.03, 4);
}

static shape make_torus(void) {
    return body_torus(120, 40);
}

static shape make_lump(void) {
    return body_lump(91, 3, 0.02);
}

static shape make_rough_lump(void) {
    return body_lump(92, 3, 0.08);
}

TEST(no_contact_is_missed_on_closed_bodies) {
    const double above[3] = {0.0, 0.0, 0.035};
    const double above_box[3] = {0.0, 0.0, 0.011};
    const double above_torus[3] = {0.030, 0.0, 0.0085};
    wander_at_all_speeds(make_sphere, "wander sphere", above, 0.003);
    wander_at_all_speeds(body_box, "wander box", above_box, 0.003);
    wander_at_all_speeds(make_torus, "wander torus", above_torus, 0.003);
    wander_at_all_speeds(make_lump, "wander lump", above, 0.002);
    wander_at_all_speeds(make_rough_lump, "wander rough lump", above, 0.002);
}

/* Height of the shape's surface at (x, y), by its own facets, or -HUGE_VAL beyond it. */
static double height_at(oracle *o, double x, double y) {
    double best = -HUGE_VAL;
    int64_t at[3] = {oracle_place(o, 0, x), oracle_place(o, 1, y), 0};
    for (; at[2] < o->cells[2]; at[2]++) {
        const size_t cell = oracle_cell(o, at);
        for (uint32_t i = o->starts[cell]; i < o->starts[cell + 1]; i++) {
            const flat *f = &o->flats[o->members[i]];
            const double below[3] = {x, y, -1.0};
            if (flat_above(f, below)) {
                const double rise =
                    ((f->origin[0] - x) * f->axes[2][0] + (f->origin[1] - y) * f->axes[2][1]) / f->axes[2][2];
                best = fmax(best, f->origin[2] + rise);
            }
        }
    }
    return best;
}

/* To and fro along x, slowly across, `press` below the facets. */
static outcome scan(shape *s, double reach, double press, double speed, int ticks) {
    SCOPED_SHAPE copy = body_copy(s);
    oracle o = oracle_make(&copy);
    SCOPED_PROBE p = probe_shape(s);
    outcome out = {ticks, 0, 0, 0.0, 0.0};
    double x = -reach + 1e-7 * PI; /* not on an edge, which both of an oracle's triangles may reject */
    double way = speed * 0.001;
    (void)probe_to(&p, x, -0.01, height_at(&o, x, -0.01) + 0.0005);
    for (int k = 0; k < ticks; k++) {
        way = x + way > reach || x + way < -reach ? -way : way;
        x += way;
        const double y = -0.01 + 0.02 * k / ticks + 1e-7;
        const double hip[3] = {x, y, height_at(&o, x, y) - press};
        assert_true(probe_at(&p, hip));
        assert_true(p.contact.z < 0.0);
        check_proxy(&p, &o, &out);
    }
    oracle_free(&o);
    return out;
}

static const double speeds[] = {0.049, 0.099, 0.247, 2.0}; /* m/s */

TEST(strokes_on_wavy_sheets_are_held_at_their_depth) {
    static const uint32_t sizes[] = {22, 71, 224};
    /* A facet holds until the HIP's foot passes its edge; the next one, turned by t, is then nearer by cos t. Turns are
     * the edges' 9, 2.8 and 0.9 mm times curvatures up to 206/m: 1 / cos t, and for the coarsest the measured value. */
    static const double bounds[] = {1.5, 1.2, 1.02};
    for (size_t m = 0; m < COUNT_OF(sizes); m++) {
        for (size_t i = 0; i < COUNT_OF(speeds); i++) {
            char name[64];
            shape s = body_wavy(sizes[m]);
            const outcome out = scan(&s, 0.04, 0.001, speeds[i], 3000);
            snprintf(name, sizeof name, "scan wavy %u at %.0f mm/s", (unsigned)(2 * sizes[m] * sizes[m]),
                     1e3 * speeds[i]);
            say(name, &out);
            assert_true(out.worst_ratio <= bounds[m]);
        }
    }
}

TEST(strokes_on_a_sphere_are_held_at_their_depth) {
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        shape s = shape_sphere(0.03, 5);
        const outcome out = scan(&s, 0.02, 0.001, speeds[i], 3000);
        say("scan sphere", &out);
        assert_true(out.worst_ratio <= 1.05);
    }
}

static void facet_normal(const shape *s, uint32_t triangle, double normal[3]) {
    double edges[2][3];
    const float *p[3];
    for (int k = 0; k < 3; k++) {
        p[k] = &s->positions[3 * (size_t)s->indices[3 * triangle + (uint32_t)k]];
    }
    for (int i = 0; i < 3; i++) {
        edges[0][i] = (double)p[1][i] - (double)p[0][i];
        edges[1][i] = (double)p[2][i] - (double)p[0][i];
    }
    cross3(edges[0], edges[1], normal);
    add3(normal, 1.0 / length3(normal) - 1.0, normal, normal);
}

/* The least cosine between two facets of a sheet of `columns` cells that are no farther apart than a cell. */
static double sharpest_turn(const shape *s, uint32_t columns) {
    double least = 1.0;
    for (uint32_t i = 0; i < s->index_count / 3; i++) {
        double own[3], other[3];
        facet_normal(s, i, own);
        for (uint32_t k = i + 1; k < s->index_count / 3 && k <= i + 2 * columns + 3; k++) {
            facet_normal(s, k, other);
            least = k <= i + 3 || k + 3 >= i + 2 * columns ? fmin(least, dot3(own, other)) : least;
        }
    }
    return least;
}

/* As on waves: by the sharpest turn from one facet to the next. */
TEST(strokes_on_random_heights_are_held_at_their_depth) {
    for (uint64_t seed = 1; seed <= 3; seed++) {
        shape s = body_noise(seed, 40, 0.001);
        const double bound = 1.0 / sharpest_turn(&s, 40);
        const outcome out = scan(&s, 0.03, 0.001, 0.247, 3000);
        say("scan random heights", &out);
        printf("at most %.3f by the sharpest turn\n", bound);
        assert_true(out.worst_ratio <= bound);
    }
}

TEST(strokes_on_the_moon_never_lose_contact) {
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        shape moon = body_moon();
        if (moon.index_count == 0) {
            skip();
        }
        const outcome out = scan(&moon, 0.05, 0.001, speeds[i], 3000);
        say("scan moon", &out);
    }
}

/* The same strokes on the same waves in 1k and in 100k triangles: the depths differ by how far the coarse facets lie
 * off the waves (the chord's sagitta: at most h^2/8 times the sum of the curvatures along and across), times the worst
 * of their slopes' effect on a distance, 1. */
TEST(the_force_does_not_depend_on_the_tessellation) {
    const uint32_t coarse_n = 66;
    const double h = 0.2 / coarse_n;
    const double kx = 0.003 * pow(2.0 * PI / 0.03, 2.0);
    const double ky = 0.003 * pow(2.0 * PI / 0.04, 2.0);
    const double kxy = 0.003 * (2.0 * PI / 0.03) * (2.0 * PI / 0.04);
    const double bound = h * h / 8.0 * (kx + ky + 2.0 * kxy);
    SCOPED_PROBE coarse = probe_of(body_wavy(coarse_n));
    SCOPED_PROBE fine = probe_of(body_wavy(224));
    double worst = 0.0;
    for (size_t i = 0; i < COUNT_OF(speeds); i++) {
        probe_forget(&coarse);
        probe_forget(&fine);
        for (int k = -1; k < 3000; k++) {
            const double x = 0.04 * sin(speeds[i] / 0.04 * 0.001 * k);
            const double y = 1e-5 * k;
            const double hip[3] = {x, y, wavy(x, y) + (k < 0 ? 0.002 : -0.0015)};
            const int held = probe_at(&coarse, hip);
            assert_int_equal(probe_at(&fine, hip), held);
            assert_int_equal(held, k >= 0);
            if (held) {
                worst = fmax(worst, fabs(coarse.contact.z - fine.contact.z));
            }
        }
    }
    printf("tessellation: 8.7k and 100k triangles differ by %.3g mm at most, chord error %.3g mm\n", 1e3 * worst,
           1e3 * bound);
    assert_true(worst <= bound);
}

static int report(void **state) {
    (void)state;
    printf("walks: %lld ticks held against the oracle\n", (long long)total_ticks);
    return 0;
}

SUITE_FIXTURES(NULL, report)
