/* Setting a Falcon up and loading its firmware, over a simulated one. SPDX-License-Identifier: MIT */
#include "support/tool.h"

#include "device/falcon/firmware.h"
#include "falcon_fake.h"
#include "falcon_image.h"

static uint8_t image[KNURL_FALCON_IMAGE_MOST + 2];
static falcon_fake fake;
static knurl_falcon_transport transport;

/* Writes an image of `size` bytes; returns their sum. */
static uint32_t write_image(size_t size) {
    const uint32_t sum = falcon_image_make(image, size);
    write_file(tool_path("image.bin"), image, size);
    return sum;
}

static int plug_in(void **state) {
    (void)state;
    falcon_fake_init(&fake, NULL);
    const knurl_falcon_bus bus = falcon_fake_bus(&fake);
    return bus.open(bus.user, &transport);
}

static int plug_out(void **state) {
    (void)state;
    transport.close(transport.self);
    falcon_fake_free(&fake);
    return 0;
}

/* A new device, which has no firmware and expects an image of that size and sum. */
static void plug_in_without(uint32_t size, uint32_t sum) {
    (void)plug_out(NULL);
    assert_int_equal(plug_in(NULL), KNURL_OK);
    falcon_sim_forget_firmware(&fake.sim, size, sum);
}

static void check_loads(void) {
    assert_int_equal(knurl_falcon_prepare(&transport, tool_path("image.bin")), KNURL_OK);
}

/* Fails with that code and a sentence that has all the words. */
static void check_fails(const char *path, knurl_result code, const char *words) {
    char nothing = 0;
    CHECK_REFUSED(knurl_falcon_prepare(&transport, path), code, nothing);
    check_message(words);
}

static void check_load_fails(knurl_result code, const char *words) {
    check_fails(tool_path("image.bin"), code, words);
}

TEST_WITH(a_device_with_firmware_needs_no_image, plug_in, plug_out) {
    assert_int_equal(knurl_falcon_prepare(&transport, ""), KNURL_OK);
    const falcon_sim sim = falcon_fake_look(&fake);
    assert_int_equal(sim.frames, 1);
    assert_int_equal(sim.motors[0] | sim.motors[1] | sim.motors[2], 0);
    assert_int_equal(sim.latency_ms, 1);
    assert_int_equal(sim.baud, 2);
}

TEST_WITH(a_device_without_firmware_is_given_the_image, plug_in, plug_out) {
    static const uint32_t sizes[] = {KNURL_FALCON_IMAGE_LEAST, 7440, 7442};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) { /* 7440: whole packets of 62 */
        plug_in_without(sizes[i], write_image(sizes[i]));
        fake.sim.deaf = (uint32_t)i; /* the boot loader hears a later call */
        check_loads();
        const falcon_sim sim = falcon_fake_look(&fake);
        assert_true(sim.has_firmware);
        assert_int_equal(sim.image_count, sizes[i]);
        assert_int_equal(sim.frames, 1);
    }
}

TEST_WITH(an_echo_may_come_in_pieces, plug_in, plug_out) {
    plug_in_without(2000, write_image(2000));
    fake.fault = DOUBLE_SPLIT;
    check_loads();
}

TEST_WITH(without_an_image_the_sentence_says_how_to_name_one, plug_in, plug_out) {
    plug_in_without(2000, 0);
    check_fails("", KNURL_ERROR_DEVICE_LOST, "falcon|firmware|?firmware=PATH|KNURL_FALCON_FIRMWARE");
}

TEST_WITH(an_image_that_cannot_be_had_is_named, plug_in, plug_out) {
    plug_in_without(2000, 0);
    check_fails("/nowhere/image.bin", KNURL_ERROR_IO, "/nowhere/image.bin|no such file");
    check_fails(tool_path(""), KNURL_ERROR_IO, tool_path(""));
    (void)write_image(KNURL_FALCON_IMAGE_LEAST - 2);
    check_load_fails(KNURL_ERROR_FORMAT, "image.bin|1024 to 65536|found 1022");
    (void)write_image(KNURL_FALCON_IMAGE_MOST + 2);
    check_load_fails(KNURL_ERROR_FORMAT, "image.bin|65536|found 65537 or more");
    write_file(tool_path("image.bin"), "", 0);
    check_load_fails(KNURL_ERROR_FORMAT, "found 0");
    assert_false(fake.sim.has_firmware);
}

/* Of an image of 2000 bytes with one of them changed. */
static void check_byte_fails(size_t at, uint8_t value, const char *words) {
    (void)falcon_image_make(image, 2000);
    image[at] = value;
    write_file(tool_path("image.bin"), image, 2000);
    check_load_fails(KNURL_ERROR_FORMAT, words);
}

