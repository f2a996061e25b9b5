/* The tool explains itself: help per command, near misses, a man page and completions from one table; inspect --check;
 * messages for traces in other formats. SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/suite.h"
#include "tool/plate.h"

static const char *const commands[] = {"inspect", "run", "signal", "metrics", "scan", "study", "bench", "devices"};

static void check_has(const char *text, const char *part) {
    if (!strstr(text, part)) {
        fail_msg("expected '%s' in: %s", part, text);
    }
}

TEST(each_command_has_a_help_of_its_own) {
    for (size_t i = 0; i < COUNT_OF(commands); i++) {
        char usage[64];
        (void)snprintf(usage, sizeof usage, "usage: knurl %s", commands[i]);
        process p[] = {RUN_TOOL("help", commands[i]), RUN_TOOL(commands[i], "--help"), RUN_TOOL(commands[i], "-h")};
        for (size_t k = 0; k < COUNT_OF(p); k++) {
            assert_int_equal(p[k].exit_code, 0);
            check_has(p[k].out, usage);
            assert_string_equal(p[k].out, p[0].out);
        }
        for (size_t k = 0; k < COUNT_OF(p); k++) {
            process_free(&p[k]);
        }
    }
}

/* Every option that completion offers is one that the command takes: it complains of anything but its name. */
TEST(completion_offers_what_commands_take) {
    SCOPED_PROCESS script = RUN_TOOL("completion", "bash");
    size_t tried = 0;
    for (size_t i = 0; i < COUNT_OF(commands); i++) {
        char label[64];
        (void)snprintf(label, sizeof label, "-*:%s) words='", commands[i]);
        const char *word = strstr(script.out, label);
        assert_non_null(word);
        word += strlen(label);
        while (*word == '-') {
            char option[64];
            (void)snprintf(option, sizeof option, "%.*s", (int)strcspn(word, " '"), word);
            word += strlen(option) + (word[strlen(option)] == ' ');
            if (strcmp(option, "--help") != 0) {
                process p = RUN_TOOL(commands[i], option, "--no-such-option");
                assert_int_equal(p.exit_code, 2);
                char unknown[96];
                (void)snprintf(unknown, sizeof unknown, "unknown option '%s'", option);
                assert_null(strstr(p.err, unknown));
                process_free(&p);
                tried++;
            }
        }
    }
    assert_true(tried >= 35);
}

/* bash's completions for the last word of a line. */
static process complete(const char *words) {
    char script[2048];
    (void)snprintf(script, sizeof script,
                   "source <('%s' completion bash); COMP_WORDS=(%s); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); "
                   "_knurl; echo \"${COMPREPLY[*]}\"",
                   KNURL_TEST_TOOL, words);
    return run_tool((const char *const[]){"/bin/bash", "-c", script, NULL});
}

