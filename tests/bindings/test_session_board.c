/* The haptic thread's data for the game. SPDX-License-Identifier: MIT */
#include "board.h"

#include "support/close.h"

#include "base/system.h"

static void take(knurl_board *b, uint64_t tick, knurl_surface_id felt) {
    knurl_tick_output output;
    memset(&output, 0, sizeof output);
    output.tick = tick;
    output.height = (double)tick;
    output.normal[1] = 1.0;
    output.force[1] = 2.0 * (double)tick;
    output.surface = felt;
    knurl_board_take(&output, b);
}

TEST(the_history_is_of_the_latest_ticks_oldest_first) {
    static knurl_board b;
    static float rows[2 * KNURL_BOARD_TICKS];
    memset(&b, 0, sizeof b);
    assert_int_equal(knurl_board_history(&b, 10, rows), 0);
    for (uint64_t tick = 0; tick < 3; tick++) {
        take(&b, tick, 0);
    }
    assert_int_equal(knurl_board_history(&b, 10, rows), 3);
    assert_int_equal(knurl_board_history(&b, 2, rows), 2);
    CHECK_SAME((double)rows[0], 1.0);
    CHECK_SAME((double)rows[3], 4.0);
    for (uint64_t tick = 3; tick < KNURL_BOARD_TICKS + 100; tick++) {
        take(&b, tick, 0);
    }
    const uint32_t count = knurl_board_history(&b, KNURL_BOARD_TICKS, rows);
    assert_in_range(count, KNURL_BOARD_TICKS - 1, KNURL_BOARD_TICKS);
    for (uint32_t i = 0; i < count; i++) {
        CHECK_SAME((double)rows[2 * i], (double)(KNURL_BOARD_TICKS + 100 - count + i));
    }
}

TEST(changes_of_contact_are_reported_once_each) {
    static knurl_board b;
    knurl_surface_id met[KNURL_BOARD_CHANGES];
    knurl_board_tick now;
    memset(&b, 0, sizeof b);
    take(&b, 0, 7);
    take(&b, 1, 7);
    take(&b, 2, 0);
    take(&b, 3, 9);
    assert_int_equal(knurl_board_changes(&b, met), 3);
    assert_true(met[0] == 7 && met[1] == 0 && met[2] == 9);
    assert_int_equal(knurl_board_changes(&b, met), 0);
    knurl_board_read(&b, &now);
    assert_true(now.surface == 9 && now.tick == 4);
    for (uint64_t tick = 4; tick < 204; tick++) {
        take(&b, tick, tick);
    }
    const uint32_t count = knurl_board_changes(&b, met);
    assert_in_range(count, KNURL_BOARD_CHANGES - 1, KNURL_BOARD_CHANGES);
    assert_true(met[0] == 204 - count && met[count - 1] == 203);
}

/* Checks the record of tick n, which is computed from n. */
static void check_tick(const knurl_board_tick *now) {
    const double n = (double)now->tick - 1.0;
    CHECK_SAME(now->height, n);
    CHECK_SAME(now->force[1], 2.0 * n);
    assert_true(now->surface == now->tick && now->sent == now->tick);
}

static uint32_t is_over;

/* Far faster than 1 kHz, with a gap in which a reader can be done. */
static void write_ticks(void *argument) {
    knurl_board *b = argument;
    for (uint64_t tick = 0; !__atomic_load_n(&is_over, __ATOMIC_ACQUIRE); tick++) {
        take(b, tick, tick + 1);
        for (int i = 0; i < 200 && !__atomic_load_n(&is_over, __ATOMIC_ACQUIRE); i++) {}
    }
}

static void check_history(const knurl_board *b) {
    static float rows[2 * KNURL_BOARD_TICKS];
    const uint32_t count = knurl_board_history(b, KNURL_BOARD_TICKS, rows);
    int is_sound = 1;
    for (uint32_t i = 0; i < count; i++) { /* from 2^24 on floats round, to the same in both */
        is_sound = is_sound && rows[2 * i + 1] == 2.0F * rows[2 * i] && (i == 0 || rows[2 * i] >= rows[2 * i - 2]);
    }
    assert_true(is_sound);
}

TEST(nothing_is_torn_however_fast_the_ticks_come) {
    static knurl_board b;
    knurl_surface_id met[KNURL_BOARD_CHANGES];
    knurl_surface_id latest = 0;
    knurl_board_tick now;
    memset(&b, 0, sizeof b);
    is_over = 0;
    knurl_thread *writer = knurl_system_start_thread(write_ticks, &b, (size_t)256 * 1024);
    assert_non_null(writer);
    do {
        knurl_board_read(&b, &now);
    } while (now.tick == 0);
    for (int round = 0; round < 2000; round++) {
        knurl_board_read(&b, &now);
        check_tick(&now);
        check_history(&b);
        const uint32_t count = knurl_board_changes(&b, met);
        for (uint32_t i = 0; i < count; i++) {
            assert_true(met[i] > latest);
            latest = met[i];
        }
    }
    __atomic_store_n(&is_over, 1, __ATOMIC_RELEASE);
    knurl_system_join_thread(writer);
}
