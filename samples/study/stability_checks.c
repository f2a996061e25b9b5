/* The laboratory against closed forms. SPDX-License-Identifier: MIT */
#include "stability.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE  20
#define QUANTUM 55e-6 /* m */

/* The regions' wall and device. */
#define REGION_K    2000.0 /* N/m */
#define REGION_MASS 0.045  /* kg */
#define REGION_FALL 0.005  /* m */

#define PI 3.141592653589793

double stability_bound(const stability_loop *l) {
    return (l->viscous + l->damping) / ((0.5 + l->delay) / l->rate);
}

/* Schur and Cohn: all roots of p[0] + p[1] z + ... lie inside the unit circle. */
static int inside(double *p, int degree) {
    double next[DEGREE + 1];
    for (int n = degree; n > 0; n--) {
        if (!(fabs(p[0]) < fabs(p[n]))) {
            return 0;
        }
        for (int i = 0; i < n; i++) {
            next[i] = p[n] * p[i + 1] - p[0] * p[n - 1 - i];
        }
        const double scale = fabs(next[n - 1]);
        for (int i = 0; i < n; i++) {
            p[i] = next[i] / scale;
        }
    }
    return 1;
}

/* The sampled mass-damper under a held force is (c1 z + c0)/((z - 1)(z - e)), e = exp(-b T/m); the law is (K + B/T (1 -
 * 1/z)) z^-d. Their loop's characteristic polynomial, times z: */
static int loop_is_stable(const stability_loop *l, double stiffness) {
    const double period = 1.0 / l->rate;
    const double tau = l->mass / l->viscous;
    const double fall = -expm1(-period / tau);
    const double e = 1.0 - fall;
    const double c1 = (period - fall * tau) / l->viscous;
    const double c0 = (fall * tau - e * period) / l->viscous;
    const double difference = l->damping / period;
    const int delay = (int)l->delay;
    double p[DEGREE + 1] = {0.0};
    p[delay + 1] += e; /* z^(d+1) (z - 1)(z - e) */
    p[delay + 2] -= 1.0 + e;
    p[delay + 3] += 1.0;
    p[0] -= difference * c0; /* (K z + B/T (z - 1)) (c1 z + c0) */
    p[1] += (stiffness + difference) * c0 - difference * c1;
    p[2] += (stiffness + difference) * c1;
    return inside(p, delay + 3);
}