/* Nothing offered: bash's default, files. */
TEST(completion_offers_values_where_there_are_some_and_files_elsewhere) {
    static const struct {
        const char *words, *offered;
    } table[] = {{"knurl run ''", "\n"},
                 {"knurl run a.glb --trace ''", "\n"},
                 {"knurl run a.glb --out -", "--out"}, /* an option may follow by mistake: options are offered */
                 {"knurl run a.glb --method ''", "S1 S2 "},
                 {"knurl run a.glb --method = ba", "bandlimited\n"},
                 {"knurl run a.glb --method =", "S1 S2 "},
                 {"knurl scan --method S", "S1 S2\n"},
                 {"knurl run a.glb --stroke s", "sweep\n"},
                 {"knurl run --fa", "--fast\n"},
                 {"knurl signal --method ''", "T1 T2 T3\n"},
                 {"knurl bench --case paced_pl", "paced_plane"},
                 {"knurl verify --only wa", "wall\n"},
                 {"knurl tag a.glb --material ''", "\n"},
                 {"knurl tag a.glb --preset cordu", "corduroy corduroy_fine\n"},
                 {"knurl run a.glb --device ''", "fake touch falcon rawhid serial dhd inverse3\n"},
                 {"knurl study tr", "tradeoff tracking transitions\n"},
                 {"knurl help insp", "inspect\n"},
                 {"knurl completion ''", "bash zsh fish\n"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        SCOPED_PROCESS p = complete(table[i].words);
        if (strchr(table[i].offered, '\n') ? strcmp(p.out, table[i].offered) != 0 : !strstr(p.out, table[i].offered)) {
            fail_msg("%s: expected '%s', found '%s' %s", table[i].words, table[i].offered, p.out, p.err);
        }
    }
}

TEST(man_page_and_completions_name_every_command) {
    SCOPED_PROCESS man = RUN_TOOL("man");
    SCOPED_PROCESS zsh = RUN_TOOL("completion", "zsh");
    SCOPED_PROCESS fish = RUN_TOOL("completion", "fish");
    for (size_t i = 0; i < COUNT_OF(commands); i++) {
        char heading[64];
        (void)snprintf(heading, sizeof heading, "\n.SH \"knurl %s\"\n", commands[i]);
        check_has(man.out, heading);
        check_has(zsh.out, commands[i]);
        check_has(fish.out, commands[i]);
    }
    check_has(fish.out, "-a \"help man completion\"");
    assert_memory_equal(zsh.out, "#compdef knurl\n", 15); /* for a folder in zsh's fpath */
}

TEST(near_misses_are_guessed) {
    static const char *const table[][3] = {{"runn", NULL, "'run'"},          {"inspcet", NULL, "'inspect'"},
                                           {"help", "devces", "'devices'"},  {"run", "--sekonds", "'--seconds'"},
                                           {"run", "--fasst", "'--fast'"},   {"inspect", "--prety", "'--pretty'"},
                                           {"bench", "--jsn", "'--json'"},   {"scan", "--methid=S1", "'--method'"},
                                           {"signal", "--tick", "'--ticks'"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        SCOPED_PROCESS p = run_tool((const char *const[]){KNURL_TEST_TOOL, table[i][0], table[i][1], NULL});
        char guess[64];
        (void)snprintf(guess, sizeof guess, "did you mean %s?", table[i][2]);
        assert_int_equal(p.exit_code, 2);
        check_has(p.err, guess);
    }
    SCOPED_PROCESS far = RUN_TOOL("dance");
    assert_null(strstr(far.err, "did you mean"));
}

TEST(a_value_may_follow_an_equals_sign) {
    SCOPED_PROCESS apart = RUN_TOOL("signal", "--method", "T1", "--period-ms", "3", "--ticks", "6");
    SCOPED_PROCESS joined = RUN_TOOL("signal", "--method=T1", "--period-ms=3", "--ticks=6");
    SCOPED_PROCESS flag = RUN_TOOL("devices", "--json=yes");
    assert_int_equal(joined.exit_code, 0);
    assert_string_equal(joined.out, apart.out);
    assert_int_equal(flag.exit_code, 2);
    check_has(flag.err, "--json takes no value, found 'yes'");
}

TEST(inspect_checks_for_build_pipelines) {
    SCOPED_PROCESS good = RUN_TOOL("inspect", "--check", plate);
    assert_int_equal(good.exit_code, 0);
    write_text(tool_path("untagged.gltf"), "{\"asset\": {\"version\": \"2.0\"}}");
    SCOPED_PROCESS untagged = RUN_TOOL("inspect", "--check", tool_path("untagged.gltf"));
    assert_int_equal(untagged.exit_code, 3);
    check_has(untagged.err, "found 0 surfaces");
}

/* A trace of one row, with this header. */
static process play(const char *header, const char *row) {
    char text[256];
    (void)snprintf(text, sizeof text, "%s\n%s\n", header, row);
    write_text(tool_path("trace.csv"), text);
    return RUN_TOOL("run", plate, "--fast", "--trace", tool_path("trace.csv"));
}

TEST(headers_that_were_written_otherwise_are_told_by_what_was_found) {
    static const char *const table[][3] = {{"t;x;y;z", "0;0;0;0", "separated by ';'"},
                                           {"t\tx\ty\tz", "0\t0\t0\t0", "separated by tabs"},
                                           {"T,X,Y,Z", "0,0,0,0", "in another case"},
                                           {"0,0,0,0", "1,0,0,0", "numbers instead of names"},
                                           {"a,b,c,d", "0,0,0,0", "found none"}};
    for (size_t i = 0; i < COUNT_OF(table); i++) {
        SCOPED_PROCESS p = play(table[i][0], table[i][1]);
        assert_int_equal(p.exit_code, 1);
        check_has(p.err, table[i][2]);
    }
    SCOPED_PROCESS marked = play("\xef\xbb\xbft,x,y,z", "0,0,-0.001,0");
    assert_null(strstr(marked.err, "line 1"));
}

TEST(a_trace_in_millimetres_is_warned_of) {
    SCOPED_PROCESS mm = play("t,x,y,z", "0,-50,0,0\n1,50,0,0");
    SCOPED_PROCESS m = play("t,x,y,z", "0,-0.05,0,0\n1,0.05,0,0");
    check_has(mm.err, "x spans 100 m");
    check_has(mm.err, "millimetres?");
    assert_null(strstr(m.err, "millimetres"));
}

SUITE_FIXTURES(make_folder, remove_folder)
