/* `knurl verify`: its reports, its answers without a terminal, and arguments that are wrong.
 * SPDX-License-Identifier: MIT */
#include "tool/plate.h"

static size_t count_of(const char *text, const char *word) {
    size_t count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word)) {
        count++;
    }
    return count;
}

TEST(a_simulated_device_gets_a_page_a_json_and_a_response) {
    const char *out = tool_path("report");
    process p = RUN_TOOL("verify", "--simulate", "--mass", "0.05", "--out", out, "--json");
    assert_int_equal(p.exit_code, 0);
    CHECK_CLOSE(json_number_of(p.out, "failed"), 0.0, 0.0);
    CHECK_CLOSE(json_number_of(p.out, "passed"), 21.0, 0.0);
    CHECK_CLOSE(json_number_of(p.out, "not_measured"), 3.0, 0.0); /* the clock, an orientation, a stop */
    process_free(&p);
    char *page = read_file(tool_path("report.html"));
    char *json = read_file(tool_path("report.json"));
    CHECK_CLOSE(json_number_of(json, "passed"), 21.0, 0.0);
    assert_int_equal(count_of(page, "<td class=\"pass\">"), 21);
    assert_int_equal(count_of(page, "<td class=\"open\">"), 3);
    assert_int_equal(count_of(page, "<tr>"), count_of(page, "</tr>"));
    assert_int_equal(count_of(page, "<svg"), count_of(page, "</svg>"));
    assert_int_equal(
        count_of(page, "<script") + count_of(page, "http") + count_of(page, "src=") + count_of(page, "@import"), 0);
    assert_non_null(strstr(page, "prefers-color-scheme: dark"));
    free(page);
    free(json);
    p = RUN_TOOL("inspect", write_plate("plate.gltf", TAG), "--response", tool_path("report.csv"));
    check_done(&p);
    assert_true(json_number_of(p.out, "lowest_gain") < 0.5);
    process_free(&p);
}

/* A device whose positions are coarser than the response needs: no file that --response would refuse. */
TEST(a_response_that_ends_early_is_no_file) {
    process p = RUN_TOOL("verify", "--simulate", "--device", "fake:?preset=falcon", "--only", "response", "--out",
                         tool_path("coarse"));
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    assert_int_equal(files_that_end("coarse.csv"), 0);
    assert_int_equal(files_that_end("coarse.json"), 1);
}

/* A response of an earlier run would be taken for this one's; a file that was given is not touched. */
TEST(an_older_response_goes_and_nothing_measured_is_a_failure) {
    const char *old = tool_path("again.csv");
    write_text(old, "# knurl response 1\nfrequency_hz,gain\n20,1\n500,0.5\n");
    process p = RUN_TOOL("verify", "--simulate", "--only", "response", "--response", old, "--out", tool_path("again"));
    assert_int_equal(p.exit_code, 0);
    process_free(&p);
    assert_int_equal(files_that_end("again.csv"), 1);
    p = RUN_TOOL("verify", "--simulate", "--only", "scale", "--out", tool_path("again"));
    assert_int_equal(p.exit_code, 1);
    assert_non_null(strstr(p.out, "no mass was given: --mass KG"));
    assert_non_null(strstr(p.err, "verify: nothing was measured, for the reasons above"));
    process_free(&p);
    assert_int_equal(files_that_end("again.csv"), 0);
    assert_int_equal(files_that_end("again.html"), 1);
}

TEST(a_file_takes_the_place_of_the_sweep) {
    const char *good = tool_path("good.csv");
    write_text(good, "# knurl response 1\nfrequency_hz,gain\n20,1\n500,0.5\n");
    process p = RUN_TOOL("verify", "--simulate", "--only", "response", "--response", good, "--json");
    assert_int_equal(p.exit_code, 0);
    CHECK_CLOSE(json_number_of(p.out, "passed"), 1.0, 0.0);
    process_free(&p);
    p = RUN_TOOL("verify", "--simulate", "--only", "response", "--response", "none.csv", "--json");
    CHECK_CLOSE(json_number_of(p.out, "not_measured"), 1.0, 0.0);
    assert_non_null(strstr(p.err, "none.csv: cannot be read"));
    process_free(&p);
}

/* Standard input is at its end: nobody is there. */
TEST(without_a_person_steps_that_ask_are_left_out_unless_told_to_go_on) {
    process p = RUN_TOOL("verify", "--only", "rate,noise", "--json");
    assert_int_equal(p.exit_code & ~3, 0); /* of the machine's lateness no test here depends */
    CHECK_CLOSE(json_number_of(p.out, "not_measured"), 1.0, 0.0);
    assert_non_null(strstr(p.out, "\"left out\""));
    process_free(&p);
    p = RUN_TOOL("verify", "--only", "noise", "--yes", "--json");
    CHECK_CLOSE(json_number_of(p.out, "passed"), 1.0, 0.0);
    assert_non_null(strstr(p.err, "at most 1 N"));
    process_free(&p);
}

TEST(a_finding_that_failed_is_exit_code_3) {
    SCOPED_PROCESS p =
        RUN_TOOL("verify", "--only", "noise", "--yes", "--device", "fake:?tremor=0.001", "--out", tool_path("bad"));
    assert_int_equal(p.exit_code, 3);
    char *page = read_file(tool_path("bad.html"));
    assert_non_null(strstr(page, "<p class=\"fail\">noise: noisy encoder"));
    free(page);
}

TEST(wrong_arguments_are_refused_and_nothing_is_written) {
    static char long_uri[1200] = "--device=fake:?seed=";
    memset(long_uri + strlen(long_uri), '1', sizeof long_uri - 1 - strlen(long_uri));
    const struct {
        const char *arguments[3];
        int code;
        const char *says;
    } cases[] = {{{"--only", "rate,wals"}, 2, "unknown step 'wals'"},
                 {{"--skip=,"}, 2, "unknown step ''"},
                 {{"--only=rate", "--skip=rate"}, 2, "leave no step"},
                 {{"--out=reports/"}, 2, "expected a file's name without its end, found 'reports/'"},
                 {{"--simulate", long_uri}, 2, "the URI is too long"},
                 {{"--simulate", "--device=touch"}, 2, "takes a fake device, found --device touch"},
                 {{"--device=fake:?nothing=1"}, 2, "expected key=value"},
                 {{"--mass=5"}, 2, "0.01|0.1"},
                 {{"more"}, 2, "unexpected argument 'more'"},
                 {{"--out=/nowhere/report"}, 1, "/nowhere/report.html"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *const *a = cases[i].arguments;
        process p = i == COUNT_OF(cases) - 1 ? RUN_TOOL("verify", a[0])
                                             : RUN_TOOL("verify", "--out", tool_path("refused"), a[0], a[1]);
        check_refused(&p, cases[i].code, cases[i].says, a[0]);
        assert_int_equal(files_that_end("refused.html") + files_that_end("refused.json"), 0);
    }
}

SUITE_FIXTURES(make_folder, remove_folder)
