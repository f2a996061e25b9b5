/* Messages of the Haply Inverse Service: accepted, refused and written ones. SPDX-License-Identifier: MIT
 */
#include "device/inverse3/inverse3_sim.h"
#include "device/inverse3/message.h"
#include "support/close.h"

#include <stdio.h>

static inverse3_sim sim;
static char text[INVERSE3_SIM_ROOM];
static knurl_inverse3_state heard;

static int read_text(const char *message) {
    return knurl_inverse3_read(message, strlen(message), &heard);
}

/* From https://docs.haply.co/inverseSDK/service/realtime/websocket-protocol has it. */
TEST(the_documented_first_message_is_read) {
    inverse3_sim_init(&sim, 0.0, 0);
    (void)inverse3_sim_greet(&sim, 0.0, text);
    assert_int_equal(read_text(text), 1);
    const knurl_inverse3_entry *entry = knurl_inverse3_find(&heard, "");
    assert_non_null(entry);
    assert_string_equal(entry->id, "049D");
    assert_int_equal(entry->has_preset, 1);
    assert_int_equal(entry->has_position, 1);
    assert_int_equal(entry->is_uncalibrated, 0);
    assert_string_equal(entry->type, "inverse3");
    CHECK_SAME(entry->position[0], 0.0);
    CHECK_CLOSE(entry->position[1], -0.12, 1e-15);
    CHECK_CLOSE(entry->position[2], 0.15, 1e-15);
}

/* One that was recorded from service 3.4.8, with wired handle: SofaHaplyRobotics, Haply_Inverse3Controller.cpp. */
TEST(a_recorded_message_is_read) {
    static const char recorded[] =
        "{\"inverse3\":[{\"device_id\":\"04EA\",\"state\":{\"angular_position\":{\"a0\":-30.927332,\"a1\":53.878685,"
        "\"a2\":-6.642623},\"body_orientation\":{\"w\":0.69885254,\"x\":0.0014648438,\"y\":0.715271,\"z\":0.0024414062}"
        ",\"control_domain\":\"undefined\",\"control_mode\":\"idle\",\"cursor_position\":{\"x\":0.10428079,"
        "\"y\":-0.03648221,\"z\":-0.06100729},\"cursor_velocity\":{\"x\":0,\"y\":0,\"z\":0},\"mode\":\"idle\"},"
        "\"status\":{\"calibrated\":true,\"in_use\":false,\"power_supply\":true,\"ready\":true,\"started\":true}}],"
        "\"verse_grip\":[{\"device_id\":\"61576\",\"state\":{\"button\":true,\"hall\":1,\"orientation\":{"
        "\"w\":0.71655273,\"x\":0.19647217,\"y\":0.6290283,\"z\":-0.22833252}}}]}";
    knurl_inverse3_grip grip;
    const double *q = grip.orientation;
    assert_int_equal(read_text(recorded), 1);
    const knurl_inverse3_entry *entry = knurl_inverse3_find(&heard, "04EA");
    assert_non_null(entry);
    CHECK_SAME(entry->position[0], 0.10428079);
    CHECK_SAME(entry->position[1], -0.03648221);
    CHECK_SAME(entry->position[2], -0.06100729);
    assert_int_equal(entry->has_preset, 0);
    knurl_inverse3_find_grip(&heard, "", &grip);
    assert_int_equal(grip.buttons, 1);
    CHECK_CLOSE(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-15);
    CHECK_CLOSE(q[2], -0.6290283, 1e-3); /* the service's y points away from the user, Knurl's z towards */
}

TEST(a_number_of_17_digits_is_read_to_15) {
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"0.10428079217672348", 0.104280792176723},
                 {"0.00014000000000000001", 0.00014},
                 {"-1.2345678901234567e-05", -1.23456789012345e-05},
                 {"6.9388939039072284e-08", 6.93889390390722e-08},
                 {"6.9388939039072284e-18", 0.0},
                 {"1e-300", 0.0},
                 {"-0.0", 0.0},
                 {"7", 7.0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        (void)snprintf(
            text, sizeof text,
            "{\"inverse3\":[{\"device_id\":\"A\",\"state\":{\"cursor_position\":{\"x\":%s,\"y\":0,\"z\":0}}}]}",
            cases[i].text);
        assert_int_equal(read_text(text), 1);
        assert_int_equal(heard.entries[0].has_position, 1);
        CHECK_CLOSE(heard.entries[0].position[0], cases[i].value, 2e-16 * fabs(cases[i].value));
    }
}

