/* The passivity controller on thousands of walls and gratings in the laboratory: counts runaways without it and those
 * that it stops, and calm runs and those that it changes. The figures in samples/study/stability.md and docs/safety.md
 * are from these tests with KNURL_LONG in the environment, which runs every cell. SPDX-License-Identifier: MIT */
#include "protection.h"

#include <stdlib.h>

/* m: a cell that swings by so much more than the reference is neither calm nor, yet, a runaway. */
#define CALM 0.0005

static const char *const grips[] = {"loose", "light", "medium", "firm"};
static const int32_t methods[] = {KNURL_METHOD_DEFAULT, KNURL_METHOD_S1, KNURL_METHOD_S2,
                                  KNURL_METHOD_BANDLIMITED}; /* first: flat */
#define METHODS (int)COUNT_OF(methods)

typedef struct counts {
    int cells, runaways, stopped, calm, changed, shaky, shaky_changed;
    int flat_runaways, flat_stopped;
    double latest;           /* s from the first touch until the controller acts, at most */
    double most, most_shaky; /* m: by how much a calm or a shaky cell that was changed swung more than the reference */
} counts;

static lab_signals raw_signals;
static lab_signals signals;

static int drop_signals(void **state) {
    (void)state;
    lab_signals_free(&raw_signals);
    lab_signals_free(&signals);
    return 0;
}

static void tell(const lab_case *c, const char *what, double before, double after) {
    print_message("%s: %s, %s, %s, %g m, %g N/m, %g m/s: %.2f mm, %.2f mm\n", what, c->device, c->grip->name,
                  c->amplitude > 0.0 ? knurl_method_name(c->method) : "flat", c->amplitude, c->stiffness, c->speed,
                  1e3 * before, 1e3 * after);
}

static void count_calm(const lab_case *c, int is_calm, int changed, const lab_result *raw, counts *n) {
    const double beyond = raw->swing - raw->reference_swing;
    n->calm += is_calm;
    n->changed += is_calm && changed;
    n->shaky += !is_calm;
    n->shaky_changed += !is_calm && changed;
    if (is_calm && changed) {
        n->most = fmax(n->most, beyond);
        tell(c, "calm, but changed", raw->swing, raw->reference_swing);
    } else if (changed) {
        n->most_shaky = fmax(n->most_shaky, beyond);
    }
}

/* A cell without the controller, and then with it. */
static void judge(lab_case *c, counts *n) {
    const int is_flat = !(c->amplitude > 0.0);
    judge_late(c);
    c->without = KNURL_PROTECT_ALL;
    const lab_result raw = run(c, &raw_signals);
    n->cells++;
    if (raw.outcome == LAB_UNSTABLE) {
        c->without = 0;
        const lab_result with = run(c, &signals);
        const int stopped = is_stopped(&with, &signals, &raw_signals);
        n->runaways++;
        n->flat_runaways += is_flat;
        n->stopped += stopped;
        n->flat_stopped += is_flat && stopped;
        n->latest = stopped ? fmax(n->latest, time_to_act(&signals)) : n->latest;
        if (!stopped) {
            tell(c, with.outcome == LAB_UNSTABLE ? "not stopped" : "more than a sixth", raw.swing, with.swing);
        }
    } else if (raw.outcome <= LAB_VIBRATION) {
        const int is_calm = raw.swing < raw.reference_swing + CALM;
        c->without = PASSIVITY_ONLY;
        (void)run(c, &signals);
        count_calm(c, is_calm,
                   memcmp(signals.written, raw_signals.written, signals.count * sizeof *signals.written) != 0, &raw, n);
    }
}

static void tell_counts(const counts *n) {
    print_message(
        "of %d cells %d run away (%d of them flat walls); %d (%d) are stopped, %.2f s after touch at the latest\n",
        n->cells, n->runaways, n->flat_runaways, n->stopped, n->flat_stopped, n->latest);
    print_message(
        "of %d calm cells %d are changed, which swung up to %.2f mm beyond the reference; of %d that shake %d, "
        "up to %.2f mm\n",
        n->calm, n->changed, 1e3 * n->most, n->shaky, n->shaky_changed, 1e3 * n->most_shaky);
}

/* The Falcon near the onset of runaways, finer than the study's maps: every grip and method, ridges of 2 x 0.2 mm,
 * from half the maker's stiffness and 60 mm/s on. */
TEST_WITH(on_ridges_of_0_4_mm_every_runaway_is_stopped, NULL, drop_signals) {
    const int fine = getenv("KNURL_LONG") != NULL;
    const int rows = fine ? 9 : 3;
    const int columns = fine ? 12 : 4;
    counts n = {0};
    for (int i = 0; i < 4 * METHODS * rows * columns; i += SUITE_SANITIZED ? 7 : 1) {
        lab_case c;
        lab_case_init(&c);
        c.device = "preset=falcon";
        c.grip = lab_grip_named(grips[i % 4]);
        c.method = methods[i / 4 % METHODS];
        c.amplitude = c.method == KNURL_METHOD_DEFAULT ? 0.0 : 0.0002;
        c.stiffness = 1500.0 + 1500.0 * (i / (4 * METHODS) % rows) / (rows - 1);
        c.speed = 0.06 + 0.24 * (i / (4 * METHODS) / rows) / (columns - 1);
        judge(&c, &n);
    }
    tell_counts(&n);
    assert_true(20 * n.runaways > n.cells && 2 * n.calm > n.cells);
    assert_int_equal(n.stopped, n.runaways);
    assert_true(fine ? 200 * n.changed <= n.calm : n.changed == 0);
}

static const char *const devices[] = {"preset=touch", "preset=falcon"};
static const double most_stiffness[] = {1020.0, 3000.0}; /* N/m: their makers' limits */
static const double amplitudes[] = {0.0001, 0.0004, 0.0008};
static const double speeds[] = {0.02, 0.05, 0.09, 0.14, 0.2, 0.28, 0.4};

/* Ridges of 2 x 0.1 to 2 x 0.8 mm on both devices, and flat walls, from a fifth of the maker's stiffness on. Exceptions
 * are ridges of 0.8 mm and more on a Falcon, which throw a hand off, or whose own force is more than a sixth of the
 * runaway's. */
TEST_WITH(on_high_ridges_five_in_six_runaways_are_stopped, NULL, drop_signals) {
    counts n = {0};
    for (int i = 0; i < 2 * 4 * METHODS * 3 * 7 * 5; i += getenv("KNURL_LONG") ? 1 : SUITE_SANITIZED ? 131 : 13) {
        const int device = i % 2;
        const int method = i / 8 % METHODS;
        const int level = i / (8 * METHODS) % 3;
        lab_case c;
        lab_case_init(&c);
        c.device = devices[device];
        c.grip = lab_grip_named(grips[i / 2 % 4]);
        c.method = methods[method];
        c.amplitude = method == 0 ? 0.0 : amplitudes[level];
        c.speed = speeds[i / (24 * METHODS) % 7];
        c.stiffness = most_stiffness[device] * (0.2 + 0.2 * (i / (168 * METHODS) % 5));
        if (method > 0 || level == 0) { /* a flat wall once */
            judge(&c, &n);
        }
    }
    tell_counts(&n);
    assert_int_equal(n.flat_stopped, n.flat_runaways);
    assert_true(6 * (n.runaways - n.stopped - 1) <= n.runaways); /* one more, for the short form has four */
    assert_true(100 * n.changed <= n.calm);
}
