/* The tool's outputs never replace its inputs, and are complete or absent. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

#include <sys/resource.h>

static void copy_file(const char *from, const char *to) {
    char *bytes = read_file(from);
    struct stat info;
    assert_int_equal(stat(from, &info), 0);
    write_file(to, bytes, (size_t)info.st_size);
    free(bytes);
}

/* A run that is refused, and leaves `kept` (a file that it reads) as it was: byte for byte, the same inode. */
static void check_kept(const char *kept, const char *scene, const char *trace, const char *out) {
    struct stat before;
    struct stat after;
    char *first = read_file(kept);
    assert_int_equal(stat(kept, &before), 0);
    process p = RUN_TOOL("run", scene, "--fast", "--seconds", "0.01", "--out", out, trace ? "--trace" : NULL, trace);
    check_refused(&p, 1, "a file that is read", out);
    char *second = read_file(kept);
    assert_int_equal(stat(kept, &after), 0);
    assert_int_equal(before.st_ino, after.st_ino);
    assert_int_equal(before.st_size, after.st_size);
    assert_memory_equal(first, second, (size_t)before.st_size);
    free(first);
    free(second);
    assert_int_equal(files_that_end(".part"), 0);
}

TEST(a_run_does_not_replace_its_model_under_any_path) {
    char spelled[1100];
    const char *model = tool_path("x.glb");
    copy_file(plate, model);
    (void)snprintf(spelled, sizeof spelled, "%s/./x.glb", tool_folder);
    assert_int_equal(symlink("x.glb", tool_path("link.csv")), 0);
    assert_int_equal(link(model, tool_path("hard.csv")), 0);
    check_kept(model, model, NULL, model);
    check_kept(model, model, NULL, spelled);
    check_kept(model, model, NULL, tool_path("link.csv"));
    check_kept(model, model, NULL, tool_path("hard.csv"));
    check_kept(model, tool_path("x.glb"), NULL, tool_path("x.glb"));
}

TEST(a_run_does_not_replace_its_trace) {
    write_text(tool_path("r.csv"), "t,x,y,z\n0,0,0.001,0\n0.1,0,-0.001,0\n");
    check_kept(tool_path("r.csv"), plate, tool_path("r.csv"), tool_path("r.csv"));
}

TEST(a_run_does_not_replace_the_buffer_of_its_model) {
    const char *model = write_plate("plate.gltf", TAG);
    check_kept(tool_path("plate.bin"), model, NULL, tool_path("plate.bin"));
}

/* Otherwise anyone who can write into the folder could make the tool overwrite any of the user's files. */
TEST(a_link_where_an_unfinished_file_was_expected_is_not_followed) {
    write_text(tool_path("victim"), "mine\n");
    assert_int_equal(symlink("victim", tool_path("out.csv.part")), 0);
    RUN_DONE("run", plate, "--fast", "--seconds", "0.01", "--out", tool_path("out.csv"));
    check_text(tool_path("victim"), "mine\n");
    assert_int_equal(remove(tool_path("out.csv.part")), 0);
}

TEST(an_output_has_the_mode_that_the_umask_gives) {
    struct stat info;
    const mode_t before = umask(027);
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", tool_path("out.csv"));
    (void)umask(before);
    check_done(&p);
    process_free(&p);
    assert_int_equal(stat(tool_path("out.csv"), &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
}

/* Names end at 255 bytes; the unfinished file's is no longer than that either. */
TEST(an_output_may_have_the_longest_name) {
    char name[256];
    memset(name, 'n', sizeof name - 1);
    name[255] = '\0';
    RUN_DONE("run", plate, "--fast", "--seconds", "0.01", "--out", tool_path(name));
    assert_true(file_exists(tool_path(name)));
}

/* So that a program reads only rows. */
TEST(standard_output_takes_the_rows_and_standard_error_the_summary) {
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", "-");
    assert_int_equal(p.exit_code, 0);
    assert_true(strncmp(p.out, RUN_HEADER, strlen(RUN_HEADER)) == 0);
    assert_int_equal(lines_in(p.out), 11);
    assert_null(strstr(p.out, "\"ticks\""));
    assert_non_null(strstr(p.err, "\"ticks\": 10,"));
    process_free(&p);
    assert_false(file_exists("-"));
}

TEST(a_run_does_not_replace_one_of_its_outputs_by_the_other) {
    char other[1100];
    const char *same = tool_path("same");
    (void)snprintf(other, sizeof other, "%s/./same", tool_folder);
    process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", same, "--wav", same);
    check_refused(&p, 2, "expected two outputs", same);
    assert_false(file_exists(same));
    p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", same, "--wav", other);
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "or another output"));
    process_free(&p);
    char *text = read_file(same);
    assert_true(strncmp(text, RUN_HEADER, strlen(RUN_HEADER)) == 0);
    free(text);
    assert_int_equal(files_that_end(".part"), 0);
}

