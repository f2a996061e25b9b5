/* samples/study/plot.py and samples/draw_run.py: never overwrite the run, and report unreadable input.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

static const char python[] = "/usr/bin/python3";
static const char plotter[] = KNURL_TEST_ASSETS "/../samples/study/plot.py";
static const char drawer[] = KNURL_TEST_ASSETS "/../samples/draw_run.py"; /* without matplotlib */

static int can_plot(void) {
    const char *const arguments[] = {python, "-c",
                                     "import sys, importlib.util as u; sys.exit(not u.find_spec('matplotlib'))", NULL};
    process p = run_tool(arguments);
    process_free(&p);
    return p.exit_code == 0;
}

TEST(a_picture_does_not_replace_the_run_that_it_shows) {
    if (!can_plot()) {
        print_message("skipped: no matplotlib for %s\n", python);
        skip();
    }
    const char *run = tool_path("run.csv");
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.5", "--out", run);
    check_done(&p);
    process_free(&p);
    assert_int_equal(link(run, tool_path("run.png")), 0);
    const char *const outputs[] = {run, tool_path("run.png")};
    for (size_t i = 0; i < COUNT_OF(outputs); i++) {
        char *before = read_file(run);
        const char *const arguments[] = {python, plotter, run, "--out", outputs[i], NULL};
        p = run_tool(arguments);
        assert_int_equal(p.exit_code, 1);
        assert_non_null(strstr(p.err, "a file that is read"));
        process_free(&p);
        char *after = read_file(run);
        assert_string_equal(before, after);
        free(before);
        free(after);
    }
    const char *const good[] = {python, plotter, run, "--out", tool_path("good.png"), NULL};
    p = run_tool(good);
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    assert_true(file_exists(tool_path("good.png")));
    const char *const straight[] = {python, plotter, run, "--out", "/dev/stdout", NULL};
    p = run_tool(straight);
    assert_int_equal(p.exit_code, 0);
    assert_memory_equal(p.out, "\x89PNG", 4);
    process_free(&p);
    assert_int_equal(files_that_end(".part"), 0);
}

/* By a path that leads nowhere, as the link /dev/stdout does if standard output is closed. */
TEST(a_picture_never_replaces_a_file_of_dev) {
    if (!can_plot()) {
        print_message("skipped: no matplotlib for %s\n", python);
        skip();
    }
    static const char code[] = "import sys; sys.path.insert(0, sys.argv[1]); import style\n"
                               "style.replace = lambda figure, out: print('replaced')\n"
                               "try: style.save(None, '/dev/fd/777')\n"
                               "except style.BadInput as error: print(error)";
    static const char studies[] = KNURL_TEST_ASSETS "/../samples/study";
    const char *const arguments[] = {python, "-c", code, studies, NULL};
    SCOPED_PROCESS p = run_tool(arguments);
    assert_non_null(strstr(p.out, "/dev/fd/777: expected a place to write a PNG to, found: No such file"));
}

static process draw_run(const char *run, const char *picture) {
    return run_tool((const char *const[]){python, drawer, run, picture, NULL});
}

TEST(a_drawing_does_not_replace_the_run_that_it_shows) {
    const char *run = tool_path("drawn.csv");
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "1", "--out", run);
    check_done(&p);
    process_free(&p);
    assert_int_equal(link(run, tool_path("drawn.svg")), 0);
    const char *const outputs[] = {run, tool_path("drawn.svg")};
    char *before = read_file(run);
    for (size_t i = 0; i < COUNT_OF(outputs); i++) {
        p = draw_run(run, outputs[i]);
        assert_int_equal(p.exit_code, 1);
        assert_non_null(strstr(p.err, "expected another file than the run"));
        process_free(&p);
        char *after = read_file(run);
        assert_string_equal(before, after);
        free(after);
    }
    free(before);
    p = draw_run(run, tool_path("good.svg"));
    assert_int_equal(p.exit_code, 0);
    assert_non_null(strstr(p.out, "ridges"));
    process_free(&p);
    char *picture = read_file(tool_path("good.svg"));
    assert_int_equal(strncmp(picture, "<svg", 4), 0);
    free(picture);
}

#define ROW "0,0,0,0,0,0,none,0,0,0,0,0,0,0\n"

TEST(a_drawing_of_what_is_no_run_is_refused_with_its_file_and_line) {
    static const struct {
        const char *text, *words;
    } runs[] = {
        {"", "found no column 't'"},
        {"t,x,y,z\n0,0,0,0\n1,0,0,0\n", "found no column 'ft'"},
        {RUN_HEADER, "at least two rows, found 0"},
        {RUN_HEADER ROW, "at least two rows, found 1"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,fast,0,0,0,0\n", "line 3: expected a number"},
        {RUN_HEADER ROW "1,0,0\n", "line 3: expected a number for ft, found nothing"},
        {RUN_HEADER ROW "nan,0,0,0,0,0,none,0,0,0,0,0,0,0\n", "line 3: expected -1e+09 to 1e+09 for t, found nan"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,0,nan,0,0,0\n", "for height, found nan"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,inf,0,0,0,0\n", "line 3: expected 0 to 1e+09 for ft, found inf"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,0,0,-inf,0,0\n", "for fx, found -inf"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,0,0,1e308,0,0\n", "for fx, found 1e308"},
        {RUN_HEADER ROW "1,0,0,0,0,0,none,0,0,-1,0,0,0,0\n", "line 3: expected 0 to 1e+09 for ft, found -1"},
        {RUN_HEADER ROW "0,0,0,0,0,0,none,0,0,0,0,0,0,0\n", "line 3: expected a time after 0 s, found 0"},
        {RUN_HEADER ROW "-1,0,0,0,0,0,none,0,0,0,0,0,0,0\n", "line 3: expected a time after 0 s, found -1"},
        {"\xff\xfe\x01", "found no text"}};
    for (size_t i = 0; i < COUNT_OF(runs); i++) {
        write_text(tool_path("bad.csv"), runs[i].text);
        process p = draw_run(tool_path("bad.csv"), tool_path("bad.svg"));
        assert_int_equal(p.exit_code, 1);
        if (!strstr(p.err, "bad.csv: ") || !strstr(p.err, runs[i].words) || lines_in(p.err) != 1) {
            fail_msg("wanted \"%s\" in one line: %s", runs[i].words, p.err);
        }
        process_free(&p);
        assert_false(file_exists(tool_path("bad.svg")));
    }
    SCOPED_PROCESS p = draw_run(tool_path("gone.csv"), tool_path("bad.svg"));
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "gone.csv: No such file or directory"));
}

SUITE_FIXTURES(make_folder, remove_folder)
