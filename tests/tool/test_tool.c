/* The command-line tool's output, a contract: each command as design.md has it, with values by hand from the equations.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

/* Tags the written plate: 1 mm period along x, 0.2 mm, 400 N/m. */
/* A CSV's header and its rows of numbers; NaN: an empty cell. */
static void check_csv(const char *csv, const char *header, const double *expected, size_t rows, size_t columns) {
    const size_t length = strlen(header);
    assert_true(strncmp(csv, header, length) == 0 && csv[length] == '\n');
    assert_int_equal(lines_in(csv), rows + 1);
    for (size_t row = 0; row < rows; row++) {
        double cells[16] = {0.0};
        assert_int_equal(csv_row(csv, row, cells, COUNT_OF(cells)), columns);
        for (size_t column = 0; column < columns; column++) {
            const double wanted = expected[row * columns + column];
            if (isnan(wanted)) {
                assert_true(isnan(cells[column]));
            } else {
                CHECK_CLOSE(cells[column], wanted, 1e-12 * fmax(1.0, fabs(wanted)));
            }
        }
    }
}

/* --- signal --- */

static void check_signal(const char *method, const char *period, const double *values, size_t count, size_t notes) {
    double expected[2 * 16];
    char ticks[16];
    (void)snprintf(ticks, sizeof ticks, "%d", (int)count);
    SCOPED_PROCESS p = RUN_TOOL("signal", "--method", method, "--period-ms", period, "--amplitude", "1", "--rate",
                                "1000", "--ticks", ticks);
    check_done(&p);
    assert_int_equal(lines_in(p.err), notes);
    for (size_t i = 0; i < count; i++) {
        expected[2 * i] = (double)i;
        expected[2 * i + 1] = values[i];
    }
    check_csv(p.out, "tick,value", expected, count, 2);
}

/* Eq. 7 with N = 3: sqrt(1/2) for two ticks and -sqrt(2) for one. */
TEST(signal_T3_at_3_ms_is_two_small_ticks_up_and_a_large_one_down) {
    const double values[] = {sqrt(0.5), sqrt(0.5), -sqrt(2.0), sqrt(0.5), sqrt(0.5), -sqrt(2.0)};
    check_signal("T3", "3", values, 6, 0);
}

TEST(signal_T1_at_3_ms_samples_the_square_wave) {
    static const double values[] = {1, 1, -1, 1, 1, -1, 1};
    check_signal("T1", "3", values, 7, 0);
}

TEST(signal_T2_at_an_even_period_and_below_two_ticks_is_one_even_wave) {
    static const double four[] = {1, 1, -1, -1, 1, 1, -1, -1};
    static const double two[] = {1, -1, 1, -1};
    check_signal("T2", "4", four, 8, 0);
    check_signal("T2", "1.5", two, 4, 1); /* with a note that two ticks are played */
}

/* Algorithm 3 with Eqs. 3, 4 at N = 3: T1 = 4, T2 = 2, a = 4, b = 2. */
TEST(signal_T2_at_3_ms_mixes_4_and_2) {
    const double a = 4.0 / sqrt(20.0);
    const double b = 2.0 / sqrt(20.0);
    const double values[] = {a + b, a - b, -a + b, -a - b, a + b};
    check_signal("T2", "3", values, 5, 0);
}

TEST(signal_works_in_ticks_at_any_rate) {
    SCOPED_PROCESS p = RUN_TOOL("signal", "--method", "T3", "--period-ms", "1.25", "--amplitude", "2", "--rate", "2000",
                                "--ticks", "6"); /* 2.5 ticks: the mix of Eq. 8, A = 2 */
    const double e = 4.0 / sqrt(13.0);
    const double o = 6.0 / sqrt(13.0);
    const double up = o * sqrt(0.5);
    const double down = o * sqrt(2.0);
    const double expected[] = {0, e + up, 1, -e + up, 2, e - down, 3, -e + up, 4, e + up, 5, -e - down};
    check_done(&p);
    check_csv(p.out, "tick,value", expected, 6, 2);
}

