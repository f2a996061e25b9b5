/* An emulated Falcon on the USB that libusb sees in a umockdev test bed, for this process and its children. One at a
 * time; the program runs under umockdev-wrapper. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_EMULATED_H
#define KNURL_TEST_FALCON_EMULATED_H

#include "falcon_sim.h"

typedef struct falcon_emulation {
    falcon_sim sim;
    double unplug_after; /* s after its first frame; 0: never */
    int is_split;        /* 1: packets of up to 6 bytes of data */
    int is_mute;         /* 1: it accepts data and never answers */
    int is_held;         /* 1: another program holds its interface */
} falcon_emulation;

/* Puts it there. `setup` is copied. 0: not under umockdev-wrapper, or umockdev refuses (said on standard error). */
int falcon_emulated_start(const falcon_emulation *setup);

/* Pulls the cable, puts it back. */
void falcon_emulated_unplug(void);
int falcon_emulated_plug_in(void);

void falcon_emulated_mute(int is_mute);

/* The path of its device node, as the file system has it. */
const char *falcon_emulated_node(void);

/* A copy of the simulated device as it is now. */
falcon_sim falcon_emulated_look(void);

void falcon_emulated_stop(void);

#endif
