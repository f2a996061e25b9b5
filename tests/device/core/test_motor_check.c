/* The check for backwards motors: on a fake device behind a caller's functions whose motors may be
 * wired backwards, and a study over simulated hands. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/fake/plant.h"
#include "device/motor_check.h"
#include "device/port.h"

#include <knurl/device_functions.h>
#include <knurl/fake.h>
#include <knurl/loop.h>
#include <stdio.h>
#include <stdlib.h>

/* --- a device in the loop --- */

#define STIFFNESS 500.0 /* N/m, of a floor at y = 0 */

typedef struct wired {
    knurl_device *inner; /* fake */
    double sign[3];      /* of the motors */
    double sent[3];      /* N: the last force */
    double strongest;    /* N: the largest ever sent */
    double deepest;      /* m */
} wired;

static void wired_info(void *user, knurl_device_info *info) {
    (void)knurl_device_get_info(((wired *)user)->inner, info);
}

static knurl_result wired_start(void *user, double rate) {
    return knurl_device_start(((wired *)user)->inner, rate);
}

static knurl_result wired_read(void *user, knurl_device_sample *sample) {
    wired *w = user;
    const knurl_result result = knurl_device_read(w->inner, sample);
    w->deepest = fmax(w->deepest, -sample->position[1]);
    return result;
}

static knurl_result wired_write(void *user, const double force[3]) {
    wired *w = user;
    double made[3];
    for (int axis = 0; axis < 3; axis++) {
        w->sent[axis] = force[axis];
        made[axis] = w->sign[axis] * force[axis];
        w->strongest = fmax(w->strongest, fabs(force[axis]));
    }
    return knurl_device_write(w->inner, made);
}

static void floor_force(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    (void)tick;
    (void)user;
    force[1] = fmax(0.0, -STIFFNESS * sample->position[1]);
}

typedef struct bench {
    wired device;
    knurl_device *outer;
    knurl_loop *loop;
} bench;

static bench b; /* begun by a test */

/* A hand rests 4 mm below the floor. */
static void begin(const char *options, double sign, uint32_t motors_known) {
    char uri[256];
    knurl_stroke_desc stroke;
    knurl_device_functions f;
    knurl_loop_desc desc;
    memset(&b, 0, sizeof b);
    b.device.sign[0] = b.device.sign[2] = 1.0;
    b.device.sign[1] = sign;
    (void)snprintf(uri, sizeof uri, "fake:?preset=falcon&%s", options);
    assert_int_equal(knurl_device_open(uri, &b.device.inner), KNURL_OK);
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_REST;
    stroke.depth = 0.004;
    assert_int_equal(knurl_fake_set_stroke(b.device.inner, &stroke), KNURL_OK);
    knurl_device_functions_init(&f, sizeof f);
    f.user = &b.device;
    f.get_info = wired_info;
    f.start = wired_start;
    f.read = wired_read;
    f.write = wired_write;
    f.motors_known = motors_known;
    assert_int_equal(knurl_device_open_functions(&f, &b.outer), KNURL_OK);
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = b.outer;
    desc.force_callback = floor_force;
    assert_int_equal(knurl_loop_create(&desc, &b.loop), KNURL_OK);
}

static int end(void **state) {
    (void)state;
    knurl_loop_destroy(b.loop);
    knurl_device_close(b.outer);
    knurl_device_close(b.device.inner);
    return 0;
}

static int count; /* of the events that first_fault() removed */

static int32_t first_fault(void) {
    knurl_device_event event;
    int32_t first = 0;
    count = 0;
    while (knurl_device_next_event(b.outer, &event)) {
        first = count == 0 ? event.code : first;
        count++;
    }
    return first;
}

