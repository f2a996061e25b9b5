/* The connection to the Haply Inverse Service, which tests replace by a simulation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_CHANNEL_H
#define KNURL_SRC_INVERSE3_CHANNEL_H

#include "device/inverse3/message.h"
#include "device/listings.h"

#include <knurl/device.h>

typedef struct knurl_inverse3_message {
    const char *text; /* until the next call; not ended by a 0 */
    size_t size;      /* 0: it was longer than KNURL_INVERSE3_LONGEST */
} knurl_inverse3_message;

/* An open connection. [one thread at a time] */
typedef struct knurl_inverse3_channel {
    void *self;
    /* Sends a message of at most KNURL_INVERSE3_COMMAND bytes. 1: it went out; 0: it did not. */
    int (*send)(void *self, const char *text, size_t size);
    /* Waits for messages for up to `milliseconds`. Returns how many came since the last call, the newest in *message;
     * 0: none; -1: the service is gone. */
    int (*receive)(void *self, int milliseconds, knurl_inverse3_message *message);
    void (*close)(void *self);
} knurl_inverse3_channel;

typedef struct knurl_inverse3_service {
    void *user;
    /* Connects to a port of this machine: 1, or 0 and why. [not the haptic thread] */
    int (*connect)(void *user, int port, knurl_inverse3_channel *channel, char *why, size_t why_size);
} knurl_inverse3_service;

/* The machine's own, by libwebsockets; null where that is missing: `why` says what helps. */
const knurl_inverse3_service *knurl_inverse3_websocket(char *why, size_t why_size);

/* The driver on another service. Errors: as knurl_device_open(). */
knurl_result knurl_inverse3_open(const char *options, const knurl_inverse3_service *service, knurl_device **device);

/* Lists the devices of another service at the usual port, or why there is none. */
void knurl_inverse3_list(const knurl_inverse3_service *service, knurl_listings *listings);

#endif
