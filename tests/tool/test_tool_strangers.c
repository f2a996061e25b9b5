/* Files and names from strangers: what the tool does not read, does not wait for, and does not put on a terminal.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/tool.h"

static const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";

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

TEST(a_fifo_that_nobody_writes_to_is_not_waited_for) {
    char uri[1200];
    assert_int_equal(mkfifo(tool_path("fifo"), 0600), 0);
    process p = RUN_TOOL("scan", "--method", "S1", "--fs", "1000,0", "--amplitude", "1e-4", "--in", tool_path("fifo"));
    check_says(&p, 1, "expected a header and at least one row, found nothing");
    (void)snprintf(uri, sizeof uri, "rawhid:?geometry=%s", tool_path("fifo"));
    p = RUN_TOOL("run", plate, "--device", uri);
    check_says(&p, 1, "expected a regular file, found a special file");
    assert_int_equal(remove(tool_path("fifo")), 0);
}

TEST(a_file_that_is_no_geometry_is_not_told_on) {
    char uri[1200];
    write_text(tool_path("secret"), "root:$6$salt$hash:19000:0\n");
    (void)snprintf(uri, sizeof uri, "rawhid:?geometry=%s", tool_path("secret"));
    process p = RUN_TOOL("run", plate, "--device", uri);
    assert_null(strstr(p.err, "$6$"));
    check_says(&p, 1, "line 1: expected key = value");
}

/* ESC, a C1 control, an override of the direction of reading, a line end. */
#define NAME_JSON "\\u001b[31m\\u009b31m\\u202egnp.exe\\nknurl: all is well"

TEST(a_name_does_nothing_to_a_terminal) {
    write_text(tool_path("name.gltf"),
               "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0,\"name\":\"" NAME_JSON "\"}],"
               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}],\"extras\":{\"knurl\":{\"version\":1,"
               "\"spatial_frequency\":[1000,0],\"amplitude\":0.02,\"stiffness\":90000,\"axis\":[1,0,0]}}}],"
               "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
               "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
               "\"data:;base64,AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MzD0AAAAA\"}]}");
    for (int inspect = 0; inspect < 2; inspect++) {
        process p = inspect ? RUN_TOOL("inspect", tool_path("name.gltf"))
                            : RUN_TOOL("run", tool_path("name.gltf"), "--fast", "--seconds", "0.2", "--out", "-");
        assert_non_null(strstr(p.err, "[31m")); /* it is told */
        const char *const texts[] = {p.out, p.err};
        for (size_t i = 0; i < 2; i++) {
            assert_null(strchr(texts[i], '\x1b'));
            assert_null(strstr(texts[i], "\xC2\x9B"));
            assert_null(strstr(texts[i], "\xE2\x80\xAE"));
            assert_null(strstr(texts[i], "\nknurl: all is well"));
        }
        process_free(&p);
    }
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

TEST(a_run_that_loads_ends_at_a_signal) {
    static const int numbers[] = {SIGINT, SIGTERM};
    const struct timespec pause = {0, 100000000};
    write_slow_file(tool_path("slow.gltf"));
    for (size_t i = 0; i < COUNT_OF(numbers); i++) {
        process p = process_start((const char *const[]){KNURL_TEST_TOOL, "run", tool_path("slow.gltf"), NULL}, NULL);
        (void)nanosleep(&pause, NULL);
        assert_int_equal(kill(p.pid, numbers[i]), 0);
        process_finish(&p);
        assert_int_equal(p.signal, numbers[i]); /* 130 and 143 to a shell */
        assert_string_equal(p.out, "");
        process_free(&p);
    }
    assert_int_equal(remove(tool_path("slow.gltf")), 0);
}

SUITE_FIXTURES(make_folder, remove_folder)
