/* The fake device as a device: its URI, information and errors, forces, halts and lost cables.
 * SPDX-License-Identifier: MIT */
#include "device/port.h"
#include "support/close.h"
#include "support/fake.h"

#include <stdio.h>

/* Nothing but a mass in free space: a force shows as F t^2/2m, from the next tick on. */
#define FREE "fake:?coulomb=0&viscous=0&hand_stiffness=0&hand_damping=0&tremor=0&resolution=0&mass=0.05"

static void write_x(knurl_device *device, double force) {
    const double forces[3] = {force, 0.0, 0.0};
    assert_int_equal(knurl_device_write(device, forces), KNURL_OK);
}

/* --- opening --- */

TEST(uris_that_name_the_fake_device_open_it) {
    static const char *const uris[] = {"fake",
                                       "fake:",
                                       "fake:?",
                                       "fake:?mass=0.1",
                                       "fake:?mass=0.1&",
                                       "fake:?mass=1e-1&viscous=0&coulomb=0&hand_stiffness=0&hand_damping=0",
                                       "fake:?max_force=1&delay=16&width=1&height=1&depth=1&tremor=0&resolution=0",
                                       "fake:?seed=4294967295&lose_at=1&seed=0"};
    for (size_t i = 0; i < COUNT_OF(uris); i++) {
        knurl_device_close(open_device(uris[i]));
    }
    knurl_device_close(NULL);
}

TEST(a_bad_key_or_value_is_refused_in_a_sentence_that_names_it) {
    static const struct {
        const char *uri, *named;
    } bad[] = {{"fake:mass=1", "mass=1"},
               {"fake:?mas=1", "mas=1"},
               {"fake:?masss=1", "masss=1"},
               {"fake:?Mass=1", "Mass=1"},
               {"fake:?mass", "mass"},
               {"fake:?=1", "=1"},
               {"fake:?&mass=1", "key=value"},
               {"fake:?mass=1&&delay=1", "key=value"},
               {"fake:?mass=", "mass"},
               {"fake:?mass=heavy", "heavy"},
               {"fake:?mass=1kg", "1kg"},
               {"fake:?mass=1=2", "1=2"},
               {"fake:?mass=0", "mass"},
               {"fake:?mass=-1", "-1"},
               {"fake:?mass=nan", "nan"},
               {"fake:?mass=inf", "inf"},
               {"fake:?mass=1e300", "1e300"},
               {"fake:?resolution=-1e-9", "resolution"},
               {"fake:?max_force=0", "max_force"},
               {"fake:?delay=1.5", "1.5"},
               {"fake:?delay=17", "17"},
               {"fake:?delay=-1", "-1"},
               {"fake:?seed=0.5", "0.5"},
               {"fake:?seed=4294967296", "4294967296"},
               {"fake:?width=0", "width"},
               {"fake:?tremor=-1", "tremor"},
               {"fake:?lose_at=-1", "lose_at"},
               {"fake:?mass=0.1&delay=two", "delay"},
               {"fake:?mass=0.00000000000000000000000000000000000000000000000000000000000000001", "mass"}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        knurl_device *device = NULL;
        CHECK_REFUSED(knurl_device_open(bad[i].uri, &device), KNURL_ERROR_ARGUMENT, device);
        if (!strstr(knurl_error_message(), bad[i].named)) {
            fail_msg("%s: '%s' does not name '%s'", bad[i].uri, knurl_error_message(), bad[i].named);
        }
    }
}

/* Every key that knurl_fake_keys() lists, with the default that it lists, is taken. */
TEST(every_key_that_is_listed_is_taken_with_its_default) {
    char uri[1024] = "fake:?";
    size_t keys = 0;
    for (const char *line = knurl_fake_keys(); *line; line = strchr(line, '\n') + 1) {
        const size_t length = strcspn(line, " \t\n");
        assert_true(length > 3 && memchr(line, '=', length) && strlen(uri) + length + 2 < sizeof uri);
        (void)strncat(uri, line, length);
        (void)strncat(uri, "&", 2);
        keys++;
        assert_non_null(strchr(line, '\n')); /* each on a line of its own */
    }
    assert_true(keys >= 10);
    SCOPED_DEVICE *device = open_device(uri);
    SCOPED_DEVICE *standard = open_device("fake");
    for (int tick = 0; tick < 500; tick++) {
        const knurl_device_sample one = read_one(device);
        const knurl_device_sample other = read_one(standard);
        assert_memory_equal(&one, &other, sizeof one);
    }
}

