/* The forces of effects against formulas, tick by tick, and their limits. SPDX-License-Identifier: MIT */
#include "effects.h"
#include "scene/ask.h"

#include "base/vec3.h"

#define PI      3.14159265358979323846
#define TOUCH_K 533.0 /* N/m, rounded down: 0.8 (0.5 + 0.5 N s/m)/(1.5 ms) */

/* A committed scene without surfaces, its HIP a Touch's but for those protections. */
static knurl_scene *touch_scene(uint32_t without, double scale) {
    knurl_hip_desc hip;
    knurl_workspace workspace;
    knurl_hip_desc_init(&hip, sizeof hip);
    knurl_workspace_set_identity(&workspace);
    workspace.scale = scale;
    hip.resolution = 0.0;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    hip.workspace = &workspace;
    return scene_with_hip(NULL, &hip);
}

/* The formulas of effect.h, written out by components along the unit axis u. */
static void expected_force(const knurl_effect *e, const double at[3], const double v[3], double force[3]) {
    const double size = sqrt(e->axis[0] * e->axis[0] + e->axis[1] * e->axis[1] + e->axis[2] * e->axis[2]);
    double along = 0.0, along_v = 0.0;
    for (int i = 0; i < 3; i++) {
        along += (at[i] - e->anchor[i]) * e->axis[i] / size;
        along_v += v[i] * e->axis[i] / size;
    }
    const double turn = 2.0 * PI / e->spacing;
    for (int i = 0; i < 3; i++) {
        const double u = e->axis[i] / size, x = at[i] - e->anchor[i];
        const double formulas[KINDS] = {
            -e->stiffness * x - e->damping * v[i],
            -(e->stiffness / turn) * sin(turn * along) * u - e->damping * along_v * u,
            -e->damping * v[i],
            -e->stiffness * (x - along * u) - e->damping * (v[i] - along_v * u),
            -e->stiffness * along * u - e->damping * along_v * u,
            e->max_force * u,
        };
        force[i] = formulas[e->kind - 1];
    }
    const double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    for (int i = 0; i < 3; i++) {
        force[i] *= fmin(1.0, e->max_force / length);
    }
}

/* A stroke of a second about the anchor, with velocities. */
static void path(int tick, double at[3], double v[3]) {
    const double t = 0.001 * tick;
    for (int i = 0; i < 3; i++) {
        const double w = 2.0 * PI * (1.0 + 0.7 * i);
        at[i] = 0.02 * sin(w * t + i);
        v[i] = 0.02 * w * cos(w * t + i);
    }
}

/* At 4.5 N some of the forces are limited and some are not. */
TEST(each_kind_has_its_formulas_force_in_every_tick) {
    for (int32_t kind = 1; kind <= KINDS; kind++) {
        SCOPED_SCENE *scene = free_scene();
        knurl_effect effect = effect_of(kind);
        effect.anchor[0] = 0.003;
        effect.anchor[2] = -0.001;
        effect.axis[0] = 0.8;
        effect.axis[2] = -1.7;
        effect.damping = 3.0;
        effect.max_force = 4.5;
        set(scene, &effect, 1, 0.0);
        int limited = 0;
        for (int tick = 0; tick < 1000; tick++) {
            double at[3], v[3], force[3];
            path(tick, at, v);
            expected_force(&effect, at, v, force);
            const knurl_tick_output out = tick_moving(scene, at, v);
            CHECK_VECTOR(out.force, force[0], force[1], force[2], AS_ONE);
            limited += vec3_length(out.force) > 4.5 - AS_ONE;
            assert_true(vec3_length(out.force) < 4.5 + AS_ONE);
        }
        assert_true(kind != KNURL_EFFECT_SPRING || (limited > 100 && limited < 900));
    }
}

TEST(an_axis_may_have_any_length) {
    static const double sizes[] = {1e-160, 1e-3, 1.0, 5e8};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        SCOPED_SCENE *scene = free_scene();
        knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
        effect.axis[0] = 0.6 * sizes[i];
        effect.axis[1] = -0.8 * sizes[i];
        set(scene, &effect, 1, 0.0);
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.force, 2.0 * 0.6, -2.0 * 0.8, 0.0, i ? AS_ONE : 0.01);
        CHECK_CLOSE(vec3_length(out.force), 2.0, AS_ONE);
    }
}

