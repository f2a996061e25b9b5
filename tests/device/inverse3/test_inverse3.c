/* The driver of the Inverse3 over a simulated service: axes, forces, orientation, faults, ends.
 * SPDX-License-Identifier: MIT */
#include "device/inverse3/inverse3_double.h"
#include "device/inverse3/service.h"
#include "device/ticked.h"

#include "device/port.h"

#include <knurl/device.h>

static void open_released(const char *options) {
    (void)close_device(NULL);
    device = inverse3_double_open(options);
    run_released();
}

static void check_open_refused(const char *options, knurl_result code, const char *words) {
    CHECK_REFUSED(knurl_inverse3_open(options, inverse3_double_service(), &device), code, device);
    check_message(words);
}

static int has_event(int32_t code) {
    knurl_device_event event;
    int has = 0;
    while (knurl_device_next_event(device, &event)) {
        has |= event.code == code;
    }
    return has;
}

/* Against a hand of 700 N/m; friction may hold up to 0.3 N more or less. */
TEST_WITH(a_force_moves_the_grip_where_it_points, NULL, close_device) {
    for (int axis = 0; axis < 3; axis++) {
        double force[3] = {0.0, 0.0, 0.0};
        open_released("");
        force[axis] = 2.0;
        assert_int_equal(run(1100, force), KNURL_OK);
        CHECK_CLOSE(latest.position[axis], 2.0 / 700.0, 0.3 / 700.0 + 0.00002);
        CHECK_CLOSE(latest.position[(axis + 1) % 3], 0.0, 0.00002);
        assert_int_equal(latest.buttons, 1); /* from its first second on */
        CHECK_CLOSE(latest.orientation[1], 0.7071067811865476, 1e-15);
        CHECK_CLOSE(latest.orientation[3], 0.7071067811865476, 1e-15);
        (void)close_device(NULL);
        assert_true(inverse3_double_sim()->limp_since >= 0.0);
        assert_int_equal(inverse3_double_connections(), 0);
    }
}

