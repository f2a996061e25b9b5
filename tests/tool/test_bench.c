/* knurl bench: its output is a contract. How long anything takes is not asserted: that is the machine's.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/tool.h"

/* The contract's cases, in its words. */
static const char *const contract[] = {"empty",
                                       "motion_foaw",
                                       "grating_S1",
                                       "grating_S2",
                                       "grating_bandlimited",

                                       "plane",
                                       "plane_bandlimited",
                                       "plane_foaw",
                                       "plane_smooth",
                                       "plane_friction",
                                       "mesh_1k",
                                       "mesh_1k_bandlimited",
                                       "mesh_1k_smooth",
                                       "mesh_1k_friction",
                                       "mesh_10k",
                                       "mesh_10k_bandlimited",
                                       "mesh_10k_smooth",
                                       "mesh_10k_friction",
                                       "curved_10k",
                                       "mesh_100k",
                                       "mesh_100k_bandlimited",
                                       "mesh_100k_smooth",
                                       "mesh_100k_friction",
                                       "mesh_100k_foaw",
                                       "mesh_1m",
                                       "mesh_1m_bandlimited",
                                       "mesh_1m_smooth",
                                       "mesh_1m_friction",
                                       "mesh_10m",
                                       "surfaces_10k",
                                       "moving_1k",
                                       "crowded",
                                       "corner_2_faces",
                                       "corner_3_faces",
                                       "moving",
                                       "worst_reach_327k",
                                       "worst_reach_2m",
                                       "worst_crowd",
                                       "worst_heap",
                                       "worst_planes",
                                       "two_hips",
                                       "eight_hips",
                                       "moving_1k_two_hips",
                                       "paced_plane",
                                       "paced_plane_thrashed",
                                       "paced_mesh_100k",
                                       "paced_mesh_100k_thrashed"};

/* The object of one case, in one line of JSON; fails the test if it is not there exactly once. */
static const char *only_case(const char *json, const char *name) {
    char quoted[64];
    (void)snprintf(quoted, sizeof quoted, "{\"case\": \"%s\", ", name);
    const char *found = strstr(json, quoted);
    assert_non_null(found);
    assert_null(strstr(found + 1, "{\"case\""));
    return found;
}

/* Every bracket closes the one that is open, outside of texts, and the object ends the line. */
static void check_brackets(const char *json) {
    char open[16] = "";
    size_t depth = 0;
    int in_text = 0;
    for (const char *c = json; *c; c++) {
        if (*c == '"' && (c == json || c[-1] != '\\')) {
            in_text = !in_text;
        } else if (!in_text && (*c == '{' || *c == '[')) {
            assert_true(depth < sizeof open);
            open[depth++] = *c;
        } else if (!in_text && (*c == '}' || *c == ']')) {
            assert_true(depth > 0 && open[depth - 1] == (*c == '}' ? '{' : '['));
            depth--;
            assert_true(depth > 0 || strcmp(c + 1, "\n") == 0);
        }
    }
    assert_true(depth == 0 && !in_text && json[0] == '{' && lines_in(json) == 1);
}

/* All fields of one case: finite, >= 0, in order. */
static void check_case(const char *json, const char *name, double ticks) {
    static const char *const keys[] = {"p50_ns", "p99_ns", "p999_ns", "max_ns", "bytes", "build_ms"};
    const char *object = only_case(json, name);
    double values[COUNT_OF(keys)];
    for (size_t i = 0; i < COUNT_OF(keys); i++) {
        values[i] = json_number_of(object, keys[i]);
        assert_true(isfinite(values[i]) && values[i] >= 0.0);
        assert_true(i == 0 || i > 3 || values[i] >= values[i - 1]);
    }
    CHECK_SAME(json_number_of(object, "ticks"), ticks);
}

/* Runs one case; `contact` is the share of its ticks that touch. */
static void check_run(const char *name, const char *asked, double ticks, double contact) {
    SCOPED_PROCESS p = RUN_TOOL("bench", "--json", "--ticks", asked, "--case", name);
    check_done(&p);
    check_brackets(p.out);
    check_case(p.out, name, ticks);
    CHECK_SAME(json_number_of(p.out, "contact"), contact);
}

TEST(one_case_is_reported_with_all_its_fields) {
    SCOPED_PROCESS p = RUN_TOOL("bench", "--case", "plane", "--json", "--ticks", "2000");
    check_done(&p);
    check_brackets(p.out);
    check_case(p.out, "plane", 2000.0);
    assert_true(isfinite(json_number_of(p.out, "timer_ns")) && json_number_of(p.out, "timer_ns") >= 0.0);
    assert_non_null(strstr(p.out, "\"machine\": \""));
    assert_true(json_number_of(p.out, "bytes") > 0.0);
}

