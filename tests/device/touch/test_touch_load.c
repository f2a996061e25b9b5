/* Finding the HD library: the error if it is missing, and its lifetime. SPDX-License-Identifier: MIT */
#include "device/touch/stub.h"

#include <dlfcn.h>
#include <stdio.h>

/* 1 while the stub is in memory. */
static int is_loaded(const char *path) {
    void *found = dlopen(path, RTLD_NOW | RTLD_NOLOAD);
    if (found) {
        (void)dlclose(found);
    }
    return found != NULL;
}

static void check_refused_uri(const char *uri, knurl_result code, const char *words) {
    knurl_device *device = NULL;
    CHECK_REFUSED(knurl_device_open(uri, &device), code, device);
    check_message(words);
    assert_true(strlen(knurl_error_message()) < 1000); /* not truncated */
}

/* A file of those bytes is refused as a library. */
static void check_refused_file(const unsigned char *bytes, size_t size, const char *words) {
    static const char path[] = KNURL_TEST_TMP "/libHD_bad.so";
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail_msg("%s cannot be written", path);
        return;
    }
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    check_refused_uri("touch:?library=" KNURL_TEST_TMP "/libHD_bad.so", KNURL_ERROR_UNSUPPORTED, words);
    assert_int_equal(remove(path), 0);
}

TEST(without_a_library_every_tried_place_is_reported_with_a_remedy) {
    assert_int_equal(unsetenv("KNURL_HD_LIBRARY"), 0);
    check_refused_uri("touch", KNURL_ERROR_UNSUPPORTED,
                      "libHD.so (|libHD.so.3.4 (|libHD.so.3.0 (|No such file|OpenHaptics|device driver|"
                      "KNURL_HD_LIBRARY|?library=|GTDD_HOME");
}

TEST(a_library_that_is_named_is_the_only_one_that_is_tried) {
    assert_int_equal(setenv("KNURL_HD_LIBRARY", "/nowhere/libHD.so", 1), 0);
    check_refused_uri("touch", KNURL_ERROR_UNSUPPORTED, "/nowhere/libHD.so (|No such file|KNURL_HD_LIBRARY names it");
    assert_null(strstr(knurl_error_message(), "libHD.so.3.4"));
    check_refused_uri("touch:?library=/elsewhere/libHD.so", KNURL_ERROR_UNSUPPORTED,
                      "/elsewhere/libHD.so (|No such file");
    assert_null(strstr(knurl_error_message(), "/nowhere"));
}

TEST(the_library_that_a_library_needs_and_lacks_shows_through) {
    check_refused_uri("touch:?library=" KNURL_TEST_STUB_ALONE, KNURL_ERROR_UNSUPPORTED,
                      "libPhantomIOLib42.so|OpenHaptics");
}

TEST(a_function_that_is_missing_is_named_and_nothing_stays_loaded) {
    check_refused_uri("touch:?library=" KNURL_TEST_STUB_OLD, KNURL_ERROR_UNSUPPORTED, "hdCheckCalibration,|too old");
    assert_false(is_loaded(KNURL_TEST_STUB_OLD));
}

TEST(a_library_for_other_machines_and_a_file_that_is_no_library_are_named) {
    unsigned char bytes[4096];
    FILE *file = fopen(KNURL_TEST_STUB, "rb");
    if (!file) {
        fail_msg("%s cannot be read", KNURL_TEST_STUB);
        return;
    }
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
    assert_int_equal(fclose(file), 0);
    bytes[4] = 1; /* EI_CLASS: 32 bits */
    check_refused_file(bytes, sizeof bytes, "wrong ELF class|ELFCLASS32");
    bytes[4] = 2;  /* 64 bits again */
    bytes[18] = 8; /* EM_MIPS */
    bytes[19] = 0;
    check_refused_file(bytes, sizeof bytes, "another processor|machine 8");
    memset(bytes, '#', sizeof bytes);
    check_refused_file(bytes, sizeof bytes, "invalid ELF header");
}

TEST(two_devices_share_the_library_and_the_last_one_unloads_it) {
    knurl_device *second = NULL;
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    assert_false(is_loaded(KNURL_TEST_STUB));
    knurl_device *left = stub_open("touch:Left Device");
    knurl_device *right = stub_open("touch:Right Device?library=" KNURL_TEST_STUB);
    CHECK_REFUSED(knurl_device_open("touch:?library=/elsewhere/libHD.so", &second), KNURL_ERROR_ARGUMENT, second);
    check_message("share one");
    knurl_device_close(left);
    assert_true(is_loaded(KNURL_TEST_STUB));
    knurl_device_close(right);
    assert_false(is_loaded(KNURL_TEST_STUB));
}

TEST(a_device_that_cannot_be_opened_leaves_no_library_behind) {
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    check_refused_uri("touch:Nobody's Device", KNURL_ERROR_DEVICE_LOST,
                      "Nobody's Device|0x0302|70-knurl.rules|Touch_AdvancedConfig");
    assert_false(is_loaded(KNURL_TEST_STUB));
}

static int refuses_memory;
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

void *__wrap_calloc(size_t count, size_t size) {
    return refuses_memory ? NULL : __real_calloc(count, size);
}

TEST(without_memory_nothing_is_opened_and_nothing_left_behind) {
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    refuses_memory = 1;
    check_refused_uri("touch", KNURL_ERROR_MEMORY, "touch|bytes");
    refuses_memory = 0;
    assert_false(is_loaded(KNURL_TEST_STUB));
}

TEST(a_uri_with_an_unknown_key_is_refused) {
    check_refused_uri("touch:?rate=1000", KNURL_ERROR_ARGUMENT, "touch|library=|rate=1000");
}

/* --- the listing --- */

TEST(the_listing_shows_the_device_or_the_reason_that_there_is_none) {
    assert_int_equal(unsetenv("KNURL_HD_LIBRARY"), 0);
    knurl_device_listing found = listing_of("touch");
    assert_string_equal(found.uri, "touch");
    assert_non_null(strstr(found.reason, "libHD.so"));
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    found = listing_of("touch");
    assert_string_equal(found.reason, "");
    assert_string_equal(found.name, "3D Systems Touch (Touch of straw, HD 3.4.0, driver 2023.11)");
    assert_int_equal(setenv("KNURL_STUB_HD", "absent", 1), 0);
    found = listing_of("touch");
    assert_non_null(strstr(found.reason, "0x0302"));
    assert_int_equal(unsetenv("KNURL_STUB_HD"), 0);
    assert_false(is_loaded(KNURL_TEST_STUB));
}

TEST(a_device_that_this_program_has_open_is_listed_as_in_use) {
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    SCOPED_DEVICE *left = stub_open("touch:Left Device");
    const knurl_device_listing found = listing_of("touch");
    assert_string_equal(found.uri, "touch:Left Device");
    assert_non_null(strstr(found.reason, "in use"));
}