TEST(a_message_that_is_no_json_object_is_refused) {
    static const char *const bad[] = {"",
                                      "hello",
                                      "7",
                                      "null",
                                      "[]",
                                      "{",
                                      "}",
                                      "{\"inverse3\":[{\"device_id\":\"049D\"}]",
                                      "{\"inverse3\":[{\"device_id\":\"049D\"}]}}",
                                      "{\"inverse3\":[}]",
                                      "{}{}"};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        if (read_text(bad[i])) {
            fail_msg("taken: %s", bad[i]);
        }
    }
    assert_int_equal(read_text("{}"), 1); /* of no device, but a message */
    assert_null(knurl_inverse3_find(&heard, ""));
}

TEST(a_device_without_a_valid_id_is_ignored) {
    static const char *const ids[] = {"17",           "\"\"",   "null", "{}", "\"one of more than fifteen letters\"",
                                      "\"4\\\"}]}\"", "\"a b\""};
    for (size_t i = 0; i < COUNT_OF(ids); i++) {
        (void)snprintf(text, sizeof text, "{\"inverse3\":[{\"device_id\":%s}]}", ids[i]);
        assert_int_equal(read_text(text), 1);
        assert_null(knurl_inverse3_find(&heard, ""));
    }
}

TEST(an_invalid_position_is_reported) {
    static const char *const values[] = {"nan",
                                         "1e999",
                                         "\"0\"",
                                         "null",
                                         "true",
                                         "{\"x\":1}",
                                         "[1]",
                                         "-",
                                         "1e",
                                         "0x12",
                                         "100000000000000000000000000000000000000000"};
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        (void)snprintf(
            text, sizeof text,
            "{\"inverse3\":[{\"device_id\":\"A\",\"state\":{\"cursor_position\":{\"y\":0,\"x\":%s,\"z\":0}}}]}",
            values[i]);
        if (read_text(text) && heard.entries[0].has_position) {
            fail_msg("taken: %s", values[i]);
        }
    }
}

TEST(of_its_status_only_true_is_true_and_what_is_missing_is_fine) {
    static const struct {
        const char *text;
        uint32_t is_unpowered, is_uncalibrated, is_not_ready;
    } cases[] = {{"\"calibrated\":true,\"power_supply\":true,\"ready\":true", 0, 0, 0},
                 {"\"started\":true", 0, 0, 0},
                 {"\"calibrated\":false", 0, 1, 0},
                 {"\"calibrated\":1", 0, 1, 0},
                 {"\"power_supply\":false,\"calibrated\":true", 1, 0, 0},
                 {"\"power_supply\":null", 1, 0, 0},
                 {"\"ready\":false", 0, 0, 1},
                 {"\"ready\":\"true\"", 0, 0, 1}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        (void)snprintf(text, sizeof text, "{\"inverse3\":[{\"status\":{%s},\"device_id\":\"A\"}]}", cases[i].text);
        assert_int_equal(read_text(text), 1);
        assert_int_equal(heard.entries[0].is_unpowered, cases[i].is_unpowered);
        assert_int_equal(heard.entries[0].is_uncalibrated, cases[i].is_uncalibrated);
        assert_int_equal(heard.entries[0].is_not_ready, cases[i].is_not_ready);
    }
}

/* As the maker's own client has it from a service 3.5 with one grip of a customer's, which is listed as a wireless one
 * as well: the crate haply 1.3.1, unit_tests.rs (shortened). */
