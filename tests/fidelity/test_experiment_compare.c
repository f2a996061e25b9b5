/* Experiment 4, any two methods: orders, training, sessions that a crash ends, exclusions, the simulated subjects.
 * SPDX-License-Identifier: MIT */
#include "experiment_runs.h"
#include "support/close.h"

#include "experiment.h"
#include "inference.h"

static exp_design compare(int32_t one, int32_t other) {
    exp_design design;
    assert_int_equal(exp_compare(one, other, &design), TOOL_OK);
    return design;
}

/* --- orders --- */

TEST(every_order_of_every_pair_comes_twice_for_every_subject) {
    const exp_design d = compare(KNURL_METHOD_BANDLIMITED, KNURL_METHOD_S2);
    assert_string_equal(d.names[0], "S2");
    assert_string_equal(d.names[1], "bandlimited");
    for (uint64_t seed = 0; seed < 300; seed++) {
        exp_trial trials[EXP_MAX_TRIALS];
        assert_int_equal(exp_plan(&d, seed, 1, 0, trials), 12);
        for (uint32_t p = 0; p < 3; p++) {
            uint32_t seen[5] = {0};
            uint32_t first = 0;
            for (uint32_t i = 0; i < 12; i++) {
                if (trials[i].period == d.periods[p]) {
                    seen[trials[i].block]++;
                    first += trials[i].methods[0] == d.methods[0];
                    CHECK_SAME(trials[i].amplitude, 0.27);
                    assert_int_not_equal(trials[i].methods[0], trials[i].methods[1]);
                }
            }
            assert_int_equal(first, 2);
            assert_true(seen[1] == 1 && seen[2] == 1 && seen[3] == 1 && seen[4] == 1);
        }
    }
}

TEST(the_order_of_a_pair_s_first_block_is_chance) {
    const exp_design d = compare(KNURL_METHOD_S1, KNURL_METHOD_S2);
    int first[3] = {0};
    for (uint64_t seed = 0; seed < 1200; seed++) {
        exp_trial trials[EXP_MAX_TRIALS];
        (void)exp_plan(&d, seed, 1, 0, trials);
        for (uint32_t i = 0; i < 3; i++) {
            const int p = trials[i].period < 0.75 ? 0 : trials[i].period < 1.5 ? 1 : 2;
            first[p] += trials[i].methods[0] == d.methods[0];
        }
    }
    for (int p = 0; p < 3; p++) {
        assert_true(abs(first[p] - 600) < 70); /* 4 sigma */
    }
}

TEST(training_has_each_fault_on_either_side_and_with_either_method) {
    const exp_design d = compare(KNURL_METHOD_S1, KNURL_METHOD_BANDLIMITED);
    for (uint64_t seed = 0; seed < 50; seed++) {
        exp_trial trials[EXP_MAX_TRIALS];
        int seen[2][4] = {{0}};
        assert_int_equal(exp_plan(&d, seed, 1, 1, trials), 18);
        for (uint32_t i = 0; i < EXP_TRAINING; i++) {
            const int side = trials[i].faults[1] != EXP_GOOD;
            assert_int_equal(trials[i].block, 0);
            assert_int_equal(trials[i].faults[!side], EXP_GOOD);
            assert_int_equal(trials[i].methods[side], d.methods[side]);
            assert_true(exp_is_right(&d, &trials[i], !side));
            assert_false(exp_is_right(&d, &trials[i], side));
            seen[side][trials[i].faults[side]]++;
        }
        for (int side = 0; side < 2; side++) {
            assert_true(seen[side][EXP_STEADY] == 1 && seen[side][EXP_ROUGH] == 1 && seen[side][EXP_PUSH] == 1);
        }
    }
}

/* T1's net force is A/N, at 2.5 ticks A/5: 3 and 5 ticks and the mix are the worst of Experiment 1 (2.5 ms' progression
 * has 3 ms in it). */
TEST(training_takes_the_worst_three_of_each_intensity) {
    exp_trial trials[EXP_MAX_TRIALS];
    double periods[2] = {0.0, 0.0};
    uint32_t ours_first = 0;
    assert_int_equal(exp_plan(exp_design_of(1), 3, 0, 1, trials), 78);
    for (uint32_t i = 0; i < EXP_TRAINING; i++) {
        assert_int_equal(trials[i].block, 0);
        periods[trials[i].amplitude == 2.10] += trials[i].period * trials[i].period;
        ours_first += trials[i].methods[0] == KNURL_WAVE_T3;
    }
    CHECK_SAME(periods[0], 2.5L * 2.5L + 9.0L + 25.0L);
    CHECK_SAME(periods[1], 2.5L * 2.5L + 9.0L + 25.0L);
    assert_int_equal(ours_first, 3);
}

