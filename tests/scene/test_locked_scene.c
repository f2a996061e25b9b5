/* The method LOCKED through a whole tick: whatever the surface, what is felt keeps step with its coordinates.
 * SPDX-License-Identifier: MIT */
#include "support/geometry.h"
#include "support/locked.h"
#include "support/scenes.h"

#define K     400.0  /* N/m, the default */
#define DEPTH 0.003  /* m: below every trough, so that contact is never lost */
#define FS    1000.0 /* cycles/m */

/* Where a straight stroke goes, and what is crossed there. */
typedef struct stroke {
    double from[3];
    double direction[3];                 /* unit */
    double (*cycles)(const double p[3]); /* fs times the coordinate, at a place in the scene */
    int given;                           /* the velocity is */
} stroke;

static double eq_11(double cycles) {
    return cycles + 0.25 - floor(cycles + 0.25) < 0.5 ? A : -A;
}

/* At its boundary to half a tick, and as many as there were cycles. */
static void check_event(const stroke *s, double before, double now, int64_t events, double first) {
    const double ahead = now < before ? 0.25 - now : 0.25 + now;
    CHECK_CLOSE(ahead, floor(ahead + 0.5), 0.5 * fabs(now - before) + (s->given ? 0.02 : 0.1));
    CHECK_CLOSE(fabs(now - first), (double)events, 0.5);
}

/* At `speed` m/s for so many ticks: slowly the height is Eq. 11's at the place, fast each event begins with its cycle,
 * and there are as many as cycles. */
static void check_stroke(knurl_scene *scene, const stroke *s, double speed, int ticks) {
    double before = 0.0;
    double first = 0.0;
    double last_height = 0.0;
    int64_t event = KNURL_NO_EVENT;
    int64_t begun = 0;
    double sum = 0.0;
    double rate = 0.0; /* cycles a tick */
    int steady = 0;    /* ticks since it changed */
    configure_plainly(scene, 0);
    (void)tick_at(scene, s->from[0], s->from[1], 0.01); /* it comes from above */
    for (int k = 0; k < ticks; k++) {
        double p[3];
        double v[3];
        for (int i = 0; i < 3; i++) {
            p[i] = s->from[i] + s->direction[i] * speed * k / 1000.0;
            v[i] = s->direction[i] * speed;
        }
        const knurl_tick_output out = s->given ? tick_moving(scene, p, v) : tick_at(scene, p[0], p[1], p[2]);
        const double now = s->cycles(p);
        steady = fabs(now - before - rate) < 1e-6 ? steady + 1 : 0;
        rate = now - before;
        assert_int_equal(out.contacts, 1);
        CHECK_CLOSE(length3(out.force), K * (out.height + out.depth), 1e-9L);
        assert_true(k == 0 || fabs(out.height - last_height) <= HIGHEST_STEP);
        if (out.event != event) {
            CHECK_CLOSE(sum, 0.0, 1e-12L * A);
            sum = 0.0;
            first = out.event == 0 ? now : first;
            begun = out.event > begun ? out.event : begun;
            if (out.event != KNURL_NO_EVENT && steady > 25) {
                check_event(s, before, now, out.event, first);
            }
        }
        sum += out.event != KNURL_NO_EVENT ? out.height : 0.0;
        if (out.event == KNURL_NO_EVENT && fabs(2.0 * now + 0.5 - floor(2.0 * now + 1.0)) > 1e-4) {
            CHECK_SAME(out.height, eq_11(now)); /* positions are floats: not on an edge */
        }
        event = out.event;
        last_height = out.height;
        before = now;
    }
    assert_true(fabs(before - s->cycles(s->from)) > 5.0);
    assert_true(speed < 0.06 ? begun == 0 : begun >= 10);
}

/* To and fro, slowly and fast, velocity given and not. */
static void check_surface(surface_parts *parts, const double from[3], const double direction[3],
                          double (*cycles)(const double p[3]), double way) {
    knurl_scene *scene = scene_of(parts);
    for (int i = 0; i < 8; i++) {
        stroke s;
        const double speed = i & 4 ? 0.25 : 0.05;
        const double end = i & 1 ? way : 0.0;
        s.cycles = cycles;
        s.given = i >> 1 & 1;
        for (int axis = 0; axis < 3; axis++) {
            s.from[axis] = from[axis] + end * direction[axis];
            s.direction[axis] = i & 1 ? -direction[axis] : direction[axis];
        }
        check_stroke(scene, &s, speed, (int)(1000.0 * way / speed));
    }
    knurl_scene_destroy(scene);
}

