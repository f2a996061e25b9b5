/* The command-line tool with an emulated Falcon connected to the machine. SPDX-License-Identifier: MIT */
#include "support/tool.h"

#include "falcon_image.h"

/* Runs the tool on such a machine; `options` are emulate_falcon's, up to a null. */
static process run_with_falcon(const char *const *options, const char *const *arguments) {
    const char *all[PROCESS_ARGUMENTS] = {KNURL_TEST_WRAPPER, KNURL_TEST_EMULATE};
    size_t count = 2;
    for (; *options; options++) {
        all[count++] = *options;
    }
    all[count++] = "--";
    all[count++] = KNURL_TEST_TOOL;
    for (; *arguments; arguments++) {
        all[count++] = *arguments;
    }
    process p = process_start(all, NULL);
    process_finish(&p);
    return p;
}

#define OPTIONS(...)   ((const char *const[]){__VA_ARGS__, NULL})
#define NO_OPTIONS     ((const char *const[]){NULL})
#define ARGUMENTS(...) ((const char *const[]){__VA_ARGS__, NULL})

static double now(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

static void check_felt(process *p) {
    if (p->exit_code != 0) {
        fail_msg("exit %d, signal %d: %s%s", p->exit_code, p->signal, p->out, p->err);
    }
    assert_non_null(strstr(p->out, "Novint Falcon"));
    assert_true(json_number_of(p->out, "contact_s") > 0.0);
    assert_true(json_number_of(p->out, "half_cycles_crossed") > 10.0);
    assert_true(json_number_of(p->out, "force_max_n") > 0.0);
    process_free(p);
}

TEST(a_falcon_is_among_the_devices) {
    SCOPED_PROCESS p = run_with_falcon(NO_OPTIONS, ARGUMENTS("devices", "--json"));
    check_done(&p);
    assert_non_null(strstr(p.out, "{\"uri\": \"falcon\", \"name\": \"Novint Falcon\", \"unusable\": \"\"}"));
}

/* The line below "uri" in the tool's listing. */
static const char *line_below(const char *listing, const char *uri) {
    const char *at = strstr(listing, uri);
    const char *end = at ? strchr(at + 1, '\n') : NULL;
    if (!end) {
        fail_msg("no %s in: %s", uri, listing);
        return "";
    }
    return end + 1;
}

TEST(a_hanging_library_a_garbage_handle_and_a_busy_falcon_are_a_line_each_within_3_s) {
    static const char *const wishes[] = {"hang", "garbage"};
    static const char *const words[] = {"does not answer within 2 s", "0x0302"};
    const double limit = SUITE_SANITIZED ? 10.0 : 3.0; /* s: sanitizers start programs slowly */
    assert_int_equal(setenv("KNURL_HD_LIBRARY", KNURL_TEST_STUB, 1), 0);
    for (size_t i = 0; i < COUNT_OF(wishes); i++) {
        assert_int_equal(setenv("KNURL_STUB_HD", wishes[i], 1), 0);
        const double begin = now();
        SCOPED_PROCESS p = run_with_falcon(OPTIONS("--busy"), ARGUMENTS("devices"));
        const double took = now() - begin;
        check_done(&p);
        const char *touch = line_below(p.out, "\ntouch");
        const char *falcon = line_below(p.out, "\nfalcon");
        assert_true(strstr(touch, words[i]) && strstr(touch, words[i]) < strchr(touch, '\n'));
        assert_true(strstr(falcon, "it is in use") && strstr(falcon, "it is in use") < strchr(falcon, '\n'));
        assert_true(took < limit);
    }
    (void)unsetenv("KNURL_STUB_HD");
    (void)unsetenv("KNURL_HD_LIBRARY");
}

TEST(calibrating_without_a_mass_or_a_file_is_refused) {
    process p = RUN_TOOL("calibrate", "falcon");
    check_refused(&p, 2, "--mass KG --out FILE", "calibrate falcon");
    p = RUN_TOOL("calibrate", "touch", "--mass", "0.2", "--out", tool_path("gain"));
    check_refused(&p, 2, "expected falcon", "calibrate touch");
    p = RUN_TOOL("calibrate", "falcon", "--mass", "5", "--out", tool_path("gain"));
    check_refused(&p, 2, "--mass|0.05|0.4", "calibrate falcon --mass 5");
}

TEST(a_plate_is_felt_through_a_falcon) {
    process p = run_with_falcon(NO_OPTIONS, ARGUMENTS("run", plate, "--device", "falcon", "--seconds", "1"));
    check_felt(&p);
}

TEST(packets_in_pieces_change_nothing) {
    process p = run_with_falcon(OPTIONS("--split"), ARGUMENTS("run", plate, "--device", "falcon", "--seconds", "1"));
    check_felt(&p);
}

TEST(a_falcon_without_firmware_is_given_the_image) {
    uint8_t image[4096];
    char uri[600];
    (void)falcon_image_make(image, sizeof image);
    write_file(tool_path("image.bin"), image, sizeof image);
    (void)snprintf(uri, sizeof uri, "falcon:?firmware=%s", tool_path("image.bin"));
    process p = run_with_falcon(OPTIONS("--no-firmware"), ARGUMENTS("run", plate, "--device", uri, "--seconds", "1"));
    check_felt(&p);
}

/* A tick takes a position: with one in four exchanges, six hundred ticks would be more than a second. */
TEST(seconds_are_seconds_also_with_a_device_that_has_no_position_most_of_the_time) {
    const double begin = now();
    process p =
        run_with_falcon(OPTIONS("--unhomed", "90"), ARGUMENTS("run", plate, "--device", "falcon", "--seconds", "0.6"));
    const double took = now() - begin;
    if (took < 0.6 || took > 2.6) {
        fail_msg("expected 0.6 s and some for the start, found %g s: %s", took, p.out);
    }
    if (p.exit_code != 0) {
        fail_msg("exit %d: %s%s", p.exit_code, p.out, p.err);
    }
    assert_true(json_number_of(p.out, "ticks") < 400.0);
    assert_true(json_number_of(p.out, "absences") > 200.0);
    process_free(&p);
}

TEST(a_run_without_any_position_has_failed) {
    SCOPED_PROCESS p = run_with_falcon(OPTIONS("--unhomed", "1000000000"),
                                       ARGUMENTS("run", plate, "--device", "falcon", "--seconds", "0.5"));
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "the device gave no position within 0.5 s"));
}

TEST(a_cable_that_is_pulled_ends_the_run_with_a_sentence) {
    SCOPED_PROCESS p = run_with_falcon(OPTIONS("--unplug-after", "0.3"),
                                       ARGUMENTS("run", plate, "--device", "falcon", "--seconds", "5"));
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "lost"));
}

SUITE_FIXTURES(make_folder, remove_folder)