TEST(an_unknown_device_is_refused) {
    static const char *const strange[] = {"", ":", "fak", "fakes", "Fake", "touc", "touches", "omega", "?", "mass=1"};
    knurl_device *device = NULL;
    for (size_t i = 0; i < COUNT_OF(strange); i++) {
        CHECK_REFUSED(knurl_device_open(strange[i], &device), KNURL_ERROR_UNKNOWN, device);
        assert_non_null(strstr(knurl_error_message(), strange[i]));
    }
    CHECK_REFUSED(knurl_device_open(NULL, &device), KNURL_ERROR_ARGUMENT, device);
}

TEST(a_listing_names_every_kind_of_device_and_why_it_cannot_be_had) {
    static const char *const kinds[] = {"fake", "touch", "falcon", "rawhid"};
    static knurl_device_listing listings[32];
    memset(listings, 0, sizeof listings);
    const uint32_t count = knurl_device_list(NULL, 0);
    assert_true(count >= COUNT_OF(kinds));
    assert_int_equal(knurl_device_list(listings, 1), count);
    assert_int_equal(listings[1].uri[0], '\0'); /* no more than there is room for */
    assert_int_equal(knurl_device_list(listings, 32), count);
    for (size_t kind = 0; kind < COUNT_OF(kinds); kind++) {
        uint32_t found = 0;
        for (uint32_t i = 0; i < count; i++) {
            found += strncmp(listings[i].uri, kinds[kind], strlen(kinds[kind])) == 0;
            assert_true(listings[i].name[0] != '\0');
        }
        assert_true(found >= 1);
    }
    assert_string_equal(listings[0].uri, "fake");
    assert_string_equal(listings[0].reason, "");
}

TEST(the_fake_device_is_a_touch) {
    SCOPED_DEVICE *device = open_device("fake");
    const knurl_device_info info = device_info(device);
    CHECK_SAME(info.workspace_min[0], -0.08);
    CHECK_SAME(info.workspace_max[0], 0.08);
    CHECK_SAME(info.workspace_min[1], -0.06);
    CHECK_SAME(info.workspace_max[1], 0.06);
    CHECK_CLOSE(info.workspace_min[2], -0.035, 1e-15);
    CHECK_CLOSE(info.workspace_max[2], 0.035, 1e-15);
    CHECK_SAME(info.resolution, 0.055e-3);
    CHECK_SAME(info.max_force, 3.3);
    CHECK_SAME(info.delay, 1.0);
    assert_int_equal(info.reserved, 0);
    assert_true(info.name[0] != '\0');
    knurl_device_info untouched;
    memset(&untouched, 0, sizeof untouched);
    CHECK_REFUSED(knurl_device_get_info(device, &untouched), KNURL_ERROR_ARGUMENT, untouched);
}

TEST(a_name_ends_in_whatever_an_older_caller_has_of_it) {
    SCOPED_DEVICE *device = open_device("fake");
    const knurl_device_info full = device_info(device);
    for (uint32_t size = 9; size <= offsetof(knurl_device_info, name) + sizeof full.name; size++) {
        knurl_device_info older;
        memset(&older, 0x77, sizeof older);
        older.struct_size = size;
        const size_t room = size - offsetof(knurl_device_info, name);
        assert_int_equal(knurl_device_get_info(device, &older), KNURL_OK);
        assert_non_null(memchr(older.name, '\0', room));
        assert_memory_equal(older.name, full.name, strlen(older.name));
    }
}

