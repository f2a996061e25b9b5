/* `knurl run`, the main job: its CSV and summary, fast and in real time, stopped by a signal, and its files.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

/* The CSV's columns. */
enum { T, X, Y, Z, VX, VY, SURFACE, DEPTH, FS, FT, HEIGHT, FX, FY, FZ, COLUMNS };

/* The written plate: 1 mm period along x, 0.2 mm, 400 N/m, round (0.25, 0.5, -0.125) m, facing up. */
/* Reads a run's CSV and checks that it is whole: header, so many rows, 14 cells each, a line's end behind the last. */
static char *read_run(const char *path, size_t rows) {
    char *csv = read_file(path);
    assert_true(strncmp(csv, RUN_HEADER, strlen(RUN_HEADER)) == 0);
    assert_int_equal(lines_in(csv), rows + 1);
    assert_int_equal(csv[strlen(csv) - 1], '\n');
    const char *line = csv;
    for (size_t row = 0; row <= rows; row++) {
        size_t commas = 0;
        for (; *line != '\n'; line++) {
            commas += *line == ',';
        }
        assert_int_equal(commas, COLUMNS - 1);
        line++;
    }
    return csv;
}

static void check_no_leftovers(void) {
    assert_int_equal(files_that_end(".part"), 0);
}

/* Down on the spot from 1 mm above to 1 mm below in 10 ticks, a rest, then 0.25 m/s along x: 250 Hz, 4 ticks a cycle.
 * F = K (H - z) along y. S2: H = 0 at rest, and then +A, +A, -A, -A from the first tick with motion.
 */
TEST(a_trace_on_a_plate_gives_the_forces_of_the_equations) {
    write_text(
        tool_path("trace.csv"),
        "t,x,y,z\n0,0.25,0.501,-0.125\n0.01,0.25,0.499,-0.125\n0.02,0.25,0.499,-0.125\n0.06,0.26,0.499,-0.125\n");
    SCOPED_PROCESS p = RUN_TOOL("run", write_plate("plate.gltf", TAG), "--trace", tool_path("trace.csv"), "--fast",
                                "--method", "S2", "--out", tool_path("out.csv"));
    check_done(&p);
    char *csv = read_run(tool_path("out.csv"), 61); /* the last row too */
    uint64_t touching = 0;
    for (int tick = 0; tick < 61; tick++) {
        double cells[COLUMNS] = {0.0};
        assert_int_equal(csv_row(csv, (size_t)tick, cells, COLUMNS), COLUMNS);
        const double y = tick < 10 ? 0.001 - 0.0002 * tick : -0.001;
        const double x = tick > 20 ? 0.00025 * (tick - 20) : 0.0;
        const double height = tick <= 20 ? 0.0 : (tick - 21) % 4 < 2 ? 0.0002 : -0.0002;
        CHECK_CLOSE(cells[T], tick * 0.001, 1e-15);
        CHECK_CLOSE(cells[X], 0.25 + x, 1e-15);
        CHECK_CLOSE(cells[Y], 0.5 + y, 1e-15);
        CHECK_CLOSE(cells[Z], -0.125, 1e-15);
        if (fabs(y) > 0.0005) { /* well out of reach, or well inside */
            const int in = y < 0.0;
            CHECK_CLOSE(cells[HEIGHT], in ? height : 0.0, 1e-15);
            CHECK_CLOSE(cells[FY], in ? 400.0 * (height - y) : 0.0, 1e-9);
            CHECK_CLOSE(cells[DEPTH], in ? -y : 0.0, 1e-12);
            CHECK_CLOSE(cells[VX], tick > 20 ? 0.25 : 0.0, 1e-9);
            CHECK_CLOSE(cells[VY], 0.0, 1e-12);
            CHECK_CLOSE(cells[FS], tick > 20 ? 1000.0 : 0.0, 1e-6);
            CHECK_CLOSE(cells[FT], tick > 20 ? 250.0 : 0.0, 1e-6);
        }
        CHECK_CLOSE(cells[FX], 0.0, 1e-12);
        CHECK_CLOSE(cells[FZ], 0.0, 1e-12);
        touching += cells[FY] > 0.0;
    }
    assert_non_null(strstr(csv, "\n0,0.25,0.501,-0.125,0,0,none,0,0,0,0,0,0,0\n"));
    assert_non_null(strstr(csv, ",plate,"));
    CHECK_SAME(json_number_of(p.out, "ticks"), 61.0L);
    CHECK_SAME(json_number_of(p.out, "events"), 10.0L); /* 40 ticks of motion, 4 each */
    CHECK_CLOSE(json_number_of(p.out, "force_max_n"), 0.48, 1e-9);
    CHECK_CLOSE(json_number_of(p.out, "contact_s"), 0.001 * (double)touching, 0.0021); /* from the crests' height on */
    check_no_leftovers();
    free(csv);
}

