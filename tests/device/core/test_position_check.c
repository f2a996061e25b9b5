/* Impossible positions: not finite, or a jump. The force is zero while they last, and starts anew afterwards. By read
 * counts, never by the clock. SPDX-License-Identifier: MIT */
#include "home.h"
#include "support/scenes.h"

#include "base/vec3.h"
#include "device/link.h"
#include "device/port.h"

#include <knurl/loop.h>

static home h; /* reset by each test */

static const double push[3] = {1.0, 0.0, 0.0};

static knurl_device *open_at(double rate) {
    knurl_device *device = home_open(&h, 0);
    assert_int_equal(knurl_device_start(device, rate), KNURL_OK);
    return device;
}

/* Reads at a position, and then tries to push. */
static knurl_result read_at(knurl_device *device, double x, double y, double z) {
    knurl_device_sample sample;
    memset(&sample, 0x55, sizeof sample);
    const knurl_device_sample before = sample;
    home_place(&h, x, y, z);
    const knurl_result result = knurl_device_read(device, &sample);
    assert_int_equal(knurl_device_write(device, push), KNURL_OK);
    if (result) {
        assert_int_equal(result, KNURL_ERROR_DEVICE_NOT_READY);
        assert_memory_equal(&sample, &before, sizeof sample);
        assert_int_equal(knurl_port_is_halted(device), 1);
        CHECK_SAME(h.motor[0], 0.0L);
    } else {
        CHECK_SAME(sample.position[0], (long double)x);
    }
    return result;
}

static knurl_device_event latest; /* the last that drain() removed */

/* Removes all events. Returns their number. */
static int drain(knurl_device *device) {
    int count = 0;
    while (knurl_device_next_event(device, &latest)) {
        count++;
    }
    return count;
}

/* --- not finite --- */

