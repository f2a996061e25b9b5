/* knurl_experiment as a program: whole sessions, their files, the analysis of answers that are known, refusals.
 * SPDX-License-Identifier: MIT */
#include "experiment_runs.h"
#include "support/close.h"

#define HEADER                                                                                                         \
    "experiment,subject,answers,device,seed,sound,trial,block,period,amplitude,first,second,preferred,rt_s,ticks,"     \
    "force_limit_ticks,above_nyquist_ticks,overruns,restarts,contact_first_s,contact_second_s,softer_ticks,"           \
    "fault_first,fault_second\n"
#define REST  ",1.5,10001,0,0,0,0,0,0,0,none,none\n"
#define GOOD  "1,s1,keyboard,touch,1,yes,1,1,23,1.05,T1,T3,T3" REST
#define GOOD2 "1,s1,keyboard,touch,1,yes,2,1,21,1.05,T3,T1,T1" REST

/* --- sessions --- */

static void check_session(const char *experiment, const char *amplitude, size_t trials) {
    const char *path = tool_path("session.csv");
    const char *again = tool_path("again.csv");
    process p = RUN(experiment, "--fast", "--amplitude", amplitude, "--seed", "5", "--out", path);
    check_done(&p);
    assert_non_null(strstr(p.out, "SIMULATED answers"));
    assert_non_null(strstr(p.out, "trials begun anew: 0"));
    process_free(&p);
    char *first = read_file(path);
    assert_true(strncmp(first, HEADER, strlen(HEADER)) == 0);
    assert_int_equal(lines_in(first), trials + 1);
    size_t simulated = 0;
    for (const char *at = first; (at = strstr(at, ",SIMULATED,fake,5,yes,")) != NULL; at++) {
        simulated++;
    }
    assert_int_equal(simulated, trials);
    p = RUN(experiment, "--fast", "--amplitude", amplitude, "--seed", "5", "--out", again);
    check_done(&p);
    process_free(&p);
    char *second = read_file(again);
    assert_string_equal(first, second);
    p = RUN("analyse", path);
    check_done(&p);
    assert_true(strncmp(p.out, "SIMULATED answers", 17) == 0);
    assert_int_equal(files_that_end(".part"), 0);
    process_free(&p);
    free(first);
    free(second);
    (void)remove(path);
    (void)remove(again);
}

TEST(experiment_1_runs_unattended_to_its_end_and_the_same_again) {
    check_session("1", "as-printed", 78);
}

TEST(experiment_2_runs_unattended_to_its_end_and_the_same_again) {
    check_session("2", "as-printed", 78);
}

TEST(experiment_3_runs_unattended_to_its_end_and_the_same_again) {
    check_session("3", "as-printed", 3);
    check_session("3", "reduced", 3);
}

/* 2 K A = 3.78 N is beyond 3.3 N; a tenth of it is not. Both plates are felt nearly all the time, a minute a pair. */
TEST(experiment_3_counts_what_the_device_cannot_give) {
    for (int reduced = 0; reduced < 2; reduced++) {
        const char *path = tool_path("three.csv");
        process p = RUN("3", "--fast", "--amplitude", reduced ? "reduced" : "as-printed", "--out", path);
        check_done(&p);
        process_free(&p);
        char *csv = read_file(path);
        for (size_t row = 0; row < 3; row++) {
            double cells[24] = {0.0};
            assert_int_equal(csv_row(csv, row, cells, COUNT_OF(cells)), 24);
            assert_int_equal(cells[14], 60000);
            assert_true(reduced ? cells[15] == 0.0 : cells[15] > 0.0);
            assert_true(cells[19] > 29.0 && cells[20] > 29.0);
        }
        free(csv);
        (void)remove(path);
    }
}

TEST(a_lost_device_leaves_no_file) {
    const char *path = tool_path("lost.csv");
    process p = RUN("1", "--fast", "--device", "fake:?lose_at=4", "--out", path);
    check_failed(&p, 1, "lost after 4000 ticks");
    assert_false(file_exists(path));
    assert_int_equal(files_that_end(".part"), 0);
}

TEST(a_hand_that_cannot_hold_still_ends_the_session) {
    process p = RUN("1", "--fast", "--device", "fake:?hand_stiffness=1&hand_damping=0&coulomb=0", "--out",
                    tool_path("soft.csv"));
    check_failed(&p, 1, "left the sphere");
}

