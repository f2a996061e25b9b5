/* Weighing a mass with a simulated Falcon whose true gain differs from the configured one. SPDX-License-Identifier: MIT
 */
#include "support/tool.h"

#include "device/driver.h"
#include "falcon_fake.h"
#include "weigh.h"

#include <math.h>

static falcon_fake fake;

/* A Falcon without a hand, at rest in the middle. */
static knurl_device *open_loose(double true_gain, const char *options) {
    knurl_device *device = NULL;
    falcon_fake_init(&fake, NULL);
    fake.sim.gain = true_gain;
    fake.sim.plant.config.hand_stiffness = fake.sim.plant.config.hand_damping = 0.0;
    memset(fake.sim.plant.position, 0, sizeof fake.sim.plant.position);
    fake.sim.weight = 0.3; /* its grip's own */
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    char all[64];
    (void)snprintf(all, sizeof all, "%s%cmotors_known=1", options, options[0] ? '&' : '?');
    if (knurl_falcon_open_on(&bus, all, &device)) {
        fail_msg("%s", knurl_error_message());
    }
    knurl_device_register(device);
    return device;
}

static void hang(double kilograms) {
    knurl_system_mutex_lock(&fake.lock);
    fake.sim.weight += 9.80665 * kilograms;
    knurl_system_mutex_unlock(&fake.lock);
}

TEST(the_gain_is_found_within_two_percent_in_spite_of_friction) {
    static const double gains[] = {0.53, 0.35, 0.45};
    const size_t count = SUITE_SANITIZED ? 1 : getenv("KNURL_LONG") ? COUNT_OF(gains) : 2; /* 4 s each */
    for (size_t i = 0; i < count; i++) {
        double height = (double)NAN;
        double empty = 0.0;
        double loaded = 0.0;
        knurl_device *device = open_loose(gains[i], "?gain=0.35");
        assert_int_equal(weigh(device, &height, &empty), KNURL_OK);
        hang(0.2);
        assert_int_equal(weigh(device, &height, &loaded), KNURL_OK);
        CHECK_CLOSE(weigh_gain(0.35, 0.2, loaded - empty), gains[i], 0.02 * gains[i]);
        knurl_device_close(device);
        falcon_fake_free(&fake);
    }
}

TEST(a_device_that_goes_away_gives_no_weight) {
    double height = (double)NAN;
    double newtons = 7.0;
    knurl_device *device = open_loose(0.35, "");
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    assert_int_equal(weigh(device, &height, &newtons), KNURL_ERROR_DEVICE_NOT_READY);
    CHECK_SAME(newtons, 7.0L);
    knurl_device_close(device);
    falcon_fake_free(&fake);
}

TEST(the_gain_that_was_written_is_taken_unless_the_uri_names_one) {
    knurl_device_info info;
    knurl_device *device = NULL;
    knurl_device_info_init(&info, sizeof info);
    write_text(tool_path("gain"), "0.412\n");
    assert_int_equal(setenv("KNURL_FALCON_GAIN", tool_path("gain"), 1), 0);
    device = open_loose(0.35, "");
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
    assert_string_equal(info.name, "Novint Falcon, gain 0.412");
    knurl_device_close(device);
    device = open_loose(0.35, "?gain=0.5");
    assert_int_equal(knurl_device_get_info(device, &info), KNURL_OK);
    assert_string_equal(info.name, "Novint Falcon, gain 0.5");
    knurl_device_close(device);
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    device = NULL;
    write_text(tool_path("gain"), "4.12\n");
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_ARGUMENT, device);
    check_message("found '4.12'");
    assert_int_equal(setenv("KNURL_FALCON_GAIN", "/nowhere/gain", 1), 0);
    CHECK_REFUSED(knurl_falcon_open_on(&bus, "", &device), KNURL_ERROR_IO, device);
    check_message("/nowhere/gain");
    assert_int_equal(unsetenv("KNURL_FALCON_GAIN"), 0);
    falcon_fake_free(&fake);
}

SUITE_FIXTURES(make_folder, remove_folder)
