/* Untrusted files: files that the tool does not read or wait for.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/terminal.h"
#include "tool/plate.h"

#include <fcntl.h>

static void check_says(process *p, int code, const char *sentence) {
    assert_int_equal(p->exit_code, code);
    assert_non_null(strstr(p->err, sentence));
    process_free(p);
}

TEST(a_device_is_no_trace) {
    process p = RUN_TOOL("scan", "--method", "S1", "--fs", "1000,0", "--amplitude", "1e-4", "--in", "/dev/zero");
    check_says(&p, 1, "expected a file, found a device");
}

TEST(a_line_without_end_is_no_trace) {
    char *text = malloc(200000);
    assert_non_null(text);
    memset(text, 'x', 200000);
    write_file(tool_path("long.csv"), text, 200000);
    free(text);
    process p =
        RUN_TOOL("scan", "--method", "S1", "--fs", "1000,0", "--amplitude", "1e-4", "--in", tool_path("long.csv"));
    check_says(&p, 1, "line 1: expected at most 65536 bytes");
}

TEST(a_fifo_without_a_writer_is_not_waited_for) {
    char uri[1200];
    assert_int_equal(mkfifo(tool_path("fifo"), 0600), 0);
    process p = RUN_TOOL("scan", "--method", "S1", "--fs", "1000,0", "--amplitude", "1e-4", "--in", tool_path("fifo"));
    check_says(&p, 1, "expected a header and at least one row, found nothing");
    (void)snprintf(uri, sizeof uri, "rawhid:?geometry=%s", tool_path("fifo"));
    p = RUN_TOOL("run", plate, "--device", uri);
    check_says(&p, 1, "expected a regular file, found a special file");
    assert_int_equal(remove(tool_path("fifo")), 0);
}

TEST(a_file_that_is_no_geometry_is_not_quoted) {
    char uri[1200];
    write_text(tool_path("secret"), "root:$6$salt$hash:19000:0\n");
    (void)snprintf(uri, sizeof uri, "rawhid:?geometry=%s", tool_path("secret"));
    process p = RUN_TOOL("run", plate, "--device", uri);
    assert_null(strstr(p.err, "$6$"));
    check_says(&p, 1, "line 1: expected key = value");
}

/* A file that takes a while: seven million numbers that nothing needs. */
static void write_slow_file(const char *path) {
    FILE *file = fopen(path, "w");
    if (!file) {
        fail_msg("%s cannot be written", path);
        return;
    }
    fputs("{\"asset\":{\"version\":\"2.0\"},\"x\":[0", file);
    for (int i = 0; i < 7000000; i++) {
        fputs(",0", file);
    }
    fputs("]}", file);
    assert_int_equal(fclose(file), 0);
}

TEST(the_budget_of_loading_is_an_option) {
    process p = RUN_TOOL("inspect", plate, "--budget", "vertices=11"); /* 4 each of POSITION, NORMAL, TEXCOORD_0 */
    check_says(&p, 1, "options.max_vertices: expected at most 11, found 12");
    p = RUN_TOOL("run", plate, "--fast", "--budget", "triangles=1,seconds=9.5");
    check_says(&p, 1, "options.max_triangles: expected at most 1, found 2");
    RUN_DONE("inspect", plate, "--budget", "surfaces=3,bytes=100000,vertices=36,triangles=6,seconds=60");
    static const char *const wrong[] = {"size=3",
                                        "bytes",
                                        "bytes=",
                                        "bytes=-1",
                                        "bytes=0.5",
                                        "bytes=1,",
                                        "bytes=1 ",
                                        "seconds=0",
                                        "seconds=nan",
                                        "surfaces=4294967296",
                                        "bytes=1,,seconds=1"};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        p = RUN_TOOL("inspect", plate, "--budget", wrong[i]);
        check_refused(&p, 2, "--budget: expected surfaces=", wrong[i]);
    }
}

/* Runs `knurl inspect path` with its standard error on a terminal, which gets `text`. is_slow: it is stopped while it
 * loads, for longer than a load may take without a word. */
static void inspect_on_terminal(const char *path, int is_slow, char *text, size_t size) {
    need_terminal();
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    size_t length = 0;
    if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0) {
        fail_msg("no pseudoterminal can be had");
        return;
    }
    const int slave = open(ptsname(terminal), O_RDWR | O_NOCTTY);
    const int nothing = open("/dev/null", O_WRONLY);
    if (slave < 0 || nothing < 0) {
        fail_msg("the pseudoterminal cannot be opened");
        return;
    }
    const pid_t pid = fork();
    if (pid == 0) {
        (void)dup2(slave, STDERR_FILENO);
        (void)dup2(nothing, STDOUT_FILENO);
        (void)execl(KNURL_TEST_TOOL, "knurl", "inspect", path, (char *)NULL);
        _exit(127);
    }
    (void)close(slave);
    (void)close(nothing);
    if (is_slow) {
        (void)nanosleep(&(struct timespec){0, 50000000}, NULL);
        (void)kill(pid, SIGSTOP);
        (void)nanosleep(&(struct timespec){0, 600000000}, NULL);
        (void)kill(pid, SIGCONT);
    }
    for (ssize_t got = 1; got > 0 && length + 1 < size; length += got > 0 ? (size_t)got : 0) {
        got = read(terminal, text + length, size - 1 - length); /* an error once the other end is closed */
    }
    text[length] = '\0';
    (void)close(terminal);
    int status = 0;
    assert_int_equal(waitpid(pid, &status, 0), pid);
}

TEST(a_terminal_is_shown_how_far_a_long_load_is) {
    char text[8192];
    inspect_on_terminal(plate, 0, text, sizeof text);
    assert_null(strstr(text, "loading"));
    write_slow_file(tool_path("slow.gltf"));
    inspect_on_terminal(tool_path("slow.gltf"), 1, text, sizeof text);
    assert_non_null(strstr(text, "\rloading: "));
    const char *erased = strstr(text, "\r\033[K"); /* before any other output */
    assert_non_null(erased);
    assert_null(strstr(erased + 1, "loading"));
    process p = RUN_TOOL("inspect", tool_path("slow.gltf"));
    assert_null(strstr(p.err, "loading")); /* no terminal */
    process_free(&p);
    assert_int_equal(remove(tool_path("slow.gltf")), 0);
}

TEST(a_run_that_loads_ends_at_a_signal) {
    static const int numbers[] = {SIGINT, SIGTERM};
    const struct timespec pause = {0, 100000000};
    write_slow_file(tool_path("slow.gltf"));
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        SCOPED_PROCESS p =
            process_start((const char *const[]){KNURL_TEST_TOOL, "run", tool_path("slow.gltf"), NULL}, NULL);
        (void)nanosleep(&pause, NULL);
        assert_int_equal(kill(p.pid, numbers[i]), 0);
        process_finish(&p);
        assert_int_equal(p.signal, numbers[i]); /* 130 and 143 to a shell */
        assert_string_equal(p.out, "");
    }
    assert_int_equal(remove(tool_path("slow.gltf")), 0);
}

SUITE_FIXTURES(make_folder, remove_folder)