TEST(answers_are_never_overwritten) {
    const char *path = tool_path("people.csv");
    write_text(path, HEADER GOOD);
    process p = RUN("3", "--fast", "--out", path);
    check_failed(&p, 1, "people.csv: is there already");
    char *text = read_file(path);
    assert_string_equal(text, HEADER GOOD);
    free(text);
    (void)remove(path);
}

/* --- analysis --- */

/* `ours` of n answers for our method in a cell: n / blocks subjects. */
static void add_cell(char *csv, int experiment, const char *cell, const char *rival, const char *own, int blocks, int n,
                     int ours) {
    for (int i = 0; i < n; i++) {
        char row[160];
        (void)snprintf(row, sizeof row, "%d,s%d,buttons,touch,1,no,%d,%d,%s,%s,%s,%s" REST, experiment, i / blocks,
                       i + 1, 1 + i % blocks, cell, rival, own, i < ours ? own : rival);
        memcpy(csv + strlen(csv), row, strlen(row) + 1);
    }
}

/* In the output's line of a cell these words, with single spaces between, follow the three probabilities. */
static void check_cell(const char *out, const char *cell, const char *verdicts) {
    const char *rest = strstr(out, cell);
    char words[64] = "";
    assert_non_null(rest);
    rest += strlen(cell);
    for (int i = 0; i < 6; i++) {
        rest += strspn(rest, " ");
        const int length = (int)strcspn(rest, " \n");
        const size_t used = strlen(words);
        if (i >= 3) {
            (void)snprintf(words + used, sizeof words - used, "%s%.*s", i > 3 ? " " : "", length, rest);
        }
        rest += length;
    }
    assert_string_equal(words, verdicts);
}

TEST(the_analysis_knows_whom_each_rule_prefers) {
    static char csv[64 * 1024];
    const char *path = tool_path("known.csv");
    (void)snprintf(csv, sizeof csv, HEADER);
    add_cell(csv, 1, "23,2.1", "T1", "T3", 3, 36, 27);
    add_cell(csv, 1, "5,2.1", "T1", "T3", 3, 36, 28);
    add_cell(csv, 1, "3,2.1", "T1", "T3", 3, 36, 29);
    add_cell(csv, 1, "2.5,2.1", "T1", "T3", 3, 36, 8);  /* 28 for T1 */
    add_cell(csv, 3, "0.5,2.7", "S1", "S2", 1, 12, 12); /* the paper's own: 12, 11, 7 */
    add_cell(csv, 3, "1,2.7", "S1", "S2", 1, 12, 11);
    add_cell(csv, 3, "2,2.7", "S1", "S2", 1, 12, 7);
    add_cell(csv, 3, "1,0.27", "S1", "S2", 1, 12, 10);
    write_text(path, csv);
    process p = RUN("analyse", path);
    check_done(&p);
    assert_null(strstr(p.out, "SIMULATED"));
    check_cell(p.out, "23       2.1    no     27   36", "- - -");
    check_cell(p.out, "5       2.1    no     28   36", "T3 T3 -");
    check_cell(p.out, "3       2.1    no     29   36", "T3 T3 T3");
    check_cell(p.out, "2.5       2.1    no      8   36", "T1 T1 -");
    check_cell(p.out, "0.5       2.7    no     12   12", "S2 S2 S2");
    check_cell(p.out, "1       2.7    no     11   12", "S2 S2 S2");
    check_cell(p.out, "2       2.7    no      7   12", "- - -");
    check_cell(p.out, "1      0.27    no     10   12", "S2 - -");
    assert_non_null(strstr(p.out, "needed of 36 trials at 0.05/48: point 28, one-sided 28, two-sided 29\n"));
    assert_non_null(strstr(p.out, "needed of 12 trials at 0.05/3: point 10, one-sided 11, two-sided 11\n"));
    assert_non_null(strstr(p.out, "point: T3 preferred in 2 of 4 cells, T1 in 1\n"));
    assert_non_null(strstr(p.out, "two-sided: T3 preferred in 1 of 4 cells, T1 in 0\n"));
    assert_non_null(strstr(p.out, "subjects: 12;"));
    process_free(&p);
    (void)remove(path);
}

