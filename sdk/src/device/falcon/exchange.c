/* Exchanges with a Falcon: a frame of motor commands, answered by a frame of encoders. Read knurl_falcon_exchange()
 * first. SPDX-License-Identifier: MIT */
#include "device/falcon/falcon_device.h"

#include "base/vec3.h"
#include "device/falcon/kinematics.h"

#include <string.h>

#define EXCHANGE_MS 4 /* an answer takes about 0.3 ms, plus up to 1 ms of USB frame in each direction */
#define WRITE_MS    2

/* Answers arrive in order, one per frame, without a number. If this many are missing, the next ones are old: no force
 * may be computed from them, and nothing is sent until all have arrived, or until QUIET_NS pass without an answer. */
#define MOST_OWED 4
#define QUIET_NS  30000000

#define MOST_PACKETS 16 /* packets read at once; the rest waits for the next exchange */

static int is_zero(const double force[3]) {
    return !(vec3_dot(force, force) > 0.0);
}

/* Red: not homed. Green: ready. Blue: pushing. As in libnifalcon, every frame has the homing bit: without it a device
 * may lose its homing. */
static int send(falcon *f, const double force[3]) {
    uint8_t frame[KNURL_FALCON_FRAME_BYTES];
    int16_t motors[3] = {0, 0, 0};
    uint32_t light = KNURL_FALCON_RED;
    if (f->has_position) {
        double scaled[3];
        vec3_scale(f->gain, force, scaled);
        (void)knurl_falcon_motors(f->position, f->theta, scaled, motors);
        light = is_zero(force) ? KNURL_FALCON_GREEN : KNURL_FALCON_BLUE;
    }
    knurl_falcon_encode(motors, KNURL_FALCON_HOMING | light, frame);
    const int outcome = f->transport.write(f->transport.self, frame, sizeof frame, WRITE_MS);
    if (outcome == KNURL_FALCON_DONE) {
        f->is_pushing = motors[0] || motors[1] || motors[2];
        f->is_behind |= ++f->owed >= MOST_OWED;
    }
    return outcome;
}

/* Counts bytes that made no frame; sixteen of them replace one lost answer. */
static void count_bad(falcon *f, uint32_t frames) {
    const uint64_t bad = f->decoder.bad_bytes - f->told_bad;
    if (bad == 0) {
        f->link.is_corrupt = f->link.is_corrupt && frames == 0; /* a burst ends with the first clean answer */
        return;
    }
    knurl_link_count_bad(&f->link, &f->base, bad);
    f->told_bad = f->decoder.bad_bytes;
    f->unanswering += bad;
    for (; f->unanswering >= KNURL_FALCON_FRAME_BYTES; f->unanswering -= KNURL_FALCON_FRAME_BYTES) {
        f->owed -= f->owed > 0;
    }
}

/* Reads the next packet and adds its answers to *frames. Returns KNURL_FALCON_. */
static int take_in(falcon *f, uint32_t timeout_ms, uint32_t *frames) {
    uint8_t packet[KNURL_FALCON_PACKET];
    size_t size = 0;
    const int outcome = f->transport.read(f->transport.self, packet, &size, timeout_ms);
    if (outcome == KNURL_FALCON_DONE && size > KNURL_FALCON_STATUS) {
        const uint32_t found =
            knurl_falcon_decode(&f->decoder, packet + KNURL_FALCON_STATUS, size - KNURL_FALCON_STATUS);
        *frames += found;
        f->owed -= found < f->owed ? found : f->owed;
        f->heard_at = knurl_system_now_ns();
        count_bad(f, found);
    }
    return outcome;
}

/* Reads the packets that arrived since the last exchange, so that they are not taken for answers to the next frame. */
static int catch_up(falcon *f, uint32_t *frames) {
    int outcome = KNURL_FALCON_DONE;
    for (int i = 0; i < MOST_PACKETS && outcome == KNURL_FALCON_DONE; i++) {
        outcome = take_in(f, 0, frames);
    }
    return outcome;
}

