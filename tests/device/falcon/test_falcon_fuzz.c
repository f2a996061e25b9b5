/* Random, mutated and cut frames in random packets. The decoder counts every byte, forward kinematics returns only true
 * positions, motors stay within their limit. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/falcon/frame.h"
#include "device/falcon/kinematics.h"

#include <stdlib.h>

/* KNURL_FUZZ_FRAMES: more of them. */
#define FRAMES 1000000

static uint64_t seed = 23;

static uint32_t frame_count(void) {
    const char *asked = getenv("KNURL_FUZZ_FRAMES");
    const long count = asked ? strtol(asked, NULL, 10) : FRAMES;
    return count > 0 && count < 2000000000 ? (uint32_t)count : FRAMES;
}

/* A frame as the device might send it, with encoders of about its range, or any. */
static void make_frame(uint8_t frame[16]) {
    int16_t counts[3];
    const int64_t range = random_integer(&seed, 0, 1) ? 3000 : 32767;
    for (int leg = 0; leg < 3; leg++) {
        counts[leg] = (int16_t)random_integer(&seed, -range, range);
    }
    knurl_falcon_encode(counts, 0, frame);
    frame[13] = (uint8_t)(0x41 + random_integer(&seed, 0, 127));
}

/* Changes, cuts or doubles a byte or several; returns the new size (32 at most). */
static size_t mutate(uint8_t bytes[32]) {
    size_t size = 16;
    for (int64_t left = random_integer(&seed, 0, 3); left > 0; left--) {
        const size_t at = (size_t)random_integer(&seed, 0, (int64_t)size - 1);
        const int64_t what = random_integer(&seed, 0, 3);
        if (what == 0) {
            bytes[at] = (uint8_t)random_integer(&seed, 0, 255);
        } else if (what == 1) {
            bytes[at] ^= (uint8_t)(1u << random_integer(&seed, 0, 7));
        } else if (what == 2 && size > 1) {
            memmove(bytes + at, bytes + at + 1, --size - at);
        } else {
            memmove(bytes + at + 1, bytes + at, size++ - at);
        }
    }
    return size;
}

/* Processes an answer like the driver, and checks it. */
static int use(const knurl_falcon_state *state, double position[3]) {
    double theta[3];
    double force[3];
    double back[3];
    int16_t motors[3];
    const double before[3] = {position[0], position[1], position[2]};
    for (int leg = 0; leg < 3; leg++) {
        theta[leg] = knurl_falcon_angle(state->counts[leg]);
        force[leg] = random_between(&seed, -9.0, 9.0);
    }
    if (!knurl_falcon_forward(theta, position)) {
        assert_memory_equal(position, before, sizeof before);
        return 0;
    }
    assert_true(knurl_falcon_inverse(position, back));
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(position[i]) <= KNURL_FALCON_REACH);
        CHECK_CLOSE(back[i], remainder(theta[i], 6.283185307179586), 1e-7);
    }
    (void)knurl_falcon_motors(position, theta, force, motors);
    for (int leg = 0; leg < 3; leg++) {
        assert_true(abs(motors[leg]) <= KNURL_FALCON_MOTOR_MOST);
    }
    return 1;
}

/* Every byte that comes is part of a frame, thrown away, or waited with. */
TEST(mutated_frames_are_told_from_whole_ones_or_counted) {
    knurl_falcon_decoder d = {0};
    double position[3] = {0.0, 0.0, 0.0};
    uint8_t stream[64];
    size_t held = 0;
    uint64_t fed = 0;
    uint64_t frames = 0;
    uint64_t poses = 0;
    const uint32_t count = frame_count();
    for (uint32_t i = 0; i < count; i++) {
        uint8_t bytes[32];
        make_frame(bytes);
        const size_t size = mutate(bytes);
        for (size_t j = 0; j < size; j++) {
            stream[held++] = bytes[j];
            if (held == 62 || random_integer(&seed, 0, 20) == 0) { /* a packet's end */
                const uint32_t found = knurl_falcon_decode(&d, stream, held);
                fed += held;
                held = 0;
                frames += found;
                poses += found > 0 && use(&d.newest, position);
            }
        }
        assert_true(d.count < 16);
        assert_int_equal(fed, 16 * frames + d.bad_bytes + d.count);
    }
    print_message("%.0f of %u mutated frames were whole, %.0f bytes bad, %.0f readings were poses\n", (double)frames,
                  (unsigned)count, (double)d.bad_bytes, (double)poses);
    assert_true(frames > count / 4 && d.bad_bytes > count && poses > 1000);
}

TEST(random_bytes_hardly_ever_make_a_frame) {
    knurl_falcon_decoder d = {0};
    double position[3] = {0.0, 0.0, 0.0};
    uint64_t fed = 0;
    uint64_t frames = 0;
    for (uint32_t i = 0; i < frame_count(); i++) {
        uint8_t bytes[64];
        const size_t size = (size_t)random_integer(&seed, 0, 62);
        for (size_t j = 0; j < size; j += 8) {
            const uint64_t bits = random_bits(&seed);
            memcpy(bytes + j, &bits, 8);
        }
        const uint32_t found = knurl_falcon_decode(&d, bytes, size);
        fed += size;
        frames += found;
        if (found > 0) {
            (void)use(&d.newest, position);
        }
        assert_int_equal(fed, 16 * frames + d.bad_bytes + d.count);
    }
    assert_true(frames < 3); /* one in 10^18 */
}

/* Any counts, from any start, be it no number at all. */
TEST(forward_kinematics_takes_anything) {
    static const double strange[] = {0.0, -0.0, NAN, INFINITY, -INFINITY, 1e308, -1e308, 5e-324, 0.04, -0.06};
    for (uint32_t i = 0; i < frame_count() / 4; i++) {
        knurl_falcon_state any = {{0, 0, 0}, 0, 0};
        double position[3];
        double theta[3];
        for (int leg = 0; leg < 3; leg++) {
            any.counts[leg] = (int16_t)random_integer(&seed, -32768, 32767);
            position[leg] = random_integer(&seed, 0, 3)
                                ? random_between(&seed, -1.0, 1.0)
                                : strange[random_integer(&seed, 0, (int64_t)COUNT_OF(strange) - 1)];
            theta[leg] = random_integer(&seed, 0, 3)
                             ? random_between(&seed, -10.0, 10.0)
                             : strange[random_integer(&seed, 0, (int64_t)COUNT_OF(strange) - 1)];
        }
        (void)use(&any, position);
        if (knurl_falcon_forward(theta, position)) {
            for (int axis = 0; axis < 3; axis++) {
                assert_true(fabs(position[axis]) <= KNURL_FALCON_REACH);
            }
        }
    }
}