TEST(a_message_with_a_custom_grip_is_read) {
    static const char recorded[] =
        "{\"inverse3\":[{\"device_id\":\"04BA\",\"config\":{\"type\":\"inverse3\",\"device_info\":{\"device_type\":4},"
        "\"preset\":\"defaults\",\"mount\":{},\"filters\":{\"force_gate\":{\"gain\":0.3},\"damping\":{\"scalar\":-1}}},"
        "\"state\":{\"cursor_position\":{\"x\":0.020575874,\"y\":-0.02761598,\"z\":0.19947645},\"transform\":{}},"
        "\"status\":{\"calibrated\":true,\"in_use\":false,\"power_supply\":true,\"ready\":true,\"started\":true}}],"
        "\"verse_grip\":[],\"wireless_verse_grip\":[{\"device_id\":\"1402\",\"state\":{\"buttons\":{\"down\":false}},"
        "\"status\":{\"awake\":true}}],\"custom_verse_grip\":[{\"device_id\":\"1402\",\"state\":{\"buttons\":{\"a\":true,"
        "\"b\":false,\"c\":true},\"hall\":15,\"orientation\":{\"x\":0.47711182,\"y\":0.431427,\"z\":-0.5709839,"
        "\"w\":0.50668335},\"extension_data\":[0,3,65]},\"status\":{\"connected\":true}}]}";
    knurl_inverse3_grip grip;
    const double *q = grip.orientation;
    assert_int_equal(read_text(recorded), 1);
    const knurl_inverse3_entry *entry = knurl_inverse3_find(&heard, "04BA");
    assert_non_null(entry);
    assert_string_equal(entry->type, "inverse3");
    CHECK_SAME(entry->force_gate, 0.3);
    assert_int_equal(entry->is_unpowered | entry->is_uncalibrated | entry->is_not_ready, 0);
    knurl_inverse3_find_grip(&heard, "", &grip);
    assert_int_equal(grip.buttons, 5);
    CHECK_CLOSE(q[0], 0.47711182, 1e-3);
    CHECK_CLOSE(q[1], -0.5709839, 1e-3); /* the service's z points up, as Knurl's y */
    CHECK_CLOSE(q[3], 0.50668335, 1e-3);
}

/* Every cut and a thousand changes of single bytes: refused, or read as finite numbers. */
TEST(a_message_that_is_cut_or_changed_anywhere_does_no_harm) {
    uint64_t random = 88172645463325252u;
    inverse3_sim_init(&sim, 0.0, 0);
    const int length = inverse3_sim_greet(&sim, 0.0, text);
    for (int i = 0; i < length; i++) {
        assert_int_equal(knurl_inverse3_read(text, (size_t)i, &heard), 0);
    }
    for (int i = 0; i < 1000; i++) {
        const size_t at = (size_t)(random_bits(&random) % (uint64_t)length);
        const char was = text[at];
        text[at] = (char)random_bits(&random);
        if (knurl_inverse3_read(text, (size_t)length, &heard)) {
            for (int k = 0; k < KNURL_INVERSE3_DEVICES; k++) {
                assert_true(isfinite(heard.entries[k].position[0]) && isfinite(heard.entries[k].position[1]));
                assert_non_null(memchr(heard.entries[k].id, '\0', KNURL_INVERSE3_ID_ROOM));
            }
        }
        text[at] = was;
    }
}

TEST(more_devices_than_there_is_room_for_are_left_out) {
    size_t used = (size_t)snprintf(text, sizeof text, "{\"inverse3\":[");
    for (int i = 0; i < 40; i++) {
        used += (size_t)snprintf(text + used, sizeof text - used, "%s{\"device_id\":\"%d\"}", i ? "," : "", i);
    }
    (void)snprintf(text + used, sizeof text - used, "]}");
    assert_int_equal(read_text(text), 1);
    assert_non_null(knurl_inverse3_find(&heard, "7"));
    assert_null(knurl_inverse3_find(&heard, "8"));
}