TEST(an_empty_name_of_an_output_is_refused_before_the_run) {
    static const char *const options[] = {"--out", "--wav"};
    for (size_t i = 0; i < COUNT_OF(options); i++) {
        process p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", options[i], "");
        check_refused(&p, 1, "expected the name of a file to write", "''");
    }
}

/* A run without the standard streams that `closed` closes: >&- or 2>&-. */
static process run_closed(const char *closed, const char *device, const char *out) {
    char script[64];
    (void)snprintf(script, sizeof script, "exec \"$0\" \"$@\" %s", closed);
    return run_tool((const char *const[]){"/bin/sh", "-c", script, KNURL_TEST_TOOL, "run", plate, "--fast", "--seconds",
                                          "0.1", "--device", device, "--out", out, NULL});
}

/* Neither a file called "-" nor the output takes a closed stream's place: otherwise the warning that the device is too
 * weak for the walls would be among the rows. */
TEST(closed_standard_streams_are_reported_and_no_file_takes_their_place) {
    process p = run_closed(">&-", "fake", "-");
    check_refused(&p, 1, "-: Bad file descriptor", "--out - >&-");
    assert_false(file_exists("-"));
    p = run_closed(">&-", "fake", tool_path("rows.csv"));
    check_refused(&p, 1, "standard output cannot be written", ">&-");
    p = run_closed("2>&-", "fake:?max_stiffness=100", tool_path("warned.csv"));
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    char *rows = read_file(tool_path("warned.csv"));
    assert_int_equal(strncmp(rows, RUN_HEADER, sizeof RUN_HEADER - 1), 0);
    assert_null(strstr(rows, "knurl"));
    free(rows);
}

/* As `knurl run ... --out /dev/stdout > all.txt`: the link in /dev stays. */
TEST(standard_output_that_is_a_file_is_written_on_not_replaced) {
    const char *const arguments[] = {KNURL_TEST_TOOL, "run",   plate,         "--fast", "--seconds",
                                     "0.01",          "--out", "/dev/stdout", NULL};
    struct stat before;
    struct stat after;
    write_text(tool_path("all.txt"), "");
    assert_int_equal(lstat("/dev/stdout", &before), 0);
    process p = process_start(arguments, tool_path("all.txt"));
    process_finish(&p);
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    assert_int_equal(lstat("/dev/stdout", &after), 0);
    assert_int_equal(before.st_ino, after.st_ino);
    char *text = read_file(tool_path("all.txt"));
    assert_true(strncmp(text, RUN_HEADER, strlen(RUN_HEADER)) == 0);
    assert_int_equal(lines_in(text), 12);
    free(text);
}

TEST(a_fifo_is_written_to_and_stays_one) {
    const char *fifo = tool_path("fifo");
    struct stat info;
    assert_int_equal(mkfifo(fifo, 0600), 0);
    const char *const reader[] = {"/bin/cat", fifo, NULL};
    SCOPED_PROCESS cat = process_start(reader, NULL);
    SCOPED_PROCESS p = RUN_TOOL("run", plate, "--fast", "--seconds", "0.01", "--out", fifo);
    process_finish(&cat);
    check_done(&p);
    assert_int_equal(lines_in(cat.out), 11);
    assert_int_equal(stat(fifo, &info), 0);
    assert_true(S_ISFIFO(info.st_mode));
}

static void pause_ms(long ms) {
    const struct timespec time = {ms / 1000, ms % 1000 * 1000000};
    (void)nanosleep(&time, NULL);
}

