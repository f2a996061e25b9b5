/* `knurl run --trace`: recorded counts, standard input, and traces that touch nothing. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

#define SPEED 0.119 /* m/s: 119 Hz */
#define FT    7     /* the CSV's column */

/* Half a second along the plate, 1 mm deep, in counts (0: exact), with so many decimals. */
static const char *record(const char *name, double count, int decimals) {
    static char text[64 * 520];
    size_t used = (size_t)snprintf(text, sizeof text, "t,x,y,z\n");
    for (int i = 0; i < 500; i++) {
        const double x = 0.22 + 0.001 * SPEED * i;
        const double y = 0.499;
        used += (size_t)snprintf(text + used, sizeof text - used, "%.3f,%.*f,%.*f,-0.125\n", 0.001 * i, decimals,
                                 count > 0.0 ? round(x / count) * count : x, decimals,
                                 count > 0.0 ? round(y / count) * count : y);
    }
    const char *path = tool_path(name);
    write_text(path, text);
    return path;
}

/* The standard deviation of f_t over its mean, from 0.1 s on. */
static double scatter(const char *path) {
    char *csv = read_file(path);
    double sum = 0.0;
    double squares = 0.0;
    const int from = 100;
    for (int i = from; i < 500; i++) {
        double cells[FT + 3] = {0.0};
        (void)csv_row(csv, (size_t)i, cells, COUNT_OF(cells));
        sum += cells[FT + 2];
        squares += cells[FT + 2] * cells[FT + 2];
    }
    free(csv);
    const double mean = sum / (500 - from);
    CHECK_CLOSE(mean, 1000.0 * SPEED, 2.0);
    return sqrt(squares / (500 - from) - mean * mean) / mean;
}

static process play(const char *trace, const char *option, const char *value) {
    return RUN_TOOL("run", write_plate("plate.gltf", TAG), "--fast", "--trace", trace, "--out", tool_path("out.csv"),
                    option, value);
}

/* Counts of 0.055 mm at 1 kHz are steps of 55 mm/s: by first differences, 119 Hz scatter by 17 %. */
TEST(recorded_counts_are_found_and_felt_as_counts) {
    static const int decimals[] = {17, 7, 6};
    for (size_t i = 0; i < COUNT_OF(decimals); i++) {
        const char *trace = record("counts.csv", 0.055e-3, decimals[i]);
        process p = play(trace, NULL, NULL);
        check_done(&p);
        CHECK_CLOSE(json_number_of(p.out, "resolution_m"), 0.055e-3, 1e-8);
        assert_non_null(strstr(p.err, "in counts of 0.055 mm"));
        process_free(&p);
        assert_true(scatter(tool_path("out.csv")) < 0.03);
    }
}

TEST(a_trace_is_exact_if_the_user_says_so) {
    process p = play(record("counts.csv", 0.055e-3, 17), "--exact", NULL);
    check_done(&p);
    CHECK_SAME(json_number_of(p.out, "resolution_m"), 0.0L);
    assert_int_equal(p.sizes[1], 0);
    process_free(&p);
    assert_true(scatter(tool_path("out.csv")) > 0.15);
    p = RUN_TOOL("run", write_plate("plate.gltf", TAG), "--fast", "--exact");
    check_refused(&p, 2, "--exact|expected --trace", "--exact without a trace");
}

TEST(an_exact_trace_is_exact_on_a_device_with_a_long_name) {
    static const char key[] = "tremor=0&";
    char uri[2048] = "fake:?";
    for (size_t used = strlen(uri); used < 2000; used += strlen(key)) {
        memcpy(uri + used, key, sizeof key);
    }
    uri[strlen(uri) - 1] = '\0'; /* the last ampersand */
    SCOPED_PROCESS p = RUN_TOOL("run", write_plate("plate.gltf", TAG), "--fast", "--trace",
                                record("counts.csv", 0.055e-3, 17), "--device", uri, "--exact");
    check_done(&p);
    CHECK_SAME(json_number_of(p.out, "resolution_m"), 0.0L);
}

TEST(an_exact_trace_stays_exact) {
    process p = play(record("exact.csv", 0.0, 17), NULL, NULL);
    check_done(&p);
    CHECK_SAME(json_number_of(p.out, "resolution_m"), 0.0L);
    assert_int_equal(p.sizes[1], 0);
    process_free(&p);
    assert_true(scatter(tool_path("out.csv")) < 1e-9);
}

TEST(a_resolution_in_the_uri_holds) {
    SCOPED_PROCESS p = play(record("counts.csv", 0.055e-3, 17), "--device", "fake:?resolution=0.0001");
    check_done(&p);
    CHECK_CLOSE(json_number_of(p.out, "resolution_m"), 0.0001L, 1e-15L);
    assert_int_equal(p.sizes[1], 0);
}

TEST(a_trace_comes_from_standard_input) {
    char command[4096];
    process p = play(record("exact.csv", 0.0, 17), NULL, NULL);
    check_done(&p);
    process_free(&p);
    char *expected = read_file(tool_path("out.csv"));
    (void)snprintf(command, sizeof command, "'%s' run '%s' --fast --trace - --out '%s' < '%s'", KNURL_TEST_TOOL,
                   tool_path("plate.gltf"), tool_path("piped.csv"), tool_path("exact.csv"));
    p = run_tool((const char *const[]){"/bin/sh", "-c", command, NULL});
    check_done(&p);
    process_free(&p);
    char *piped = read_file(tool_path("piped.csv"));
    assert_string_equal(piped, expected);
    free(piped);
    free(expected);
    (void)snprintf(command, sizeof command, "echo t,x,y | '%s' run '%s' --fast --trace -", KNURL_TEST_TOOL,
                   tool_path("plate.gltf"));
    p = run_tool((const char *const[]){"/bin/sh", "-c", command, NULL});
    check_refused(&p, 1, "standard input: line 1|'z'", "a header without z");
}

TEST(a_short_trace_that_touches_nothing_is_reported) {
    write_text(tool_path("high.csv"), "t,x,y,z\n0,0.25,0.52,-0.125\n0.1,0.26,0.52,-0.125\n");
    SCOPED_PROCESS p = RUN_TOOL("run", write_plate("plate.gltf", TAG), "--fast", "--trace", tool_path("high.csv"));
    assert_int_equal(p.exit_code, 4);
    assert_non_null(strstr(p.err, "nothing was touched in 0.101 s"));
}

SUITE_FIXTURES(make_folder, remove_folder)