/* A turn by 90 degrees about the vertical, and one about the right: Knurl's y and x. */
TEST(orientations_are_turned_into_knurls_axes) {
    static const double half = 0.7071067811865476;
    knurl_inverse3_grip grip;
    memset(&heard, 0, sizeof heard);
    heard.grip_count = 2;
    heard.grips[0].orientation[2] = heard.grips[0].orientation[3] = half;
    knurl_inverse3_find_grip(&heard, "", &grip);
    CHECK_CLOSE(grip.orientation[1], half, 1e-15);
    CHECK_CLOSE(grip.orientation[3], half, 1e-15);
    memset(heard.grips, 0, sizeof heard.grips);
    heard.grips[1].orientation[0] = heard.grips[1].orientation[3] = half;
    knurl_inverse3_find_grip(&heard, "", &grip);
    CHECK_CLOSE(grip.orientation[0], half, 1e-15);
    heard.grips[1].orientation[3] = 0.0; /* no unit quaternion */
    knurl_inverse3_find_grip(&heard, "", &grip);
    CHECK_SAME(grip.orientation[0], 0.0);
}

/* Two devices with a wireless grip each; the second one's is a customer's, which is listed twice. */
TEST(a_grip_is_found_by_its_id_and_its_two_entries_are_one) {
    static const char two[] =
        "{\"wireless_verse_grip\":[{\"device_id\":\"61576\",\"state\":{\"orientation\":{\"w\":1,\"x\":0,\"y\":0,\"z\":0},"
        "\"buttons\":{\"a\":true},\"battery_level\":0.5}},{\"device_id\":\"1402\",\"state\":{\"buttons\":{\"b\":true}}}],"
        "\"custom_verse_grip\":[{\"device_id\":\"1402\",\"state\":{\"orientation\":{\"w\":0,\"x\":1,\"y\":0,\"z\":0},"
        "\"buttons\":{\"c\":true},\"battery_level\":0.25}},{\"device_id\":\"9\",\"state\":{\"battery_level\":7}}]}";
    knurl_inverse3_grip grip;
    assert_int_equal(read_text(two), 1);
    knurl_inverse3_find_grip(&heard, "", &grip);
    assert_string_equal(grip.id, "61576");
    assert_int_equal(grip.buttons, 1);
    CHECK_SAME(grip.battery, 0.5L);
    knurl_inverse3_find_grip(&heard, "1402", &grip);
    assert_int_equal(grip.buttons, 6);
    CHECK_SAME(grip.battery, 0.25L);
    CHECK_SAME(grip.orientation[0], 1.0L);
    knurl_inverse3_find_grip(&heard, "9", &grip);
    CHECK_SAME(grip.battery, 0.0L); /* not a charge */
    knurl_inverse3_find_grip(&heard, "absent", &grip);
    assert_int_equal(grip.buttons, 0);
}

/* From https://docs.haply.co/inverseSDK/service/realtime/control-commands has it. */
TEST(a_force_is_written_as_documented_in_the_services_axes) {
    static const double force[3] = {0.25, 1.5, -0.0000012};
    char command[KNURL_INVERSE3_COMMAND];
    const size_t length = knurl_inverse3_command(command, "049D", force, "");
    assert_int_equal(length, strlen(command));
    assert_string_equal(command,
                        "{\"inverse3\":[{\"device_id\":\"049D\",\"commands\":{\"set_cursor_force\":{\"vector\":"
                        "{\"x\":0.250000,\"y\":0.000001,\"z\":1.500000}}}}]}");
}

TEST(the_longest_command_fits) {
    static const double force[3] = {-999.999999, -999.999999, 999.999999};
    char command[KNURL_INVERSE3_COMMAND];
    for (int i = 0; i < 3; i++) {
        static const char *const gravities[] = {"0", "1", ""};
        static const char *const expected[] = {
            ",\"gravity_compensation\":{\"enabled\":false}},\"commands\":",
            ",\"gravity_compensation\":{\"enabled\":true}},\"commands\":", "\"damping\":{\"scalar\":0}},\"commands\":"};
        const char *configuration = knurl_inverse3_configuration(gravities[i]);
        assert_true(knurl_inverse3_command(command, "0123456789abcde", force, configuration) < sizeof command);
        assert_non_null(strstr(command, "\"configure\":{\"preset\":{\"preset\":\"arm_front_centered\"},"
                                        "\"damping\":{\"scalar\":0}"));
        assert_non_null(strstr(command, expected[i]));
    }
}
