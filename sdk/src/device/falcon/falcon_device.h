/* Internals of the Falcon's driver. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_FALCON_DEVICE_H
#define KNURL_SRC_FALCON_DEVICE_H

#include "device/driver.h"
#include "device/falcon/frame.h"
#include "device/falcon/transport.h"
#include "device/link.h"

typedef struct falcon {
    knurl_device base;
    knurl_falcon_bus bus;
    knurl_falcon_transport transport;
    char firmware[KNURL_URI_ROOM]; /* "": unknown */
    double gain;
    uint32_t is_gain_set; /* 1: by the URI or KNURL_FALCON_GAIN */
    uint32_t wants_guard;
    uint32_t motors_known;
    knurl_link link;
    /* of the I/O thread */
    knurl_falcon_decoder decoder;
    double position[3]; /* the last one; the search for the next starts here */
    double theta[3];
    uint32_t has_position;
    uint32_t owed;        /* frames without an answer */
    uint32_t is_behind;   /* 1: `owed` reached MOST_OWED */
    uint32_t is_pushing;  /* 1: the last frame had a force */
    uint64_t told_bad;    /* part of decoder.bad_bytes already counted */
    uint64_t unanswering; /* bad bytes not yet counted as an answer */
    uint32_t is_unhomed;  /* 1: already reported */
    uint32_t is_nowhere;  /* the same */
    int64_t heard_at;
    int64_t exchanged_at;
} falcon;

/* exchange.c, for knurl_link_open(). */
int knurl_falcon_exchange(knurl_device *device, const double force[3], knurl_device_sample *sample);

#endif