TEST_WITH(every_kind_of_grip_gives_orientation_and_buttons, NULL, close_device) {
    static const struct {
        int grip;
        uint32_t buttons;
        double turned;
    } cases[] = {{INVERSE3_SIM_WIRELESS, 1, 0.7071067811865476},
                 {INVERSE3_SIM_WIRED, 1, 0.7071067811865476},
                 {INVERSE3_SIM_CUSTOM, 1, 0.7071067811865476},
                 {INVERSE3_SIM_NO_GRIP, 0, 0.0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        open_released("");
        inverse3_double_take()->grip = cases[i].grip;
        inverse3_double_give_back();
        assert_int_equal(run(1100, none), KNURL_OK); /* pressed from its first second on */
        assert_int_equal(latest.buttons, cases[i].buttons);
        CHECK_CLOSE(latest.orientation[1], cases[i].turned, 1e-15);
        CHECK_CLOSE(latest.orientation[3], cases[i].turned, 1e-15);
    }
}

/* Degrees, as the service has them: -30.927332, 53.878685, -6.642623. */
TEST_WITH(the_joints_angles_are_told_in_radians, NULL, close_device) {
    open_released("");
    assert_int_equal(run(20, none), KNURL_OK);
    assert_int_equal(latest.joint_count, 3);
    CHECK_CLOSE(latest.joints[0], -30.927332 / 57.29577951308232, 1e-12);
    CHECK_CLOSE(latest.joints[2], -6.642623 / 57.29577951308232, 1e-12);
}

TEST_WITH(a_grips_battery_is_in_the_status_and_an_event_once_it_is_almost_empty, NULL, close_device) {
    knurl_device_event event;
    open_released("");
    assert_int_equal(run(20, none), KNURL_OK);
    CHECK_CLOSE(device_status(device).battery, 1.0, 1e-15);
    while (knurl_device_next_event(device, &event)) {}
    for (int k = 0; k < 2; k++) {
        inverse3_double_take()->discharged = k ? 0.875 : 0.75;
        inverse3_double_give_back();
        assert_int_equal(run(20, none), KNURL_OK);
        CHECK_CLOSE(device_status(device).battery, k ? 0.125 : 0.25, 1e-15);
        assert_int_equal(knurl_device_next_event(device, &event), k);
    }
    assert_int_equal(event.code, KNURL_FAULT_BATTERY);
    CHECK_CLOSE(event.value, 0.125, 1e-15);
    assert_int_equal(run(20, none), KNURL_OK);
    assert_int_equal(knurl_device_next_event(device, &event), 0);
}

TEST_WITH(another_devices_grip_is_not_this_ones, NULL, close_device) {
    open_released("?grip=1402");
    assert_int_equal(run(1100, none), KNURL_OK); /* 61576 is pressed from its first second on */
    assert_int_equal(latest.buttons, 0);
    CHECK_SAME(latest.orientation[3], 0.0L);
    inverse3_double_take()->grip = INVERSE3_SIM_CUSTOM;
    inverse3_double_give_back();
    assert_int_equal(run(20, none), KNURL_OK);
    assert_int_equal(latest.buttons, 1);
}

TEST_WITH(gravity_compensation_is_switched_by_the_uri_and_otherwise_left_alone, NULL, close_device) {
    static const char *const options[] = {"", "?gravity=1", "?gravity=0"};
    static const int expected[] = {0, 1, -1};
    for (size_t i = 0; i < COUNT_OF(options); i++) {
        open_released(options[i]);
        assert_int_equal(inverse3_double_sim()->gravity, expected[i]);
    }
}

/* The maker's tutorial 06: a sphere of 0.1 m, of a Minverse 0.04 m. Nothing is published of a Minverse's force. */
TEST_WITH(each_type_has_its_own_name_workspace_and_force_and_others_are_refused, NULL, close_device) {
    static const struct {
        const char *type, *name;
        double radius, max_force;
    } cases[] = {{"inverse3", "Haply Inverse3", 0.1, 4.0},
                 {"inverse3x", "Haply Inverse3x", 0.1, 4.0},
                 {"minverse", "Haply Minverse", 0.04, 1.0}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const double force[3] = {0.0, 100.0, 0.0};
        inverse3_double_begin();
        inverse3_double_sim()->type = cases[i].type;
        assert_int_equal(knurl_inverse3_open("", inverse3_double_service(), &device), KNURL_OK);
        const knurl_device_info info = device_info(device);
        assert_memory_equal(info.name, cases[i].name, strlen(cases[i].name));
        CHECK_CLOSE(info.workspace_max[1], cases[i].radius / sqrt(3.0), 1e-12);
        CHECK_SAME(info.max_force, cases[i].max_force);
        run_released();
        (void)run(10, force);
        CHECK_CLOSE(inverse3_double_sim()->force[2], cases[i].max_force, 1e-12);
        (void)close_device(NULL);
    }
    inverse3_double_begin();
    inverse3_double_sim()->type = "inverse9";
    check_open_refused("", KNURL_ERROR_UNSUPPORTED, "expected an inverse3, inverse3x or minverse, found 'inverse9'");
}

/* The service's filter pipeline: viscous damping is set for the session, its oscillation damper cannot be, and the
 * force gate's gain has no published meaning: it is kept, and shown in the device's name. */
TEST_WITH(the_sessions_damping_is_off_and_the_force_gate_is_reported, NULL, close_device) {
    open_released("");
    CHECK_SAME(inverse3_double_sim()->damping, 0.0);
    const knurl_device_info info = device_info(device);
    assert_string_equal(info.name, "Haply Inverse3 (force gate 0.3)");
    inverse3_double.inject(DOUBLE_UNPLUG);
    (void)run(100, none);
    inverse3_double.inject(DOUBLE_WELL);
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK); /* a session of its own */
    CHECK_SAME(inverse3_double_sim()->damping, 0.0);
}