/* --- scan --- */

static void check_scan(const char *method, const char *fs, const char *csv, const double *expected, size_t rows) {
    write_text(tool_path("motion.csv"), csv);
    SCOPED_PROCESS p = RUN_TOOL("scan", "--method", method, "--fs", fs, "--amplitude", "0.001", "--rate", "1000",
                                "--in", tool_path("motion.csv"));
    check_done(&p);
    check_csv(p.out, "tick,height,fs,ft,event", expected, rows, 5);
}

/* 0.4 m/s over 1000 cycles/m: 400 Hz, 2.5 ticks a cycle. Six ticks of Eq. 8, then the next event. */
TEST(scan_S2_at_400_hz_plays_the_six_tick_mix_to_its_end) {
    const double e = 2e-3 / sqrt(13.0);
    const double o = 3e-3 / sqrt(13.0);
    const double mix[6] = {e + o * sqrt(0.5),  -e + o * sqrt(0.5), e - o * sqrt(2.0),
                           -e + o * sqrt(0.5), e + o * sqrt(0.5),  -e - o * sqrt(2.0)};
    double expected[15 * 5];
    char csv[512] = "vx,vy\n";
    for (size_t i = 0; i < 15; i++) {
        const size_t event = i / 6;
        const double row[5] = {(double)i, mix[i % 6], 1000.0, 400.0, (double)event};
        memcpy(&expected[5 * i], row, sizeof row);
        (void)strncat(csv, "0.4,0\n", 8);
    }
    check_scan("S2", "1000,0", csv, expected, 15);
}

/* At 0.25 m/s 4 ticks, at 0.2 m/s 5 (Eq. 7: Tp 3, Tn 2): taken when the event before has ended, and played to the end
 * when the motion stops in it. */
TEST(scan_S2_takes_a_new_period_only_when_an_event_has_ended) {
    const double up = 1e-3 * sqrt(5.0 * 2.0 / (9.0 + 6.0));
    const double down = -1e-3 * sqrt(5.0 * 3.0 / (4.0 + 6.0));
    const double expected[] = {0,   0, 0,     0,    NAN,  1, 1e-3, 1000,  250,  0,   2, 1e-3, 1000, 200,
                               0,   3, -1e-3, 1000, 200,  0, 4,    -1e-3, 1000, 200, 0, 5,    up,   1000,
                               200, 1, 6,     up,   0,    0, 1,    7,     up,   0,   0, 1,    8,    down,
                               0,   0, 1,     9,    down, 0, 0,    1,     10,   0,   0, 0,    NAN};
    check_scan("S2", "1000,0", "vx,vy\n0,0\n0.25,0\n0.2,0\n0.2,0\n0.2,0\n-0.2,0\n0,0\n0,0\n0,0\n0,0\n0,0\n", expected,
               11);
}

TEST(scan_S2_idles_below_1_mm_a_second_and_along_the_ridges) {
    const double expected[] = {0, 0, 1000, 0.9, NAN, 1, 0, 0, 0, NAN, 2, 0, 0, 0, NAN};
    check_scan("S2", "1000,0", "vx,vy\n0.0009,0\n0,0.3\n0,0\n", expected, 3);
}

/* Eq. 11, and velocities as differences, the first 0 wherever it is. x in fifths of a period. */
TEST(scan_S1_looks_the_height_up_at_positions) {
    const double expected[] = {0,    1e-3, 0,    0,    NAN,   1,    1e-3, 1000,  200,  NAN,  2,    -1e-3,
                               1000, 200,  NAN,  3,    -1e-3, 1000, 200,  NAN,   4,    1e-3, 1000, 200,
                               NAN,  5,    1e-3, 1000, 200,   NAN,  6,    -1e-3, 1000, 400,  NAN};
    check_scan("S1", "1000,0", "x,y\n0.003,0\n0.0032,0\n0.0034,0\n0.0036,0\n0.0038,0\n0.004,0\n0.0036,0\n", expected,
               7);
}