TEST(a_non_finite_position_is_reported_once_and_the_force_is_zeroed) {
    static const double wrong[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (size_t i = 0; i < 3 * COUNT_OF(wrong); i++) {
        SCOPED_DEVICE *device = open_at(1000.0);
        double p[3] = {0.01, 0.02, 0.03};
        assert_int_equal(read_at(device, p[0], p[1], p[2]), KNURL_OK);
        CHECK_SAME(h.motor[0], 1.0L);
        p[i % 3] = wrong[i / 3];
        for (int k = 0; k < 50; k++) {
            assert_int_equal(read_at(device, p[0], p[1], p[2]), KNURL_ERROR_DEVICE_NOT_READY);
        }
        assert_int_equal(drain(device), 1);
        assert_int_equal(latest.code, KNURL_FAULT_NOT_FINITE);
    }
}

TEST(a_first_position_that_is_not_finite_is_ignored) {
    SCOPED_DEVICE *device = open_at(1000.0);
    assert_int_equal(read_at(device, (double)NAN, 0.0, 0.0), KNURL_ERROR_DEVICE_NOT_READY);
    assert_int_equal(drain(device), 1);
}

/* Every second position is bad, such as from a loose contact. The ring of events has 64 places. */
TEST(repeated_non_finite_positions_are_one_fault_until_they_settle) {
    SCOPED_DEVICE *device = open_at(1000.0);
    assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
    for (int k = 0; k < 200; k++) {
        assert_int_equal(read_at(device, k % 2 ? 0.0 : (double)NAN, 0.0, 0.0), KNURL_ERROR_DEVICE_NOT_READY);
    }
    assert_int_equal(drain(device), 1);
    for (int k = 0; k < 40; k++) {
        (void)read_at(device, 0.0, 0.0, 0.0);
    }
    assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
    assert_int_equal(read_at(device, (double)NAN, 0.0, 0.0), KNURL_ERROR_DEVICE_NOT_READY);
    assert_int_equal(drain(device), 1); /* a new fault */
}

/* --- jumps --- */

/* The distance that a hand can move at 10 m/s since the previous position, but at least 20 mm: a device that measures
 * at 1 kHz moves in steps when it is read faster. */
TEST(the_limit_is_10_metres_a_second_and_20_mm_at_least) {
    static const struct {
        double rate, limit;
    } cases[] = {{100.0, 0.1}, {250.0, 0.04}, {499.0, 10.0 / 499.0}, {1000.0, 0.02}, {3000.0, 0.02}, {10000.0, 0.02}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        for (int beyond = 0; beyond < 2; beyond++) {
            SCOPED_DEVICE *device = open_at(cases[i].rate);
            const double step = cases[i].limit * (beyond ? 1.01 : 0.99) / sqrt(3.0);
            assert_int_equal(read_at(device, 0.01, 0.0, 0.0), KNURL_OK);
            assert_int_equal(read_at(device, 0.01 + step, -step, step),
                             beyond ? KNURL_ERROR_DEVICE_NOT_READY : KNURL_OK);
            assert_int_equal(drain(device), beyond);
            if (beyond) {
                assert_int_equal(latest.code, KNURL_FAULT_JUMP);
                CHECK_CLOSE(latest.value, cases[i].limit * 1.01, 1e-9);
            }
        }
    }
}

TEST(a_position_held_for_20_ms_is_accepted) {
    static const double rates[] = {100.0, 1000.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        SCOPED_DEVICE *device = open_at(rates[i]);
        int without = 0;
        assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
        while (read_at(device, 0.5 + 1e-5 * without, 0.0, 0.0) && without < 1000) {
            without++;
        }
        assert_in_range(without, (int)(0.02 * rates[i]) - 1, (int)(0.02 * rates[i]) + 1);
        assert_int_equal(drain(device), 1);
        assert_int_equal(knurl_port_is_halted(device), 1); /* for the haptic thread to release, with a ramp */
    }
}

TEST(a_position_that_jumps_to_and_fro_is_one_fault_until_it_has_settled) {
    SCOPED_DEVICE *device = open_at(1000.0);
    assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
    for (int k = 0; k < 200; k++) {
        assert_int_equal(read_at(device, k % 3 ? 0.0 : 0.05, 0.0, 0.0), KNURL_ERROR_DEVICE_NOT_READY);
    }
    assert_int_equal(drain(device), 1);
    for (int k = 0; k < 40; k++) {
        (void)read_at(device, 0.0, 0.0, 0.0);
    }
    assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
    assert_int_equal(read_at(device, 0.0, 0.0, 0.05), KNURL_ERROR_DEVICE_NOT_READY);
    assert_int_equal(drain(device), 1);
    CHECK_CLOSE(latest.value, 0.05, 1e-12);
}

TEST(a_start_forgets_where_it_was) {
    SCOPED_DEVICE *device = open_at(1000.0);
    assert_int_equal(read_at(device, 0.0, 0.0, 0.0), KNURL_OK);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(read_at(device, 0.3, 0.0, 0.0), KNURL_OK);
    assert_int_equal(drain(device), 0);
}

/* --- no false alarms --- */

/* The hand's position at t, measured by the device every `native` s. */
static double measured(double t, double native, double speed) {
    const double at = native * floor(t / native + 1e-9);
    return 0.02 * sin(20.0 * at) + speed * at;
}

TEST(a_device_of_1_khz_in_a_fast_hand_is_believed_however_often_it_is_read) {
    static const double rates[] = {100.0, 130.0, 333.0, 500.0, 999.0, 1000.0, 1001.0, 1500.0, 3000.0, 7777.0, 10000.0};
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        SCOPED_DEVICE *device = open_at(rates[i]);
        for (int k = 0; k < 3000; k++) {
            assert_int_equal(read_at(device, measured(k / rates[i], 0.001, 2.0), 0.0, 0.0), KNURL_OK);
        }
        assert_int_equal(drain(device), 0);
    }
}

static double native; /* Hz, the next device's native rate */

static void tell_native(void *user, knurl_device_info *info) {
    home_info(user, info);
    info->native_rate = native;
}

