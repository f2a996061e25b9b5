/* The I/O thread: writes the force, reads the position, repeatedly. Read run_cycle() first.
 * SPDX-License-Identifier: MIT */
#include "device/link.h"

#include "base/atomic.h"

#include <string.h>

#define STACK_BYTES ((size_t)256 * 1024)

static int64_t patience_ns(void) {
    return (int64_t)(KNURL_LINK_PATIENCE * 1e9);
}

static const double zeros[KNURL_FORCES];

/* The newest force; zero if the device is halted or the force is too old. */
static void choose_force(knurl_link *link, int64_t now, double force[KNURL_FORCES]) {
    knurl_device *device = link->device;
    (void)knurl_mailbox_take(&link->orders);
    const double *newest = link->forces[link->orders.front].force;
    const int64_t age = now - link->forces[link->orders.front].time_ns;
    const int is_late = !knurl_force_is_zero(newest) && age > patience_ns();
    if (is_late && !link->is_late && !knurl_load_acquire(&device->halted)) {
        knurl_device_halt(device); /* so that later forces ramp up */
        knurl_events_report(&device->events, KNURL_FAULT_LATE, 1e-9 * (double)age);
    }
    link->is_late = (uint32_t)is_late;
    const int is_off = knurl_load_relaxed(&link->is_off) || knurl_load_acquire(&device->halted);
    memcpy(force, is_late || is_off ? zeros : newest, sizeof zeros);
    knurl_device_before_force(device, force);
}

static void publish(knurl_link *link, const knurl_device_sample *sample) {
    link->samples[link->positions.back] = *sample;
    knurl_mailbox_post(&link->positions);
    knurl_count_up(&link->exchanges);
}

/* Reports silence once, from either thread, until the device answers again. */
static void tell_silence(knurl_link *link, double seconds) {
    if (!knurl_load_relaxed(&link->is_silent) && !__atomic_exchange_n(&link->is_silent, 1, __ATOMIC_ACQ_REL)) {
        knurl_device_halt(link->device);
        knurl_events_report(&link->device->events, KNURL_FAULT_SILENT, seconds);
    }
}

/* Handles the outcome of an exchange. */
static void judge(knurl_link *link, int outcome, int64_t now) {
    knurl_device *device = link->device;
    const uint32_t is_off = outcome == KNURL_LINK_OFF;
    if (is_off) {
        knurl_device_halt(device);
    }
    if (outcome == KNURL_LINK_POSITION || outcome == KNURL_LINK_NO_POSITION || is_off) {
        link->heard_at = now;
        knurl_store_release(&link->is_off, is_off);
        knurl_store_release(&link->is_silent, 0u); /* after the position has been posted */
    }
    const int64_t silence = now - link->heard_at;
    if (silence > patience_ns() && outcome != KNURL_LINK_LOST) {
        tell_silence(link, 1e-9 * (double)silence);
    }
    if (outcome == KNURL_LINK_LOST || (double)silence > 1e9 * KNURL_LINK_GIVE_UP) {
        knurl_device_halt(device);
        knurl_events_report(&device->events, KNURL_FAULT_LOST, 0.0);
        knurl_store_release(&link->lost, 1u);
    }
}

/* Sends a heartbeat to the guard process, which takes silence as the end of this process. */
static void tell_guard(knurl_link *link, int64_t now) {
    if (link->guard && !link->is_unguarded && now - link->told_guard_at >= KNURL_GUARD_SIGN_MS * (int64_t)1000000) {
        link->told_guard_at = now;
        if (!knurl_guard_process_tell(link->guard)) {
            link->is_unguarded = 1;
            knurl_events_report(&link->device->events, KNURL_FAULT_UNGUARDED, 0.0);
        }
    }
}

/* One exchange. Returns 0 if the device is lost. */
static int run_cycle(knurl_link *link) {
    double force[KNURL_FORCES];
    knurl_device_sample sample;
    memset(&sample, 0, sizeof sample);
    const int64_t before = knurl_system_now_ns();
    choose_force(link, before, force);
    const int outcome = link->exchange(link->device, force, &sample);
    const int64_t now = knurl_system_now_ns();
    if (outcome == KNURL_LINK_POSITION) {
        knurl_histogram_add(&link->durations, now - before);
        publish(link, &sample);
    }
    if (outcome != KNURL_LINK_NOTHING) { /* after that it is unknown whether the force was sent */
        knurl_device_after_force(link->device, force);
    }
    knurl_count_up(&link->cycles);
    tell_guard(link, now);
    judge(link, outcome, now);
    return !knurl_load_relaxed(&link->lost);
}

static void io_thread(void *argument) {
    knurl_link *link = argument;
    knurl_device_sample ignored;
    const int64_t period = (int64_t)(1e9 / link->native_rate);
    int64_t next = knurl_system_now_ns();
    knurl_store_relaxed(&link->realtime, (uint32_t)knurl_system_make_realtime());
    link->heard_at = next;
    while (!knurl_load_acquire(&link->stop)) {
        if (!run_cycle(link)) {
            knurl_store_release(&link->device->quiet, 1u); /* no device left to send to */
            return;
        }
        const int64_t now = knurl_system_now_ns();
        next = next + period > now ? next + period : now; /* if transfers are slow, they set the rate */
        knurl_system_sleep_until_ns(next);
    }
    (void)link->exchange(link->device, zeros, &ignored); /* twice: the first may be answered for an earlier one */
    (void)link->exchange(link->device, zeros, &ignored);
    knurl_store_release(&link->device->quiet, 1u);
}