/* x_k = x_(k-1) + v_k/rate from 0: the first row is at 0.2 mm already. */
TEST(scan_S1_integrates_velocities_from_zero) {
    const double expected[] = {0,   1e-3, 1000, 200,  NAN,  1,   -1e-3, 1000, 200,  NAN,  2,   -1e-3, 1000,
                               200, NAN,  3,    1e-3, 1000, 200, NAN,   4,    1e-3, 1000, 200, NAN};
    check_scan("S1", "1000,0", "vx,vy\n0.2,0\n0.2,0\n0.2,0\n0.2,0\n0.2,0\n", expected, 5);
}

/* Eqs. 12, 13: f_t = max(1000 x 0.03, 500 x 0.04) = 30 Hz at 0.05 m/s: 600 cycles/m. S1 is the checkerboard. */
TEST(scan_tells_the_spatial_frequency_in_the_direction_of_motion) {
    const double expected[] = {0, 1e-3, 600, 30, NAN};
    check_scan("S1", "1000,500", "vx,vy\n0.03,0.04\n", expected, 1);
}

TEST(scan_finds_its_columns_by_name_in_any_order_among_others) {
    const double expected[] = {0, 1e-3, 1000, 250, 0, 1, 1e-3, 1000, 250, 0};
    check_scan("S2", "1000", " note , vy ,t, vx\r\nfirst,0,0,0.25\r\n\r\nsecond, 0 ,1, 0.25\r\n", expected, 2);
}

/* --- inspect, devices, version --- */

TEST(inspect_tells_each_surface_in_one_line_of_json) {
    SCOPED_PROCESS p = RUN_TOOL("inspect", write_plate("plate.gltf", TAG));
    check_done(&p);
    assert_int_equal(p.err[0], '\0');
    assert_int_equal(lines_in(p.out), 1);
    check_keys(p.out, "surfaces name shape model triangles dropped_triangles bytes material amplitude "
                      "damping spatial_frequency friction method stretch min mean max skipped stiffness "
                      "orientation why model_error in_reach double_sided reversed_twins turned_triangles "
                      "coordinates uneven projection_seams smooth edges hard_edges facet_angle felt_angle");
    CHECK_SAME(json_number_of(p.out, "amplitude"), 0.0002);
    CHECK_SAME(json_number_of(p.out, "stiffness"), 400.0L);
    CHECK_SAME(json_number_of(p.out, "triangles"), 2.0L);
    CHECK_SAME(json_number_of(p.out, "skipped"), 0.0L);
    CHECK_SAME(json_number_of(p.out, "mean"), 1.0L);
    assert_non_null(strstr(p.out, "\"method\": \"bandlimited\""));
    assert_non_null(strstr(p.out, "[1000, 0]"));
}

/* Two triangles that face up, 100 x 100 mm; and each of them turned round. */
static const float sheet[12][3] = {{-0.05F, 0, 0.05F}, {0.05F, 0, 0.05F},   {0.05F, 0, -0.05F},  {-0.05F, 0, 0.05F},
                                   {0.05F, 0, -0.05F}, {-0.05F, 0, -0.05F}, {-0.05F, 0, 0.05F},  {0.05F, 0, -0.05F},
                                   {0.05F, 0, 0.05F},  {-0.05F, 0, 0.05F},  {-0.05F, 0, -0.05F}, {0.05F, 0, -0.05F}};

/* `copies` nodes at places[i] along x, all of one mesh of the first `corners` of a sheet. */
static const char *write_sheets(const float (*from)[3], int corners, const double *places, size_t copies) {
    char nodes[512] = "";
    char list[64] = "";
    char text[2048];
    for (size_t i = 0; i < copies; i++) {
        const size_t used = strlen(nodes);
        const size_t listed = strlen(list);
        (void)snprintf(nodes + used, sizeof nodes - used, "%s{\"name\":\"n%d\",\"mesh\":0,\"translation\":[%g,0,0]}",
                       i > 0 ? "," : "", (int)i, places[i]);
        (void)snprintf(list + listed, sizeof list - listed, "%s%d", i > 0 ? "," : "", (int)i);
    }
    (void)snprintf(text, sizeof text,
                   "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[%s]}],\"nodes\":[%s],"
                   "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                   "\"materials\":[{\"extras\":" TAG "}],"
                   "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"}],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],"
                   "\"buffers\":[{\"uri\":\"sheets.bin\",\"byteLength\":%d}]}",
                   list, nodes, corners, 12 * corners, 12 * corners);
    write_file(tool_path("sheets.bin"), from, (size_t)corners * sizeof *from);
    write_text(tool_path("sheets.gltf"), text);
    return tool_path("sheets.gltf");
}

