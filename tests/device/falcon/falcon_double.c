/* The Falcon's row in the table of faults. SPDX-License-Identifier: MIT */
#include "device/doubles.h"
#include "device/falcon/falcon_fake.h"

static falcon_fake fake;

static knurl_device *open_wired(uint32_t backwards, const char *options) {
    knurl_device *device = NULL;
    knurl_stroke_desc stroke;
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    stroke.stroke = KNURL_STROKE_REST;
    stroke.depth = -0.005; /* stays at the height of a stroke's start */
    falcon_fake_init(&fake, &stroke);
    fake.sim.backwards = backwards;
    fake.sim.plant.config.hand_stiffness = backwards ? 200.0 : fake.sim.plant.config.hand_stiffness;
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    if (knurl_falcon_open_on(&bus, options, &device)) {
        falcon_fake_free(&fake);
        return NULL;
    }
    knurl_device_register(device);
    return device;
}

static knurl_device *double_open(void) {
    return open_wired(0, "?motors_known=1");
}

static knurl_device *double_open_backwards(void) {
    return open_wired(1, "");
}

static void double_inject(int fault) {
    falcon_fake_inject(&fake, fault);
}

static int64_t double_limp_since(void) {
    knurl_system_mutex_lock(&fake.lock);
    const int64_t since = fake.limp_at;
    knurl_system_mutex_unlock(&fake.lock);
    return since;
}

static void double_close(knurl_device *device) {
    knurl_device_close(device);
    falcon_fake_free(&fake);
}

static void double_hold_grip(int is_held) {
    knurl_system_mutex_lock(&fake.lock);
    double_hold(&fake.sim.plant, is_held);
    knurl_system_mutex_unlock(&fake.lock);
}

const device_double falcon_double = {
    .name = "falcon",
    .faults = 1u << DOUBLE_WELL | 1u << DOUBLE_UNPLUG | 1u << DOUBLE_MUTE | 1u << DOUBLE_HANG | 1u << DOUBLE_LATE |
              1u << DOUBLE_SHORT | 1u << DOUBLE_SPLIT | 1u << DOUBLE_CORRUPT | 1u << DOUBLE_JUMP | 1u << DOUBLE_UNHOMED,
    .open = double_open,
    .inject = double_inject,
    .limp_since = double_limp_since,
    .close = double_close,
    .open_backwards = double_open_backwards,
    .hold = double_hold_grip,
};
