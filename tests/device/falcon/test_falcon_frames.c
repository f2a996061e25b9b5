/* A Falcon's frames: digits, flags, resynchronisation after cut, doubled and foreign bytes. SPDX-License-Identifier:
 * MIT
 */
#include "support/close.h"

#include "device/falcon/frame.h"

/* A frame from the device, written out by hand in libnifalcon's order. */
#define FRAME_A "<BAAAACAAPPPPAA>" /* 1, 2 * 16, -1; no button, no leg homed */
#define FRAME_B "<EDCBAAAIPPPHSA>" /* 0x1234, -32768, 32767; button 1 (bit 1), leg 0 homed: 'A' + 16 + 2 */

static uint32_t feed(knurl_falcon_decoder *d, const char *text) {
    return knurl_falcon_decode(d, (const uint8_t *)text, strlen(text));
}

static void check_b(const knurl_falcon_state *s) {
    assert_int_equal(s->counts[0], 0x1234);
    assert_int_equal(s->counts[1], -32768);
    assert_int_equal(s->counts[2], 32767);
    assert_int_equal(s->buttons, 2);
    assert_int_equal(s->homed, 1);
}

TEST(a_frame_to_the_device_has_its_digits_low_first) {
    const int16_t motors[3] = {0x1234, -32768, 32767};
    uint8_t frame[16];
    knurl_falcon_encode(motors, KNURL_FALCON_HOMING | KNURL_FALCON_RED, frame);
    assert_memory_equal(frame, "<EDCBAAAIPPPHJA>", 16);
    const int16_t small[3] = {-1, 0, 4096};
    knurl_falcon_encode(small, KNURL_FALCON_GREEN | KNURL_FALCON_BLUE, frame);
    assert_memory_equal(frame, "<PPPPAAAAAAABGA>", 16);
}

TEST(a_frame_from_the_device_is_read) {
    knurl_falcon_decoder d = {0};
    assert_int_equal(feed(&d, FRAME_A), 1);
    assert_int_equal(d.newest.counts[0], 1);
    assert_int_equal(d.newest.counts[1], 32);
    assert_int_equal(d.newest.counts[2], -1);
    assert_int_equal(d.newest.homed, 0);
    assert_int_equal(feed(&d, FRAME_B), 1);
    check_b(&d.newest);
    assert_int_equal(d.bad_bytes, 0);
}

TEST(of_several_frames_the_newest_counts) {
    knurl_falcon_decoder d = {0};
    assert_int_equal(feed(&d, FRAME_A FRAME_A FRAME_B), 3);
    check_b(&d.newest);
}

TEST(a_frame_may_come_in_pieces_of_any_size) {
    for (size_t cut = 1; cut < 16; cut++) {
        knurl_falcon_decoder d = {0};
        assert_int_equal(knurl_falcon_decode(&d, (const uint8_t *)FRAME_B, cut), 0);
        assert_int_equal(knurl_falcon_decode(&d, (const uint8_t *)FRAME_B + cut, 16 - cut), 1);
        check_b(&d.newest);
        assert_int_equal(d.bad_bytes, 0);
    }
}

TEST(all_homed_legs_and_buttons_are_reported) {
    knurl_falcon_decoder d = {0};
    uint8_t frame[17] = FRAME_A;
    for (uint32_t flags = 0; flags < 128; flags++) {
        frame[13] = (uint8_t)(0x41 + flags);
        assert_int_equal(knurl_falcon_decode(&d, frame, 16), 1);
        assert_int_equal(d.newest.buttons, flags & 15);
        assert_int_equal(d.newest.homed, flags >> 4);
    }
}

TEST(a_frame_that_is_cut_off_costs_only_itself) {
    for (size_t cut = 1; cut < 16; cut++) {
        knurl_falcon_decoder d = {0};
        assert_int_equal(knurl_falcon_decode(&d, (const uint8_t *)FRAME_A, cut), 0);
        assert_int_equal(feed(&d, FRAME_B), 1);
        check_b(&d.newest);
        assert_int_equal(d.bad_bytes, cut);
    }
}

TEST(a_partial_frame_at_the_beginning_is_skipped) {
    for (size_t cut = 1; cut < 16; cut++) {
        knurl_falcon_decoder d = {0};
        assert_int_equal(feed(&d, &FRAME_A[cut]), 0);
        assert_int_equal(feed(&d, FRAME_B), 1);
        check_b(&d.newest);
        assert_int_equal(d.bad_bytes, 16 - cut);
    }
}

TEST(a_foreign_byte_anywhere_is_seen_and_the_next_frame_is_found) {
    static const uint8_t foreign[] = {0x00, '<', '>', 0x40, 0x51, 0xc1, 0xff};
    for (size_t at = 0; at < 16; at++) {
        for (size_t i = 0; i < sizeof foreign; i++) {
            knurl_falcon_decoder d = {0};
            uint8_t frame[17] = FRAME_A;
            if (frame[at] == foreign[i] || ((at == 13 || at == 14) && foreign[i] == 0x51)) {
                continue;
            }
            frame[at] = foreign[i];
            assert_int_equal(knurl_falcon_decode(&d, frame, 16), 0);
            assert_int_equal(feed(&d, FRAME_B), 1);
            check_b(&d.newest);
            assert_int_equal(d.bad_bytes, 16);
        }
    }
}

TEST(a_byte_that_is_lost_or_doubled_is_seen) {
    for (size_t at = 0; at < 16; at++) {
        uint8_t bytes[17];
        knurl_falcon_decoder lost = {0};
        knurl_falcon_decoder doubled = {0};
        memcpy(bytes, FRAME_A, at);
        memcpy(bytes + at, &FRAME_A[at + 1], 15 - at);
        assert_int_equal(knurl_falcon_decode(&lost, bytes, 15), 0);
        assert_int_equal(feed(&lost, FRAME_B), 1);
        assert_int_equal(lost.bad_bytes, 15);
        memcpy(bytes, FRAME_A, at + 1);
        memcpy(bytes + at + 1, &FRAME_A[at], 16 - at);
        /* a second bracket at either end is one byte too many; the frame itself is whole */
        const uint32_t whole = at == 0 || at == 15;
        assert_int_equal(knurl_falcon_decode(&doubled, bytes, 17), whole);
        assert_int_equal(feed(&doubled, FRAME_B), 1);
        assert_int_equal(doubled.bad_bytes, whole ? 1 : 17);
    }
}