TEST(an_invalid_record_is_refused_with_its_line) {
    static const struct {
        const char *text, *word;
    } bad[] = {
        {"", "expected a header"},
        {HEADER, "at least one row"},
        {"period,amplitude\n" GOOD, "line 1: expected the header"},
        {HEADER GOOD "1,s1,keyboard\n", "line 3: expected 24 cells, found 3"},
        {HEADER GOOD "\n", "line 3: expected 24 cells"},
        {HEADER GOOD GOOD2 "5,s1,keyboard,touch,1,yes,1,1,23,1.05,T1,T3,T3" REST, "line 4: experiment: expected"},
        {HEADER "1,,keyboard,touch,1,yes,1,1,23,1.05,T1,T3,T3" REST, "line 2: subject"},
        {HEADER "1,s1,nobody,touch,1,yes,1,1,23,1.05,T1,T3,T3" REST, "line 2: answers"},
        {HEADER "1,s1,keyboard,touch,1,loud,1,1,23,1.05,T1,T3,T3" REST, "line 2: sound"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,4,23,1.05,T1,T3,T3" REST, "line 2: block"},
        {HEADER "3,s1,keyboard,touch,1,yes,1,2,1,2.7,S1,S2,S2" REST, "line 2: block"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,22,1.05,T1,T3,T3" REST, "line 2: period"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,nan,1.05,T1,T3,T3" REST, "line 2: period"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,23,0.35,T1,T3,T3" REST, "line 2: amplitude"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,23,1.05,T2,T3,T3" REST, "line 2: first"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,23,1.05,T3,T3,T3" REST, "line 2: second"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,23,1.05,T1,T3,T2" REST, "line 2: preferred"},
        {HEADER "1,s1,keyboard,touch,1,yes,1,1,23,1.05,T1,T3,T3,1.5,10001,-1,0,0,0,0,0,0,none,none\n",
         "line 2: force_limit_ticks"},
        {HEADER GOOD GOOD, "line 3: this trial of subject s1"},
        {HEADER GOOD "1,s2,SIMULATED,fake,1,yes,1,1,23,1.05,T1,T3,T3" REST, "line 3: people's answers"}};
    const char *path = tool_path("bad.csv");
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        write_text(path, bad[i].text);
        process p = RUN("analyse", path);
        check_failed(&p, 1, bad[i].word);
    }
    write_text(path, HEADER GOOD);
    process p = RUN("analyse", path, path); /* the same session twice */
    check_failed(&p, 1, "this trial of subject s1");
    (void)remove(path);
    p = RUN("analyse", path);
    check_failed(&p, 1, "bad.csv: cannot be read");
}

TEST(wrong_usage_is_2_and_one_line) {
    static const struct {
        const char *arguments[5], *word;
    } bad[] = {{{"4"}, "expected 1, 2, 3, compare, analyse or power, found '4'"},
               {{"analyse"}, "at least one CSV"},
               {{"1", "--quick"}, "unknown option '--quick'"},
               {{"1", "--seed"}, "after --seed"},
               {{"1", "--seed", "-1"}, "--seed: expected"},
               {{"1", "--seed", "4294967296"}, "--seed: expected"},
               {{"1", "--sound", "loud"}, "--sound: expected"},
               {{"1", "--subject", "a b"}, "--subject: expected"},
               {{"1", "--subject", ""}, "--subject: expected"},
               {{"1", "--amplitude", "reduced"}, "is for gratings"},
               {{"3", "--amplitude", "big"}, "--amplitude: expected"},
               {{"1", "--answers", "guess"}, "--answers: expected"},
               {{"1", "--answers", "buttons"}, "the fake device has none"},
               {{"1", "--fast", "--answers", "keyboard"}, "people answer in real time"},
               {{"3", "--answers", "keyboard"}, "nobody moves the fake device"},
               {{"1", "--fast", "--device", "touch"}, "--fast: expected the fake device"},
               {{"1", "--device", "nix"}, "expected fake, touch"},
               {{"1", "--device", "fake:?mass=x"}, "mass: expected"}};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        const char *const *a = bad[i].arguments;
        process p = RUN(a[0], a[1], a[2], a[3], a[4]);
        check_failed(&p, 2, bad[i].word);
    }
    process p = RUN("1", "--device", "touch");
    check_failed(&p, 1, "libHD.so");
    p = RUN("1", "--fast", "--out", tool_path("no/such/folder.csv"));
    check_failed(&p, 1, "No such file");
    p = RUN("--help");
    check_done(&p);
    assert_non_null(strstr(p.out, "knurl_experiment 1|2|3"));
    process_free(&p);
}

SUITE_FIXTURES(make_folder, remove_folder)
