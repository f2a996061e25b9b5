/* The simulated WoodenHaptics v2015. SPDX-License-Identifier: MIT */
#include "device/rawhid/hid_sim.h"

#include <math.h>
#include <string.h>

#define STEP 0.0005 /* s */

/* Its drives: motor radians a body radian, counts a motor turn, N m a A. */
static const double gear[3] = {16.0, 12.0, 12.0};
static const double turn = 2000.0;
static const double torque_constant = 0.0259;

void hid_sim_grip(const double angles[3], double own[3]) {
    const double r = 0.205 * sin(angles[1]) + 0.245 * sin(angles[2]);
    own[0] = cos(angles[0]) * r - 0.220;
    own[1] = sin(angles[0]) * r;
    own[2] = 0.080 + 0.205 * cos(angles[1]) - 0.245 * cos(angles[2]) - 0.080;
}

/* Columns: how the grip moves with each angle. */
static void slopes(const double angles[3], double slope[3][3]) {
    const double h = 1e-6;
    for (int joint = 0; joint < 3; joint++) {
        double less[3];
        double more[3];
        double bent[3] = {angles[0], angles[1], angles[2]};
        bent[joint] += h;
        hid_sim_grip(bent, more);
        bent[joint] -= 2.0 * h;
        hid_sim_grip(bent, less);
        for (int i = 0; i < 3; i++) {
            slope[i][joint] = (more[i] - less[i]) / (2.0 * h);
        }
    }
}

static double determinant(double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Cramer's rule; transposed: of the transposed matrix. */
static void solve(double m[3][3], int transposed, const double right[3], double x[3]) {
    for (int column = 0; column < 3; column++) {
        double changed[3][3];
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) {
                changed[i][j] = j == column ? right[i] : transposed ? m[j][i] : m[i][j];
            }
        }
        x[column] = determinant(changed) / determinant(m);
    }
}

int hid_sim_bend(const double own[3], double angles[3]) {
    static const double middle[3] = {0.0, 0.3438, 0.6637}; /* the grip at the origin, to a tenth of a millimetre */
    memcpy(angles, middle, sizeof middle);
    for (int i = 0; i < 100; i++) {
        double slope[3][3];
        double there[3];
        double step[3];
        hid_sim_grip(angles, there);
        const double miss[3] = {own[0] - there[0], own[1] - there[1], own[2] - there[2]};
        const double far = sqrt(miss[0] * miss[0] + miss[1] * miss[1] + miss[2] * miss[2]);
        if (far < 1e-12) {
            return 1;
        }
        slopes(angles, slope);
        solve(slope, 0, miss, step);
        const double share = fmin(1.0, 0.05 / far); /* limits the step: the linearisation is only local */
        for (int joint = 0; joint < 3; joint++) {
            angles[joint] += share * step[joint];
        }
    }
    return 0;
}

void hid_sim_push(const double angles[3], const int16_t ma[3], double force[3]) {
    double slope[3][3];
    double own[3];
    double torque[3];
    for (int joint = 0; joint < 3; joint++) {
        torque[joint] = 0.001 * ma[joint] * torque_constant * gear[joint];
    }
    slopes(angles, slope);
    solve(slope, 1, torque, own);
    force[0] = own[1]; /* right */
    force[1] = own[2]; /* up */
    force[2] = own[0]; /* towards the user */
}

/* Moves the arm to the plant's grip position. */
static void follow(hid_sim *sim) {
    const double *p = sim->plant.position;
    const double own[3] = {p[2] + sim->shift[2], p[0] + sim->shift[0], p[1] + sim->shift[1]};
    double angles[3];
    if (hid_sim_bend(own, angles)) {
        memcpy(sim->angles, angles, sizeof angles);
    }
}

static int16_t wrap(int32_t counts) {
    const int32_t low = counts & 0xffff;
    return (int16_t)(low < 32768 ? low : low - 65536);
}

static int16_t true_counts(const hid_sim *sim, int joint) {
    return wrap((int32_t)floor(sim->angles[joint] * gear[joint] / 6.283185307179586 * turn));
}