TEST(an_invalid_update_rate_is_refused) {
    static const double rates[] = {0.0, -1.0, 1e9, 0.5, NAN, HUGE_VAL};
    SCOPED_DEVICE *device = open_device("fake");
    for (size_t i = 0; i < COUNT_OF(rates); i++) {
        char nothing = 0;
        CHECK_REFUSED(knurl_device_start(device, rates[i]), KNURL_ERROR_ARGUMENT, nothing);
    }
}

/* --- forces --- */

TEST(a_force_shows_after_the_tick_and_its_delay) {
    for (int delay = 0; delay <= 16; delay++) {
        char uri[200];
        (void)snprintf(uri, sizeof uri, FREE "&delay=%d", delay);
        SCOPED_DEVICE *device = open_device(uri);
        stand(device);
        for (int tick = 0; tick < 40; tick++) {
            const double x = read_one(device).position[0];
            assert_int_equal(x > 0.0, tick > 10 + delay);
            write_x(device, tick == 10 ? 1.0 : 0.0);
        }
    }
}

TEST(a_force_is_shortened_to_the_limit_and_keeps_its_direction) {
    static const double far_too_much[3] = {30.0, 0.0, -40.0};
    SCOPED_DEVICE *device = open_device(FREE "&max_force=2&delay=0&width=1&depth=1");
    stand(device);
    for (int tick = 0; tick < 100; tick++) {
        (void)read_one(device);
        assert_int_equal(knurl_device_write(device, far_too_much), KNURL_OK);
    }
    const knurl_device_sample sample = read_one(device);
    CHECK_CLOSE(sample.position[0], 0.5 * 1.2 / 0.05 * 0.01, 24.0 * 0.1 / RATE);
    CHECK_CLOSE(sample.position[2] / sample.position[0], -1.6 / 1.2, 1e-12);
}

TEST(a_force_that_is_not_finite_does_not_move_the_hand) {
    static const double bad[][3] = {{NAN, 0, 0}, {1, NAN, 1}, {HUGE_VAL, 0, 0}, {0, -HUGE_VAL, 0}, {1, 1, HUGE_VAL}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        SCOPED_DEVICE *device = open_device(FREE "&delay=0");
        stand(device);
        const knurl_device_sample before = read_one(device);
        for (int tick = 0; tick < 10; tick++) {
            assert_int_equal(knurl_device_write(device, bad[i]), KNURL_OK);
            assert_memory_equal(read_one(device).position, before.position, sizeof before.position);
        }
    }
}

TEST(while_halted_a_force_counts_nothing_until_it_is_released) {
    SCOPED_DEVICE *device = open_device(FREE "&delay=0");
    stand(device);
    assert_int_equal(knurl_port_is_halted(device), 0);
    knurl_device_halt(device);
    knurl_device_halt(device);
    assert_int_equal(knurl_port_is_halted(device), 1);
    for (int tick = 0; tick < 50; tick++) {
        CHECK_SAME(read_one(device).position[0], 0.0L);
        write_x(device, 1.0);
    }
    knurl_port_release_halt(device);
    assert_int_equal(knurl_port_is_halted(device), 0);
    CHECK_SAME(read_one(device).position[0], 0.0L); /* forces written during the halt are dropped */
    write_x(device, 1.0);
    assert_true(read_one(device).position[0] > 0.0);
}

TEST(a_start_ends_a_halt) {
    SCOPED_DEVICE *device = open_device(FREE "&delay=0");
    knurl_device_halt(device);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    (void)read_one(device);
    write_x(device, 1.0);
    assert_true(read_one(device).position[0] > 0.0);
}

/* Immediately and independently of the haptic thread: also the present force and one in transit, without further
 * writes. */
