/* Random and mutated reports and files: no crash, no undefined behaviour, incomplete input is refused, outputs are
 * unchanged on refusal. KNURL_FUZZ=N: N times as much. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/vec3.h"
#include "device/rawhid/geometry.h"
#include "device/rawhid/kinematics.h"
#include "device/rawhid/report.h"

#include <stdio.h>
#include <stdlib.h>

static uint64_t bits = 20260101;
static uint32_t more = 1;

static int set_up(void **state) {
    (void)state;
    const char *wanted = getenv("KNURL_FUZZ");
    more = wanted ? (uint32_t)strtoul(wanted, NULL, 10) : 1;
    return 0;
}

static void fill(uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (uint8_t)(random_bits(&bits) >> 32);
    }
}

/* Passes a report through all of its processing. */
static uint32_t feed(const knurl_rawhid_arm *arm, const uint8_t *bytes, size_t size, size_t report_bytes) {
    const knurl_rawhid_in before = {{1, 2, 3, 4, 5, 6}, 7};
    knurl_rawhid_in in = before;
    double angles[3];
    double position[3];
    int16_t ma[3];
    const double force[3] = {3.0, -3.0, 3.0};
    if (!knurl_rawhid_parse(bytes, size, report_bytes, &in)) {
        assert_memory_equal(&in, &before, sizeof in);
        return 0;
    }
    assert_true(size == report_bytes && (in.info == 0 || in.info == 1));
    knurl_rawhid_angles(arm, in.counts, angles);
    knurl_rawhid_position(arm, angles, position);
    assert_true(vec3_finite(position) && vec3_length(position) < 1.0);
    (void)knurl_rawhid_is_pose(arm, angles);
    knurl_rawhid_currents(arm, angles, force, ma);
    for (int i = 0; i < 3; i++) {
        assert_true(ma[i] >= -2000 && ma[i] <= 2000);
    }
    return 1;
}

TEST(a_million_random_and_mutated_reports_are_positions_or_nothing) {
    knurl_rawhid_geometry geometry;
    knurl_rawhid_arm arm;
    uint32_t believed = 0;
    knurl_rawhid_geometry_init(&geometry);
    knurl_rawhid_arm_init(&arm, &geometry);
    for (uint32_t i = 0; i < 1000000 * more; i++) {
        uint8_t bytes[65];
        const size_t report_bytes = i & 1 ? 64 : 14;
        const size_t size =
            (size_t)random_integer(&bits, 0, 9) == 0 ? (size_t)random_integer(&bits, 0, 65) : report_bytes;
        uint8_t *exact = bytes + sizeof bytes - size; /* at the end, so that a byte beyond it is seen */
        fill(exact, size);
        if (i % 4 < 2 && size > 13) { /* a good one, but for a byte */
            exact[12] = exact[13] = 0;
            exact[random_integer(&bits, 0, (int64_t)size - 1)] ^= (uint8_t)(random_bits(&bits) >> 32);
        }
        believed += feed(&arm, exact, size, report_bytes);
    }
    assert_true(believed > 300000 * more);
}

TEST(random_descriptors_are_sizes_or_nothing) {
    for (uint32_t i = 0; i < 200000 * more; i++) {
        uint8_t bytes[64];
        const knurl_rawhid_sizes before = {7, 7};
        knurl_rawhid_sizes sizes = before;
        const size_t size = (size_t)random_integer(&bits, 0, 64);
        fill(bytes + 64 - size, size);
        if (!knurl_rawhid_measure(bytes + 64 - size, size, &sizes)) {
            assert_memory_equal(&sizes, &before, sizeof sizes);
        }
        assert_true(sizes.in <= 125000 && sizes.out <= 125000);
    }
}

/* The text from a heap block of its very size, so that a sanitizer sees a byte beyond it. */
static void parse(const char *text, size_t size) {
    knurl_rawhid_geometry before;
    knurl_rawhid_geometry g;
    knurl_rawhid_arm arm;
    char *exact = malloc(size > 0 ? size : 1);
    assert_non_null(exact);
    memcpy(exact, text, size);
    memset(&before, 0x55, sizeof before);
    g = before;
    const knurl_result result = knurl_rawhid_geometry_parse("fuzz", exact, size, &g);
    free(exact);
    if (result) {
        assert_int_equal(result, KNURL_ERROR_FORMAT);
        assert_int_equal(strncmp(knurl_error_message(), "fuzz: ", 6), 0);
        assert_memory_equal(&g, &before, sizeof g);
        return;
    }
    knurl_rawhid_arm_init(&arm, &g);
    const double resolution = knurl_rawhid_resolution(&arm);
    assert_true(resolution > 0.0 && resolution < 1.0);
}

static char shipped[16384];
static size_t shipped_size;

static void mutate(char *text, size_t *size) {
    static const char likely[] = "=#\n.-+e0123456789x ,\r\t_abc";
    const int64_t changes = random_integer(&bits, 1, 8);
    for (int64_t i = 0; i < changes && *size > 1; i++) {
        const size_t at = (size_t)random_integer(&bits, 0, (int64_t)*size - 1);
        switch (random_integer(&bits, 0, 4)) {
        case 0:
            text[at] = (char)random_bits(&bits);
            break;
        case 1:
            text[at] = likely[random_integer(&bits, 0, (int64_t)sizeof likely - 2)];
            break;
        case 2: /* a byte less */
            memmove(text + at, text + at + 1, *size - at - 1);
            (*size)--;
            break;
        case 3: /* cut off */
            *size = random_integer(&bits, 0, 7) == 0 ? at : *size;
            break;
        default: /* a piece twice */
            if (at + 16 < *size) {
                memmove(text + (size_t)random_integer(&bits, 0, (int64_t)*size - 16), text + at, 16);
            }
            break;
        }
    }
}

TEST(mutated_geometry_files_are_geometries_or_sentences) {
    FILE *file = fopen(KNURL_TEST_ASSETS "/devices/woodenhaptics.geometry", "rb");
    if (!file) {
        fail_msg("no geometry file to start from");
        return;
    }
    for (int c = fgetc(file); c != EOF && shipped_size < sizeof shipped; c = fgetc(file)) {
        shipped[shipped_size++] = (char)c;
    }
    (void)fclose(file);
    assert_in_range(shipped_size, 1000, sizeof shipped - 1);
    for (uint32_t i = 0; i < 100000 * more; i++) {
        static char text[sizeof shipped];
        size_t size = shipped_size;
        memcpy(text, shipped, size);
        mutate(text, &size);
        parse(text, size);
    }
}

TEST(random_text_is_a_sentence) {
    for (uint32_t i = 0; i < 100000 * more; i++) {
        uint8_t bytes[64];
        fill(bytes, sizeof bytes);
        parse((const char *)bytes, (size_t)random_integer(&bits, 0, 64));
    }
}

SUITE_FIXTURES(set_up, NULL)