TEST_WITH(a_backwards_motor_is_reported_with_its_axis_and_gets_no_force_until_the_device_is_opened_again, NULL, end) {
    begin("hand_stiffness=100&hand_damping=1", -1.0, 0);
    assert_int_equal(knurl_loop_step(b.loop, 1500), KNURL_OK);
    assert_int_equal(first_fault(), KNURL_FAULT_BACKWARDS_Y);
    assert_int_equal(count, 1); /* and no "resumed" */
    assert_true(b.device.strongest <= 1.0 + 1e-12);
    assert_true(b.device.deepest < 0.025);
    knurl_port_release_halt(b.outer);
    assert_int_equal(knurl_port_is_halted(b.outer), 1);
    assert_int_equal(knurl_loop_step(b.loop, 500), KNURL_OK);
    assert_true(b.device.sent[0] == 0.0 && b.device.sent[1] == 0.0 && b.device.sent[2] == 0.0);
    assert_string_equal(knurl_fault_name(KNURL_FAULT_BACKWARDS_Y), "backwards_y");
    assert_non_null(strstr(knurl_fault_string(KNURL_FAULT_BACKWARDS_Y), "along y: a motor is wired or signed"));
}

TEST_WITH(motors_that_are_right_get_the_whole_force_after_some_pulses, NULL, end) {
    begin("", 1.0, 0);
    assert_int_equal(knurl_loop_step(b.loop, 300), KNURL_OK);
    assert_true(b.device.strongest <= 1.0 + 1e-12);
    assert_int_equal(knurl_loop_step(b.loop, 1500), KNURL_OK);
    assert_int_equal(first_fault(), 0);
    assert_true(b.device.sent[1] > 1.2); /* 4 mm deep: 700 N/m of the hand against 500 N/m */
}

TEST_WITH(motors_that_are_known_are_not_checked, NULL, end) {
    begin("", 1.0, 1);
    int pulses = 0;
    for (int i = 0; i < 600; i++) {
        assert_int_equal(knurl_loop_step(b.loop, 1), KNURL_OK);
        pulses += i > 300 && b.device.sent[1] == 0.0;
    }
    assert_int_equal(pulses, 0);
    assert_int_equal(first_fault(), 0);
}

TEST(forces_that_do_no_harm_are_sent_as_they_are) {
    knurl_motor_check check;
    double force[3] = {0.0, 0.2, 0.1};
    const double position[3] = {0.0, 0.0, 0.0};
    knurl_motor_check_init(&check, 5.0);
    knurl_motor_check_start(&check, 0.001);
    for (int i = 0; i < 500; i++) {
        assert_int_equal(knurl_motor_check_step(&check, position), 0);
        knurl_motor_check_shape(&check, force);
        assert_true(force[0] == 0.0 && force[1] == 0.2 && force[2] == 0.1);
    }
}

/* --- the study --- */

typedef struct hand {
    const char *name;
    double stiffness, damping, mass;
} hand;

static const hand hands[] = {
    {"free", 0, 0, 0},         {"light", 100, 1, 0.03}, {"soft", 300, 3, 0.1},
    {"passive", 700, 5, 0.15}, {"firm", 2000, 15, 0.3}, {"stiff", 4000, 30, 0.5},
};

typedef struct maker {
    double mass, viscous, coulomb, resolution, max_force;
    int32_t delay;
} maker;

/* Falcon, WoodenHaptics, a small device built at home, a slow one. */
static const maker makers[] = {{0.2, 1.5, 0.5, 6e-5, 8.9, 2},
                               {0.2, 0.5, 0.3, 1e-4, 3.0, 2},
                               {0.05, 0.1, 0.05, 2e-5, 3.0, 1},
                               {0.2, 0.5, 0.3, 1e-4, 5.0, 4}};

static const char *const motions[] = {"rests", "presses", "taps", "jerks", "pulls away", "trembles"};

/* The motors' response to a force along y: right; backwards; a Falcon's motors 0, 1 and 2 backwards, from its Jacobian.
 */
static const double wirings[][3] = {{0, 1, 0}, {0, -1, 0}, {0.37, -0.22, 1.70}, {-0.67, 0.29, -1.29}};

typedef struct trial {
    const maker *device;
    const hand *held;
    int motion;
    int wiring;
    double stiffness; /* N/m: the floor's */
    double pace, size;
    uint64_t random;
} trial;

