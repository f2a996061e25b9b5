/* knurl_experiment: the paper's experiments, and any two methods, on any device. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "contender.h"
#include "os.h"
#include "say.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "knurl_experiment: which of two methods do people prefer? The paper's three experiments, and any two methods\n"
    "\n"
    "  knurl_experiment 1|2|3 [options]               a session with one subject; a CSV, a row a trial\n"
    "  knurl_experiment compare METHOD METHOD [...]   the same, two of S1, S2, bandlimited, or your own (study/own.c)\n"
    "  knurl_experiment analyse CSV...                exclusions, counts, Eq. 14, intervals and verdicts\n"
    "  knurl_experiment power [options]               how many subjects are needed for which effect\n"
    "\n"
    "  1        T1 against T3, 1.05 and 2.10 N   72 trials of two progressions low-medium-high, some 15 minutes\n"
    "  2        T2 against T3, 0.35 and 0.70 N   likewise\n"
    "  3        S1 against S2, K = 700 N/m       3 pairs of gratings (0.5, 1, 2 mm), a minute or more each\n"
    "  compare  any two, K = 700 N/m             the same pairs 4 times, twice in each order, half a minute or more each\n"
    "\n"
    "  --device URI        fake (default), fake:?key=value&...; see 'knurl devices'\n"
    "  --subject NAME      letters, digits, - _ and ., at most 31; default test\n"
    "  --amplitude A       gratings: as-printed (2.7 mm; beyond a Touch; default of 3) or reduced (0.27 mm; of compare)\n"
    "  --sound yes|no      condition of this session, for the record; default yes. A subject does two sessions (of 1, 2\n"
    "                      and compare), half of the subjects the one with headphones on (no) first\n"
    "  --training yes|no   1, 2, compare: good and bad progressions, then six trials; default yes. no in a subject's\n"
    "                      second session\n"
    "  --seed N            of the order, 0 to 4294967295; default: made from experiment, methods, subject and sound\n"
    "  --answers WHO       keyboard (keys 1, 2 and Enter; default), buttons (the device's first two), or simulated: a\n"
    "                      formula that says nothing about people (default with --fast)\n"
    "  --fast              as fast as the machine can; fake device and simulated answers only\n"
    "  --out CSV           default experiment-N-NAME-sound-yes.csv here (N: 1, 2, 3 or the two methods), with -reduced\n"
    "                      or -as-printed if that is not the default\n"
    "\n"
    "CSV is complete after each trial. A session that was ended (Ctrl-C, the break's question, a crash) goes on with the\n"
    "next trial when the same command is given again. Both buttons at once stop the force; the trial begins anew.\n"
    "What people answered is never written over.\n"
    "\n"
    "power: --repetitions N   trials a subject and cell (default 4, compare's)\n"
    "       --comparisons N   that Bonferroni's correction divides by (6: three periods, with and without sound)\n"
    "       --correlation R   between two answers of a subject (0.1: an assumption)\n"
    "       --power P         default 0.8\n"
    "\n"
    "The plan for a laboratory: samples/study/experiment/README.md.\n"
    "Exit codes: 0 done, 1 failed or ended early, 2 wrong usage or unknown device, 128 + signal.\n";

typedef struct options {
    const char *device, *subject, *amplitude, *sound, *training, *seed, *answers, *out;
    int fast;
} options;

static int usage(const char *what, const char *expected, const char *found) {
    return tool_error(TOOL_USAGE, "%s: expected %s, found '%s'", what, expected, found);
}

static int read_options(int argc, char **argv, options *o) {
    const tool_option known[] = {{"--device", TOOL_TEXT, &o->device, 0, 0, ""},
                                 {"--subject", TOOL_TEXT, &o->subject, 0, 0, ""},
                                 {"--amplitude", TOOL_TEXT, &o->amplitude, 0, 0, ""},
                                 {"--sound", TOOL_TEXT, &o->sound, 0, 0, ""},
                                 {"--training", TOOL_TEXT, &o->training, 0, 0, ""},
                                 {"--seed", TOOL_TEXT, &o->seed, 0, 0, ""},
                                 {"--answers", TOOL_TEXT, &o->answers, 0, 0, ""},
                                 {"--out", TOOL_TEXT, &o->out, 0, 0, ""},
                                 {"--fast", TOOL_FLAG, &o->fast, 0, 0, ""}};
    return tool_parse(argc, argv, known, sizeof known / sizeof *known, NULL);
}

/* Returns 0 or 1 for the first or second word, -1 for any other. */
static int32_t choose(const char *text, const char *first, const char *second) {
    return strcmp(text, first) == 0 ? 0 : strcmp(text, second) == 0 ? 1 : -1;
}