/* The text after a key of the surface `name`, to the end of the JSON. */
static const char *value_of(const char *json, const char *name, const char *key) {
    char quoted[64];
    (void)snprintf(quoted, sizeof quoted, "\"name\": \"%s\"", name);
    const char *surface = strstr(json, quoted);
    assert_non_null(surface);
    (void)snprintf(quoted, sizeof quoted, "\"%s\": ", key);
    const char *value = surface ? strstr(surface, quoted) : NULL;
    if (!value) {
        fail_msg("no %s of %s in %s", key, name, json);
        return "";
    }
    return value + strlen(quoted);
}

static int is_value(const char *json, const char *name, const char *key, const char *value) {
    return strncmp(value_of(json, name, key), value, strlen(value)) == 0;
}

TEST(inspect_tells_the_model_and_why) {
    SCOPED_PROCESS reduced = RUN_TOOL("inspect", write_plate("plate.gltf", TAG));
    SCOPED_PROCESS full = RUN_TOOL("inspect", tool_path("plate.gltf"), "--full-model");
    check_done(&reduced);
    check_done(&full);
    assert_true(is_value(reduced.out, "plate", "model", "\"plane\""));
    assert_true(is_value(full.out, "plate", "model", "\"mesh+bvh\""));
    assert_true(strncmp(value_of(reduced.out, "plate", "why"), value_of(full.out, "plate", "why"), 12) != 0);
    assert_true(json_number_of(reduced.out, "model_error") <= 1e-9);
    CHECK_SAME(json_number_of(full.out, "model_error"), 0.0L); /* the mesh itself */
}

/* One corner of four a distance d above the plane of the others: no plane comes nearer to all of them than d/4, and
 * that of the others errs by d. */
TEST(inspect_tells_how_far_a_model_is_off) {
    const double d = 4e-7;
    float bent[6][3];
    memcpy(bent, sheet, sizeof bent);
    bent[5][1] = (float)d;
    SCOPED_PROCESS p = RUN_TOOL("inspect", write_sheets((const float (*)[3])bent, 6, (const double[1]){0.0}, 1));
    check_done(&p);
    assert_true(is_value(p.out, "n0", "model", "\"plane"));
    assert_true(json_number_of(p.out, "model_error") > 0.999 * d / 4.0);
    assert_true(json_number_of(p.out, "model_error") < 1.001 * d);
}

TEST(inspect_counts_triangles_in_reversed_pairs_and_calls_them_double_sided) {
    for (int twins = 0; twins < 2; twins++) {
        SCOPED_PROCESS p = RUN_TOOL("inspect", write_sheets(sheet, twins ? 12 : 6, (const double[1]){0.0}, 1));
        check_done(&p);
        CHECK_SAME(json_number_of(p.out, "triangles"), 2.0L);
        CHECK_SAME(json_number_of(p.out, "reversed_twins"), twins ? 2.0L : 0.0L);
        assert_true(is_value(p.out, "n0", "double_sided", twins ? "true" : "false"));
    }
}

/* The workspace's middle is at the middle of all sheets: the sheet there can be touched, those 5 m away
 * cannot; and one whose edge is 1 mm inside the Touch's 160 mm can, 1 mm outside not. */