/* The data sheet's figures; the workspace is the cube in the sphere that the maker's tutorial 06 keeps within. */
TEST_WITH(forces_are_no_stronger_than_it_can_play, NULL, close_device) {
    const double force[3] = {0.0, 100.0, 0.0};
    open_released("");
    (void)run(10, force);
    CHECK_CLOSE(inverse3_double_sim()->force[2], 4.0, 1e-12); /* up in Knurl is the service's z */
    const knurl_device_info info = device_info(device);
    CHECK_SAME(info.max_force, 4.0);
    CHECK_SAME(info.max_stiffness, 1000.0);
    CHECK_SAME(info.resolution, 0.00001);
    CHECK_CLOSE(info.workspace_max[0], 0.1 / sqrt(3.0), 1e-12);
}

TEST_WITH(of_two_devices_the_one_that_is_named_is_moved_and_read, NULL, close_device) {
    static const double force[3] = {0.0, 1.0, 0.0};
    inverse3_double_begin();
    inverse3_double_sim()->has_second = 1;
    assert_int_equal(knurl_inverse3_open("049D", inverse3_double_service(), &device), KNURL_OK);
    run_released();
    assert_int_equal(run(500, force), KNURL_OK);
    CHECK_CLOSE(latest.position[0], 0.0, 0.00002); /* the other one is at 0.05 */
    CHECK_SAME(inverse3_double_sim()->force[2], 1.0);
    CHECK_SAME(inverse3_double_sim()->force_of_second[2], 0.0);
}

TEST_WITH(a_failed_open_gives_the_reason, NULL, close_device) {
    inverse3_double_begin();
    check_open_refused("1234", KNURL_ERROR_DEVICE_LOST, "no Inverse3 '1234', only '049D'");
    check_open_refused("a_name_that_is_too_long", KNURL_ERROR_ARGUMENT, "a_name_that_is_too_long");
    check_open_refused("?port=0", KNURL_ERROR_ARGUMENT, "");
    check_open_refused("?port=1e9", KNURL_ERROR_ARGUMENT, "");
    check_open_refused("?host=example.org", KNURL_ERROR_ARGUMENT, "expected port=");
    inverse3_double_sim()->is_old = 1;
    check_open_refused("", KNURL_ERROR_UNSUPPORTED, "3.5 or newer");
    inverse3_double_sim()->is_gone = 1;
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "lists no Inverse3: plug it in");
    inverse3_double_say("[]", 2);
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "");
    inverse3_double_say("hello", 5);
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "is not the Haply Inverse Service");
    inverse3_double.inject(DOUBLE_MUTE);
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "found nothing");
    inverse3_double_end_service(1);
    check_open_refused("", KNURL_ERROR_DEVICE_LOST, "does not answer at localhost:10001 (conn fail: 111)");
    assert_int_equal(inverse3_double_connections(), 0);
}

TEST(its_devices_are_listed_by_id_or_the_reason_is_given) {
    knurl_device_listing found[4];
    knurl_listings listings = {found, 4, 0};
    inverse3_double_begin();
    inverse3_double_sim()->has_second = 1;
    knurl_inverse3_list(inverse3_double_service(), &listings);
    assert_int_equal(listings.count, 2);
    assert_string_equal(found[0].uri, "inverse3:0A11");
    assert_string_equal(found[1].uri, "inverse3:049D");
    assert_string_equal(found[1].reason, "");
    inverse3_double_sim()->has_second = 0;
    inverse3_double_sim()->is_gone = 1;
    knurl_inverse3_list(inverse3_double_service(), &listings);
    assert_non_null(strstr(found[2].reason, "not connected: plug it in"));
    inverse3_double_end_service(1);
    knurl_inverse3_list(inverse3_double_service(), &listings);
    assert_int_equal(strncmp(found[3].reason, "the Haply Inverse Service does not answer", 41), 0);
    assert_int_equal(listings.count, 4);
    inverse3_double_begin();
    inverse3_double_sim()->is_unpowered = 1;
    inverse3_double_sim()->type = "minverse";
    listings.count = 0;
    knurl_inverse3_list(inverse3_double_service(), &listings);
    assert_string_equal(found[0].name, "Haply Minverse");
    assert_non_null(strstr(found[0].reason, "its power supply is unplugged"));
    inverse3_double_sim()->is_unpowered = 0;
    inverse3_double_sim()->is_not_ready = 1;
    knurl_inverse3_list(inverse3_double_service(), &listings);
    assert_non_null(strstr(found[1].reason, "not ready"));
    assert_int_equal(inverse3_double_connections(), 0);
}