static int read_seed(const char *text, exp_session *s) {
    if (text) {
        char *end = NULL;
        errno = 0;
        const unsigned long long value = strtoull(text, &end, 10);
        s->seed = value;
        return strspn(text, "0123456789") == strlen(text) && end != text && !errno && value <= 4294967295u
                   ? TOOL_OK
                   : usage("--seed", "a whole number from 0 to 4294967295", text);
    }
    s->seed = 2166136261u; /* FNV-1a: a different but reproducible order for every subject */
    for (const char *c = s->subject; *c; c++) {
        s->seed = ((s->seed ^ (unsigned char)*c) * 16777619u) & 0xffffffffu;
    }
    const int32_t *pair = s->design->methods;
    const int32_t other = s->design->experiment == EXP_COMPARE ? 16 * pair[0] + 256 * pair[1] : 0;
    s->seed = ((s->seed ^ (uint64_t)(2 * s->design->experiment + s->sound + other)) * 16777619u) & 0xffffffffu;
    return TOOL_OK;
}

static const char *default_amplitude(const exp_design *design) {
    return design->experiment == EXP_COMPARE ? "reduced" : "as-printed";
}

static int read_words(const options *o, exp_session *s) {
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    const char *answers = o->answers ? o->answers : o->fast ? "simulated" : "keyboard";
    s->subject = o->subject ? o->subject : "test";
    s->uri = o->device ? o->device : "fake";
    s->fast = o->fast;
    s->sound = choose(o->sound ? o->sound : "yes", "no", "yes");
    s->reduced = choose(o->amplitude ? o->amplitude : default_amplitude(s->design), "as-printed", "reduced");
    s->training = choose(o->training ? o->training : s->design->experiment == 3 ? "no" : "yes", "no", "yes");
    s->answers = strcmp(answers, "simulated") == 0 ? EXP_SIMULATED : choose(answers, "keyboard", "buttons");
    if (!s->subject[0] || strlen(s->subject) > 31 || strspn(s->subject, letters) != strlen(s->subject)) {
        return usage("--subject", "1 to 31 letters, digits, '-', '_' or '.'", s->subject);
    }
    if (s->sound < 0) {
        return usage("--sound", "yes or no", o->sound);
    }
    if (s->reduced < 0) {
        return usage("--amplitude", "as-printed or reduced", o->amplitude);
    }
    if (s->reduced && !exp_has_gratings(s->design)) {
        return tool_error(TOOL_USAGE, "--amplitude reduced: is for gratings; 1 and 2 are played as printed");
    }
    if (s->training < 0) {
        return usage("--training", "yes or no", o->training);
    }
    if (s->training && s->design->experiment == 3) {
        return tool_error(TOOL_USAGE, "--training yes: experiment 3 has none in the paper; compare S1 S2 has");
    }
    if (s->answers < 0) {
        return usage("--answers", "keyboard, buttons or simulated", answers);
    }
    if (strpbrk(s->uri, ",\"\r\n")) {
        return usage("--device", "no comma, quote or line's end", s->uri);
    }
    return read_seed(o->seed, s);
}

/* Options that exclude each other. */
static int check(const exp_session *s) {
    const int fake = strncmp(s->uri, "fake", 4) == 0;
    if (s->fast && !fake) {
        return usage("--fast", "the fake device", s->uri);
    }
    if (s->fast && s->answers != EXP_SIMULATED) {
        return tool_error(TOOL_USAGE, "--fast: people answer in real time; expected --answers simulated");
    }
    if (fake && s->answers == EXP_BUTTONS) {
        return tool_error(TOOL_USAGE, "--answers buttons: the fake device has none");
    }
    if (fake && exp_has_gratings(s->design) && s->answers != EXP_SIMULATED) {
        return tool_error(TOOL_USAGE, "gratings: nobody moves the fake device; expected --answers simulated");
    }
    return TOOL_OK;
}

static void on_signal(int number) {
    exp_interrupted = number;
}