TEST(the_summary_is_one_line_of_json_with_every_key_of_the_contract) {
    process p = RUN_TOOL("run", plate, "--fast", "--method", "S2"); /* which plays events at any speed */
    check_done(&p);
    assert_int_equal(lines_in(p.out), 1);
    check_keys(p.out, "ticks contact_s events overruns force_limit_ticks force_max_n tick_ns jitter_us p50 p99 max");
    CHECK_SAME(json_number_of(p.out, "ticks"), 5000.0L); /* 5 s at 1 kHz, unless said otherwise */
    assert_true(json_number_of(p.out, "contact_s") > 4.0);
    assert_true(json_number_of(p.out, "events") > 100.0);
    CHECK_SAME(json_number_of(p.out, "overruns"), 0.0L);
    CHECK_SAME(json_number_of(p.out, "force_limit_ticks"), 0.0L);
    assert_true(json_number_of(p.out, "force_max_n") > 0.2 && json_number_of(p.out, "force_max_n") < 3.3);
    process_free(&p);
    p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.1", "--pretty");
    check_done(&p);
    assert_true(lines_in(p.out) > 10);
    process_free(&p);
}

TEST(fast_twice_gives_the_same_bytes_and_another_seed_others) {
    static const char *const strokes[] = {"line", "sweep", "circle", "press", "rest"};
    for (size_t i = 0; i < COUNT_OF(strokes); i++) {
        SCOPED_PROCESS one =
            RUN_TOOL("run", plate, "--fast", "--stroke", strokes[i], "--seconds", "1.5", "--out", tool_path("one.csv"));
        SCOPED_PROCESS two =
            RUN_TOOL("run", plate, "--fast", "--stroke", strokes[i], "--seconds", "1.5", "--out", tool_path("two.csv"));
        SCOPED_PROCESS other = RUN_TOOL("run", plate, "--fast", "--stroke", strokes[i], "--seconds", "1.5", "--out",
                                        tool_path("other.csv"), "--device", "fake:?seed=2");
        check_done(&one);
        check_done(&two);
        check_done(&other);
        char *first = read_run(tool_path("one.csv"), 1500);
        char *second = read_run(tool_path("two.csv"), 1500);
        char *third = read_run(tool_path("other.csv"), 1500);
        assert_string_equal(first, second);
        assert_string_not_equal(first, third);
        free(first);
        free(second);
        free(third);
    }
    check_no_leftovers();
}

/* By S1, whose height depends on the proxy's position, by S2, and by bandlimited; over a rim too: the sweep's
 * strokes are longer than a bar.
 */
TEST(the_full_model_feels_the_same) {
    static const char *const methods[] = {"S1", "S2", "bandlimited"};
    static const char *const devices[] = {"fake:?resolution=0", "fake", "fake:?resolution=0"};
    for (size_t i = 0; i < COUNT_OF(methods); i++) {
        SCOPED_PROCESS reduced = RUN_TOOL("run", plate, "--fast", "--stroke", "sweep", "--seconds", "2", "--method",
                                          methods[i], "--device", devices[i], "--out", tool_path("reduced.csv"));
        SCOPED_PROCESS full =
            RUN_TOOL("run", plate, "--fast", "--stroke", "sweep", "--seconds", "2", "--method", methods[i], "--device",
                     devices[i], "--out", tool_path("full.csv"), "--full-model");
        check_done(&reduced);
        check_done(&full);
        char *first = read_run(tool_path("reduced.csv"), 2000);
        char *second = read_run(tool_path("full.csv"), 2000);
        int touching = 0;
        for (size_t row = 0; row < 2000; row++) {
            double a[COLUMNS] = {0.0};
            double b[COLUMNS] = {0.0};
            (void)csv_row(first, row, a, COLUMNS);
            (void)csv_row(second, row, b, COLUMNS);
            for (int column = 0; column < COLUMNS; column++) {
                if (column != SURFACE) { /* a name */
                    CHECK_CLOSE(a[column], b[column], 1e-9 * fmax(1.0, fabs(b[column])));
                }
            }
            touching += b[FY] > 0.0;
        }
        assert_true(touching > 1000);
        free(first);
        free(second);
    }
}