TEST(each_kind_of_case_runs) {
    static const char *const names[] = {"empty", "motion_foaw", "grating_S1", "grating_S2", "grating_bandlimited"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        check_run(names[i], "20", 20.0, 0.0);
    }
}

/* A HIP that had slipped off would be cheap. 600 ticks: there and back once, over every seam. */
TEST(each_scene_is_touched_in_every_tick) {
    static const char *const names[] = {"plane_smooth",
                                        "plane_friction",
                                        "plane_bandlimited",
                                        "plane_foaw",
                                        "mesh_1k",
                                        "mesh_1k_smooth",
                                        "mesh_10k_friction",
                                        "curved_10k",
                                        "surfaces_10k",
                                        "moving_1k",
                                        "crowded",
                                        "corner_2_faces",
                                        "corner_3_faces",
                                        "moving",
                                        "two_hips",
                                        "eight_hips",
                                        "moving_1k_two_hips",
                                        "paced_plane",
                                        "paced_plane_thrashed",
                                        "paced_mesh_100k"};
    for (size_t i = 0; i < COUNT_OF(names); i += SUITE_SANITIZED ? 4 : 1) {
        check_run(names[i], "600", 600.0, 1.0);
    }
}

TEST(a_mesh_tells_its_triangles_and_bytes) {
    SCOPED_PROCESS p = RUN_TOOL("bench", "--json", "--ticks", "1", "--case", "mesh_10k");
    check_done(&p);
    const double triangles = json_number_of(p.out, "triangles");
    CHECK_CLOSE(triangles, 10000.0, 100.0);
    assert_true(json_number_of(p.out, "bytes") > 12.0 * triangles); /* three corners of four bytes at the least */
}

TEST(batches_are_told_beside_single_ticks_and_edits_where_things_move) {
    process p = RUN_TOOL("bench", "--json", "--ticks", "640", "--case", "plane");
    check_done(&p);
    assert_true(json_number_of(p.out, "batch_ns") > 0.0);
    assert_true(json_number_of(p.out, "clock_step_ns") > 0.0);
    assert_non_null(strstr(p.out, "\"version\": \""));
    assert_null(strstr(p.out, "edits_per_s"));
    process_free(&p);
    p = RUN_TOOL("bench", "--json", "--ticks", "640", "--case", "moving_1k");
    check_done(&p);
    assert_true(json_number_of(p.out, "edits_per_s") > 0.0);
    assert_null(strstr(p.out, "batch_ns"));
    process_free(&p);
}

TEST(the_table_has_a_line_a_case) {
    SCOPED_PROCESS p = RUN_TOOL("bench", "--case", "plane", "--ticks", "100");
    check_done(&p);
    assert_int_equal(lines_in(p.out), 3); /* the machine, the columns, the case */
    assert_non_null(strstr(p.out, "\nplane "));
}

TEST(an_unknown_case_is_refused_with_the_list) {
    process p = RUN_TOOL("bench", "--case", "mesh_2k");
    char names[2048] = "";
    for (size_t i = 0; i < COUNT_OF(contract); i++) {
        (void)strncat(names, i > 0 ? ", " : "expected one of ", sizeof names - strlen(names) - 1);
        (void)strncat(names, contract[i], sizeof names - strlen(names) - 1);
    }
    assert_non_null(strstr(p.err, names)); /* all of them, no others */
    check_refused(&p, 2, "--case|empty|paced_mesh_100k_thrashed|found 'mesh_2k'", "an unknown case");
}

TEST(wrong_ticks_are_refused) {
    static const char *const wrong[] = {"0", "-1", "many", "1e9", "nan"};
    for (size_t i = 0; i < COUNT_OF(wrong); i++) {
        process p = RUN_TOOL("bench", "--case", "plane", "--ticks", wrong[i]);
        check_refused(&p, 2, "--ticks|found", wrong[i]);
    }
}

TEST(an_interrupt_ends_it_with_what_there_is) {
    const char *const arguments[] = {KNURL_TEST_TOOL, "bench", "--json", "--case", "paced_plane", NULL};
    SCOPED_PROCESS p = process_start(arguments, NULL);
    const struct timespec while_it_runs = {1, 0}; /* of 5 s */
    (void)nanosleep(&while_it_runs, NULL);
    assert_int_equal(kill(p.pid, SIGINT), 0);
    process_finish(&p);
    assert_int_equal(p.exit_code, 130);
    check_brackets(p.out);
    assert_non_null(strstr(p.err, "interrupted in paced_plane"));
}