TEST(forces_of_all_effects_and_of_a_surface_add_up) {
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_effect effects[KNURL_EFFECTS_MAX];
    double sum[3] = {0.0, 0.0, 0.001 * 400.0};
    const double at[3] = {0.004, -0.003, -0.001}, v[3] = {0.1, 0.2, 0.0};
    for (int i = 0; i < KNURL_EFFECTS_MAX; i++) {
        double force[3];
        effects[i] = effect_of(1 + i % KINDS);
        effects[i].anchor[0] = 0.001 * i;
        effects[i].damping = 0.1 * i;
        expected_force(&effects[i], at, v, force);
        vec3_madd(sum, 1.0, force, sum);
    }
    set(scene, effects, KNURL_EFFECTS_MAX, 0.0);
    const knurl_tick_output out = tick_moving(scene, at, v);
    CHECK_VECTOR(out.force, sum[0], sum[1], sum[2], AS_ONE);
    assert_int_equal(out.contacts, 1);
    CHECK_CLOSE(out.depth, 0.001, 1e-15);
}

TEST(an_anchor_moves_evenly_and_carries_a_damper_along) {
    SCOPED_SCENE *scene = free_scene();
    knurl_effect effects[2] = {effect_of(KNURL_EFFECT_SPRING), effect_of(KNURL_EFFECT_DAMPER)};
    effects[1].damping = 2.0;
    set(scene, effects, 2, 0.0);
    (void)tick_at(scene, 0.0, 0.0, 0.0);
    effects[0].anchor[0] = effects[1].anchor[0] = 0.005; /* 0.25 m/s */
    set(scene, effects, 2, 0.02);
    for (int tick = 1; tick <= 10; tick++) {
        const double still[3] = {0.0, 0.0, 0.0};
        CHECK_CLOSE(tick_moving(scene, still, still).force[0], 200.0 * 0.25 * 0.001 * tick + 2.0 * 0.25, 1e-9);
    }
    effects[0].anchor[0] = effects[1].anchor[0] = 0.0; /* turned back on the way: it goes on from its place there */
    set(scene, effects, 2, 0.01);
    for (int tick = 1; tick <= 20; tick++) {
        const double anchor = fmax(0.0, 0.0025 - 0.25 * 0.001 * tick);
        const double still[3] = {0.0, 0.0, 0.0};
        CHECK_CLOSE(tick_moving(scene, still, still).force[0], 200.0 * anchor - (tick < 10 ? 0.5 : 0.0), 1e-9);
    }
}

TEST(an_anchor_that_arrives_with_a_tick_drags_no_more_in_it) {
    static const double still[3] = {0.0, 0.0, 0.0};
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.update_rate_hz = 1024.0; /* every tick's time is exact */
    hip.protections = 0;
    SCOPED_SCENE *scene = scene_with_hip(NULL, &hip);
    knurl_effect damper = effect_of(KNURL_EFFECT_DAMPER);
    damper.damping = 2.0;
    set(scene, &damper, 1, 0.0);
    (void)tick_moving(scene, still, still);
    damper.anchor[0] = 0.25 * 8.0 / 1024.0; /* 0.25 m/s */
    set(scene, &damper, 1, 8.0 / 1024.0);
    for (int tick = 1; tick <= 10; tick++) {
        CHECK_CLOSE(tick_moving(scene, still, still).force[0], tick < 8 ? 2.0 * 0.25 : 0.0, AS_ONE);
    }
}

TEST(an_effect_of_another_kind_is_at_its_anchor_at_once) {
    SCOPED_SCENE *scene = free_scene();
    knurl_effect effect = effect_of(KNURL_EFFECT_PLANE);
    set(scene, &effect, 1, 0.02); /* none before */
    effect.kind = KNURL_EFFECT_SPRING;
    effect.anchor[0] = 0.005;
    set(scene, &effect, 1, 0.02);
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[0], 1.0, AS_ONE);
    effect.anchor[0] = -0.005;
    set(scene, &effect, 1, 5e-324); /* shorter than a tick: a jump */
    CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[0], -1.0, AS_ONE);
}