knurl_result knurl_link_open(knurl_link *link, knurl_device *device, knurl_link_exchange exchange, double native_rate) {
    link->device = device;
    link->exchange = exchange;
    link->native_rate = native_rate;
    if (device->link != link) { /* after a reopen it is already set, and other threads may read it */
        device->link = link;
    }
    knurl_mailbox_init(&link->positions);
    knurl_mailbox_init(&link->orders);
    memset(link->forces, 0, sizeof link->forces);
    link->has_sample = link->is_silent = link->is_off = link->is_late = link->is_unguarded = link->is_corrupt = 0;
    link->trouble = 0;
    link->stale = link->watched = link->stuck = 0;
    link->cycles = 0;
    knurl_store_release(&link->stop, 0u);
    knurl_store_release(&link->lost, 0u);
    knurl_link_start(link, device->period > 0.0 ? 1.0 / device->period : 1000.0);
    link->thread = knurl_system_start_thread(io_thread, link, STACK_BYTES);
    return link->thread ? KNURL_OK
                        : knurl_fail(KNURL_ERROR_SYSTEM, "device: the system refused a thread for transfers");
}

void knurl_link_close(knurl_link *link) {
    if (link->thread) {
        knurl_store_release(&link->stop, 1u);
        knurl_system_join_thread(link->thread);
        link->thread = NULL;
    }
    knurl_guard_process_stop(link->guard);
    link->guard = NULL;
}

knurl_result knurl_link_start_guard(knurl_link *link, const knurl_device *device, int shared,
                                    const knurl_guard_order *order) {
    char why[256] = "its handle is not available";
    if (shared >= 0) {
        link->guard = knurl_guard_process_start(shared, order, why, sizeof why);
    }
    return link->guard ? KNURL_OK
                       : knurl_fail(KNURL_ERROR_UNSUPPORTED, "device '%s': guard: %s", device->driver->uri, why);
}

void knurl_link_count_bad(knurl_link *link, knurl_device *device, uint64_t bytes) {
    knurl_store_relaxed(&link->bad_bytes, knurl_load_relaxed(&link->bad_bytes) + bytes);
    if (!link->is_corrupt) {
        link->is_corrupt = 1;
        knurl_events_report(&device->events, KNURL_FAULT_CORRUPT, (double)bytes);
    }
}

int knurl_link_take_trouble(knurl_link *link, int32_t trouble, int32_t cause) {
    if (trouble && trouble != link->trouble) {
        knurl_device_halt(link->device);
        knurl_events_report(&link->device->events, trouble, cause);
    }
    link->trouble = trouble;
    return trouble ? KNURL_LINK_OFF : KNURL_LINK_POSITION;
}

void knurl_link_start(knurl_link *link, double update_rate_hz) {
    const double slower = update_rate_hz < link->native_rate ? update_rate_hz : link->native_rate;
    const double period = 1.0 / slower; /* the slower rate limits new positions */
    link->patience = (uint64_t)((KNURL_LINK_PATIENCE + 2.0 * period) * update_rate_hz);
}

knurl_result knurl_link_read(knurl_link *link, knurl_device_sample *sample) {
    if (knurl_load_acquire(&link->lost)) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    if (knurl_load_acquire(&link->is_off)) {
        link->stuck = 0;
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    const uint64_t cycles = knurl_load_relaxed(&link->cycles);
    link->stuck = cycles == link->watched ? link->stuck + 1 : 0;
    link->watched = cycles;
    if (knurl_mailbox_take(&link->positions)) {
        link->has_sample = 1;
        link->device->check.gap += (double)link->stale * link->device->period; /* repeated positions count as a gap */
        link->stale = 0;
        *sample = link->samples[link->positions.front];
        return KNURL_OK;
    }
    link->stale++;
    if (link->stuck >= link->patience) {
        /* the I/O thread hangs and cannot report it; the motors go on until the device's own watchdog acts */
        tell_silence(link, (double)link->stuck * link->device->period);
    }
    if (!link->has_sample || link->stale >= link->patience || knurl_load_acquire(&link->is_silent)) {
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    *sample = link->samples[link->positions.front];
    return KNURL_OK;
}

knurl_result knurl_link_write(knurl_link *link, const double force[KNURL_FORCES]) {
    if (knurl_load_acquire(&link->lost)) {
        return KNURL_ERROR_DEVICE_LOST;
    }
    memcpy(link->forces[link->orders.back].force, force, sizeof zeros);
    link->forces[link->orders.back].time_ns = knurl_system_now_ns();
    knurl_mailbox_post(&link->orders);
    return KNURL_OK;
}

void knurl_link_get_status(const knurl_link *link, knurl_device_status *status) {
    status->lost |= knurl_load_acquire(&link->lost); /* also if no read has happened since */
    status->exchanges = knurl_load_relaxed(&link->exchanges);
    status->bad_bytes = knurl_load_relaxed(&link->bad_bytes);
    status->exchange_ns_p50 = knurl_histogram_percentile(&link->durations, 0.5);
    status->exchange_ns_p99 = knurl_histogram_percentile(&link->durations, 0.99);
}