/* Its steps are longer than at 1 kHz, and it declares its rate. */
TEST(a_device_that_measures_slowly_is_believed_when_it_is_read_more_often) {
    static const double natives[] = {100.0, 125.0, 300.0, 3000.0};
    for (size_t i = 0; i < COUNT_OF(natives); i++) {
        SCOPED_DEVICE *device = NULL;
        memset(&h, 0, sizeof h);
        knurl_device_functions f = home_functions(&h, 0);
        f.get_info = tell_native;
        native = natives[i];
        assert_int_equal(knurl_device_open_functions(&f, &device), KNURL_OK);
        assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
        for (int k = 0; k < 1000; k++) {
            assert_int_equal(read_at(device, measured(k / 1000.0, 1.0 / native, 4.0), 0.0, 0.0), KNURL_OK);
        }
        assert_int_equal(drain(device), 0);
    }
}

/* Nine times out of ten there is no position, and the previous one is used. */
TEST(a_position_that_held_for_a_while_is_left_as_fast_as_a_hand_can) {
    SCOPED_DEVICE *device = open_at(1000.0);
    for (int k = 0; k < 1000; k++) {
        knurl_device_sample sample;
        h.read_gives = k % 10 ? KNURL_ERROR_DEVICE_NOT_READY : KNURL_OK;
        home_place(&h, 4.0 * k / 1000.0, 0.0, 0.0);
        assert_int_equal(knurl_device_read(device, &sample), KNURL_OK);
    }
    assert_int_equal(drain(device), 0);
}

/* The same for an I/O thread with such long exchanges: a link without its thread, and positions posted by hand. */
static knurl_link io;

static void tell_io(const knurl_device *device, knurl_device_info *info) {
    (void)device;
    info->max_force = 1.0;
    info->native_rate = 1000.0;
}

TEST(exchanges_that_take_long_do_not_make_a_hand_jump) {
    static const knurl_driver driver = {.uri = "io", .get_info = tell_io};
    knurl_device device;
    memset(&io, 0, sizeof io);
    memset(&device, 0, sizeof device);
    knurl_device_init(&device, &driver);
    device.max_speed = KNURL_HAND_SPEED;
    device.link = &io;
    io.device = &device;
    io.native_rate = 1000.0;
    knurl_mailbox_init(&io.positions);
    assert_int_equal(knurl_device_start(&device, 1000.0), KNURL_OK);
    for (int k = 0; k < 1000; k++) {
        knurl_device_sample sample;
        if (k % 10 == 0) {
            io.samples[io.positions.back].position[0] = 4.0 * k / 1000.0;
            knurl_mailbox_post(&io.positions);
        }
        io.cycles++;
        assert_int_equal(knurl_device_read(&device, &sample), KNURL_OK);
        CHECK_SAME(sample.position[0], (long double)(4.0 * (k - k % 10) / 1000.0));
    }
    assert_true(device.events.head == 0);
}

/* --- in a loop --- */

typedef struct record {
    knurl_tick_output ticks[4000];
    int count;
} record;

static record seen;

static void keep(const knurl_tick_output *output, void *user) {
    (void)user;
    if (seen.count < (int)COUNT_OF(seen.ticks)) {
        seen.ticks[seen.count++] = *output;
    }
}

/* A stroke of 50 mm/s over a grating of 1 mm, 1 mm deep. */
static double stroked_x(int beat) {
    return -0.04 + 0.00005 * beat;
}

/* S2 events at 50 Hz: one every 20 ticks; at 1 kHz, each takes 18 to 22 ticks. */
static int64_t events_within(int from, int to) {
    return seen.ticks[to].event - seen.ticks[from].event;
}

