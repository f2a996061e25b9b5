/* The command-line tool's errors for bad input: exit 1 for a failure, 2 for wrong usage or an unknown method or device;
 * one line on standard error with the fault, its place and the expected value; no incomplete file.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

static void check_all_wrong(const wrong_line *table, size_t count) {
    write_text(tool_path("good.csv"), "vx,vy\n0.1,0\n");
    for (size_t i = 0; i < count; i++) {
        check_wrong(&table[i]);
    }
}

TEST(wrong_usage_of_the_tool_is_reported) {
    static const wrong_line table[] = {
        {"fly", 2, "fly|inspect"},
        {"--fast", 2, "--fast"},
        {"run", 2, "run|file"},
        {"inspect", 2, "inspect|file"},
        {"inspect %P %P", 2, "argument"},
        {"inspect %P --colour", 2, "--colour"},
        {"run %P --colour blue", 2, "--colour"},
        {"run %P %P", 2, "argument"},
        {"devices all", 2, "all"},
        {"devices --xml", 2, "--xml"},
        {"signal extra --method T1", 2, "extra"},
        {"run %P --stroke line --trace %T/good.csv", 2, "--stroke|--trace"},
        {"run %P --even --response %T/good.csv", 2, "--even|--response"},
        {"inspect %P --even --response %T/good.csv", 2, "--even|--response"},
        {"--version now", 2, "--version: unexpected argument 'now'"},
        {"man run", 2, "man: unexpected argument 'run'"},
        {"completion bash zsh", 2, "completion: unexpected argument 'zsh'"},
        {"completion", 2, "bash, zsh or fish, found none"},
        {"completion tcsh", 2, "bash, zsh or fish, found 'tcsh'"},
    };
    check_all_wrong(table, COUNT_OF(table));
}

TEST(a_missing_value_is_reported) {
    static const char *const options[] = {"--device", "--surface", "--stroke", "--trace",
                                          "--method", "--seconds", "--rate",   "--out"};
    for (size_t i = 0; i < COUNT_OF(options); i++) {
        process p = RUN_TOOL("run", plate, "--fast", options[i]);
        check_refused(&p, 2, options[i], options[i]);
    }
    static const wrong_line table[] = {
        {"signal --period-ms 3 --ticks 6", 2, "--method"},
        {"signal --method T1 --ticks 6", 2, "--period-ms"},
        {"signal --method T1 --period-ms 3", 2, "--ticks"},
        {"scan --fs 1000,0 --amplitude 1 --in %T/good.csv", 2, "found no --method"},
        {"scan --method S2 --amplitude 1 --in %T/good.csv", 2, "found no --fs"},
        {"scan --method S2 --fs 1000,0 --in %T/good.csv", 2, "found no --amplitude"},
        {"scan --method S2 --fs 1000,0 --amplitude 1", 2, "found no --in"},
    };
    check_all_wrong(table, COUNT_OF(table));
}

TEST(a_number_out_of_range_is_reported) {
    static const wrong_line table[] = {
        {"run %P --fast --rate 0 --out %T/out.csv", 2, "--rate|100|10000"},
        {"run %P --fast --rate 1e9 --out %T/out.csv", 2, "--rate|1e9"},
        {"run %P --fast --rate -1000", 2, "--rate"},
        {"run %P --fast --rate nan", 2, "--rate"},
        {"run %P --fast --rate fast", 2, "--rate|fast"},
        {"run %P --fast --rate 1000Hz", 2, "1000Hz"},
        {"run %P --fast --seconds 0", 2, "--seconds"},
        {"run %P --fast --seconds -1", 2, "--seconds"},
        {"run %P --fast --seconds inf", 2, "--seconds"},
        {"run %P --fast --seconds nan", 2, "--seconds"},
        {"signal --method T1 --period-ms 0 --ticks 6", 2, "--period-ms"},
        {"signal --method T1 --period-ms nan --ticks 6", 2, "--period-ms"},
        {"signal --method T1 --period-ms 3 --ticks 0", 2, "--ticks"},
        {"signal --method T1 --period-ms 3 --ticks -6", 2, "--ticks"},
        {"signal --method T1 --period-ms 3 --ticks 6 --rate 0", 2, "--rate"},
        {"signal --method T1 --period-ms 3 --ticks 6 --rate 1e9", 2, "--rate"},
        {"signal --method T1 --period-ms 3 --ticks 6 --amplitude -1", 2, "--amplitude"},
        {"scan --method S2 --fs 1000,0 --amplitude -1 --in %T/good.csv", 2, "--amplitude"},
        {"scan --method S2 --fs 1000,0 --amplitude 1 --rate 0 --in %T/good.csv", 2, "--rate"},
        {"scan --method S2 --fs 1000,0 --amplitude 1 --rate 1e9 --in %T/good.csv", 2, "--rate"},
        {"scan --method S2 --fs -1,0 --amplitude 1 --in %T/good.csv", 2, "spatial_frequency"},
        {"scan --method S2 --fs nan,0 --amplitude 1 --in %T/good.csv", 2, "--fs"},
        {"scan --method S2 --fs wide --amplitude 1 --in %T/good.csv", 2, "--fs|wide"},
        {"scan --method S2 --fs 1,2,3 --amplitude 1 --in %T/good.csv", 2, "--fs|1,2,3"},
        {"scan --method S2 --fs 1, --amplitude 1 --in %T/good.csv", 2, "--fs"},
    };
    check_all_wrong(table, COUNT_OF(table));
}

TEST(an_invalid_limit_of_loading_is_reported) {
    static const char *const limits[] = {"",         "surfaces",   "surfaces=", "surfaces=0",  "surfaces=1.5",
                                         "bytes=-1", "bytes=1e9,", "seconds=0", "seconds=nan", "walls=1"};
    for (size_t i = 0; i < COUNT_OF(limits); i++) {
        process p = RUN_TOOL("run", plate, "--fast", "--budget", limits[i]);
        check_refused(&p, 2, "--budget: expected surfaces=|whole number|seconds=", limits[i]);
    }
}

TEST(an_empty_name_of_a_scene_is_reported) {
    process p = RUN_TOOL("run", "");
    check_refused(&p, 2, "run: expected a .gltf or .glb file, found none", "run ''");
    p = RUN_TOOL("inspect", "");
    check_refused(&p, 2, "inspect: expected a .gltf or .glb file, found none", "inspect ''");
}

TEST(a_number_of_ticks_that_is_no_whole_number_is_reported) {
    static const wrong_line table[] = {{"signal --method T1 --period-ms 3 --ticks 2.5", 2, "--ticks|2.5"}};
    check_all_wrong(table, COUNT_OF(table));
}

TEST(unknown_names_are_reported_with_those_that_are_known) {
    static const wrong_line table[] = {
        {"run %P --fast --method S3 --out %T/out.csv", 2, "S3|S1|S2"},
        {"run %P --fast --method s2", 2, "s2"},
        {"run %P --fast --stroke zigzag --out %T/out.csv", 2,
         "run: stroke: expected line|sweep|circle|press|rest|zigzag"},
        {"run %P --fast --device omega --out %T/out.csv", 2, "omega|fake|touch|falcon|rawhid"},
        {"run %P --fast --device fake:?weight=3 --out %T/out.csv", 2, "weight|mass"},
        {"run %P --fast --device fake:?mass=heavy --out %T/out.csv", 2, "mass|heavy"},
        {"run %P --fast --device fake:mass=1", 2, "fake"},
        {"run %P --fast --surface ceiling --out %T/out.csv", 1, "ceiling|bar 1 mm|bar 2 mm"},
        {"signal --method T4 --period-ms 3 --ticks 6", 2, "T4|T1|T2|T3"},
        {"signal --method S1 --period-ms 3 --ticks 6", 2, "S1|T1"},
        {"scan --method T3 --fs 1000,0 --amplitude 1 --in %T/good.csv", 2, "T3|S1|S2"},
    };
    check_all_wrong(table, COUNT_OF(table));
}

TEST(an_unavailable_device_fails_with_a_sentence) {
    static const wrong_line table[] = {
        {"run %P --fast --device touch --out %T/out.csv", 1, "touch"},
        {"run %P --fast --device touch:Left", 1, "touch"},
        {"run %P --fast --device falcon", 1, "falcon"},
        {"run %P --fast --device rawhid:1:2", 1, "rawhid"},
    };
    check_all_wrong(table, COUNT_OF(table));
}

TEST(a_scene_that_cannot_be_read_is_reported_with_its_name) {
    static const char *const commands[] = {"inspect", "run"};
    write_text(tool_path("text.gltf"), "this is no JSON");
    write_text(tool_path("empty.glb"), "");
    write_text(tool_path("plate.txt"), "{}");
    (void)write_plate("whole.gltf", TAG);
    (void)write_plate("missing.gltf", TAG);
    char *text = read_file(tool_path("missing.gltf"));
    char *buffer = strstr(text, "plate.bin");
    assert_non_null(buffer);
    buffer[0] = 'g';
    write_text(tool_path("missing.gltf"), text);
    free(text);
    (void)write_plate("wrong_key.gltf", "{\"knurl\":{\"version\":1,\"spatial_frequenzy\":[1000,0],\"amplitude\":0.0002,"
                                        "\"stiffness\":400,\"axis\":[1,0,0]}}");
    (void)write_plate(
        "no_stiffness.gltf",
        "{\"knurl\":{\"version\":1,\"spatial_frequency\":[1000,0],\"amplitude\":0.0002,\"axis\":[1,0,0]}}");
    (void)write_plate("negative.gltf", "{\"knurl_spatial_frequency\":1000,\"knurl_amplitude\":-0.0002,"
                                       "\"knurl_stiffness\":400,\"knurl_axis\":[1,0,0]}");
    static const char *const files[][2] = {{"nowhere.glb", "nowhere.glb"},
                                           {"no/such/folder/plate.gltf", "plate.gltf"},
                                           {"text.gltf", "text.gltf"},
                                           {"empty.glb", "empty.glb"},
                                           {"plate.txt", "plate.txt|.gltf|.glb"},
                                           {"missing.gltf", "missing.gltf|glate.bin"},
                                           {"wrong_key.gltf", "wrong_key.gltf|ridges|spatial_frequenzy"},
                                           {"no_stiffness.gltf", "no_stiffness.gltf|stiffness"},
                                           {"negative.gltf", "negative.gltf|amplitude"},
                                           {".", "tool_"}};
    for (size_t i = 0; i < 2 * COUNT_OF(files); i++) {
        char line[256];
        (void)snprintf(line, sizeof line, "%s %%T/%s%s", commands[i % 2], files[i / 2][0],
                       i % 2 ? " --fast --out %T/out.csv" : "");
        const wrong_line w = {line, 1, files[i / 2][1]};
        check_wrong(&w);
    }
}

TEST(run_on_an_untagged_scene_fails_and_hints_at_inspect) {
    (void)write_plate("untagged.gltf", "");
    static const wrong_line table[] = {
        {"run %T/untagged.gltf --fast --out %T/out.csv", 1, "untagged.gltf|tag|inspect"}};
    check_all_wrong(table, COUNT_OF(table));
}

TEST(a_bad_trace_is_reported_with_its_file_line_and_column) {
    static const struct {
        const char *text, *words;
    } traces[] = {{"t,x,y,z\n0,0,0,0\n0.001,0,nan,0\n", "trace.csv|line 3|y|nan"},
                  {"t,x,y,z\n0,0,0,inf\n", "trace.csv|line 2|z|inf"},
                  {"t,x,y,z\n\n0,zero,0,0\n", "trace.csv|line 3|x|zero"},
                  {"t,x,y,z\n0,0,0,0\n0.1,0,0\n", "trace.csv|line 3|z"},
                  {"t,x,y,z\n0,0,0,0\n0.1,,0,0\n", "trace.csv|line 3|x"},
                  {"t,x,y,z\n0,0,0,0\n0.1,0 0,0,0\n", "trace.csv|line 3|x"},
                  {"t,x,y\n0,0,0\n", "trace.csv|line 1|z"},
                  {"0,0,0,0\n0.1,0,0,0\n", "trace.csv|line 1|t"},
                  {"t,x,y,z\n", "trace.csv|row"},
                  {"", "trace.csv"},
                  {"t,x,y,z\n0,0,0,0\n0.2,0,0,0\n0.1,0,0,0\n", "trace.csv|row 3|0.1"},
                  {"t,x,y,z\n0,0,0,0\n0,0,0,0\n", "trace.csv|row 2"},
                  {"t,x,y,z,x\n0,0,0,0,1\n", "trace.csv|line 1|expected one column 'x', found two"},
                  {"t,x,y,z\n-2,0,0,0\n-1,0,0,0\n", "trace.csv|the last from 0 to 86400, found -1"},
                  {"t,x,y,z\n1.79e9,0,0,0\n1.79e9,0,0,0\n", "trace.csv|the last from 0 to 86400, found 1.79e+09"}};
    for (size_t i = 0; i < COUNT_OF(traces); i++) {
        write_text(tool_path("trace.csv"), traces[i].text);
        const wrong_line w = {"run %P --fast --trace %T/trace.csv --out %T/out.csv", 1, traces[i].words};
        check_wrong(&w);
    }
    static const wrong_line table[] = {{"run %P --fast --trace %T/gone.csv --out %T/out.csv", 1, "gone.csv"},
                                       {"run %P --fast --trace %T --out %T/out.csv", 1, "tool_"}};
    check_all_wrong(table, COUNT_OF(table));
}

TEST(a_bad_motion_for_scan_is_reported_with_its_file_line_and_column) {
    static const struct {
        const char *text, *words;
    } motions[] = {{"x,y\n0,0\n0,nan\n", "motion.csv|line 3|y"},
                   {"vx,vy\n0,0\n,0\n", "motion.csv|line 3|vx"},
                   {"vx\n0\n", "motion.csv|line 1|vy"},
                   {"a,b\n0,0\n", "motion.csv|line 1"},
                   {"vx,vy,vy\n0,0,1\n", "motion.csv|line 1|expected one column 'vy', found two"},
                   {"vx,vy\n", "motion.csv|row"},
                   {"", "motion.csv"},
                   {"vx,vy\n0,0\n0,0x\n", "motion.csv|line 3|vy"},
                   {"vx,vy\n1e999,0\n", "motion.csv|line 2|vx"}};
    for (size_t i = 0; i < COUNT_OF(motions); i++) {
        write_text(tool_path("motion.csv"), motions[i].text);
        const wrong_line w = {"scan --method S2 --fs 1000,0 --amplitude 1 --in %T/motion.csv", 1, motions[i].words};
        check_wrong(&w);
    }
    static const wrong_line table[] = {{"scan --method S2 --fs 1000,0 --amplitude 1 --in %T/gone.csv", 1, "gone.csv"}};
    check_all_wrong(table, COUNT_OF(table));
}

TEST(an_output_that_cannot_be_written_is_reported_and_nothing_is_left) {
    static const wrong_line table[] = {{"run %P --fast --seconds 0.1 --out %T/no/such/folder/o.csv", 1, "o.csv"},
                                       {"run %P --fast --seconds 0.1 --out %T", 1, "tool_"}};
    check_all_wrong(table, COUNT_OF(table));
    assert_false(file_exists(tool_path("no")));
}

TEST(an_existing_output_outlives_a_run_that_fails) {
    static const char *const reasons[][2] = {{"--device", "touch"},   {"--method", "S3"}, {"--surface", "ceiling"},
                                             {"--trace", "gone.csv"}, {"--rate", "0"},    {"--stroke", "zigzag"}};
    for (size_t i = 0; i < COUNT_OF(reasons); i++) {
        write_text(tool_path("kept.csv"), "mine\n");
        process p = RUN_TOOL("run", plate, "--fast", "--out", tool_path("kept.csv"), reasons[i][0], reasons[i][1]);
        assert_true(p.exit_code == 1 || p.exit_code == 2);
        check_text(tool_path("kept.csv"), "mine\n");
        process_free(&p);
        assert_int_equal(files_that_end(".part"), 0);
    }
}

/* One line, with any name. */
TEST(a_line_break_in_a_name_does_not_break_the_line) {
    process p = RUN_TOOL("inspect", "two\nlines.glb");
    check_refused(&p, 1, "lines.glb", "a scene's name");
    p = RUN_TOOL("run", plate, "--fast", "--trace", "two\nlines.csv");
    check_refused(&p, 1, "lines.csv", "a trace's name");
    p = RUN_TOOL("run", plate, "--fast", "--two\nlines");
    check_refused(&p, 2, "lines", "an option's name");
    p = RUN_TOOL("fly\naway");
    check_refused(&p, 2, "away", "a command's name");
}

TEST(without_a_command_the_usage_is_printed) {
    SCOPED_PROCESS p = RUN_TOOL(NULL);
    assert_int_equal(p.exit_code, 2);
    assert_int_equal(p.sizes[0], 0);
    assert_non_null(strstr(p.err, "knurl"));
}

/* The tool alone in a folder, as without the library that the studies need. */
TEST(without_the_studies_the_tool_runs_and_tells_what_they_need) {
    char tool[1024];
    (void)snprintf(tool, sizeof tool, "%s", tool_path("knurl"));
    assert_int_equal(link(KNURL_TEST_TOOL, tool), 0);
    process p = run_tool((const char *const[]){tool, "inspect", plate, NULL});
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    p = run_tool((const char *const[]){tool, "study", "signals", "--out", tool_folder, NULL});
    check_refused(&p, 1, "study|knurl_study|was not built|libkissfft-dev", "a study");
    p = run_tool(
        (const char *const[]){tool, "metrics", "--method", "T1", "--period-ms", "5", "--amplitude", "1", NULL});
    check_refused(&p, 1, "metrics|knurl_study|was not built|libkissfft-dev", "metrics");
    assert_false(file_exists(tool_path("signals.csv")));
}

SUITE_FIXTURES(make_folder, remove_folder)
