/* The connection to the Haply Inverse Service; tests replace it by a simulation. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_INVERSE3_CHANNEL_H
#define KNURL_SRC_INVERSE3_CHANNEL_H

#include "device/driver.h"
#include "device/inverse3/message.h"

#include <knurl/device.h>

typedef struct knurl_inverse3_message {
    const char *text; /* valid until the next call; not 0-terminated */
    size_t size;      /* 0 if it was longer than KNURL_INVERSE3_LONGEST */
} knurl_inverse3_message;

/* An open connection. [one thread at a time] */
typedef struct knurl_inverse3_channel {
    void *self;
    /* Sends a message of at most KNURL_INVERSE3_COMMAND bytes. Returns 1 if it was sent, otherwise 0. */
    int (*send)(void *self, const char *text, size_t size);
    /* Waits for messages for up to `milliseconds`. Returns the number received since the last call, with the newest in
     * *message; 0: no message; -1: the service is gone. */
    int (*receive)(void *self, int milliseconds, knurl_inverse3_message *message);
    void (*close)(void *self);
} knurl_inverse3_channel;

/* Chooses the messages that a channel receives; others are dropped and do not replace a chosen one. */
typedef struct knurl_inverse3_filter {
    int (*takes)(const void *self, const char *text, size_t size); /* null: all. [any thread, one at a time] */
    const void *self;                                              /* must outlive the channel */
} knurl_inverse3_filter;

typedef struct knurl_inverse3_service {
    void *user;
    /* Connects to a port of this machine: returns 1, or 0 and the reason. [not the haptic thread] */
    int (*connect)(void *user, int port, knurl_inverse3_filter filter, knurl_inverse3_channel *channel, char *why,
                   size_t why_size);
} knurl_inverse3_service;

/* The system's, through libwebsockets; null if that is missing, with the remedy in `why`. */
const knurl_inverse3_service *knurl_inverse3_websocket(char *why, size_t why_size);

/* Opens the driver on another service. Errors: as knurl_device_open(). */
knurl_result knurl_inverse3_open(const char *options, const knurl_inverse3_service *service, knurl_device **device);

#endif