double stability_exact(const stability_loop *l) {
    double low = 0.0;
    double high = 4.0 * stability_bound(l);
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (loop_is_stable(l, middle)) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

double stability_found(const stability_loop *l, lab_signals *signals) {
    char device[160];
    lab_case c;
    lab_result r;
    double low = 0.5 * stability_bound(l);
    double high = 2.0 * stability_bound(l);
    (void)snprintf(device, sizeof device, "preset=ideal&mass=%.15g&viscous=%.15g&delay=%d", l->mass, l->viscous,
                   (int)l->delay);
    lab_case_init(&c);
    c.device = device;
    c.grip = lab_grip_named("none");
    c.approach = 0.0;
    c.bilateral = 1;
    c.damping = l->damping;
    c.rate = l->rate;
    c.seconds = 3.0;
    for (int i = 0; i < 14; i++) { /* to 1e-4 of the bound */
        c.stiffness = 0.5 * (low + high);
        if (lab_run(&c, signals, &r)) {
            return -1.0;
        }
        if (r.growth < 1.0) {
            low = c.stiffness;
        } else {
            high = c.stiffness;
        }
    }
    return 0.5 * (low + high);
}

/* The work of the motors and the loss in the device's damper over whole cycles of a hand that moves to and fro. Because
 * the motion repeats, the damper absorbs the work of motors and hand. Simpson's rule for the hand's part would need
 * midpoints at twice the rate; v is smooth, so the trapezoidal rule is enough. */
static int works(const stability_loop *l, double stiffness, double hz, double *given, double *taken) {
    char uri[256];
    knurl_device *device = NULL;
    knurl_stroke_desc stroke;
    double last = 0.0;
    const int cycle = (int)floor(l->rate / hz + 0.5);
    (void)snprintf(uri, sizeof uri,
                   "fake:?preset=ideal&mass=%.15g&viscous=%.15g&delay=%d&hand_stiffness=2000&hand_damping=20", l->mass,
                   l->viscous, (int)l->delay);
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_PRESS;
    stroke.period = cycle / l->rate;
    knurl_result result = knurl_device_open(uri, &device);
    result = result ? result : knurl_fake_set_stroke(device, &stroke);
    result = result ? result : knurl_device_start(device, l->rate);
    *given = 0.0;
    *taken = 0.0;
    const int settled = (int)(0.8 * l->rate);
    for (int i = 0; i <= settled + 10 * cycle && !result; i++) {
        knurl_device_sample sample;
        knurl_fake_truth truth;
        (void)knurl_device_read(device, &sample);
        (void)knurl_fake_get_truth(device, &truth);
        if (i > settled) {
            *given += truth.motor[1] * (truth.position[1] - last);
            *taken += l->viscous * truth.velocity[1] * truth.velocity[1] / l->rate;
        }
        last = truth.position[1];
        const double force[3] = {0.0, -stiffness * truth.position[1], 0.0};
        (void)knurl_device_write(device, force);
    }
    knurl_device_close(device);
    return result != KNURL_OK;
}

double stability_passive_found(const stability_loop *l, double hz) {
    double low = 0.2 * stability_bound(l);
    double high = 3.0 * stability_bound(l);
    for (int i = 0; i < 20; i++) {
        double given;
        double taken;
        const double middle = 0.5 * (low + high);
        if (works(l, middle, hz, &given, &taken)) {
            return -1.0;
        }
        if (given < taken) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

int stability_region_run(double beta, double sigma, lab_signals *signals, lab_result *result) {
    static const lab_grip push = {"push", 2.0, 0.0, 0.0}; /* so soft that it acts as a constant force */
    char device[160];
    lab_case c;
    lab_case_init(&c);
    (void)snprintf(device, sizeof device, "preset=ideal&mass=%.15g&viscous=%.15g&coulomb=%.15g&resolution=%.15g",
                   REGION_MASS, beta * REGION_K / c.rate, sigma * REGION_K * QUANTUM, QUANTUM);
    c.device = device;
    c.grip = &push;
    c.press = 1.5 * REGION_K * QUANTUM;
    c.approach = 0.0;
    c.stiffness = REGION_K;
    c.bilateral = 1;
    c.settle = 3.0;
    return lab_run(&c, signals, result);
}

int stability_region_expected(double beta, double sigma) {
    /* A swing of amplitude X gains (K T/2 - b) pi w X^2 a cycle and loses 4 fc X: larger swings grow. */
    const double gain = (0.5 - beta) * REGION_K / 1000.0 * PI * sqrt(REGION_K / REGION_MASS);
    if (beta < 0.5 && 4.0 * sigma * REGION_K * QUANTUM / gain < REGION_FALL) {
        return LAB_UNSTABLE;
    }
    return sigma < 0.5 ? LAB_LIMIT_CYCLE : LAB_REST;
}

double stability_sliding_bound(const knurl_device_info *device, const lab_grip *grip, double speed, double rate) {
    return (device->viscous + device->coulomb / speed + grip->damping) / ((0.5 + device->delay) / rate);
}

double stability_clean_found(const lab_case *c, lab_signals *signals) {
    lab_case at = *c;
    lab_result r;
    for (at.stiffness = 50.0; at.stiffness < 100000.0; at.stiffness *= 1.05) {
        if (lab_run(&at, signals, &r)) {
            return -1.0;
        }
        if (r.outcome >= LAB_LIMIT_CYCLE) {
            break;
        }
    }
    return at.stiffness / 1.05;
}

int stability_holds(const stability_check *k) {
    return isinf(k->tolerance) ? k->found >= k->expected
                               : fabs(k->found - k->expected) <= k->tolerance * fabs(k->expected);
}

/* The table of checks while it is filled. */
typedef struct table {
    stability_check *checks;
    size_t count;
    int failed;
    lab_signals signals;
} table;

static stability_check *add(table *t, const char *unit, double expected, double found, double tolerance) {
    stability_check *k = &t->checks[t->count];
    t->count += t->count + 1 < STABILITY_CHECKS;
    t->failed |= found < 0.0;
    k->unit = unit;
    k->expected = expected;
    k->found = found;
    k->tolerance = tolerance;
    return k;
}

/* The bound is an approximation, with an error up to a tenth for large B; the discretisation is exact. */
static void check_loops(table *t) {
    static const double rates[] = {1000.0, 2000.0, 5000.0, 10000.0};
    for (size_t rate = 0; rate < 4; rate++) {
        for (int wall = 0; wall < (rate == 0 ? 2 : 1); wall++) {
            for (int delay = 0; delay < 3 && !t->failed; delay++) {
                const stability_loop loop = {0.072, 0.5, 5.0 * wall, delay, rates[rate]};
                const double found = stability_found(&loop, &t->signals);
                stability_check *k = add(t, "N/m", stability_bound(&loop), found, wall ? 0.1 : 0.02);
                (void)snprintf(k->what, sizeof k->what, "(b + B)/(T/2 + td): B %g, td %d T, %g kHz", loop.damping,
                               delay, 1e-3 * loop.rate);
                k = add(t, "N/m", stability_exact(&loop), found, 0.003);
                (void)snprintf(k->what, sizeof k->what, "poles of the same loop, discretised");
            }
        }
    }
}

static void check_passivity(table *t) {
    for (int delay = 0; delay < 3 && !t->failed; delay++) {
        const stability_loop loop = {0.072, 0.5, 0.0, delay, 1000.0};
        stability_check *k = add(t, "N/m", stability_bound(&loop), stability_passive_found(&loop, 10.0), 0.02);
        (void)snprintf(k->what, sizeof k->what, "K where the works cancel, b = K (T/2 + td): td %d T, moved at 10 Hz",
                       delay);
    }
}

static void check_regions(table *t) {
    static const double betas[] = {0.2, 0.35, 0.7, 2.0};
    static const double sigmas[] = {0.1, 0.2, 0.7, 2.0};
    for (size_t i = 0; i < 16 && !t->failed; i++) {
        lab_result r;
        const double beta = betas[i / 4];
        const double sigma = sigmas[i % 4];
        memset(&r, 0, sizeof r);
        t->failed |= stability_region_run(beta, sigma, &t->signals, &r);
        stability_check *k = add(t, "outcome", stability_region_expected(beta, sigma), r.outcome, 0.0);
        (void)snprintf(k->what, sizeof k->what, "quantised wall, beta %g, sigma %g", beta, sigma);
    }
}

/* A force held over a tick while the spring moves by dx gives K dx^2/2 more energy than it took: the observer must find
 * this over a contact that ends. */
static void check_leak(table *t) {
    lab_case c;
    lab_result r;
    double given = 0.0;
    double leaked = 0.0;
    lab_case_init(&c);
    c.device = "preset=ideal&viscous=0.5";
    c.grip = lab_grip_named("none");
    c.bilateral = 1;
    c.approach = 0.0;
    t->failed |= lab_run(&c, &t->signals, &r);
    const lab_signals *s = &t->signals;
    for (size_t i = 1; i < s->count && !t->failed; i++) {
        const double step = s->height[i] - s->height[i - 1];
        given += s->motor[i] * step;
        given += 0.5 * c.stiffness * (s->height[i] * s->height[i] - s->height[i - 1] * s->height[i - 1]);
        leaked += 0.5 * c.stiffness * step * step;
    }
    stability_check *k = add(t, "J", leaked, given, 1e-6);
    (void)snprintf(k->what, sizeof k->what, "sample and hold leaks K dx^2/2 a tick");
}

/* A flat wall under a device that slides, in a loose hand: to within two steps of the scan. */
static void check_sliding(table *t) {
    static const char *const presets[] = {"preset=touch&resolution=0", "preset=falcon&resolution=0"};
    static const double speeds[] = {0.15, 0.3};
    for (size_t i = 0; i < 4 && !t->failed; i++) {
        char uri[64];
        knurl_device *device;
        knurl_device_info info;
        lab_case c;
        lab_case_init(&c);
        c.device = presets[i / 2];
        c.grip = lab_grip_named("loose");
        c.speed = speeds[i % 2];
        knurl_device_info_init(&info, sizeof info);
        (void)snprintf(uri, sizeof uri, "fake:?%s", c.device);
        t->failed |= knurl_device_open(uri, &device) != KNURL_OK;
        if (!t->failed) {
            (void)knurl_device_get_info(device, &info);
            knurl_device_close(device);
            stability_check *k = add(t, "N/m", stability_sliding_bound(&info, c.grip, c.speed, c.rate),
                                     stability_clean_found(&c, &t->signals), 0.1);
            (void)snprintf(k->what, sizeof k->what,
                           "(b + fc/v + hand)/(T/2 + td): a %s without quantum slides at %g m/s",
                           i < 2 ? "Touch" : "Falcon", c.speed);
        }
    }
}

/* Choi and Tan (2004): clean from 0.325 N/mm at 250 Hz to 0.904 at 40 kHz. Their device, hand and texture differ, so
 * only the trend is checked, on a flat wall with a sliding device: each value must not be less than the previous one,
 * within two steps of the scan. */
static void check_trend(table *t) {
    static const double rates[] = {250.0, 500.0, 1000.0, 2000.0, 5000.0, 10000.0};
    double last = 0.0;
    for (size_t i = 0; i < 6 && !t->failed; i++) {
        lab_case c;
        lab_case_init(&c);
        c.rate = rates[i];
        c.grip = lab_grip_named("loose");
        c.speed = 0.15;
        const double found = stability_clean_found(&c, &t->signals);
        stability_check *k = add(t, "N/m", fmax(last / (1.05 * 1.05), 50.0), found, INFINITY);
        (void)snprintf(k->what, sizeof k->what, "largest clean stiffness at %g Hz (a trend)", rates[i]);
        last = found;
    }
}

size_t stability_checks(stability_check checks[STABILITY_CHECKS]) {
    table t;
    memset(&t, 0, sizeof t);
    t.checks = checks;
    check_loops(&t);
    check_passivity(&t);
    check_regions(&t);
    check_leak(&t);
    check_sliding(&t);
    check_trend(&t);
    lab_signals_free(&t.signals);
    return t.failed ? 0 : t.count;
}
