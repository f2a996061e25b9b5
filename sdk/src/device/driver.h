/* What a driver gives the device interface. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DRIVER_H
#define KNURL_SRC_DRIVER_H

#include <knurl/device.h>

typedef struct knurl_driver {
    const char *uri;    /* what a URI begins with, up to a ':' */
    const char *name;   /* for people */
    const char *reason; /* why it cannot be opened, or "" */
    /* options: what follows "uri:", or "". Errors: as knurl_device_open(). */
    knurl_result (*open)(const char *options, knurl_device **device);
    void (*close)(knurl_device *device);
    void (*get_info)(const knurl_device *device, knurl_device_info *info);
    knurl_result (*start)(knurl_device *device, double update_rate_hz);
    knurl_result (*read)(knurl_device *device, knurl_device_sample *sample);
    knurl_result (*write)(knurl_device *device, const double force[3]);
} knurl_driver;

/* First member of every driver's own struct. */
struct knurl_device {
    const knurl_driver *driver;
    double max_force;  /* N */
    uint32_t halted;   /* atomic */
    uint32_t reserved; /* 0 */
};

extern const knurl_driver knurl_fake_driver;

#endif
