/* A driver over the double of its device, as the table of faults sees every one of them: real driver, simulated device,
 * simulated transport. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_DOUBLE_H
#define KNURL_TEST_DOUBLE_H

#include "device/fake/plant.h"

#include <knurl/device.h>

/** Faults of a double. */
enum {
    DOUBLE_WELL,    /**< nothing; after DOUBLE_UNPLUG: it is plugged in again */
    DOUBLE_UNPLUG,  /**< transfers fail as they do when the cable is pulled */
    DOUBLE_MUTE,    /**< it accepts data and never answers */
    DOUBLE_HANG,    /**< a transfer blocks for as long as the driver's own timeout lets it */
    DOUBLE_LATE,    /**< each answer comes 20 ms late */
    DOUBLE_SHORT,   /**< answers are cut off */
    DOUBLE_SPLIT,   /**< answers come in pieces: no fault, nothing may happen */
    DOUBLE_CORRUPT, /**< answers hold random bytes */
    DOUBLE_NAN,     /**< positions are not finite, if the device can send such values */
    DOUBLE_JUMP,    /**< the position is 50 mm off from now on */
    DOUBLE_REFUSE,  /**< the device reports that it will not play the force (too warm, too strong) */
    DOUBLE_UNHOMED, /**< the device reports that it is not homed */
    DOUBLE_OFF,     /**< the device switches its forces off by itself, and reports it */
    DOUBLE_FAULT_COUNT
};

typedef struct device_double {
    const char *name;
    uint32_t faults; /**< bit 1 << DOUBLE_...: those that this device can have */
    /** A new simulated device, homed, at rest near the middle of its workspace, with the driver opened on it. Null: see
     * knurl_error_message(). */
    knurl_device *(*open)(void);
    void (*inject)(int fault); /**< at once, from any thread */
    /** ns on the monotonic clock since when the simulated motors get no force; 0: they get one now. [any thread] */
    int64_t (*limp_since)(void);
    void (*close)(knurl_device *device); /**< driver and double */
    /** The same without ?motors_known=1, loosely held, with motors that are wired backwards; null: its driver has no
     * check. */
    knurl_device *(*open_backwards)(void);
    double alone_ms; /**< for which its firmware plays on by itself when nothing reaches it any more; 0: not at all */
    /** A hand like the fake device's holds it (1), or lets it go (0); null: it has no mechanics. */
    void (*hold)(int is_held);
} device_double;

static inline void double_hold(knurl_plant *plant, int is_held) {
    plant->config.hand_stiffness = is_held ? 700.0 : 0.0;
    plant->config.hand_damping = is_held ? 5.0 : 0.0;
    plant->motion.step = 0.0; /* computed anew */
}

#endif
