/* Smooth meshes against the true forms: direction, depth and steps of the force on strokes.
 * SPDX-License-Identifier: MIT */
#include "scene/smooth.h"

#include <stdio.h>

#define K     800.0
#define DEPTH 0.001  /* m */
#define WAY   0.0001 /* m per tick: 100 mm/s */

/* How a stroke 1 mm below a form differs from it. */
typedef struct stroke {
    double degrees, degrees_most; /* mean, most */
    double depth;                 /* most, share of DEPTH */
    double step;                  /* N between two ticks, the most */
    long lost;
    long ticks;
} stroke;

static void place(double u, double v, smooth_form *form, double depth, double hip[3], double normal[3]) {
    form(u, v, hip, normal);
    add3(hip, -depth, normal, hip);
}

static void sphere(double u, double v, double point[3], double normal[3]) {
    const double n[3] = {cos(v) * cos(u), cos(v) * sin(u), sin(v)};
    memcpy(normal, n, sizeof n);
    for (int i = 0; i < 3; i++) {
        point[i] = 0.03 * n[i];
    }
}

/* Turns back before the form's border: a step in the parameters that keeps within the middle of their range. */
static double turned(double at, double step, double low, double high) {
    const double inner = 0.1 * (high - low);
    return (at > high - inner && step > 0.0) || (at < low + inner && step < 0.0) ? -step : step;
}

/* A slanted path to and fro over the form, one step per tick. */
static stroke stroke_over(const smooth_mesh *m, int how, const smooth_patch *p) {
    surface_parts parts = smooth_surface(m, how);
    parts.material.stiffness = K;
    SCOPED_SCENE *scene = scene_of(&parts);
    stroke s = {0};
    double last[3] = {0.0, 0.0, 0.0};
    double u = 0.7 * p->low[0] + 0.3 * p->high[0], v = 0.72 * p->low[1] + 0.28 * p->high[1];
    double du = 0.4 * (p->high[0] - p->low[0]), dv = 0.37 * (p->high[1] - p->low[1]);
    double hip[3], normal[3];
    const int ticks = 2000;
    p->form(u, v, hip, normal);
    add3(hip, 0.005, normal, hip);
    (void)tick_at(scene, hip[0], hip[1], hip[2]);
    for (int k = 0; k < ticks; k++) {
        double next[3];
        place(u, v, p->form, DEPTH, hip, normal);
        const knurl_tick_output out = tick_at(scene, hip[0], hip[1], hip[2]);
        const double force = length3(out.force);
        s.lost += !(force > 0.0);
        const double angle = acos(fmin(1.0, dot3(out.force, normal) / fmax(force, 1e-9))) * 180.0 / SMOOTH_PI;
        s.degrees += angle / ticks;
        s.degrees_most = fmax(s.degrees_most, angle);
        s.depth = fmax(s.depth, fabs(force / (K * DEPTH) - 1.0));
        s.step = k > 0 ? fmax(s.step, distance3(out.force, last)) : 0.0;
        memcpy(last, out.force, sizeof last);
        place(u + 1e-6 * du, v + 1e-6 * dv, p->form, DEPTH, next, normal); /* a tick's step in the parameters */
        const double way = 1e6 * distance3(next, hip);
        du = turned(u, du, p->low[0], p->high[0]);
        dv = turned(v, dv, p->low[1], p->high[1]);
        u += du * WAY / way;
        v += dv * WAY / way;
    }
    s.ticks = ticks;
    return s;
}

static const smooth_patch ball = {"sphere", sphere, {0.0, -1.2}, {2.0 * SMOOTH_PI, 1.2}, {0, 0}, {1.0, 1.0}};

/* Strokes over a form as it is felt: flat, by its normals, and by computed ones. */
static void stroke_all(const smooth_mesh *m, const smooth_patch *p, stroke all[3]) {
    static const char *const names[] = {"flat", "smooth", "computed"};
    (void)printf("%-10s %6u triangles:", p->name, (unsigned)m->s.index_count / 3);
    for (int how = SMOOTH_FLAT; how <= SMOOTH_COMPUTED; how++) {
        stroke *s = &all[how];
        *s = stroke_over(m, how, p);
        (void)printf(" %s %.3f (%.3f) degrees, depth off %.3f %%, step %.4f N;", names[how], s->degrees,
                     s->degrees_most, 100.0 * s->depth, s->step);
        assert_true(how != SMOOTH_GIVEN || s->lost == 0);
    }
    (void)printf("\n");
}

TEST(a_smooth_sphere_is_felt_as_one) {
    for (int level = 2; level <= 5; level++) {
        smooth_mesh m = smooth_make_sphere(level);
        stroke all[3];
        stroke_all(&m, &ball, all);
        if (level == 3) { /* 1,280 */
            const stroke *smooth = &all[SMOOTH_GIVEN];
            assert_true(smooth->degrees <= 0.1 && smooth->step <= 0.005 && smooth->depth <= 0.002);
        }
        smooth_free(&m);
    }
}

TEST(smooth_forms_are_felt_as_their_closed_forms) {
    static const uint32_t sizes[] = {300, 1300, 5000, 20000};
    for (size_t i = 0; i < COUNT_OF(smooth_patches); i++) {
        for (size_t k = 0; k < COUNT_OF(sizes); k++) {
            smooth_mesh m = smooth_make(&smooth_patches[i], sizes[k]);
            stroke all[3];
            stroke_all(&m, &smooth_patches[i], all);
            const stroke *flat = &all[SMOOTH_FLAT], *smooth = &all[SMOOTH_GIVEN], *computed = &all[SMOOTH_COMPUTED];
            assert_true(smooth->degrees <= 0.25 * flat->degrees && smooth->depth <= 0.25 * flat->depth);
            assert_true(smooth->step <=
                        1.05 * K * WAY); /* as on the form itself, whose curvature allows less than that */
            if (i != 1 || k > 0) {       /* the tube of the coarsest torus has seven sides, and keeps their edges */
                assert_int_equal(computed->lost, 0);
                assert_true(computed->degrees <= 0.5 * flat->degrees && computed->depth <= 0.5 * flat->depth);
                assert_true(computed->step <= 0.5 * flat->step);
            }
            smooth_free(&m);
        }
    }
}