typedef struct verdict {
    int fault;    /* 1 + axis; 0: no fault */
    int passed;   /* 1: y passed */
    double after; /* s since the first contact */
    double moved; /* m since then */
} verdict;

static double noise(uint64_t *random) { /* variance 1 */
    double sum = -6.0;
    for (int i = 0; i < 12; i++) {
        sum += random_between(random, 0.0, 1.0);
    }
    return sum;
}

/* m: the hand's target height. */
static double height(const trial *t, double time) {
    const double w = 6.283185307179586 * time;
    switch (t->motion) {
    case 0:
        return -0.004 * t->size;
    case 1:
        return 0.005 - fmin(0.05 * t->pace * time, 0.005 + 0.006 * t->size);
    case 2:
        return 0.005 * cos((2.0 + 3.0 * t->pace) * w) - 0.002;
    case 3:
        return t->size * (-0.003 + 0.004 * sin(3.1 * t->pace * w) + 0.0024 * sin(5.3 * w) + 0.0012 * sin(8.7 * w));
    case 4:
        return -0.005 + (time > 0.2 ? 0.02 * t->size * fmin(5.0 * (time - 0.2), 2.0) : 0.0);
    default:
        return -0.003 * t->size + 0.0005 * (sin(10.0 * w) + sin(12.3 * t->pace * w));
    }
}

static knurl_plant_config plant_of(const maker *m, const hand *held) {
    return (knurl_plant_config){.mass = m->mass + held->mass,
                                .viscous = m->viscous,
                                .coulomb = m->coulomb,
                                .hand_stiffness = held->stiffness,
                                .hand_damping = held->damping,
                                .resolution = m->resolution,
                                .max_force = m->max_force,
                                .half_workspace = {0.05, 0.05, 0.05},
                                .delay = m->delay,
                                .exact = 1};
}

/* The hand's target and velocity, and its tremor: noise through three filters. */
typedef struct aim {
    double target[3], speed[3], shake[3];
} aim;

static void aim_step(aim *a, trial *t, double time) {
    a->shake[0] += -0.02 * a->shake[0] + noise(&t->random) * (t->motion == 3 ? 9e-5 : 3e-5);
    a->shake[1] += 0.05 * (a->shake[0] - a->shake[1]);
    a->shake[2] += 0.05 * (a->shake[1] - a->shake[2]);
    const double wanted[3] = {0.01 * (t->pace - 0.5) * sin(10.7 * t->pace * time), height(t, time) + a->shake[2],
                              0.01 * (t->pace - 0.5) * sin(18.2 * time)};
    for (int axis = 0; axis < 3; axis++) {
        a->speed[axis] = 1000.0 * (wanted[axis] - a->target[axis]);
        a->target[axis] = wanted[axis];
    }
}

static verdict run(trial t) {
    const maker *m = t.device;
    const int is_free = t.held->stiffness == 0.0;
    const knurl_plant_config config = plant_of(m, t.held);
    verdict v = {0, 0, 0.0, 0.0};
    knurl_plant plant;
    knurl_motor_check check;
    aim hand_aim = {{0.0, height(&t, 0.0), 0.0}, {0.0}, {0.0}};
    double first = -1.0;
    double began = 0.0;
    const double start[3] = {0.0, is_free ? -0.002 * t.size : hand_aim.target[1], 0.0};
    knurl_plant_init(&plant, &config, start);
    knurl_motor_check_init(&check, m->max_force);
    knurl_motor_check_start(&check, 0.001);
    for (int i = 0; i < 2000 && check.is_on && (check.axes & 2u); i++) {
        const double time = 0.001 * i;
        double position[3];
        double force[3] = {0.0, 0.0, 0.0};
        double made[3];
        aim_step(&hand_aim, &t, time);
        knurl_plant_step(&plant, 0.001, hand_aim.target, hand_aim.speed);
        knurl_plant_measure(&plant, position);
        v.fault = knurl_motor_check_step(&check, position);
        v.after = time - first;
        v.moved = fabs(plant.position[1] - began);
        if (v.fault) {
            return v;
        }
        force[1] = fmin(m->max_force, fmax(0.0, -t.stiffness * position[1]));
        if (force[1] > 0.25 && first < 0.0) {
            first = time;
            began = plant.position[1];
        }
        knurl_motor_check_shape(&check, force);
        for (int axis = 0; axis < 3; axis++) {
            made[axis] = wirings[t.wiring][axis] * force[1];
        }
        knurl_plant_write(&plant, made);
    }
    v.passed = !(check.axes & 2u);
    return v;
}