/* --- limits --- */

/* A Touch: 3.3 N within 5 ms, 0.66 N a tick. */
TEST(a_new_effect_grows_at_the_slew_rate_up_to_the_devices_force) {
    SCOPED_SCENE *scene = touch_scene(KNURL_PROTECT_HEAT, 1.0);
    knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
    effect.max_force = 1000.0;
    set(scene, &effect, 1, 0.0);
    for (int tick = 1; tick <= 10; tick++) {
        const knurl_tick_output out = tick_at(scene, 0.0, 0.0, 0.0);
        CHECK_CLOSE(out.force[1], fmin(3.3, 0.66 * tick), 1e-9);
        assert_true((out.flags & KNURL_TICK_SLEW) != 0 || tick > 5);
    }
}

static double counted(const knurl_scene *scene) {
    return (double)counts_of(scene).passivity_ticks;
}

/* Stiffness felt along x at 1 mm, N/m. */
static double felt_stiffness(knurl_scene *scene) {
    const double at[3] = {0.001, 0.0, 0.0}, still[3] = {0.0, 0.0, 0.0};
    (void)tick_moving(scene, at, still);
    return -tick_moving(scene, at, still).force[0] / 0.001;
}

TEST(together_they_are_as_stiff_as_a_loose_hand_holds_steady) {
    SCOPED_SCENE *scene = touch_scene(KNURL_PROTECT_SLEW, 1.0);
    knurl_effect effects[3] = {effect_of(KNURL_EFFECT_SPRING), effect_of(KNURL_EFFECT_PLANE),
                               effect_of(KNURL_EFFECT_LINE)};
    effects[0].stiffness = TOUCH_K;
    set(scene, effects, 1, 0.0);
    CHECK_CLOSE(felt_stiffness(scene), TOUCH_K, 1e-6);
    CHECK_SAME(counted(scene), 0.0);
    effects[1].axis[0] = 1.0; /* along x; the line along y holds x too */
    effects[1].axis[1] = 0.0;
    set(scene, effects, 3, 0.0);
    CHECK_CLOSE(felt_stiffness(scene), 0.8 * 1.0 / 1.5e-3, 1e-6);
    CHECK_SAME(counted(scene), 2.0);
}

TEST(three_planes_at_right_angles_are_not_added_up) {
    SCOPED_SCENE *scene = touch_scene(KNURL_PROTECT_SLEW, 1.0);
    knurl_effect planes[3];
    for (int i = 0; i < 3; i++) {
        planes[i] = effect_of(KNURL_EFFECT_PLANE);
        planes[i].stiffness = TOUCH_K;
        planes[i].axis[1] = 0.0;
        planes[i].axis[i] = 1.0;
    }
    set(scene, planes, 3, 0.0);
    CHECK_CLOSE(felt_stiffness(scene), TOUCH_K, 1e-6);
    CHECK_SAME(counted(scene), 0.0);
}

/* At twice the scale a device metre has twice the stiffness of a scene metre. */
TEST(the_limit_is_the_devices_at_every_scale_and_ends_with_its_protection) {
    knurl_effect effect = effect_of(KNURL_EFFECT_SPRING);
    effect.stiffness = 2000.0;
    SCOPED_SCENE *twice = touch_scene(KNURL_PROTECT_SLEW, 2.0);
    set(twice, &effect, 1, 0.0);
    CHECK_CLOSE(0.5 * felt_stiffness(twice), 0.5 * 0.8 / 1.5e-3, 1e-6);
    SCOPED_SCENE *raw = touch_scene(KNURL_PROTECT_SLEW | KNURL_PROTECT_PASSIVITY, 1.0);
    set(raw, &effect, 1, 0.0);
    CHECK_CLOSE(felt_stiffness(raw), 2000.0, 1e-6);
}

/* N s/m that are felt of two dampers. */
static double felt_damping(knurl_scene *scene, double asked) {
    knurl_effect dampers[2] = {effect_of(KNURL_EFFECT_DAMPER), effect_of(KNURL_EFFECT_DAMPER)};
    const double at[3] = {0.0, 0.0, 0.0}, v[3] = {0.01, 0.0, 0.0};
    dampers[0].damping = dampers[1].damping = 0.5 * asked;
    set(scene, dampers, 2, 0.0);
    return -tick_moving(scene, at, v).force[0] / 0.01;
}