TEST(real_time_gives_the_same_csv_as_fast_and_says_nothing_into_a_pipe) {
    process slow = RUN_TOOL("run", plate, "--stroke", "sweep", "--seconds", "0.6", "--out", tool_path("slow.csv"));
    /* If the machine stalls for 50 ms the watchdog zeroes the force, correctly: then the forces differ. */
    for (int again = 0; again < 5 && json_number_of(slow.out, "watchdogs") > 0.0L; again++) {
        process_free(&slow);
        slow = RUN_TOOL("run", plate, "--stroke", "sweep", "--seconds", "0.6", "--out", tool_path("slow.csv"));
    }
    const int stalled = json_number_of(slow.out, "watchdogs") > 0.0L;
    process fast =
        RUN_TOOL("run", plate, "--stroke", "sweep", "--seconds", "0.6", "--out", tool_path("fast.csv"), "--fast");
    check_done(&slow); /* no carriage return, no escape, nothing but notes */
    check_done(&fast);
    char *first = read_run(tool_path("slow.csv"), 600);
    char *second = read_run(tool_path("fast.csv"), 600);
    CHECK_SAME(json_number_of(slow.out, "ticks"), 600.0L);
    if (!stalled) {
        assert_string_equal(first, second);
        CHECK_SAME(json_number_of(slow.out, "events"), json_number_of(fast.out, "events"));
        CHECK_SAME(json_number_of(slow.out, "force_max_n"), json_number_of(fast.out, "force_max_n"));
    }
    check_no_leftovers();
    free(first);
    free(second);
    process_free(&slow);
    process_free(&fast);
    if (stalled) {
        print_message("skipped: this machine stalls for 50 ms in every run\n");
        skip();
    }
}

TEST(rate_seconds_surface_and_method_are_obeyed) {
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--fast", "--rate", "3000", "--seconds", "1", "--surface", "bar 2 mm",
                                "--method", "S1", "--out", tool_path("out.csv"));
    check_done(&p);
    CHECK_SAME(json_number_of(p.out, "ticks"), 3000.0L);
    CHECK_SAME(json_number_of(p.out, "events"), 0.0L); /* S1 has no events */
    char *csv = read_run(tool_path("out.csv"), 3000);
    double last[COLUMNS] = {0.0};
    (void)csv_row(csv, 2999, last, COLUMNS);
    CHECK_CLOSE(last[T], 2999.0 / 3000.0, 1e-12);
    assert_non_null(strstr(csv, ",bar 2 mm,"));
    assert_null(strstr(csv, ",bar 1 mm,"));
    for (size_t row = 1500; row < 2200; row += 100) { /* 25 to 48 of 54 mm at 0.1 m/s over 500 cycles/m */
        double cells[COLUMNS] = {0.0};
        (void)csv_row(csv, row, cells, COLUMNS);
        CHECK_CLOSE(fabs(cells[HEIGHT]), 0.0002, 1e-15);
        CHECK_CLOSE(cells[FS], 500.0, 25.0); /* the hand's tremor turns it a little */
        CHECK_CLOSE(cells[FT], 50.0, 15.0);
    }
    free(csv);
}

TEST(a_stroke_lies_1_mm_below_the_surface_along_its_x) {
    SCOPED_PROCESS p =
        RUN_TOOL("run", plate, "--fast", "--seconds", "1", "--device",
                 "fake:?tremor=0&coulomb=0&resolution=0&hand_stiffness=10000", "--out", tool_path("out.csv"));
    check_done(&p);
    char *csv = read_run(tool_path("out.csv"), 1000);
    for (size_t row = 0; row <= 600; row += 50) { /* to 35 of 54 mm */
        double cells[COLUMNS] = {0.0};
        (void)csv_row(csv, row, cells, COLUMNS);
        if (row == 0) {
            CHECK_CLOSE(cells[Y], 0.005, 1e-9); /* 5 mm above */
        } else if (row >= 300) {                /* the plate pushes the hand's spring up by K/k of the depth, 4 % */
            CHECK_CLOSE(cells[DEPTH], 0.001, 0.00006);
            CHECK_CLOSE(cells[VX], 0.1, 0.02);
        }
        CHECK_CLOSE(cells[Z], 0.0, 1e-4);
    }
    free(csv);
}

