/* Untrusted names: no effect on a terminal or in a spreadsheet, and distinct from "no contact".
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

#include "csv.h"
#include "json.h"

static const char python[] = "/usr/bin/python3";
static const char drawer[] = KNURL_TEST_ASSETS "/../samples/draw_run.py";

/* ESC, a C1 control, an override of the direction of reading, a tag that cannot be seen, U+180E, a byte order mark, a
 * line end: as JSON has them, and as they are. */
#define NAME_JSON "\\u001b[31m\\u009b31m\\u202egnp.exe\\udb40\\udc41\\u180e\\ufeff\\nknurl: all is well"
#define NAME                                                                                                           \
    "\x1b[31m\xC2\x9B"                                                                                                 \
    "31m\xE2\x80\xAEgnp.exe\xF3\xA0\x81\x81\xE1\xA0\x8E\xEF\xBB\xBF\nknurl: all is well"

/** Two tagged triangles of 0.1 m, `apart` m from one another, the first with this name. */
static const char *write_named(const char *file, const char *json_name, double apart) {
    char text[2048];
    (void)snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0,\"name\":\"%s\"},"
        "{\"mesh\":0,\"name\":\"other\",\"translation\":[%g,0,0]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}],\"extras\":{\"knurl\":{\"version\":1,"
        "\"spatial_frequency\":[1000,0],\"amplitude\":0.02,\"stiffness\":90000,\"axis\":[1,0,0]}}}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":"
        "\"data:;base64,AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MzD0AAAAA\"}]}",
        json_name, apart);
    write_text(tool_path(file), text);
    return tool_path(file);
}

/** Standard output and error hold the name, as text of one line that sends nothing to a terminal. Frees. */
static void check_harmless(process *p, const char *what) {
    static const char *const harmful[] = {"\x1b",         "\r",           "\x7f",
                                          "\xC2\x9B",     "\xE2\x80\xAE", "\xF3\xA0",
                                          "\xE1\xA0\x8E", "\xEF\xBB\xBF", "\nknurl: all is well"};
    const char *const texts[] = {p->out, p->err};
    if (p->signal != 0 || (!strstr(p->out, "[31m") && !strstr(p->err, "[31m"))) {
        fail_msg("%s: the name is not told: %s%s", what, p->out, p->err);
    }
    for (size_t i = 0; i < 2 * COUNT_OF(harmful); i++) {
        if (strstr(texts[i % 2], harmful[i / 2])) {
            fail_msg("%s: character %u of the list is printed: %s", what, (unsigned)(i / 2), texts[i % 2]);
        }
    }
    process_free(p);
}

TEST(a_name_does_nothing_to_a_terminal) {
    const char *near = write_named("near.gltf", NAME_JSON, 0.2);
    const char *far = write_named("far.gltf", NAME_JSON, 10.0);
    const char *trace = tool_path(NAME ".csv");
    write_text(trace, "t,x,y,z\n0,0,0,0\n0.1,0,3,0\n");
    process p = RUN_TOOL("inspect", near);
    check_harmless(&p, "JSON and warnings");
    p = RUN_TOOL("run", near, "--fast", "--seconds", "0.2", "--out", "-");
    check_harmless(&p, "CSV");
    p = RUN_TOOL("run", far, "--fast", "--seconds", "0.2");
    assert_non_null(strstr(p.err, "the workspace is moved to it"));
    check_harmless(&p, "the note on the workspace");
    p = RUN_TOOL("run", near, "--fast", "--trace", trace);
    assert_non_null(strstr(p.err, "are these millimetres?"));
    check_harmless(&p, "the warning of millimetres");
    p = RUN_TOOL("inspect", trace);
    check_harmless(&p, "a path");
}

TEST(a_librarys_path_does_nothing_to_a_terminal) {
    static const char *const variables[][2] = {{"KNURL_HD_LIBRARY", "touch"}, {"KNURL_DHD_LIBRARY", "dhd"}};
    for (size_t i = 0; i < COUNT_OF(variables); i++) {
        assert_int_equal(setenv(variables[i][0], "/nowhere/" NAME ".so", 1), 0);
        process p = RUN_TOOL("devices");
        check_harmless(&p, variables[i][0]);
        p = RUN_TOOL("devices", "--json");
        check_harmless(&p, variables[i][0]);
        p = RUN_TOOL("run", plate, "--device", variables[i][1]);
        check_harmless(&p, variables[i][0]);
        assert_int_equal(unsetenv(variables[i][0]), 0);
    }
}

TEST(a_drawing_does_nothing_to_a_terminal) {
    const char *run = tool_path("named.csv");
    write_text(run, "t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz\n"
                    "0,0,0,0,0,0,\"" NAME "\",0,0,0,0,0,0,0\n0.001,0,0,0,0,0,none,0,0,0,0,0,0,0\n");
    process p = run_tool((const char *const[]){python, drawer, run, tool_path("named.svg"), NULL});
    assert_int_equal(p.exit_code, 0);
    check_harmless(&p, "what was felt");
    p = run_tool((const char *const[]){python, drawer, tool_path(NAME ".csv"), tool_path("named.svg"), NULL});
    check_harmless(&p, "a run that is not there");
    p = run_tool((const char *const[]){python, drawer, run, tool_path("gone/" NAME), NULL});
    check_harmless(&p, "a picture that cannot be written");
}