typedef struct tally {
    int runs, faults, passed;
    double after, moved; /* sums of those found */
} tally;

static void add(tally *c, const verdict *v) {
    c->runs++;
    c->faults += v->fault != 0;
    c->passed += v->passed;
    c->after += v->fault || v->passed ? v->after : 0.0;
    c->moved += v->fault ? v->moved : 0.0;
}

/* Tries each device, floor and motion in a hand. */
static tally try_hand(const hand *held, int motion, int wiring) {
    static const double floors[] = {300.0, 1500.0};
    const char *asked = getenv("KNURL_TEST_RUNS"); /* runs of each kind */
    const int runs = asked ? (int)strtol(asked, NULL, 10) : 1;
    tally c = {0};
    for (size_t d = 0; d < COUNT_OF(makers); d++) {
        for (size_t k = 0; k < COUNT_OF(floors); k++) {
            for (int r = 0; r < runs; r++) {
                const uint64_t seed = (uint64_t)(r + 1) * 7919u + d * 101u + k * 13u + (uint64_t)motion;
                const trial t = {&makers[d],
                                 held,
                                 motion,
                                 wiring,
                                 floors[k],
                                 0.5 + 0.35 * (double)(seed % 4u),
                                 0.5 + (double)(seed / 4u % 3u),
                                 seed * UINT64_C(0x9e3779b97f4a7c15)};
                const verdict v = run(t);
                add(&c, &v);
            }
        }
    }
    return c;
}

/* 1: a hand without a spring can only release. */
static int is_idle(const hand *held, int motion) {
    return held->stiffness == 0.0 && motion > 0;
}

TEST(no_hand_is_taken_for_a_backwards_motor_and_a_light_one_does_not_hide_it) {
    tally all = {0};
    tally loose = {0}; /* free, light and soft hands, in which the handle would run away */
    (void)printf(
        "hand     motion      right: runs faults passed ms | backwards: faults passed ms mm | aside: faults\n");
    for (size_t h = 0; h < COUNT_OF(hands); h++) {
        for (int motion = 0; motion < (int)COUNT_OF(motions); motion++) {
            if (is_idle(&hands[h], motion)) {
                continue;
            }
            const tally right = try_hand(&hands[h], motion, 0);
            const tally wrong = try_hand(&hands[h], motion, 1);
            const tally aside = try_hand(&hands[h], motion, 2);
            const tally more = try_hand(&hands[h], motion, 3);
            (void)printf("%-8s %-10s %4d %4d %4d %6.0f | %4d %4d %6.0f %5.1f | %4d %4d\n", hands[h].name,
                         motions[motion], right.runs, right.faults, right.passed,
                         1e3 * right.after / fmax(1, right.passed), wrong.faults, wrong.passed,
                         1e3 * wrong.after / fmax(1, wrong.faults + wrong.passed),
                         1e3 * wrong.moved / fmax(1, wrong.faults), aside.faults, more.faults);
            all.runs += right.runs;
            all.faults += right.faults;
            if (h < 3) {
                loose.runs += wrong.runs;
                loose.faults += wrong.faults;
                loose.passed += wrong.passed;
            }
        }
    }
    (void)printf("motors that are right: %d of %d taken for backwards\n", all.faults, all.runs);
    (void)printf("free, light, soft: %d of %d found, %d passed\n", loose.faults, loose.runs, loose.passed);
    assert_true(all.faults <= 0.001 * all.runs);
    assert_true(loose.faults >= 0.9 * loose.runs);
    assert_true(loose.passed <= 0.02 * loose.runs);
}