static void check_return(int before, int after) {
    const double step = 1.0 / 21.0; /* of the ramp: 20 ms */
    for (int k = before; k < seen.count; k++) {
        assert_true(fabs(seen.ticks[k].hip_velocity[0]) < 0.2); /* the jump itself would be 50 m/s */
        assert_true(vec3_length(seen.ticks[k].device_force) <= 3.3);
    }
    CHECK_SAME(vec3_length(seen.ticks[after].device_force), 0.0L);
    for (int k = 0; k < 20; k++) {
        assert_true(vec3_length(seen.ticks[after + k].device_force) <= k * step * 3.3 + 1e-12);
    }
    assert_true(events_within(after + 1, after + 401) <= 401 / 18 + 1);
    assert_true(vec3_length(seen.ticks[after + 300].device_force) > 0.1); /* the force is back */
}

TEST(after_a_jump_the_loop_comes_back_by_a_ramp_and_a_first_tick) {
    static const int faults[] = {DOUBLE_JUMP, DOUBLE_NAN};
    for (size_t i = 0; i < COUNT_OF(faults); i++) {
        surface_parts parts = surface_plane();
        knurl_loop_desc desc;
        knurl_loop *loop = NULL;
        SCOPED_DEVICE *device = open_at(1000.0);
        parts.plane.half_extents[0] = 0.3; /* also at the jump's end */
        set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0003);
        SCOPED_SCENE *scene = scene_of(&parts);
        knurl_loop_desc_init(&desc, sizeof desc);
        desc.device = device;
        desc.scene = scene;
        desc.tick_callback = keep;
        seen.count = 0;
        assert_int_equal(knurl_loop_create(&desc, &loop), KNURL_OK);
        for (int beat = 0; beat < 1500; beat++) {
            home_place(&h, stroked_x(beat), 0.0, -0.001);
            if (beat == 700) {
                home_inject(&h, faults[i]);
            } else if (beat == 710 && faults[i] == DOUBLE_NAN) {
                home_inject(&h, DOUBLE_WELL); /* the jump stays */
            }
            assert_int_equal(knurl_loop_step(loop, 1), KNURL_OK);
        }
        const knurl_loop_stats stats = loop_stats(loop);
        const int away = faults[i] == DOUBLE_NAN ? 30 : 20;
        assert_in_range(stats.absences, away - 1, away + 1);
        assert_int_equal(stats.ticks + stats.absences, 1500);
        assert_int_equal(stats.absent, 0);
        CHECK_CODES(device, 0, faults[i] == DOUBLE_NAN ? KNURL_FAULT_NOT_FINITE : KNURL_FAULT_JUMP,
                    KNURL_FAULT_RESUMED);
        assert_int_equal(seen.ticks[699].event > 20, 1); /* the stroke crossed a grating */
        check_return(100, 700);
        knurl_loop_destroy(loop);
    }
}

/* Ticks marked as absent: no force, and no state from before is kept. */
TEST(an_absent_tick_feels_nothing_and_the_next_one_is_a_first_one) {
    surface_parts parts = surface_plane();
    set_grating(&parts, KNURL_METHOD_S2, 1000.0, 0.0, 0.0003);
    SCOPED_SCENE *scene = scene_of(&parts);
    knurl_tick_output out;
    knurl_tick_input away;
    memset(&away, 0, sizeof away);
    away.absent = 1;
    away.position[0] = (double)NAN; /* not used */
    for (int k = 0; k < 300; k++) {
        out = tick_at(scene, stroked_x(k), 0.0, -0.001);
    }
    assert_true(out.flags & KNURL_TICK_CONTACT);
    assert_int_equal(knurl_scene_tick(scene, 0, &away, &out), KNURL_OK);
    assert_int_equal(out.flags, KNURL_TICK_ABSENT);
    assert_int_equal(out.tick, 300);
    assert_int_equal(out.event, KNURL_NO_EVENT);
    assert_int_equal(out.contacts, 0);
    CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0);
    out = tick_at(scene, 0.045, 0.0, -0.001);
    CHECK_SAME(out.hip_velocity[0], 0.0L);
    assert_true(out.event <= 1);
    assert_int_equal(out.tick, 301);
    knurl_hip_counts counts;
    assert_int_equal(knurl_scene_get_tick(scene, 0, NULL, &counts), KNURL_OK);
    assert_int_equal(counts.non_finite_ticks, 0);
}