/* 985 words of data: 0x03d9. */
TEST_WITH(a_file_that_the_boot_loader_would_not_take_whole_is_never_sent, plug_in, plug_out) {
    plug_in_without(2000, 0);
    check_byte_fails(0, 0xab, "image.bin|byte 0: expected the boot loader's key, aa 08");
    check_byte_fails(FALCON_IMAGE_BLOCK, 0xda, "image.bin|byte 2000: expected a block of 0 words");
    check_byte_fails(FALCON_IMAGE_BLOCK, 0xdb, "image.bin|byte 22: expected a block that ends within the file");
    check_byte_fails(FALCON_IMAGE_BLOCK + 1, 0, "image.bin|byte 462: expected a block that ends within the file");
    check_byte_fails(1998, 1, "image.bin|byte 1998: expected a block that ends within the file");
    check_byte_fails(FALCON_IMAGE_ENTRY, 0x3e, "image.bin|byte 18: expected an entry point in one of the blocks");
    assert_int_equal(falcon_fake_look(&fake).image_count, 0);
}

TEST_WITH(a_byte_that_comes_back_wrong_ends_it, plug_in, plug_out) {
    static const int32_t bytes[] = {62, 1999};
    const uint32_t sum = write_image(2000);
    for (size_t i = 0; i < COUNT_OF(bytes); i++) {
        char words[64];
        plug_in_without(2000, sum);
        fake.sim.wrong_echo = bytes[i];
        (void)snprintf(words, sizeof words, "byte %d |0x%02x|power", (int)bytes[i],
                       (unsigned)(uint8_t)~image[bytes[i]]);
        check_load_fails(KNURL_ERROR_DEVICE_LOST, words);
        assert_false(fake.sim.has_firmware);
    }
}

TEST_WITH(an_image_is_loaded_up_to_ten_times, plug_in, plug_out) {
    plug_in_without(2000, write_image(2000));
    fake.sim.bad_loads = 9;
    check_loads();
    assert_true(fake.sim.has_firmware);
    plug_in_without(2000, write_image(2000));
    fake.sim.bad_loads = 10;
    check_load_fails(KNURL_ERROR_DEVICE_LOST, "byte 100 |power");
}

TEST_WITH(an_echo_that_stays_away_ends_it, plug_in, plug_out) {
    plug_in_without(2000, write_image(2000));
    fake.sim.no_echo = 700;
    check_load_fails(KNURL_ERROR_DEVICE_LOST, "no echo of byte 700 |500 ms");
}

TEST_WITH(a_boot_loader_that_does_not_answer_ends_it, plug_in, plug_out) {
    (void)write_image(2000);
    plug_in_without(2000, 0);
    fake.sim.deaf = 1000;
    check_load_fails(KNURL_ERROR_DEVICE_LOST, "boot loader|0A 44 2C 0D");
}

TEST_WITH(an_image_of_another_device_is_named, plug_in, plug_out) {
    (void)write_image(2000);
    plug_in_without(2000, 1);
    check_load_fails(KNURL_ERROR_FORMAT, "image.bin|nothing answers");
}

TEST_WITH(a_cable_that_is_pulled_ends_it, plug_in, plug_out) {
    falcon_fake_inject(&fake, DOUBLE_UNPLUG);
    check_fails("", KNURL_ERROR_DEVICE_LOST, "unplugged while it was set up");
}

static int refuse_control(void *self, uint8_t request, uint16_t value) {
    (void)self;
    return request == 3 && value == 2 ? KNURL_FALCON_NOTHING : KNURL_FALCON_DONE;
}

TEST_WITH(a_request_that_the_chip_refuses_is_named, plug_in, plug_out) {
    transport.control = refuse_control;
    check_fails("", KNURL_ERROR_DEVICE_LOST, "step 4 of 6|request 3, value 0x2");
}

static uint32_t pieces_read;

/* Two answers: all of the first and three bytes of the second, then the rest. */
static int read_pieces(void *self, uint8_t packet[KNURL_FALCON_PACKET], size_t *count, uint32_t timeout_ms) {
    static const char answers[] = "<AAAAAAAAAAAAqA><AAAAAAAAAAAAqA>"; /* homed, at the middle of the encoders' range */
    const size_t at = pieces_read == 0 ? 0 : 19;
    const size_t size = pieces_read == 0 ? 19 : 13;
    (void)self;
    (void)timeout_ms;
    if (pieces_read == 2) {
        return KNURL_FALCON_NOTHING;
    }
    memcpy(packet + KNURL_FALCON_STATUS, answers + at, size);
    *count = KNURL_FALCON_STATUS + size;
    pieces_read++;
    return KNURL_FALCON_DONE;
}

/* Otherwise the driver would start in the middle of an answer, and report it as corrupt. */
TEST_WITH(an_answer_whose_beginning_was_taken_in_is_taken_in_to_its_end, plug_in, plug_out) {
    transport.read = read_pieces;
    pieces_read = 0;
    assert_int_equal(knurl_falcon_prepare(&transport, ""), KNURL_OK);
    assert_int_equal(pieces_read, 2);
}

SUITE_FIXTURES(make_folder, remove_folder)