static void check_lost_and_had_back(void (*lose)(void), void (*mend)(void)) {
    static const double force[3] = {0.0, 1.0, 0.0};
    open_released("");
    (void)run(50, force);
    lose();
    assert_int_equal(run(20, force), KNURL_ERROR_DEVICE_LOST);
    assert_int_equal(knurl_port_is_halted(device), 1);
    assert_true(has_event(KNURL_FAULT_LOST));
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_ERROR_DEVICE_LOST);
    mend();
    assert_int_equal(knurl_device_start(device, 1000.0), KNURL_OK);
    assert_int_equal(run(50, force), KNURL_OK);
    CHECK_SAME(inverse3_double_sim()->force[2], 0.0); /* zero until the halt is released */
    CHECK_CLOSE(latest.position[0], 0.0, 0.001);      /* positions count from the middle again */
    (void)close_device(NULL);
    assert_int_equal(inverse3_double_connections(), 0);
}

static void unplug(void) {
    inverse3_double.inject(DOUBLE_UNPLUG);
}

static void plug_in(void) {
    inverse3_double.inject(DOUBLE_WELL);
}

static void end_service(void) {
    inverse3_double_end_service(1);
}

static void begin_service(void) {
    const double limp[3] = {0.0, 0.0, 0.0};
    memcpy(inverse3_double_sim()->force, limp, sizeof limp); /* restart it */
    inverse3_double_end_service(0);
}

TEST_WITH(a_pulled_cable_is_a_loss_and_the_device_is_had_back, NULL, close_device) {
    check_lost_and_had_back(unplug, plug_in);
}

TEST_WITH(a_service_that_ends_is_a_loss_and_the_device_is_had_back, NULL, close_device) {
    check_lost_and_had_back(end_service, begin_service);
}

/* An answer without a position, one that is too long (size 0), other JSON. */
TEST_WITH(an_invalid_answer_zeroes_the_force_and_is_counted, NULL, close_device) {
    static const struct {
        const char *text;
        size_t size;
    } answers[] = {{"", 0}, {"{\"inverse3\":[{\"device_id\":\"049D\"}]}", 36}, {"null", 4}, {"\377\376\375", 3}};
    static const double force[3] = {0.0, 1.0, 0.0};
    for (size_t i = 0; i < COUNT_OF(answers); i++) {
        open_released("");
        (void)run(50, force);
        CHECK_SAME(inverse3_double_sim()->force[2], 1.0);
        inverse3_double_say(answers[i].text, answers[i].size);
        (void)run(5, force);
        CHECK_SAME(inverse3_double_sim()->force[2], 0.0);
        assert_true(has_event(KNURL_FAULT_CORRUPT));
        assert_int_equal(run(20, force), KNURL_ERROR_DEVICE_NOT_READY);
        const knurl_device_status status = device_status(device);
        assert_true(status.bad_bytes >= answers[i].size);
        inverse3_double_say(NULL, 0);
        assert_int_equal(run(20, force), KNURL_OK);
    }
}

/* One answer per message, in order: answers to earlier messages are not present positions. */
TEST_WITH(answers_that_stay_behind_are_no_positions, NULL, close_device) {
    static const double force[3] = {0.0, 1.0, 0.0};
    open_released("");
    (void)run(50, force);
    inverse3_double.inject(DOUBLE_LATE);
    (void)run(200, force);
    assert_int_equal(run(1, force), KNURL_ERROR_DEVICE_NOT_READY);
    assert_true(has_event(KNURL_FAULT_SILENT));
    CHECK_SAME(inverse3_double_sim()->force[2], 0.0);
    inverse3_double.inject(DOUBLE_WELL);
    assert_int_equal(run(50, none), KNURL_OK);
}
