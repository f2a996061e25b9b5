/* Raw HID reports, byte by byte. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "device/rawhid/report.h"

static const knurl_rawhid_in untouched = {{1, 2, 3, 4, 5, 6}, 7};

/* Usage page ffab, usage 200, 64 bytes of input and 64 of output, as Teensy's RawHID describes itself. */
static const uint8_t teensy[] = {0x06, 0xab, 0xff, 0x0a, 0x00, 0x02, 0xa1, 0x01, 0x75, 0x08, 0x15, 0x00, 0x26, 0xff,
                                 0x00, 0x95, 0x40, 0x09, 0x01, 0x81, 0x02, 0x95, 0x40, 0x09, 0x02, 0x91, 0x02, 0xc0};

TEST(a_report_is_seven_words_low_byte_first) {
    const uint8_t bytes[14] = {0x01, 0x00, 0x00, 0x01, 0xff, 0xff, 0x00, 0x80, 0xff, 0x7f, 0x70, 0x17, 0x01, 0x00};
    static const int16_t expected[6] = {1, 256, -1, -32768, 32767, 6000};
    knurl_rawhid_in in = untouched;
    assert_int_equal(knurl_rawhid_parse(bytes, 14, 14, &in), 1);
    for (int i = 0; i < 6; i++) {
        assert_int_equal(in.counts[i], expected[i]);
    }
    assert_int_equal(in.info, 1);
}

TEST(a_report_of_another_length_than_the_devices_is_refused) {
    const uint8_t bytes[65] = {0};
    for (size_t device = 14; device <= 64; device++) {
        for (size_t size = 0; size <= 65; size++) {
            knurl_rawhid_in in = untouched;
            assert_int_equal(knurl_rawhid_parse(bytes, size, device, &in), size == device);
            if (size != device) {
                assert_memory_equal(&in, &untouched, sizeof in);
            }
        }
    }
    knurl_rawhid_in in = untouched;
    assert_int_equal(knurl_rawhid_parse(bytes, 13, 13, &in), 0); /* too short for seven words, on any device */
}

TEST(a_report_whose_last_word_is_neither_0_nor_1_is_refused) {
    for (int32_t word = 0; word < 65536; word++) {
        uint8_t bytes[14] = {0};
        knurl_rawhid_in in = untouched;
        bytes[12] = (uint8_t)(word & 0xff);
        bytes[13] = (uint8_t)(word >> 8);
        assert_int_equal(knurl_rawhid_parse(bytes, 14, 14, &in), word < 2);
    }
}

TEST(currents_go_behind_the_report_id_low_byte_first_and_the_rest_is_0) {
    static const int16_t ma[3] = {-3000, 1, 0x1234};
    const uint8_t expected[15] = {0, 0x48, 0xf4, 0x01, 0x00, 0x34, 0x12};
    uint8_t bytes[65];
    memset(bytes, 0xaa, sizeof bytes);
    assert_int_equal(knurl_rawhid_put_currents(bytes, 14, ma), 15);
    assert_memory_equal(bytes, expected, 15);
    assert_int_equal(knurl_rawhid_put_currents(bytes, 64, ma), 65);
    for (size_t i = 7; i < 65; i++) {
        assert_int_equal(bytes[i], 0);
    }
}

TEST(counters_are_set_by_command_1_without_any_current) {
    static const int16_t counts[3] = {-2, 256, 6000};
    const uint8_t expected[15] = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0xfe, 0xff, 0x00, 0x01, 0x70, 0x17};
    uint8_t bytes[65];
    memset(bytes, 0xaa, sizeof bytes);
    assert_int_equal(knurl_rawhid_put_counters(bytes, 14, counts), 15);
    assert_memory_equal(bytes, expected, 15);
}

TEST(a_descriptor_tells_how_long_reports_are) {
    knurl_rawhid_sizes sizes = {0, 0};
    assert_int_equal(knurl_rawhid_measure(teensy, sizeof teensy, &sizes), 1);
    assert_int_equal(sizes.in, 64);
    assert_int_equal(sizes.out, 64);
}

TEST(a_descriptor_that_is_cut_off_in_an_item_or_promises_too_much_is_refused) {
    static const uint8_t huge[] = {0x77, 0xff, 0xff, 0xff, 0xff, 0x97, 0xff, 0xff, 0xff, 0xff, 0x81, 0x02};
    static const uint8_t long_item[] = {0xfe, 0x02, 0x10, 0x00, 0x00};
    const knurl_rawhid_sizes before = {7, 7};
    knurl_rawhid_sizes sizes = before;
    assert_int_equal(knurl_rawhid_measure(huge, sizeof huge, &sizes), 0);
    assert_int_equal(knurl_rawhid_measure(long_item, sizeof long_item, &sizes), 0);
    assert_int_equal(knurl_rawhid_measure(teensy, 2, &sizes), 0);
    assert_int_equal(knurl_rawhid_measure(teensy, 20, &sizes), 0);
    assert_memory_equal(&sizes, &before, sizeof sizes);
    assert_int_equal(knurl_rawhid_measure(teensy, 0, &sizes), 1);
    assert_int_equal(sizes.in + sizes.out, 0);
}
