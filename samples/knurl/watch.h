/* Watches a loop that plays a force callback: prints faults, and ends it at a fault, a key or a signal.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_WATCH_H
#define KNURL_TOOL_WATCH_H

#include <knurl/loop.h>

#include <signal.h>

/* Sets *interrupted to SIGINT if standard input is a terminal and a key comes within 5 ms. */
void watch_key(volatile sig_atomic_t *interrupted);

/* Until the loop has ended; `ticks` at `rate` (Hz): how long that takes, for the line of progress. simulated: 1: steps
 * it on this thread. It is asked to stop after a fault other than an overrun, once *interrupted is set, and by a key if
 * standard input is a terminal, which sets *interrupted to SIGINT. Returns the fault's code, or 0. */
int watch_loop(knurl_loop *loop, knurl_device *device, uint64_t ticks, double rate, int simulated,
               volatile sig_atomic_t *interrupted, knurl_loop_stats *stats);

#endif
