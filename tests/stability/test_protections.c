/* The protections in the laboratory: the defaults stop runaways, and do not change calm runs by a bit.
 * test_protection_grids.c has many more cells. SPDX-License-Identifier: MIT */
#include "protection.h"
#include "runaways.h"

#define STEP (SUITE_SANITIZED ? 7 : 1) /* through the cases of a grid */

static lab_signals signals;
static lab_signals others;

static int drop_signals(void **state) {
    (void)state;
    lab_signals_free(&signals);
    lab_signals_free(&others);
    return 0;
}

/* others: the raw run, with the same times. Returns the time to act. */
static double check_stopped(const lab_case *raw) {
    lab_case c = *raw;
    c.without = 0;
    const lab_result r = run(&c, &signals);
    const double acts = time_to_act(&signals);
    const double force = late_swing(&signals, signals.written);
    const double raw_force = late_swing(&others, others.written);
    if (!is_stopped(&r, &signals, &others)) {
        fail_msg("%s, %s, method %d, %g N/m, %g m, %g m/s: acts after %g s, force swings by %g N instead of %g N: %s",
                 c.device, c.grip->name, (int)c.method, c.stiffness, c.amplitude, c.speed, acts, force, raw_force,
                 lab_outcome_name(r.outcome));
    }
    return acts;
}

/* Bounces of millimetres must end within a second; slower ones are smaller, and may last longer. */
TEST_WITH(every_runaway_at_a_devices_own_limits_is_stopped_by_the_defaults, NULL, drop_signals) {
    for (size_t i = 0; i < COUNT_OF(runaways); i++) {
        lab_case c = runaway_case(&runaways[i], KNURL_PROTECT_ALL);
        judge_late(&c);
        const lab_result raw = run(&c, &others);
        assert_int_equal(raw.outcome, LAB_UNSTABLE);
        const double acts = check_stopped(&c);
        print_message("%s, %s, method %d, %g N/m, %g m/s: acts %.2f s after touch; force swings by %.2f N instead of "
                      "%.2f N, motion by %.2f mm instead of %.2f mm\n",
                      runaways[i].device, runaways[i].grip, (int)runaways[i].method, runaways[i].stiffness,
                      runaways[i].speed, acts, late_swing(&signals, signals.written),
                      late_swing(&others, others.written), 1e3 * late_swing(&signals, signals.height),
                      1e3 * late_swing(&others, others.height));
        assert_true(acts < (raw.swing > 0.003 ? 1.0 : 2.5));
    }
}

static const char *const devices[] = {"preset=touch", "preset=falcon"};
static const double most[] = {1020.0, 3000.0}; /* N/m: their makers' limits */
static const char *const grips[] = {"loose", "light", "medium", "firm"};
static const int32_t methods[] = {KNURL_METHOD_DEFAULT, KNURL_METHOD_S1, KNURL_METHOD_S2,
                                  KNURL_METHOD_BANDLIMITED}; /* the first: a flat wall */
static const double speeds[] = {0.01, 0.05, 0.1, 0.3};

/* Runs raw, and if that is calm, with the controller: the forces must be equal. Returns 1 if it was calm. */
static int compare(size_t device, const char *grip, int32_t method, double speed, double stiffness) {
    lab_case c;
    lab_case_init(&c);
    c.device = devices[device];
    c.grip = lab_grip_named(grip);
    c.method = method;
    c.stiffness = stiffness;
    c.amplitude = method == KNURL_METHOD_DEFAULT ? 0.0 : 0.0002;
    c.speed = speed;
    if (run(&c, &others).outcome > LAB_VIBRATION) {
        return 0;
    }
    c.without = PASSIVITY_ONLY;
    (void)run(&c, &signals);
    if (memcmp(signals.written, others.written, signals.count * sizeof *signals.written) != 0) {
        fail_msg("%s, %s, method %d, %g m/s, %g N/m: not the same forces", devices[device], grip, (int)method, speed,
                 stiffness);
    }
    return 1;
}

TEST_WITH(calm_walls_and_textures_are_left_alone_to_the_bit, NULL, drop_signals) {
    int calm = 0;
    for (size_t i = 0; i < COUNT_OF(devices) * COUNT_OF(grips) * COUNT_OF(methods) * COUNT_OF(speeds); i += STEP) {
        const size_t device = i % COUNT_OF(devices);
        const size_t grip = i / COUNT_OF(devices) % COUNT_OF(grips);
        const size_t method = i / (COUNT_OF(devices) * COUNT_OF(grips)) % COUNT_OF(methods);
        const size_t speed = i / (COUNT_OF(devices) * COUNT_OF(grips) * COUNT_OF(methods));
        for (int row = 0; row < 3; row++) {
            const double stiffness = 100.0 * pow(most[device] / 100.0, row / 2.0);
            calm += compare(device, grips[grip], methods[method], speeds[speed], stiffness);
        }
    }
    const int cases = (int)(3 * COUNT_OF(devices) * COUNT_OF(grips) * COUNT_OF(methods) * COUNT_OF(speeds));
    print_message("%d of %d cases are calm, and left alone\n", calm, cases / STEP);
    assert_true(10 * calm * STEP > 7 * cases);
}

