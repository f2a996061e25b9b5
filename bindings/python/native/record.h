/* Passes a loop's ticks to Python without making its haptic thread wait. SPDX-License-Identifier: MIT */
#ifndef KNURL_PYTHON_RECORD_H
#define KNURL_PYTHON_RECORD_H

#include <knurl/hip.h>

/** A ring of ticks with one writer and one reader. Its owner sets rows and capacity and zeroes the rest. */
typedef struct knurl_record {
    knurl_tick_output *rows; /**< `capacity` rows, owned by the caller */
    uint64_t capacity;
    uint64_t written; /**< ticks added, by the haptic thread */
    uint64_t read;    /**< ticks taken, by the reader */
    uint64_t lost;    /**< ticks dropped because the ring was full */
} knurl_record;

/** Adds a tick, or counts it as lost if the ring is full: a knurl_tick_callback whose `user` is a record. [haptic
 * thread] */
KNURL_API void knurl_record_put(const knurl_tick_output *output, void *record);

/** Takes up to `count` of the oldest ticks. Returns the number taken. [one reader at a time] */
KNURL_API uint64_t knurl_record_take(knurl_record *record, knurl_tick_output *rows, uint64_t count);

#endif