void hid_sim_init(hid_sim *sim, size_t report_bytes, const knurl_stroke_desc *stroke) {
    const knurl_plant_config config = {
        0.2, 0.5, 0.3, stroke ? 700.0 : 2000.0, stroke ? 5.0 : 20.0, 0.0, 20.0, {0.1, 0.1, 0.1}, 0, 1};
    static const double middle[3] = {0.0, 0.0, 0.0};
    memset(sim, 0, sizeof *sim);
    sim->report_bytes = report_bytes;
    sim->watchdog = 0.5;
    if (stroke) {
        knurl_hand_init(&sim->hand, stroke, 0.0, 1);
        knurl_hand_target(&sim->hand, 0.0, STEP, sim->target);
    }
    knurl_plant_init(&sim->plant, &config, stroke ? sim->target : middle);
    follow(sim);
}

static void step(hid_sim *sim) {
    double force[3];
    double velocity[3] = {0.0, 0.0, 0.0};
    sim->time += STEP;
    if (sim->limp_from < 0.0 && sim->time - sim->heard_at > sim->watchdog) {
        memset(sim->current, 0, sizeof sim->current);
        sim->limp_from = sim->heard_at + sim->watchdog;
    }
    if (sim->hand.stroke.speed > 0.0) {
        const double before[3] = {sim->target[0], sim->target[1], sim->target[2]};
        knurl_hand_target(&sim->hand, sim->time - sim->begun_at, STEP, sim->target);
        for (int axis = 0; axis < 3; axis++) {
            velocity[axis] = (sim->target[axis] - before[axis]) / STEP;
        }
    }
    hid_sim_push(sim->angles, sim->current, force);
    knurl_plant_write(&sim->plant, force);
    knurl_plant_step(&sim->plant, STEP, sim->target, velocity);
    follow(sim);
}

void hid_sim_advance(hid_sim *sim, double time) {
    if (time - sim->time > 0.05) {
        sim->time = time - 0.05;
    }
    while (sim->time + STEP <= time) {
        step(sim);
    }
}

static int16_t word(const uint8_t *report, int which) {
    return wrap(report[2 * which] + 256 * report[2 * which + 1]);
}

int hid_sim_hear(hid_sim *sim, double time, const uint8_t *report, size_t size) {
    hid_sim_advance(sim, time);
    if (size != sim->report_bytes) {
        return 0;
    }
    int any = 0;
    const int16_t command = word(report, 3);
    sim->heard_at = time;
    sim->begun_at = sim->reports == 0 ? time : sim->begun_at;
    sim->reports++;
    for (int i = 0; i < 3; i++) {
        const int16_t sign = sim->backwards >> i & 1u ? -1 : 1;
        sim->current[i] = command == 1 ? 0 : (int16_t)(sign * word(report, i));
        any |= sim->current[i] != 0;
        sim->offset[i] = command == 1 ? wrap(word(report, 4 + i) - true_counts(sim, i)) : sim->offset[i];
    }
    sim->commands += command == 1;
    sim->info = command == 1 ? 0 : sim->info;
    sim->limp_from = any ? -1.0 : sim->limp_from < 0.0 ? time : sim->limp_from;
    return 1;
}

void hid_sim_say(const hid_sim *sim, uint8_t report[HID_SIM_MOST_BYTES]) {
    memset(report, 0, HID_SIM_MOST_BYTES);
    for (int i = 0; i < 7; i++) {
        const int32_t value = i < 3 ? true_counts(sim, i) + sim->offset[i] : i == 6 ? sim->info : 0;
        report[2 * i] = (uint8_t)(value & 0xff);
        report[2 * i + 1] = (uint8_t)(value >> 8 & 0xff);
    }
}

void hid_sim_forget(hid_sim *sim) {
    for (int i = 0; i < 3; i++) {
        sim->offset[i] = wrap(-true_counts(sim, i));
        sim->current[i] = 0;
    }
    sim->limp_from = sim->limp_from < 0.0 ? sim->time : sim->limp_from;
}

double hid_sim_limp_since(const hid_sim *sim, double time) {
    return sim->limp_from >= 0.0                  ? sim->limp_from
           : time - sim->heard_at > sim->watchdog ? sim->heard_at + sim->watchdog
                                                  : -1.0;
}