/* Reads packets until every frame is answered or the deadline passes; adds the answers to *frames. KNURL_FALCON_. */
static int receive(falcon *f, int64_t deadline, uint32_t *frames) {
    while (f->owed > 0) {
        const int64_t left = deadline - knurl_system_now_ns();
        if (left <= 0) {
            return KNURL_FALCON_NOTHING;
        }
        const int outcome = take_in(f, (uint32_t)(left / 1000000) + 1, frames);
        if (outcome == KNURL_FALCON_GONE) {
            return outcome;
        }
    }
    return KNURL_FALCON_DONE;
}

/* Computes the position from the newest answer. Returns KNURL_LINK_. */
static int locate(falcon *f, knurl_device_sample *sample) {
    const knurl_falcon_state *state = &f->decoder.newest;
    double position[3];
    double theta[3];
    if (state->homed != KNURL_FALCON_ALL_HOMED) {
        if (!f->is_unhomed) {
            knurl_events_report(&f->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
        }
        f->is_unhomed = 1;
        f->has_position = 0;
        knurl_device_halt(&f->base); /* without it the motors get no force; later forces ramp up */
        return KNURL_LINK_NO_POSITION;
    }
    f->is_unhomed = 0;
    memcpy(position, f->position, sizeof position);
    for (int leg = 0; leg < 3; leg++) {
        theta[leg] = knurl_falcon_angle(state->counts[leg]);
    }
    if (!knurl_falcon_forward(theta, position)) { /* no hand can reach this */
        if (!f->is_nowhere) {
            knurl_events_report(&f->base.events, KNURL_FAULT_NOT_FINITE, 0.0);
        }
        f->is_nowhere = 1;
        return KNURL_LINK_NO_POSITION;
    }
    f->is_nowhere = 0;
    f->has_position = 1;
    vec3_copy(position, f->position);
    vec3_copy(theta, f->theta);
    vec3_copy(position, sample->position);
    sample->buttons = state->buttons;
    return KNURL_LINK_POSITION;
}

/* After a long silence the answers to the guard's frames may be among those to this driver's. */
static void mind_the_guard(falcon *f, int64_t now) {
    const int64_t silence = KNURL_GUARD_SILENCE_MS * (int64_t)1000000;
    if (f->link.guard && f->exchanged_at > 0 && now - f->exchanged_at >= silence) {
        f->is_behind = 1;
        f->owed = MOST_OWED;
        f->heard_at = now;
    }
    f->exchanged_at = now;
}

/* Sends a force and receives a position; copes with missing, late and extra answers. */
int knurl_falcon_exchange(knurl_device *device, const double force[3], knurl_device_sample *sample) {
    falcon *f = (falcon *)(void *)device; /* first member */
    uint32_t frames = 0;
    const int64_t begin = knurl_system_now_ns();
    const int was_held_up = (double)(begin - f->exchanged_at) > 1e9 * KNURL_LINK_PATIENCE;
    mind_the_guard(f, begin);
    int outcome = catch_up(f, &frames);
    if (was_held_up) { /* answers received meanwhile may be as old as that */
        frames = 0;
    }
    if (f->is_behind && begin - f->heard_at > QUIET_NS) { /* missing answers are lost */
        f->is_behind = 0;
        f->owed = 0;
    }
    if (outcome != KNURL_FALCON_GONE) {
        const int listen = f->is_behind && is_zero(force) && !f->is_pushing;
        outcome = listen ? KNURL_FALCON_DONE : send(f, force);
    }
    if (outcome == KNURL_FALCON_DONE) {
        outcome = receive(f, begin + EXCHANGE_MS * 1000000, &frames);
    }
    if (outcome == KNURL_FALCON_GONE) {
        return KNURL_LINK_LOST;
    }
    if (f->is_behind) {
        f->is_behind = f->owed > 0;
        return KNURL_LINK_NOTHING;
    }
    if (frames == 0) {
        return KNURL_LINK_NOTHING;
    }
    f->owed = 0; /* one arrived, and the time for the others is over */
    return locate(f, sample);
}