static const double along_x[3] = {1.0, 0.0, 0.0};
static const double start[3] = {-0.03, 0.004, -DEPTH};

static double cycles_of_x(const double p[3]) {
    return FS * p[0];
}

TEST(on_a_plane_it_keeps_step_with_x) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_DEFAULT, FS, 0.0, A);
    check_surface(&parts, start, along_x, cycles_of_x, 0.06);
}

/* 30 degrees: x cos + y sin. */
static double cycles_turned(const double p[3]) {
    return FS * (sqrt(0.75) * p[0] + 0.5 * p[1]);
}

TEST(an_orientation_turns_the_ridges) {
    surface_parts parts = surface_plane();
    const double askew[3] = {0.8, 0.6, 0.0};
    set_grating(&parts, KNURL_METHOD_LOCKED, FS, 0.0, A);
    parts.material.orientation = asin(0.5);
    check_surface(&parts, start, along_x, cycles_turned, 0.06);
    check_surface(&parts, start, askew, cycles_turned, 0.06);
}

/* Half a turn about x: its back is up and its y runs down; n x x seen from behind is the scene's y again. */
TEST(from_behind_as_well) {
    surface_parts parts = surface_plane();
    const double askew[3] = {0.8, 0.6, 0.0};
    parts.desc.double_sided = 1;
    set_grating(&parts, KNURL_METHOD_LOCKED, FS, 0.0, A);
    parts.material.orientation = asin(0.5);
    parts.desc.rotation[0] = 1.0;
    parts.desc.rotation[3] = 0.0;
    check_surface(&parts, start, askew, cycles_turned, 0.06);
}

/* Uvs that run u = x + y / 2: one stretch all over, so the sheet becomes a plane, sheared. dP/du is x; u in metres. */
static double cycles_sheared(const double p[3]) {
    return FS * (p[0] + 0.5 * p[1]);
}

static shape sheet(double (*u)(double x, double y), double (*height)(double, double)) {
    static const double half[2] = {0.05, 0.05};
    shape s = shape_sheet(50, 4, half, height);
    for (uint32_t v = 0; v < s.vertex_count; v++) {
        double p[3];
        shape_get(&s, v, p);
        s.uvs[2 * v] = (float)u(p[0], p[1]);
        s.uvs[2 * v + 1] = (float)p[1];
    }
    return s;
}

static double sheared(double x, double y) {
    return x + 0.5 * y;
}

static const char *model_of(knurl_scene *scene) {
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    assert_int_equal(knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, 0), &info), KNURL_OK);
    return info.model;
}

static void check_model(surface_parts *parts, const char *expected) {
    knurl_scene *scene = scene_of(parts);
    assert_non_null(strstr(model_of(scene), expected));
    knurl_scene_destroy(scene);
}

TEST(sheared_uvs_of_a_flat_sheet_are_kept_step_with_as_a_plane) {
    const double diagonal[3] = {0.8, 0.6, 0.0};
    shape s = sheet(sheared, NULL);
    surface_parts parts = surface_mesh(&s);
    set_grating(&parts, KNURL_METHOD_LOCKED, FS, 0.0, A);
    check_model(&parts, "plane");
    check_surface(&parts, start, along_x, cycles_sheared, 0.06);
    check_surface(&parts, start, diagonal, cycles_sheared, 0.05);
    shape_free(&s);
}

/* du/dx from 0.5 to 2 in five steps, u continuous; the scale makes the mean of dx/du, by area, 1. At 0.25 m/s over 850
 * cycles/m this is from below the crossover to 469 Hz. */
static const double slopes[5] = {0.5, 0.8, 1.0, 1.5, 2.0};

static double stepped(double x, double y) {
    double u = 0.0;
    (void)y;
    for (int i = 0; i < 5; i++) {
        const double begin = -0.05 + 0.02 * i;
        u += slopes[i] * fmax(0.0, fmin(x - begin, 0.02));
    }
    return u;
}

static double cycles_stepped(const double p[3]) {
    double scale = 0.0;
    for (int i = 0; i < 5; i++) {
        scale += 0.2 / slopes[i];
    }
    return 850.0 * scale * stepped(p[0], p[1]);
}

TEST(where_uvs_stretch_it_keeps_step_with_their_stripes) {
    const double from[3] = {-0.045, 0.004, -DEPTH};
    shape s = sheet(stepped, NULL);
    surface_parts parts = surface_mesh(&s);
    set_grating(&parts, KNURL_METHOD_LOCKED, 850.0, 0.0, A);
    check_model(&parts, "mesh");
    check_surface(&parts, from, along_x, cycles_stepped, 0.09);
    shape_free(&s);
}