/* The default name of the file. */
static void name_file(const exp_session *s, char *path, size_t size) {
    const exp_design *d = s->design;
    const char *amplitude = s->reduced ? "reduced" : "as-printed";
    const int usual = !exp_has_gratings(d) || strcmp(amplitude, default_amplitude(d)) == 0;
    char which[64];
    (void)snprintf(which, sizeof which, "%d", (int)d->experiment);
    if (d->experiment == EXP_COMPARE) {
        (void)snprintf(which, sizeof which, "%s-%s", d->names[0], d->names[1]);
    }
    (void)snprintf(path, size, "experiment-%s-%s-sound-%s%s%s.csv", which, s->subject, s->sound ? "yes" : "no",
                   usual ? "" : "-", usual ? "" : amplitude);
}

static int open_and_run(exp_session *s) {
    const knurl_result result = knurl_device_open(s->uri, &s->device);
    if (result) { /* a device that cannot be opened is a failure; an unknown name is wrong usage */
        return tool_error(result == KNURL_ERROR_UNSUPPORTED ? TOOL_FAILURE : TOOL_USAGE, "--device: %s",
                          knurl_error_message());
    }
    (void)knurl_device_zero_on_exit(0); /* before the handler below, which ends a session with a ramp */
    os_on_interrupt(on_signal);
    knurl_device_info_init(&s->info, sizeof s->info);
    const int code = knurl_device_get_info(s->device, &s->info) ? tool_error(TOOL_FAILURE, "%s", knurl_error_message())
                                                                : exp_run_session(s);
    knurl_device_close(s->device);
    return code;
}

/* arguments: those after the experiment, options first. */
static int run(int argc, char **argv, const exp_design *design) {
    options o;
    exp_session s;
    char path[192];
    memset(&o, 0, sizeof o);
    memset(&s, 0, sizeof s);
    s.design = design;
    int code = read_options(argc, argv, &o);
    code = code ? code : read_words(&o, &s);
    code = code ? code : check(&s);
    if (code) {
        return code;
    }
    name_file(&s, path, sizeof path);
    s.out = o.out ? o.out : path;
    return open_and_run(&s);
}

static int run_printed(int argc, char **argv) {
    const exp_design *design = strlen(argv[1]) == 1 ? exp_design_of(argv[1][0] - '0') : NULL;
    return design ? run(argc - 1, argv + 1, design)
                  : tool_error(TOOL_USAGE,
                               "expected 1, 2, 3, compare, analyse or power, found '%s'; see 'knurl_experiment --help'",
                               argv[1]);
}

static int run_comparison(int argc, char **argv) {
    int32_t methods[2];
    exp_design design;
    if (argc < 4) {
        return tool_error(TOOL_USAGE, "compare: expected the names of two methods, such as S2 bandlimited");
    }
    for (int i = 0; i < 2; i++) {
        if (knurl_method_from_name(argv[2 + i], &methods[i])) {
            return tool_error(TOOL_USAGE, "compare: %s", knurl_error_message());
        }
    }
    const int code = exp_compare(methods[0], methods[1], &design);
    return code ? code : run(argc - 3, argv + 3, &design);
}

static int run_power(int argc, char **argv) {
    exp_power o = {4.0, 6.0, 0.1, 0.8};
    const tool_option known[] = {{"--repetitions", TOOL_NUMBER, &o.repetitions, 1, 100, ""},
                                 {"--comparisons", TOOL_NUMBER, &o.comparisons, 1, 1000, ""},
                                 {"--correlation", TOOL_NUMBER, &o.correlation, 0, 0.99, ""},
                                 {"--power", TOOL_NUMBER, &o.power, 0.05, 0.999, ""}};
    const int code = tool_parse(argc - 1, argv + 1, known, sizeof known / sizeof *known, NULL);
    return code ? code : exp_print_power(&o);
}

static int dispatch(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            say_page(stdout, help);
            return TOOL_OK;
        }
    }
    if (argc < 2) {
        say_page(stderr, help);
        return TOOL_USAGE;
    }
    if (strcmp(argv[1], "compare") == 0) {
        return run_comparison(argc, argv);
    }
    if (strcmp(argv[1], "power") == 0) {
        return run_power(argc, argv);
    }
    if (strcmp(argv[1], "analyse") != 0) {
        return run_printed(argc, argv);
    }
    return argc < 3 ? tool_error(TOOL_USAGE, "analyse: expected at least one CSV, found none")
                    : exp_analyse(argc - 2, argv + 2);
}

int main(int argc, char **argv) {
    tool_name = "knurl_experiment";
    os_begin(&argc, &argv);
    if (study_add_own()) {
        return tool_end(tool_error(TOOL_FAILURE, "samples/study/own.c: %s", knurl_error_message()));
    }
    return tool_end(dispatch(argc, argv));
}