/* A hand that moves randomly near a form, up to 4 mm deep. */
typedef struct wander {
    double at[3], velocity[3];
    uint64_t seed;
} wander;

static void go_on(wander *w, const knurl_tick_output *out, double speed) {
    if (random_integer(&w->seed, 0, 30) == 0 || out->depth > 0.004) {
        random_direction(&w->seed, w->velocity);
        if (out->depth > 0.004) {
            add3(w->velocity, 1.0, out->normal, w->velocity);
        } else if (!out->contacts) {
            double towards[3];
            add3(w->velocity, -0.7 / fmax(1e-3, length3(w->at)), w->at, towards);
            memcpy(w->velocity, towards, sizeof towards);
        }
        const double scale = speed / (length3(w->velocity) + 1e-9);
        for (int i = 0; i < 3; i++) {
            w->velocity[i] *= scale;
        }
    }
    add3(w->at, 0.001, w->velocity, w->at);
}

/* On a sphere or a torus the force changes by no more than K times the distance moved, on any mesh. */
static void check_continuous(const smooth_mesh *m, double speed, const char *what) {
    surface_parts parts = smooth_surface(m, 1);
    parts.material.stiffness = K;
    SCOPED_SCENE *scene = scene_of(&parts);
    wander w = {{0.0, 0.0, 0.035}, {0.0, 0.0, 0.0}, 17};
    knurl_tick_output last = tick_at(scene, w.at[0], w.at[1], w.at[2]);
    double worst = 0.0;
    long felt = 0;
    for (int k = 0; k < 200000; k++) {
        go_on(&w, &last, speed);
        const knurl_tick_output out = tick_at(scene, w.at[0], w.at[1], w.at[2]);
        worst = fmax(worst, distance3(out.force, last.force) / (K * distance3(out.hip, last.hip) + 1e-12));
        felt += out.contacts > 0;
        assert_true(dot3(out.force, out.normal) >= 0.0);
        last = out;
    }
    (void)printf("%s: %ld of 200000 ticks felt; the force changed by at most %.4f K times the way\n", what, felt,
                 worst);
    assert_true(felt > 10000 && worst < 1.02);
}

TEST(force_is_continuous_on_smooth_bodies) {
    for (int level = 1; level <= 4; level++) {
        smooth_mesh m = smooth_make_sphere(level);
        check_continuous(&m, 0.2, "sphere");
        smooth_free(&m);
    }
    static const uint32_t sizes[] = {300, 1300, 5000};
    for (size_t k = 0; k < COUNT_OF(sizes); k++) {
        smooth_mesh m = smooth_make(&smooth_patches[1], sizes[k]);
        check_continuous(&m, 0.2, "torus");
        smooth_free(&m);
    }
}

/* Half cycles crossed and played on half a turn round a cylinder, 1 mm deep, over ridges of 1 mm along its girth. */
static knurl_hip_counts count_round(const smooth_mesh *m, int is_smooth, int32_t method) {
    surface_parts parts = smooth_surface(m, is_smooth);
    knurl_hip_counts counts;
    knurl_tick_output out;
    parts.material.stiffness = K;
    set_grating(&parts, method, 1000.0, 0.0, 0.0001);
    SCOPED_SCENE *scene = scene_of(&parts);
    for (int k = 60; k > 0; k--) {
        (void)tick_at(scene, (0.019 + 1e-4 * k) * cos(0.3), (0.019 + 1e-4 * k) * sin(0.3), 0.001);
    }
    for (double u = 0.3; u < 2.8; u += 0.0001 / 0.02) {
        (void)tick_at(scene, 0.019 * cos(u), 0.019 * sin(u), 0.001);
    }
    memset(&counts, 0, sizeof counts);
    assert_int_equal(knurl_scene_get_tick(scene, 0, &out, &counts), KNURL_OK);
    return counts;
}

TEST(as_many_ridges_are_felt_on_a_smooth_mesh_as_on_its_triangles) {
    static const int32_t methods[] = {KNURL_METHOD_S1, KNURL_METHOD_BANDLIMITED};
    static const uint32_t sizes[] = {300, 1300, 5000};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        smooth_mesh m = smooth_make(&smooth_patches[0], sizes[i]);
        for (size_t k = 0; k < COUNT_OF(methods); k++) {
            const knurl_hip_counts flat = count_round(&m, 0, methods[k]), smooth = count_round(&m, 1, methods[k]);
            (void)printf("%u triangles, %s: %.1f crossed and %llu played flat, %.1f and %llu smooth\n",
                         (unsigned)m.s.index_count / 3, knurl_method_name(methods[k]), flat.half_cycles_crossed,
                         (unsigned long long)flat.half_cycles_played, smooth.half_cycles_crossed,
                         (unsigned long long)smooth.half_cycles_played);
            /* 2.5 rad of 20 mm; at a facet's edge, the point of the flat mesh jumps over up to half a ridge */
            assert_in_range(smooth.half_cycles_played, 98, 101);
            assert_in_range(smooth.half_cycles_played + 3, flat.half_cycles_played, flat.half_cycles_played + 6);
        }
        smooth_free(&m);
    }
}