TEST(a_halt_zeroes_the_force_at_once) {
    for (int delay = 0; delay <= 3; delay++) {
        char uri[200];
        (void)snprintf(uri, sizeof uri, FREE "&delay=%d", delay);
        SCOPED_DEVICE *device = open_device(uri);
        stand(device);
        for (int tick = 0; tick < 20; tick++) {
            (void)read_one(device);
            write_x(device, 1.0);
        }
        const double before = read_one(device).position[0];
        knurl_device_halt(device);
        const double step = read_one(device).position[0] - before;
        double last = before + step;
        for (int tick = 0; tick < 50; tick++) { /* no force: it drifts on at the speed it has */
            const double now = read_one(device).position[0];
            CHECK_CLOSE(now - last, step, 1e-12);
            last = now;
        }
    }
}

TEST(a_lost_device_says_so_when_read_and_when_written_until_it_is_started_again) {
    static const double force[3] = {1.0, 0.0, 0.0};
    SCOPED_DEVICE *device = open_device("fake:?lose_at=0.1");
    for (int turn = 0; turn < 2; turn++) {
        assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
        for (int tick = 0; tick < 100; tick++) { /* 0 to 0.099 s */
            (void)read_one(device);
            assert_true(tick == 99 || knurl_device_write(device, force) == KNURL_OK);
        }
        for (int tick = 0; tick < 10; tick++) {
            knurl_device_sample sample;
            memset(&sample, 0x11, sizeof sample);
            const knurl_device_sample before = sample;
            (void)knurl_fail(KNURL_ERROR_IO, "an older sentence");
            assert_int_equal(knurl_device_read(device, &sample), KNURL_ERROR_DEVICE_LOST);
            assert_string_equal(knurl_error_message(), knurl_result_string(KNURL_ERROR_DEVICE_LOST));
            assert_memory_equal(&sample, &before, sizeof sample);
            assert_int_equal(knurl_device_write(device, force), KNURL_ERROR_DEVICE_LOST);
        }
    }
}

TEST(a_press_of_its_button_lasts_a_tenth_of_a_second_and_is_told_by_the_status) {
    SCOPED_DEVICE *device = open_device("fake:?press_at=0.0505");
    assert_int_equal(knurl_device_start(device, RATE), KNURL_OK);
    for (int tick = 0; tick < 300; tick++) {
        const uint32_t pressed = tick > 50 && tick <= 150;
        assert_int_equal(read_one(device).buttons, pressed);
        const knurl_device_status status = device_status(device);
        assert_int_equal(status.buttons, pressed);
    }
}

/* --- the plant behind the device --- */

TEST(a_constant_force_holds_the_hand_off_its_target_by_force_over_stiffness) {
    static const double force[3] = {0.7, 1.4, -0.35};
    SCOPED_DEVICE *device = open_device("fake:?coulomb=0&tremor=0&resolution=0&hand_stiffness=700");
    stand(device);
    knurl_device_sample sample = read_one(device);
    for (int tick = 0; tick < 3000; tick++) {
        assert_int_equal(knurl_device_write(device, force), KNURL_OK);
        sample = read_one(device);
    }
    CHECK_CLOSE(sample.position[0], 0.001, 1e-12);
    CHECK_CLOSE(sample.position[1], -0.001 + 0.002, 1e-12); /* the target is 1 mm below */
    CHECK_CLOSE(sample.position[2], -0.0005, 1e-12);
    assert_int_equal(sample.buttons, 0);
    for (size_t i = 0; i < COUNT_OF(sample.reserved); i++) {
        assert_int_equal(sample.reserved[i], 0);
    }
}

TEST(positions_are_multiples_of_the_resolution) {
    static const struct {
        const char *uri;
        double resolution;
    } devices[] = {{"fake", 0.055e-3}, {"fake:?resolution=0.001", 0.001}, {"fake:?resolution=1e-6", 1e-6}};
    for (size_t i = 0; i < COUNT_OF(devices); i++) {
        SCOPED_DEVICE *device = open_device(devices[i].uri);
        for (int tick = 0; tick < 2000; tick++) {
            const knurl_device_sample sample = read_one(device);
            for (int axis = 0; axis < 3; axis++) {
                const double counts = sample.position[axis] / devices[i].resolution;
                CHECK_CLOSE(counts, round(counts), 1e-7);
            }
        }
    }
}