static void wait_for_part(void) {
    for (int tries = 0; tries < 1000 && files_that_end(".part") == 0; tries++) {
        pause_ms(10);
    }
    assert_true(files_that_end(".part") > 0);
}

/* The old file stays, and the exit code shows that there is no new one. */
TEST(an_interrupted_run_leaves_no_short_file) {
    static const int signals[] = {SIGINT, SIGTERM};
    const char *const arguments[] = {KNURL_TEST_TOOL,      "run", plate, "--seconds", "60", "--out",
                                     tool_path("out.csv"), NULL};
    write_text(tool_path("out.csv"), "mine\n");
    for (size_t i = 0; i < COUNT_OF(signals); i++) {
        process p = process_start(arguments, NULL);
        wait_for_part();
        pause_ms(200);
        assert_int_equal(kill(p.pid, signals[i]), 0);
        process_finish(&p);
        assert_int_equal(p.exit_code, 128 + signals[i]);
        assert_non_null(strstr(p.err, "interrupted after"));
        assert_non_null(strstr(p.out, "\"ticks\": ")); /* the summary is still printed */
        process_free(&p);
        check_text(tool_path("out.csv"), "mine\n");
        assert_int_equal(files_that_end(".part"), 0);
    }
}

static const int endings[] = {SIGHUP,  SIGQUIT, SIGPIPE, SIGALRM,   SIGUSR1,
                              SIGUSR2, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGTERM};

/* The process ends by the signal, and its unfinished files are gone. */
static void check_ended(const char *const *arguments, int number) {
    const struct rlimit none = {0, 0};
    (void)setrlimit(RLIMIT_CORE, &none);
    (void)signal(number, SIG_DFL); /* the process inherits both */
    process p = process_start(arguments, NULL);
    wait_for_part();
    assert_int_equal(kill(p.pid, number), 0);
    process_finish(&p);
    assert_int_equal(p.signal, number);
    process_free(&p);
    assert_int_equal(files_that_end(".part"), 0);
}

/* SIGTERM ends one by the ramp, see above. */
TEST(a_run_that_a_signal_ends_leaves_nothing) {
    const char *const arguments[] = {
        KNURL_TEST_TOOL,      "run", plate, "--seconds", "60", "--out", tool_path("end.csv"), "--wav",
        tool_path("end.wav"), NULL};
    for (size_t i = 0; i + 1 < COUNT_OF(endings); i++) {
        check_ended(arguments, endings[i]);
    }
    assert_false(file_exists(tool_path("end.csv")) || file_exists(tool_path("end.wav")));
}

TEST(a_run_whose_reader_has_gone_leaves_nothing) {
    char line[2400];
    (void)signal(SIGPIPE, SIG_DFL);
    (void)snprintf(line, sizeof line, "%s run %s --fast --seconds 20 --out - --wav %s | head -1", KNURL_TEST_TOOL,
                   plate, tool_path("p.wav"));
    process p = run_tool((const char *const[]){"/bin/sh", "-c", line, NULL});
    assert_string_equal(p.out, RUN_HEADER);
    process_free(&p);
    assert_int_equal(files_that_end(".part"), 0);
    assert_false(file_exists(tool_path("p.wav")));
}

/* A whole file that cannot have its name is a failure, and leaves nothing. */
TEST(a_name_that_is_taken_meanwhile_is_a_failure) {
    const char *const arguments[] = {KNURL_TEST_TOOL,        "run", plate, "--seconds", "1", "--out",
                                     tool_path("taken.csv"), NULL};
    SCOPED_PROCESS p = process_start(arguments, NULL);
    wait_for_part();
    assert_int_equal(mkdir(tool_path("taken.csv"), 0777), 0);
    process_finish(&p);
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.err, "taken.csv"));
    assert_int_equal(files_that_end(".part"), 0);
}

TEST(a_study_that_a_signal_ends_leaves_nothing) {
    const char *const arguments[] = {KNURL_TEST_TOOL, "study", "gratings", "--out", tool_folder, NULL};
    for (size_t i = 0; i < COUNT_OF(endings); i++) {
        check_ended(arguments, endings[i]);
    }
    assert_false(file_exists(tool_path("gratings.csv")));
}

SUITE_FIXTURES(make_folder, remove_folder)