/* --- a session that does not end --- */

static void check_same_files(const char *a, const char *b) {
    char *first = read_file(a);
    char *second = read_file(b);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void session(const char *path, const char *note) {
    SCOPED_PROCESS p = RUN("compare", "S1", "S2", "--fast", "--seed", "9", "--out", path);
    assert_int_equal(p.exit_code, 0);
    assert_true(note ? strstr(p.err, note) != NULL : p.sizes[1] == 0);
}

TEST(a_session_goes_on_after_its_last_trial) {
    const char *whole = tool_path("whole.csv");
    const char *part = tool_path("part.csv");
    session(whole, NULL);
    char *text = read_file(whole);
    assert_int_equal(lines_in(text), 19);
    for (int rows = 1; rows < 18; rows += 4) {
        char *end = text;
        for (int i = 0; i <= rows; i++) {
            end = strchr(end, '\n') + 1;
        }
        char note[64];
        (void)snprintf(note, sizeof note, "going on with trial %d of 18", rows + 1);
        write_file(part, text, (size_t)(end - text));
        session(part, note);
        check_same_files(part, whole);
    }
    free(text);
    (void)remove(whole);
    (void)remove(part);
}

static void wait_for_file(const char *path) {
    const struct timespec pause = {0, 500000L};
    for (int i = 0; i < 20000 && !file_exists(path); i++) {
        (void)nanosleep(&pause, NULL);
    }
}

/* Killed at any moment: whole rows or no file, and the same answers in the end. */
TEST(a_killed_session_has_whole_rows_and_goes_on) {
    const char *whole = tool_path("whole.csv");
    const char *cut = tool_path("cut.csv");
    size_t between = 0;
    session(whole, NULL);
    for (int round = 0; round < 4; round++) {
        const struct timespec pause = {0, 2000000L * round};
        const char *const arguments[] = {
            KNURL_TEST_EXPERIMENT, "compare", "S1", "S2", "--fast", "--seed", "9", "--out", cut, NULL};
        process p = process_start(arguments, NULL);
        wait_for_file(cut);
        (void)nanosleep(&pause, NULL);
        (void)kill(p.pid, SIGKILL);
        process_finish(&p);
        process_free(&p);
        if (file_exists(cut)) {
            char *text = read_file(cut);
            const size_t lines = lines_in(text);
            assert_true(lines >= 2 && text[strlen(text) - 1] == '\n');
            between += lines < 19;
            free(text);
            p = RUN("analyse", cut);
            check_done(&p);
            process_free(&p);
        }
        p = RUN("compare", "S1", "S2", "--fast", "--seed", "9", "--out", cut);
        assert_int_equal(p.exit_code, 0);
        process_free(&p);
        check_same_files(cut, whole);
        (void)remove(cut);
    }
    print_message("killed between two trials: %u of 4\n", (unsigned)between);
    (void)remove(whole);
}

TEST(people_s_answers_are_only_gone_on_with_by_their_own_session) {
    const char *path = tool_path("people.csv");
    write_text(path, "experiment,subject,answers,device,seed,sound,trial,block,period,amplitude,first,second,preferred,"
                     "rt_s,ticks,force_limit_ticks,above_nyquist_ticks,overruns,restarts,contact_first_s,"
                     "contact_second_s,softer_ticks,fault_first,fault_second\n"
                     "4,test,keyboard,touch,8,yes,1,1,1,0.27,S1,S2,S2,1,30000,0,0,0,0,9,9,0,none,none\n");
    process p = RUN("compare", "S1", "S2", "--fast", "--seed", "9", "--out", path);
    check_failed(&p, 1, "neither an unfinished part of this session");
    (void)remove(path);
}

/* Its rows name the device, in as many bytes as its URI has. */
TEST(a_session_goes_on_with_its_own_device_only_however_long_its_name) {
    const char *path = tool_path("device.csv");
    char uri[1000] = "fake:?seed=1";
    while (strlen(uri) < 900) {
        const size_t used = strlen(uri);
        (void)snprintf(uri + used, sizeof uri - used, "&seed=1");
    }
    const char *const devices[] = {uri, uri, "fake"}; /* begun, gone on with, and begun anew: answers are simulated */
    for (size_t i = 0; i < COUNT_OF(devices); i++) {
        process p = RUN("1", "--fast", "--seed", "9", "--device", devices[i], "--out", path);
        assert_int_equal(p.exit_code, 0);
        process_free(&p);
        char *text = read_file(path);
        size_t rows = 0;
        for (const char *at = strchr(text, '\n') + 1; *at; at = strchr(at, '\n') + 1, rows++) {
            const char *named = strstr(at, ",SIMULATED,");
            assert_non_null(named);
            assert_int_equal(strncmp(named + 11, devices[i], strlen(devices[i])), 0);
            assert_int_equal(named[11 + strlen(devices[i])], ',');
        }
        assert_true(rows >= 72);
        char *last = strrchr(text, '\n'); /* all but the last row */
        *last = '\0';
        *(strrchr(text, '\n') + 1) = '\0';
        write_text(path, text);
        free(text);
    }
    (void)remove(path);
}

/* As an editor may leave it. */
TEST(a_file_whose_last_line_has_no_end_is_gone_on_with) {
    const char *whole = tool_path("ended.csv");
    const char *cut = tool_path("unended.csv");
    session(whole, NULL);
    char *text = read_file(whole);
    char *end = text;
    for (int line = 0; line < 5; line++) {
        end = strchr(end, '\n') + 1;
    }
    end[-1] = 0;
    write_text(cut, text);
    session(cut, "going on with trial 5 of 18");
    check_same_files(cut, whole);
    free(text);
    (void)remove(cut);
    (void)remove(whole);
}

TEST(a_session_interrupted_in_its_first_trial_ends_with_130_and_writes_no_file) {
    const char *path = tool_path("long.csv");
    const char *const arguments[] = {KNURL_TEST_EXPERIMENT, "compare", "S1",    "S2", "--answers", "simulated",
                                     "--training",          "no",      "--out", path, NULL};
    const struct timespec pause = {0, 300000000L};
    SCOPED_PROCESS p = process_start(arguments, NULL);
    (void)nanosleep(&pause, NULL);
    (void)kill(p.pid, SIGINT);
    process_finish(&p);
    assert_int_equal(p.exit_code, 130);
    assert_false(file_exists(path));
}

/* By name, which the records keep. */
TEST(a_method_of_one_s_own_can_be_compared_and_analysed) {
    const char *path = tool_path("own.csv");
    SCOPED_PROCESS p = RUN("compare", "triangle", "S2", "--fast", "--seed", "9", "--out", path);
    assert_int_equal(p.exit_code, 0);
    SCOPED_PROCESS found = RUN("analyse", path);
    assert_int_equal(found.exit_code, 0);
    assert_non_null(strstr(found.out, "S2 against triangle: 12 trials"));
}

TEST(a_comparison_names_the_methods) {
    process p = RUN("compare", "S1", "T3", "--fast");
    check_failed(&p, 2, "expected S1, S2, bandlimited or triangle, found 'T3'");
    p = RUN("compare", "S1", "S1", "--fast");
    check_failed(&p, 2, "twice");
    p = RUN("compare", "S1");
    check_failed(&p, 2, "two methods");
}

/* --- exclusions --- */

static exp_record row(const char *subject, uint32_t block, uint32_t number, int32_t side) {
    exp_record r;
    memset(&r, 0, sizeof r);
    r.experiment = EXP_COMPARE;
    (void)snprintf(r.subject, sizeof r.subject, "%s", subject);
    r.number = number;
    r.trial.block = block;
    r.trial.period = block ? 1.0 : EXP_TRAINING_MM;
    r.trial.amplitude = 0.27;
    r.trial.methods[0] = KNURL_METHOD_S1;
    r.trial.methods[1] = KNURL_METHOD_S2;
    r.trial.faults[1] = block ? EXP_GOOD : EXP_PUSH;
    r.side = side;
    r.ticks = 30000.0;
    r.contact_s[0] = r.contact_s[1] = 10.0;
    return r;
}

/* Six trials of training with `wrong` wrong answers, and ten trials of which `second` chose the second. */
static size_t add_subject(exp_record *rows, const char *subject, uint32_t wrong, uint32_t second) {
    for (uint32_t i = 0; i < 16; i++) {
        rows[i] = row(subject, i < 6 ? 0 : 1, i + 1, i < 6 ? i < wrong : i - 6 < second);
    }
    return 16;
}

TEST(subjects_and_trials_are_excluded_by_the_rules_alone) {
    static exp_record rows[80];
    exp_records records = {rows, 0, COUNT_OF(rows)};
    records.count += add_subject(rows + records.count, "good", 1, 5);
    records.count += add_subject(rows + records.count, "untaught", 2, 5);
    records.count += add_subject(rows + records.count, "onesided", 0, 10);
    records.count += add_subject(rows + records.count, "nearly", 0, 9);
    records.count += add_subject(rows + records.count, "half", 0, 5);
    rows[6].contact_s[1] = 2.9;
    rows[7].overruns = 31.0;
    rows[8].force_limit_ticks = 301.0;
    rows[9].softer_ticks = 301.0;
    rows[10].contact_s[0] = 3.0;
    rows[10].overruns = 30.0;
    rows[10].force_limit_ticks = rows[10].softer_ticks = 300.0;
    rows[64].trial.block = 1; /* "half" lacks one trial of the training */
    rows[64].trial.faults[1] = EXP_GOOD;
    exp_exclude(&records);
    for (size_t i = 0; i < records.count; i++) {
        const int wanted = (i >= 6 && i <= 9) || i / 16 == 1 || i / 16 == 2 || i / 16 == 4;
        if (rows[i].excluded != wanted) {
            fail_msg("row %u of %s: excluded %d", (unsigned)(i % 16), rows[i].subject, rows[i].excluded);
        }
    }
}

/* 3 of 12 wrong: more than one in six, whether the training was had once or before each session. */
TEST(a_second_training_is_held_to_the_same_share_of_right_answers) {
    static exp_record rows[64];
    exp_records records = {rows, 0, COUNT_OF(rows)};
    records.count += add_subject(rows + records.count, "right", 1, 5);
    records.count += add_subject(rows + records.count, "right", 1, 5);
    records.count += add_subject(rows + records.count, "wrong", 1, 5);
    records.count += add_subject(rows + records.count, "wrong", 2, 5);
    exp_exclude(&records);
    for (size_t i = 0; i < records.count; i++) {
        assert_int_equal(rows[i].excluded, i >= 32);
    }
}

/* --- simulated subjects: no evidence about people, but of the whole chain --- */

TEST(simulated_subjects_answer_by_their_formula_and_the_analysis_counts_them) {
    enum { SUBJECTS = 6 };
    static const double periods[3] = {0.5, 1.0, 2.0};
    const char *paths[SUBJECTS];
    static char kept[SUBJECTS][1024];
    for (int i = 0; i < SUBJECTS; i++) {
        char subject[16];
        (void)snprintf(subject, sizeof subject, "s%d", i);
        (void)snprintf(kept[i], sizeof kept[i], "%s", tool_path(subject));
        paths[i] = kept[i];
        SCOPED_PROCESS p = RUN("compare", "S2", "bandlimited", "--fast", "--subject", subject, "--out", paths[i]);
        check_done(&p);
        assert_non_null(strstr(p.out, "SIMULATED answers"));
    }
    process p = RUN("analyse", paths[0], paths[1], paths[2], paths[3], paths[4], paths[5]);
    check_done(&p);
    assert_true(strncmp(p.out, "SIMULATED answers", 17) == 0);
    assert_null(strstr(p.out, "excluded"));
    for (int i = 0; i < 3; i++) {
        char cell[64];
        unsigned m = 0;
        const double difference = exp_grating_badness(KNURL_METHOD_S2, periods[i], 0.27) -
                                  exp_grating_badness(KNURL_METHOD_BANDLIMITED, periods[i], 0.27);
        const double share = 1.0 / (1.0 + exp(-difference / 0.1));
        const double spread = sqrt(24.0 * share * (1.0 - share));
        (void)snprintf(cell, sizeof cell, "%9g      0.27   yes", periods[i]);
        const char *line = strstr(p.out, cell);
        assert_non_null(line);
        m = (unsigned)strtoul(line + strlen(cell), NULL, 10);
        CHECK_CLOSE(m, 24.0 * share, 4.0 * spread + 0.5);
    }
    process_free(&p);
    for (int i = 0; i < SUBJECTS; i++) {
        (void)remove(paths[i]);
    }
}

/* The formula's own parts: no net force and no false tone from a method that keeps step. S1 pushes and aliases. */
TEST(the_simulated_badness_of_a_grating_orders_s1_last) {
    for (double period = 0.5; period <= 2.0; period *= 2.0) {
        assert_true(exp_grating_badness(KNURL_METHOD_BANDLIMITED, period, 0.27) <
                    exp_grating_badness(KNURL_METHOD_S1, period, 0.27));
    }
    CHECK_CLOSE(exp_grating_badness(KNURL_METHOD_BANDLIMITED, 4.0, 0.27), 0.0L, 0.1L);
}

SUITE_FIXTURES(make_folder, remove_folder)
