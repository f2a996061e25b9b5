/* A simulated Falcon in place of the driver's transport: a bus with one device, in real time, with faults.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FALCON_FAKE_H
#define KNURL_TEST_FALCON_FAKE_H

#include "support/double.h"

#include "base/system.h"
#include "device/falcon/transport.h"
#include "falcon_sim.h"

#define FALCON_FAKE_QUEUE 128

typedef struct falcon_fake {
    knurl_mutex lock; /* over all of it */
    falcon_sim sim;
    int fault;   /* DOUBLE_ */
    int is_gone; /* an open handle is lost */
    int denied;  /* 1: opening it is not permitted */
    uint32_t opens, closes;
    int64_t limp_at;     /* ns since when its motors get no force; 0: they get one */
    int64_t late_ns;     /* so late come the answers to frames from now on */
    int64_t stall_until; /* a read that finds no data returns no earlier: its thread was not run */
    uint64_t random;
    struct {
        int64_t due;
        uint8_t bytes[64];
        size_t count, taken;
    } queue[FALCON_FAKE_QUEUE]; /* on its way to the host */
    uint32_t first, held;
} falcon_fake;

/* A homed device with firmware in a hand with that stroke (null: the sim's own). */
void falcon_fake_init(falcon_fake *fake, const knurl_stroke_desc *stroke);
void falcon_fake_free(falcon_fake *fake);

knurl_falcon_bus falcon_fake_bus(falcon_fake *fake);

/* At once. */
void falcon_fake_inject(falcon_fake *fake, int fault);

/* A copy of the simulated device as it is now. */
falcon_sim falcon_fake_look(falcon_fake *fake);

#endif