TEST(together_they_damp_by_at_most_20_newton_seconds_per_metre) {
    SCOPED_SCENE *scene = touch_scene(KNURL_PROTECT_SLEW, 1.0);
    CHECK_CLOSE(felt_damping(scene, 19.99), 19.99, 1e-9);
    CHECK_SAME(counted(scene), 0.0);
    CHECK_CLOSE(felt_damping(scene, 2000.0), 20.0, 1e-9);
    CHECK_SAME(counted(scene), 1.0);
}

TEST(a_faster_device_is_not_damped_more_and_a_late_one_less) {
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.protections = KNURL_PROTECT_PASSIVITY;
    hip.update_rate_hz = 4000.0;
    SCOPED_SCENE *fast = scene_with_hip(NULL, &hip);
    CHECK_CLOSE(felt_damping(fast, 2000.0), 20.0, 1e-9);
    hip.update_rate_hz = 1000.0;
    hip.delay = 4.0;
    SCOPED_SCENE *late = scene_with_hip(NULL, &hip);
    CHECK_CLOSE(felt_damping(late, 2000.0), 0.03 * 1.0 / 4.5e-3, 1e-9);
}

TEST(the_makers_stiffness_is_a_limit_too) {
    knurl_hip_desc hip;
    knurl_hip_desc_init(&hip, sizeof hip);
    hip.protections = KNURL_PROTECT_PASSIVITY;
    hip.update_rate_hz = 4000.0; /* stable to 2133 N/m */
    SCOPED_SCENE *scene = scene_with_hip(NULL, &hip);
    knurl_effect effect = effect_of(KNURL_EFFECT_SPRING);
    effect.stiffness = 5000.0;
    set(scene, &effect, 1, 0.0);
    CHECK_CLOSE(felt_stiffness(scene), 1020.0, 1e-6);
}

TEST(no_effect_is_felt_while_paused_absent_attenuated_or_without_a_number) {
    SCOPED_SCENE *scene = free_scene();
    knurl_effect effect = effect_of(KNURL_EFFECT_FORCE);
    set(scene, &effect, 1, 0.0);
    const knurl_tick_input silent[] = {
        {.paused = 1}, {.absent = 1}, {.attenuation = 1.0}, {.position = {NAN, 0.0, 0.0}}};
    for (size_t i = 0; i < COUNT_OF(silent); i++) {
        knurl_tick_output out;
        assert_int_equal(knurl_scene_tick(scene, 0, &silent[i], &out), KNURL_OK);
        CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0);
        CHECK_CLOSE(tick_at(scene, 0.0, 0.0, 0.0).force[1], 2.0, AS_ONE);
    }
}

/* The largest accepted numbers, at the largest coordinates. */
TEST(the_largest_numbers_give_finite_forces) {
    for (int32_t kind = 1; kind <= KINDS; kind++) {
        SCOPED_SCENE *scene = free_scene();
        knurl_effect effect = effect_of(kind);
        for (int i = 0; i < 3; i++) {
            effect.anchor[i] = -KNURL_COORDINATE_MAX;
            effect.axis[i] = i == 1 ? KNURL_COORDINATE_MAX : 0.0;
        }
        effect.stiffness = 1e9;
        effect.damping = 1000.0;
        effect.spacing = 1e-6;
        effect.max_force = 1000.0;
        set(scene, &effect, 1, 0.0);
        effect.anchor[0] = KNURL_COORDINATE_MAX;
        set(scene, &effect, 1, 0.0011);
        const double at[3] = {0.0, 0.9 * KNURL_COORDINATE_MAX, 0.0}, v[3] = {0.0, 1e14, 0.0};
        for (int tick = 0; tick < 4; tick++) {
            const knurl_tick_output out = tick_moving(scene, at, v);
            assert_int_equal(out.flags & KNURL_TICK_NOT_FINITE, 0);
            CHECK_CLOSE(vec3_length(out.force), 1000.0, 1e-9);
        }
    }
}
