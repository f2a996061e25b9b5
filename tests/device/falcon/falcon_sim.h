/* A simulated Novint Falcon behind its FTDI chip: boot loader, firmware, legs, a plant in a hand. No I/O, no clock: a
 * frame is a millisecond. Its kinematics are Stamper's equations solved by bisection and differentiated numerically, so
 * that a mistake in the driver's cannot cancel out. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_SIM_H
#define KNURL_TEST_FALCON_SIM_H

#include "device/fake/hand.h"
#include "device/fake/plant.h"

#include <stddef.h>

#define FALCON_SIM_ROOM 4096

typedef struct falcon_sim {
    /* motion of its grip */
    knurl_plant plant;
    knurl_hand hand;
    double target[3];
    uint64_t ticks;
    double jump[3];     /* m: error of the encoders */
    double gain;        /* motor units that make a newton metre, over libnifalcon's 10000 */
    uint32_t backwards; /* bits: motors that are wired backwards */
    double weight;      /* N that hang from its grip */
    int is_moving;      /* 0: it stays in place, independent of the motors */
    /* its messages */
    int16_t motors[3];
    double force[3]; /* N that they make there */
    uint32_t flags;  /* as heard: bit 0 homing, 1 green, 2 blue, 3 red */
    uint32_t buttons;
    uint32_t homed;
    uint32_t homes_at;    /* frames with the homing bit after which the legs are homed; 0: never */
    uint32_t homing_run;  /* such frames in a row so far */
    uint64_t unhomed_for; /* it loses its homing for so many frames, and has it again for 100; 0: it keeps it */
    uint64_t frames;
    uint64_t bad_bytes;
    uint64_t overdriven; /* frames with a motor beyond +-4096 */
    uint8_t heard[16];
    uint32_t heard_count;
    uint8_t said[FALCON_SIM_ROOM]; /* not fetched yet */
    uint32_t said_count;
    /* the chip and the boot loader */
    uint32_t latency_ms;
    uint32_t baud; /* the chip's own number for it */
    int has_firmware;
    uint32_t boot_step; /* requests in the right order so far */
    uint32_t deaf;      /* calls that the boot loader does not hear */
    uint32_t image_size;
    uint32_t image_count;
    uint32_t image_sum;   /* sum of the right image's bytes */
    uint32_t loading_sum; /* of the received bytes */
    int32_t wrong_echo;   /* index of the image byte that is echoed wrong; -1: no byte */
    uint32_t bad_loads;   /* so many loadings from now on get a wrong echo of byte 100 */
    int32_t no_echo;      /* index from which on bytes are not echoed; -1: all are */
    int is_loading;
} falcon_sim;

/* With firmware, homed, in the middle of the workspace, in a hand with that stroke (null: LINE, +-30 mm). */
void falcon_sim_init(falcon_sim *sim, const knurl_stroke_desc *stroke);

/* As after power-on, for an image of so many bytes that add up to `sum`. */
void falcon_sim_forget_firmware(falcon_sim *sim, uint32_t image_size, uint32_t sum);

/* A request to the chip. 0, or -32 (a stall). */
int falcon_sim_control(falcon_sim *sim, uint32_t request, uint32_t value);

void falcon_sim_out(falcon_sim *sim, const uint8_t *bytes, size_t count);

/* A packet of up to `room` bytes, its two status bytes first; returns its size. */
size_t falcon_sim_in(falcon_sim *sim, uint8_t *packet, size_t room);

/* The angles at a position (rad, m). 0: out of reach. */
int falcon_sim_angles(const double position[3], double theta[3]);

/* The encoders' counts there. */
void falcon_sim_counts(const double position[3], int16_t counts[3]);

/* The force (N) that motors make at a position, by virtual work; with libnifalcon's gain. */
void falcon_sim_force(const double position[3], const int16_t motors[3], double force[3]);

/* Puts the grip at a position, at rest. */
void falcon_sim_put(falcon_sim *sim, double x, double y, double z);

#endif
