/* The simulated Falcon. SPDX-License-Identifier: MIT */
#include "falcon_sim.h"

#include <math.h>
#include <string.h>

#define PI 3.141592653589793

/* libnifalcon's names and values (FalconGeometry.h), m. */
static const double geometry_a = 0.060, geometry_b = 0.1025, geometry_c = 0.01443, geometry_d = 0.01125,
                    geometry_e = 0.01125, geometry_f = -0.025, geometry_r = 0.0400, geometry_s = -0.02309;

/* Stamper: u = a cos t1 - c + (d + e + b sin t3) cos t2, v = b cos t3 - f, w = a sin t1 + (d + e + b sin t3) sin t2.
 * How far the lower arm would have to be longer than it is to reach from the upper arm at t1. */
static double missing(double u, double w, double sin_t3, double t1) {
    const double along = u + geometry_c - geometry_a * cos(t1);
    const double up = w - geometry_a * sin(t1);
    return sqrt(along * along + up * up) - (geometry_d + geometry_e + geometry_b * sin_t3);
}

/* The first solution above the angle at which the upper arm points away from the grip: elbow outward. */
static int find_angle(double u, double w, double sin_t3, double *angle) {
    double high = atan2(w, u + geometry_c);
    double low = high - PI;
    if (missing(u, w, sin_t3, low) < 0.0 || missing(u, w, sin_t3, high) > 0.0) {
        return 0;
    }
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (missing(u, w, sin_t3, middle) > 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    *angle = 0.5 * (low + high);
    return 1;
}

int falcon_sim_angles(const double position[3], double theta[3]) {
    static const double degrees[3] = {105.0, -15.0, -135.0};
    for (int leg = 0; leg < 3; leg++) {
        const double phi = degrees[leg] * PI / 180.0;
        const double u = position[0] * cos(phi) + position[1] * sin(phi) - geometry_r;
        const double v = position[1] * cos(phi) - position[0] * sin(phi) - geometry_s;
        const double cos_t3 = (v + geometry_f) / geometry_b;
        if (fabs(cos_t3) > 1.0 || !find_angle(u, position[2] + 0.12, sqrt(1.0 - cos_t3 * cos_t3), &theta[leg])) {
            return 0;
        }
    }
    return 1;
}

void falcon_sim_counts(const double position[3], int16_t counts[3]) {
    double theta[3] = {0.0, 0.0, 0.0};
    (void)falcon_sim_angles(position, theta);
    for (int leg = 0; leg < 3; leg++) {
        counts[leg] = (int16_t)lround((theta[leg] * 180.0 / PI - 35.0) / 0.036434659090909090);
    }
}

void falcon_sim_force(const double position[3], const int16_t motors[3], double force[3]) {
    const double h = 1e-5;
    for (int axis = 0; axis < 3; axis++) {
        double before[3];
        double after[3];
        double at[3] = {position[0], position[1], position[2]};
        at[axis] -= h;
        const int found = falcon_sim_angles(at, before);
        at[axis] += 2.0 * h;
        force[axis] = 0.0;
        for (int leg = 0; found && falcon_sim_angles(at, after) && leg < 3; leg++) {
            const double torque = -1e-4 * motors[leg]; /* N m: a negative unit turns the count up */
            force[axis] += torque * (after[leg] - before[leg]) / (2.0 * h);
        }
    }
}

void falcon_sim_init(falcon_sim *sim, const knurl_stroke_desc *stroke) {
    /* the mass and frictions of the fake device's preset "falcon", a light grip */
    const knurl_plant_config config = {.mass = 0.2,
                                       .viscous = 1.5,
                                       .coulomb = 0.5,
                                       .hand_stiffness = 700.0,
                                       .hand_damping = 5.0,
                                       .max_force = 1000.0, /* the motors' own limit is in their units */
                                       .half_workspace = {0.04, 0.04, 0.04},
                                       .exact = 1};
    knurl_stroke_desc line;
    knurl_stroke_desc_init(&line, sizeof line);
    line.speed = 0.1;
    line.reach[0] = 0.03;
    memset(sim, 0, sizeof *sim);
    knurl_hand_init(&sim->hand, stroke ? stroke : &line, 0.0, 1);
    knurl_hand_target(&sim->hand, 0.0, 0.001, sim->target);
    knurl_plant_init(&sim->plant, &config, sim->target);
    sim->gain = 0.35;
    sim->is_moving = 1;
    sim->homed = 7;
    sim->latency_ms = 16;
    sim->has_firmware = 1;
    sim->wrong_echo = sim->no_echo = -1;
}

void falcon_sim_forget_firmware(falcon_sim *sim, uint32_t image_size, uint32_t sum) {
    sim->has_firmware = sim->is_loading = 0;
    sim->boot_step = sim->image_count = sim->loading_sum = 0;
    sim->image_size = image_size;
    sim->image_sum = sum;
}

void falcon_sim_put(falcon_sim *sim, double x, double y, double z) {
    sim->plant.position[0] = x;
    sim->plant.position[1] = y;
    sim->plant.position[2] = z;
    sim->is_moving = 0;
}

/* Counts the completed steps of entering the boot loader. */
static void follow_boot(falcon_sim *sim, uint32_t request, uint32_t value) {
    static const uint32_t way[][2] = {{9, 16},    {3, 0x4138}, {4, 8},     {2, 0},   {1, 0x200},
                                      {1, 0x100}, {1, 0x101},  {1, 0x100}, {3, 0x15}};
    if (request == 0) {
        return;
    }
    if (request == way[0][0] && value == way[0][1]) {
        sim->boot_step = 1;
    } else if (sim->boot_step > 0 && sim->boot_step < 9 && request == way[sim->boot_step][0] &&
               value == way[sim->boot_step][1]) {
        sim->boot_step++;
    } else {
        sim->boot_step = 0;
    }
}

int falcon_sim_control(falcon_sim *sim, uint32_t request, uint32_t value) {
    if (request > 4 && request != 9) {
        return -32;
    }
    follow_boot(sim, request, value);
    if (request == 0 && value == 1) {
        sim->said_count = 0;
    } else if (request == 0) {
        sim->heard_count = 0;
    } else if (request == 9) {
        sim->latency_ms = value & 255u;
    } else if (request == 3) {
        sim->baud = value;
        sim->has_firmware |= value == 2 && sim->image_size > 0 && sim->image_count == sim->image_size &&
                             sim->loading_sum == sim->image_sum;
        sim->is_loading = 0;
    }
    return 0;
}

static void say(falcon_sim *sim, const uint8_t *bytes, uint32_t count) {
    if (sim->said_count + count <= FALCON_SIM_ROOM) {
        memcpy(sim->said + sim->said_count, bytes, count);
        sim->said_count += count;
    }
}

static void hear_boot(falcon_sim *sim, uint8_t byte) {
    static const uint8_t reply[] = {0x00, 0x0a, 0x44, 0x2c, 0x0d};
    static const uint8_t call[] = {0x0a, 0x43, 0x0d};
    if (sim->is_loading) {
        const int32_t at = (int32_t)sim->image_count++;
        const int is_bad = at == sim->wrong_echo || (at == 100 && sim->bad_loads > 0);
        const uint8_t echo = is_bad ? (uint8_t)~byte : byte;
        sim->bad_loads -= at == 100 && sim->bad_loads > 0;
        sim->loading_sum += byte;
        if (sim->no_echo < 0 || at < sim->no_echo) {
            say(sim, &echo, 1);
        }
    } else if (sim->boot_step == 9 && byte == 0x41) {
        sim->is_loading = 1;
        sim->image_count = sim->loading_sum = 0;
        say(sim, &byte, 1);
    } else if (sim->boot_step == 7) {
        sim->heard_count = byte == call[sim->heard_count] ? sim->heard_count + 1 : 0;
        if (sim->heard_count == sizeof call) {
            const uint32_t leading = sim->deaf % 2; /* sometimes a 00 comes first */
            sim->heard_count = 0;
            if (sim->deaf > 0) {
                sim->deaf--;
            } else {
                say(sim, reply + leading, (uint32_t)sizeof reply - leading);
            }
        }
    }
}

static void move(falcon_sim *sim) {
    double before[3];
    double speed[3];
    int16_t wired[3];
    for (int leg = 0; leg < 3; leg++) {
        wired[leg] = (int16_t)(sim->backwards >> leg & 1u ? -sim->motors[leg] : sim->motors[leg]);
    }
    falcon_sim_force(sim->plant.position, wired, sim->force);
    for (int axis = 0; axis < 3; axis++) {
        sim->force[axis] /= sim->gain;
    }
    if (!sim->is_moving) {
        return;
    }
    memcpy(before, sim->target, sizeof before);
    knurl_hand_target(&sim->hand, 0.001 * (double)++sim->ticks, 0.001, sim->target);
    for (int axis = 0; axis < 3; axis++) {
        speed[axis] = (sim->target[axis] - before[axis]) / 0.001;
    }
    const double pulled[3] = {sim->force[0], sim->force[1] - sim->weight, sim->force[2]};
    knurl_plant_write(&sim->plant, pulled);
    knurl_plant_step(&sim->plant, 0.001, sim->target, speed);
}

static void answer(falcon_sim *sim) {
    uint8_t frame[16];
    double seen[3];
    int16_t counts[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        seen[axis] = sim->plant.position[axis] + sim->jump[axis];
    }
    falcon_sim_counts(seen, counts);
    frame[0] = 0x3c;
    for (int i = 0; i < 12; i++) {
        frame[1 + i] = (uint8_t)("ABCDEFGHIJKLMNOP"[(counts[i / 4] & (0xf << (4 * (i % 4)))) >> (4 * (i % 4))]);
    }
    frame[13] = (uint8_t)(0x41 + 16 * sim->homed + sim->buttons);
    frame[14] = 0x41;
    frame[15] = 0x3e;
    say(sim, frame, 16);
}

/* Without the homing bit the legs' homing is forgotten. */
static void follow_homing(falcon_sim *sim) {
    sim->homing_run = sim->flags & 1u ? sim->homing_run + 1 : 0;
    if (sim->homing_run == 0 || (sim->unhomed_for > 0 && sim->frames % (sim->unhomed_for + 100) < sim->unhomed_for)) {
        sim->homed = 0;
    } else if ((sim->homes_at > 0 && sim->homing_run >= sim->homes_at) || sim->unhomed_for > 0) {
        sim->homed = 7;
    }
}

static void hear_frame(falcon_sim *sim) {
    int over = 0;
    for (int leg = 0; leg < 3; leg++) {
        int value = 0;
        for (int digit = 3; digit >= 0; digit--) {
            value = 16 * value + (sim->heard[1 + 4 * leg + digit] - 'A');
        }
        sim->motors[leg] = (int16_t)(value >= 32768 ? value - 65536 : value);
        over |= sim->motors[leg] > 4096 || sim->motors[leg] < -4096;
    }
    sim->overdriven += (uint64_t)over;
    sim->flags = sim->heard[13] - 0x41u;
    sim->frames++;
    follow_homing(sim);
    move(sim);
    answer(sim);
}

void falcon_sim_out(falcon_sim *sim, const uint8_t *bytes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!sim->has_firmware) {
            hear_boot(sim, bytes[i]);
            continue;
        }
        if (sim->baud != 2 || (sim->heard_count == 0 && bytes[i] != '<')) {
            sim->bad_bytes++;
            continue;
        }
        sim->heard[sim->heard_count++] = bytes[i];
        if (sim->heard_count == 16) {
            sim->heard_count = 0;
            if (bytes[i] == '>') {
                hear_frame(sim);
            } else {
                sim->bad_bytes += 16;
            }
        }
    }
}

size_t falcon_sim_in(falcon_sim *sim, uint8_t *packet, size_t room) {
    const size_t most = room < 64 ? room - 2 : 62;
    const size_t count = sim->said_count < most ? sim->said_count : most;
    packet[0] = 0x01;
    packet[1] = 0x60;
    memcpy(packet + 2, sim->said, count);
    memmove(sim->said, sim->said + count, sim->said_count - count);
    sim->said_count -= (uint32_t)count;
    return count + 2;
}