TEST(inspect_tells_what_a_device_can_reach) {
    const double reach = 0.5 * 0.16 + 0.05; /* m, of a sheet's middle */
    const struct {
        double away;
        const char *expected;
    } cases[] = {{5.0, "false"}, {reach + 0.001, "false"}, {reach - 0.001, "true"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const double places[3] = {-cases[i].away, 0.0, cases[i].away};
        SCOPED_PROCESS p = RUN_TOOL("inspect", write_sheets(sheet, 6, places, 3));
        check_done(&p);
        assert_true(is_value(p.out, "n0", "in_reach", cases[i].expected));
        assert_true(is_value(p.out, "n1", "in_reach", "true"));
        assert_true(is_value(p.out, "n2", "in_reach", cases[i].expected));
    }
}

static void remove_spaces(char *text) {
    char *to = text;
    for (const char *from = text; *from; from++) {
        if (*from != ' ' && *from != '\n') {
            *to++ = *from;
        }
    }
    *to = '\0';
}

TEST(pretty_is_the_same_json_over_several_lines) {
    SCOPED_PROCESS one = RUN_TOOL("inspect", plate);
    SCOPED_PROCESS many = RUN_TOOL("inspect", plate, "--pretty");
    check_done(&one);
    check_done(&many);
    assert_int_equal(lines_in(one.out), 1);
    assert_true(lines_in(many.out) > 20);
    remove_spaces(one.out);
    remove_spaces(many.out);
    assert_string_equal(one.out, many.out);
}

TEST(inspect_of_an_untagged_file_finds_nothing_and_hints) {
    SCOPED_PROCESS p = RUN_TOOL("inspect", write_plate("untagged.gltf", ""));
    check_done(&p);
    assert_true(strncmp(p.out, "{\"surfaces\": []", 15) == 0);
    CHECK_SAME(json_number_of(p.out, "skipped"), 1.0L);
    assert_non_null(strstr(p.err, "knurl_spatial_frequency"));
    assert_int_equal(lines_in(p.err), 1);
}

TEST(devices_are_listed_for_people_and_as_json) {
    static const char *const names[] = {"fake", "touch", "falcon", "rawhid"};
    SCOPED_PROCESS people = RUN_TOOL("devices");
    SCOPED_PROCESS json = RUN_TOOL("devices", "--json");
    check_done(&people);
    check_done(&json);
    assert_int_equal(lines_in(json.out), 1);
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        char quoted[32];
        (void)snprintf(quoted, sizeof quoted, "\"%s\"", names[i]);
        assert_non_null(strstr(people.out, names[i]));
        assert_non_null(strstr(json.out, quoted));
    }
    assert_non_null(strstr(people.out, "hand_stiffness")); /* and how the fake one is set up */
}

TEST(version_and_help_are_no_errors) {
    char expected[64];
    (void)snprintf(expected, sizeof expected, "knurl %d.%d.%d\n", KNURL_VERSION_MAJOR, KNURL_VERSION_MINOR,
                   KNURL_VERSION_PATCH);
    SCOPED_PROCESS version = RUN_TOOL("--version");
    SCOPED_PROCESS help = RUN_TOOL("--help");
    check_done(&version);
    check_done(&help);
    assert_string_equal(version.out, expected);
    assert_non_null(strstr(help.out, "knurl run"));
}

TEST(a_full_disk_does_not_look_like_success) {
    static const char *const few[] = {KNURL_TEST_TOOL, "signal", "--method", "T1", "--period-ms", "3",
                                      "--ticks",       "10",     NULL};
    static const char *const many[] = {KNURL_TEST_TOOL, "signal", "--method", "T1", "--period-ms", "3",
                                       "--ticks",       "100000", NULL};
    if (!file_exists("/dev/full")) {
        print_message("skipped: no /dev/full here\n");
        skip();
    }
    process p = process_start(few, "/dev/full");
    process_finish(&p);
    check_refused(&p, 1, "written", "a few lines to a full disk");
    p = process_start(many, "/dev/full");
    process_finish(&p);
    check_refused(&p, 1, "written", "many lines to a full disk");
}

SUITE_FIXTURES(make_folder, remove_folder)