/* --- JSON --- */

TEST(json_escapes_what_acts_on_a_terminal_and_keeps_the_name) {
    static const struct {
        const char *name, *json;
    } names[] = {{"Gr\xC3\xB6\xC3\x9F"
                  "e \xF0\x9F\x98\x80",
                  "\"Gr\xC3\xB6\xC3\x9F"
                  "e \xF0\x9F\x98\x80\"\n"},
                 {"a\"b\\c\n", "\"a\\\"b\\\\c\\u000a\"\n"},
                 {"\x1b\x7f\xC2\x9B", "\"\\u001b\\u007f\\u009b\"\n"},
                 {"\xE2\x80\xAE\xE1\xA0\x8E\xEF\xBB\xBF", "\"\\u202e\\u180e\\ufeff\"\n"},
                 {"\xF3\xA0\x81\x81", "\"\\udb40\\udc41\"\n"},                 /* U+E0041 */
                 {"\x9B\xC3(\xE2\x80", "\"\\ufffd\\ufffd(\\ufffd\\ufffd\"\n"}, /* no UTF-8 */
                 {"\xC0\xAF\xED\xA0\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd\"\n"}};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        char *text = NULL;
        size_t size = 0;
        json_writer json;
        FILE *stream = open_memstream(&text, &size);
        assert_non_null(stream);
        json_start(&json, stream, 0);
        json_string(&json, NULL, names[i].name);
        fputc('\n', stream);
        assert_int_equal(fclose(stream), 0);
        assert_string_equal(text, names[i].json);
        free(text);
    }
}

/* --- CSV --- */

/** The cell of the surface in a run's second row after the header */
static void first_cell(const char *csv, char *cell, size_t size) {
    const char *line = strchr(csv, '\n');
    assert_non_null(line);
    for (int commas = 0; commas < 6; commas++) {
        line = strchr(line + 1, ',');
        assert_non_null(line);
    }
    (void)snprintf(cell, size, "%.*s", (int)strcspn(line + 1, ",\n"), line + 1);
}

/* See docs/tagging.md: without its first apostrophe, a cell is the name. */
TEST(a_name_is_no_formula_and_no_word_in_csv) {
    static const struct {
        const char *name, *cell;
    } names[] = {{"plate", "plate"},
                 {"", ""},
                 {"none", "'none"},
                 {"None", "None"},
                 {"nonesuch", "nonesuch"},
                 {"=1+1", "'=1+1"},
                 {"+1", "'+1"},
                 {"-1", "'-1"},
                 {"@SUM(1)", "'@SUM(1)"},
                 {" =1", "' =1"},
                 {"\t=1", "' =1"},
                 {"\r=1", "' =1"},
                 {"\xEF\xBC\x9D"
                  "1",
                  "'\xEF\xBC\x9D"
                  "1"},
                 {"'none", "''none"},
                 {"a=b", "a=b"},
                 {"=a,\"b\"", "\"'=a,\"\"b\"\"\""}};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        char *text = NULL;
        size_t size = 0;
        csv_writer csv;
        FILE *stream = open_memstream(&text, &size);
        assert_non_null(stream);
        csv_start(&csv, stream, "surface");
        csv_name(&csv, names[i].name);
        csv_end_row(&csv);
        assert_int_equal(fclose(stream), 0);
        char expected[64];
        (void)snprintf(expected, sizeof expected, "surface\n%s\n", names[i].cell);
        assert_string_equal(text, expected);
        free(text);
    }
}

TEST(a_surface_called_none_can_be_told_from_no_contact) {
    static const struct {
        const char *trace, *cell;
    } runs[] = {{"t,x,y,z\n0,0.03,0.03,-0.001\n0.01,0.03,0.03,-0.001\n", "'none"},
                {"t,x,y,z\n0,0.03,0.03,0.05\n0.01,0.03,0.03,0.05\n", "none"}};
    const char *scene = write_named("none.gltf", "none", 0.2);
    for (size_t i = 0; i < COUNT_OF(runs); i++) {
        char cell[64];
        write_text(tool_path("none.csv"), runs[i].trace);
        SCOPED_PROCESS p = RUN_TOOL("run", scene, "--fast", "--trace", tool_path("none.csv"), "--out", "-");
        first_cell(strchr(p.out, 0x0a) + 1, cell, sizeof cell);
        assert_string_equal(cell, runs[i].cell);
    }
}

TEST(inspect_tells_the_true_name) {
    SCOPED_PROCESS p = RUN_TOOL("inspect", write_named("formula.gltf", "=none", 0.2));
    assert_non_null(strstr(p.out, "\"name\": \"=none\""));
}

SUITE_FIXTURES(make_folder, remove_folder)