TEST(an_output_is_replaced_only_by_a_whole_one) {
    write_text(tool_path("out.csv"), "mine\n");
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--device", "fake:?lose=1", "--out",
                         tool_path("out.csv"));
    assert_int_equal(p.exit_code, 2);
    process_free(&p);
    check_text(tool_path("out.csv"), "mine\n");
    p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", tool_path("out.csv"));
    check_done(&p);
    free(read_run(tool_path("out.csv"), 10));
    process_free(&p);
    check_no_leftovers();
}

TEST(an_output_may_be_a_device) {
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.1", "--out", "/dev/null");
    check_done(&p);
    assert_false(file_exists("/dev/null.part"));
    process_free(&p);
    static const char *const seconds[] = {"0.001", "1"}; /* noticed at the end, and during the run */
    for (size_t i = 0; i < COUNT_OF(seconds) && file_exists("/dev/full"); i++) {
        p = RUN_TOOL("run", plate, "--fast", "--seconds", seconds[i], "--out", "/dev/full");
        assert_int_equal(p.exit_code, 1);
        assert_int_equal(lines_in(p.err), 1);
        assert_non_null(strstr(p.err, "/dev/full"));
        process_free(&p);
    }
}

TEST(a_lost_device_is_a_failure_whose_csv_is_whole) {
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--fast", "--device", "fake:?lose_at=0.1", "--out", tool_path("out.csv"));
    assert_int_equal(p.signal, 0);
    assert_int_equal(p.exit_code, 1);
    assert_int_equal(lines_in(p.err), 2); /* the fault with its time, and the end of the run */
    assert_non_null(strstr(p.err, "knurl: note: after 0.100 s: lost")); /* of simulated time */
    assert_non_null(strstr(p.err, "knurl: run: the device was lost after 100 ticks"));
    assert_non_null(strstr(p.out, "\"faults\": {\"lost\": 1}"));
    free(read_run(tool_path("out.csv"), 100));
    check_no_leftovers();
}

TEST(a_lost_device_may_be_looked_for) {
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--fast", "--seconds", "1", "--reconnect", "--device",
                                "fake:?lose_at=0.1", "--out", tool_path("out.csv"));
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "\"ticks\": 1000,"));
    assert_non_null(strstr(p.out, "\"lost\": 1, \"resumed\": 1, \"reconnected\": 1"));
    free(read_run(tool_path("out.csv"), 1000));
}

/* 5000 N/m is beyond (0.5 + 2 N s/m)/1.5 ms and the 1020 N/m of a Touch: a line each. A demo's plate is within both. */
TEST(settings_beyond_the_device_are_warned_of_and_clamped_on_request) {
    static const char tag[] = "{\"knurl\":{\"version\":1,\"spatial_frequency\":[1000,0],\"amplitude\":0.00002,"
                              "\"stiffness\":5000,\"axis\":[1,0,0]}}";
    double forces[2] = {0.0, 0.0};
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.1");
    assert_null(strstr(p.err, "warning"));
    process_free(&p);
    for (int clamped = 0; clamped < 2; clamped++) {
        p = RUN_TOOL("run", write_plate("plate.gltf", tag), "--fast", "--seconds", "1", "--stroke", "press",
                     clamped ? "--clamp" : "--fast");
        assert_int_equal(p.exit_code, 0);
        const char *first =
            strstr(p.err, "knurl: warning: surface 'plate': stiffness 5000 N/m is 3 times the 1667 N/m");
        assert_non_null(first);
        assert_non_null(strstr(first, "knurl: warning: surface 'plate': stiffness 5000 N/m is 4.9 times the 1020 N/m"));
        assert_int_equal(strstr(first, "lower it") != NULL, !clamped);
        assert_int_equal(strstr(first, "it is felt at its limit") != NULL, clamped);
        forces[clamped] = json_number_of(p.out, "force_max_n");
        process_free(&p);
    }
    assert_true(forces[1] < 0.9 * forces[0]); /* the hand's spring yields to both */
}

SUITE_FIXTURES(make_folder, remove_folder)
