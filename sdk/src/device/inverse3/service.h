/* The devices that the Haply Inverse Service knows, before one is opened. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_SERVICE_H
#define KNURL_SRC_INVERSE3_SERVICE_H

#include "device/inverse3/channel.h"

#define KNURL_INVERSE3_NAME     "Haply Inverse3"
#define KNURL_INVERSE3_PLUG_IN  "plug it in, and its power supply as well; the Haply Hub shows it then"
#define KNURL_INVERSE3_PORT     10001 /* the service's default */
#define KNURL_INVERSE3_HELLO_MS 500   /* to wait for a first message, and for the first answer */

typedef struct knurl_inverse3_model {
    const char *type, *name;
    double max_force;        /* N that it can play in 80 % of its workspace */
    double continuous_force; /* N that it holds for long */
    double max_stiffness;    /* N/m */
    double radius;           /* m: of its workspace, a sphere */
} knurl_inverse3_model;

/* A device's properties; null if its type is unknown. */
const knurl_inverse3_model *knurl_inverse3_find_model(const knurl_inverse3_entry *entry);

/* Connects to a port of this machine and reads the service's first message: all devices, with their configurations.
 * On failure the channel is closed. Errors: KNURL_ERROR_DEVICE_LOST. [not the haptic thread] */
knurl_result knurl_inverse3_first(const knurl_inverse3_service *service, int port, knurl_inverse3_channel *channel,
                                  knurl_inverse3_state *state);

/* Lists the devices of another service at the usual port, or the reason if there is no device. */
void knurl_inverse3_list(const knurl_inverse3_service *service, knurl_listings *listings);

#endif