/* Runs raw and with the controller: the same forces. */
static void check_untouched(lab_case *c) {
    (void)run(c, &others);
    c->without = PASSIVITY_ONLY;
    (void)run(c, &signals);
    if (memcmp(signals.written, others.written, signals.count * sizeof *signals.written) != 0) {
        fail_msg("%s, %s, %g N/m, %g N, %g m/s: not the same forces; acts after %g s", c->device, c->grip->name,
                 c->stiffness, c->press, c->approach, time_to_act(&signals));
    }
}

TEST_WITH(hard_taps_and_firm_presses_are_left_alone, NULL, drop_signals) {
    const struct {
        const char *device, *grip;
        double stiffness, press, approach; /* N/m, N, m/s */
    } hands[] = {{"preset=touch", "light", 1020.0, 1.0, 0.25},  {"preset=touch", "medium", 1020.0, 2.0, 0.15},
                 {"preset=touch", "firm", 1020.0, 3.3, 0.1},    {"preset=falcon", "light", 3000.0, 1.0, 0.25},
                 {"preset=falcon", "medium", 3000.0, 4.0, 0.2}, {"preset=falcon", "firm", 3000.0, 8.0, 0.15}};
    for (size_t i = 0; i < COUNT_OF(hands); i++) {
        lab_case c;
        lab_case_init(&c);
        c.device = hands[i].device;
        c.grip = lab_grip_named(hands[i].grip);
        c.stiffness = hands[i].stiffness;
        c.press = hands[i].press;
        c.approach = hands[i].approach;
        check_untouched(&c);
    }
}

/* 0.5 mm at 10 Hz, five times a healthy hand's, on the stiffest walls. */
TEST_WITH(a_hand_that_shakes_is_left_alone, NULL, drop_signals) {
    const char *const shaking[] = {"preset=touch&tremor=0.0005", "preset=falcon&tremor=0.0005"};
    for (size_t i = 0; i < 2 * COUNT_OF(shaking); i++) {
        lab_case c;
        lab_case_init(&c);
        c.device = shaking[i % 2];
        c.grip = lab_grip_named("medium");
        c.stiffness = i % 2 ? 3000.0 : 1020.0;
        c.amplitude = i / 2 ? 0.0002 : 0.0;
        c.speed = 0.1;
        check_untouched(&c);
    }
}

typedef struct seen {
    double low, high; /* N: of the force over the last quarter of a second */
    uint64_t from;    /* tick */
} seen;

static void see(const knurl_tick_output *output, void *user) {
    seen *s = user;
    if (output->tick >= s->from) {
        s->low = fmin(s->low, output->force[1]);
        s->high = fmax(s->high, output->force[1]);
    }
}

/* A plate with its front up that is as stiff as the Touch's maker promises. */
static knurl_scene *hard_plate(uint32_t without) {
    knurl_scene *scene = NULL;
    knurl_plane_desc plane;
    knurl_material_desc material;
    knurl_surface_desc surface;
    knurl_workspace workspace;
    knurl_hip_desc hip;
    knurl_plane_desc_init(&plane, sizeof plane);
    knurl_material_desc_init(&material, sizeof material);
    knurl_surface_desc_init(&surface, sizeof surface);
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&hip, sizeof hip);
    material.stiffness = 1020.0;
    material.friction = 0.0;
    surface.plane = &plane;
    surface.material = &material;
    surface.normal[1] = 1.0;
    hip.workspace = &workspace;
    hip.protections = KNURL_PROTECT_ALL & ~without;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &hip), KNURL_OK);
    assert_int_equal(knurl_scene_add_surface(scene, &surface, NULL), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* Three seconds of a Touch without dry friction in a loose hand that presses with 1 N. Returns the late force's swing,
 * N; passivities: ticks. */
static double press_through_a_loop(uint32_t without, uint64_t *passivities) {
    seen s = {HUGE_VAL, -HUGE_VAL, 2750};
    knurl_scene *scene = hard_plate(without);
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    knurl_stroke_desc stroke;
    knurl_hip_counts counts;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    knurl_loop_desc_init(&desc, sizeof desc);
    stroke.stroke = KNURL_STROKE_REST;
    stroke.depth = 0.01; /* 1 N of 100 N/m */
    assert_int_equal(knurl_device_open("fake:?preset=touch&coulomb=0&tremor=0&hand_stiffness=100&hand_damping=0.5&"
                                       "hand_mass=0.005",
                                       &device),
                     KNURL_OK);
    assert_int_equal(knurl_fake_set_stroke(device, &stroke), KNURL_OK);
    desc.device = device;
    desc.scene = scene;
    desc.tick_callback = see;
    desc.user = &s;
    assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
    assert_int_equal(knurl_loop_step(loop, 3000), KNURL_OK);
    assert_int_equal(knurl_scene_get_tick(scene, 0, NULL, &counts), KNURL_OK);
    *passivities = counts.passivity_ticks;
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return s.high - s.low;
}

TEST(a_runaway_through_the_loop_is_stopped_and_counted) {
    uint64_t passivities;
    assert_true(press_through_a_loop(KNURL_PROTECT_PASSIVITY, &passivities) > 1.0);
    assert_true(passivities == 0);
    assert_true(press_through_a_loop(0, &passivities) < 0.2);
    assert_true(passivities > 1000);
}
