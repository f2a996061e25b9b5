/* knurl_experiment: the paper's Experiments 1, 2 and 3 on any device. SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "os.h"
#include "say.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "knurl_experiment: the paper's three experiments on any device\n"
    "\n"
    "  knurl_experiment 1|2|3 [options]     a session with one subject; a CSV, a row a trial\n"
    "  knurl_experiment analyse CSV...      counts, Eq. 14 and verdicts over all sessions given\n"
    "\n"
    "  1  T1 against T3, 1.05 and 2.10 N    72 trials of two progressions low-medium-high, some 15 minutes\n"
    "  2  T2 against T3, 0.35 and 0.70 N    likewise\n"
    "  3  S1 against S2, K = 700 N/m        3 pairs of gratings (0.5, 1, 2 mm), a minute or more each\n"
    "\n"
    "  --device URI        fake (default), fake:?key=value&...; see 'knurl devices'\n"
    "  --subject NAME      letters, digits, - _ and ., at most 31; default test\n"
    "  --amplitude A       experiment 3: as-printed (2.7 mm, default; beyond a Touch) or reduced (0.27 mm)\n"
    "  --sound yes|no      what holds in this session, for the record; default yes. A subject of experiments 1 and 2\n"
    "                      does two sessions, half of the subjects the one with headphones on (no) first\n"
    "  --seed N            of the order, 0 to 4294967295; default: made from experiment, subject and sound\n"
    "  --answers WHO       keyboard (keys 1, 2 and Enter; default), buttons (the device's first two), or simulated: a\n"
    "                      formula that says nothing about people (default with --fast)\n"
    "  --fast              as fast as the machine can; fake device and simulated answers only\n"
    "  --out CSV           default experiment-N-NAME-sound-yes.csv here, with -reduced where it is. What people\n"
    "                      answered is never written over\n"
    "\n"
    "Ctrl-C ends a session; what was answered until then stays beside CSV, in a .part file whose name is told.\n"
    "Exit codes: 0 done, 1 failed, 2 wrong usage or unknown device.\n";

typedef struct options {
    const char *device, *subject, *amplitude, *sound, *seed, *answers, *out;
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
                                 {"--seed", TOOL_TEXT, &o->seed, 0, 0, ""},
                                 {"--answers", TOOL_TEXT, &o->answers, 0, 0, ""},
                                 {"--out", TOOL_TEXT, &o->out, 0, 0, ""},
                                 {"--fast", TOOL_FLAG, &o->fast, 0, 0, ""}};
    return tool_parse(argc, argv, known, sizeof known / sizeof *known, NULL);
}

/* 0 or 1 for the first or second word, -1 for neither. */
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
    s->seed = 2166136261u; /* FNV-1a: another order for every subject, the same one every time */
    for (const char *c = s->subject; *c; c++) {
        s->seed = ((s->seed ^ (unsigned char)*c) * 16777619u) & 0xffffffffu;
    }
    s->seed = ((s->seed ^ (uint64_t)(2 * s->design->experiment + s->sound)) * 16777619u) & 0xffffffffu;
    return TOOL_OK;
}

static int read_words(const options *o, exp_session *s) {
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    const char *answers = o->answers ? o->answers : o->fast ? "simulated" : "keyboard";
    s->subject = o->subject ? o->subject : "test";
    s->uri = o->device ? o->device : "fake";
    s->fast = o->fast;
    s->sound = choose(o->sound ? o->sound : "yes", "no", "yes");
    s->reduced = choose(o->amplitude ? o->amplitude : "as-printed", "as-printed", "reduced");
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
    if (s->reduced && s->design->experiment != 3) {
        return tool_error(TOOL_USAGE, "--amplitude reduced: is experiment 3's; 1 and 2 are played as printed");
    }
    if (s->answers < 0) {
        return usage("--answers", "keyboard, buttons or simulated", answers);
    }
    if (strpbrk(s->uri, ",\"\r\n")) {
        return usage("--device", "no comma, quote or line's end", s->uri);
    }
    return read_seed(o->seed, s);
}

/* What does not go together. */
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
    if (fake && s->design->experiment == 3 && s->answers != EXP_SIMULATED) {
        return tool_error(TOOL_USAGE, "3: nobody moves the fake device; expected --answers simulated");
    }
    return TOOL_OK;
}

static void on_signal(int number) {
    (void)number;
    exp_interrupted = 1;
}

static int run(int argc, char **argv) {
    options o;
    exp_session s;
    char path[128];
    memset(&o, 0, sizeof o);
    memset(&s, 0, sizeof s);
    s.design = strlen(argv[1]) == 1 ? exp_design_of(argv[1][0] - '0') : NULL;
    if (!s.design) {
        return tool_error(TOOL_USAGE, "expected 1, 2, 3 or analyse, found '%s'; see 'knurl_experiment --help'",
                          argv[1]);
    }
    int code = read_options(argc - 1, argv + 1, &o);
    code = code ? code : read_words(&o, &s);
    code = code ? code : check(&s);
    if (code) {
        return code;
    }
    (void)snprintf(path, sizeof path, "experiment-%d-%s-sound-%s%s.csv", (int)s.design->experiment, s.subject,
                   s.sound ? "yes" : "no", s.reduced ? "-reduced" : "");
    s.out = o.out ? o.out : path;
    const knurl_result result = knurl_device_open(s.uri, &s.device);
    if (result) { /* a device that exists and cannot be had is a failure; a name that is none is wrong usage */
        return tool_error(result == KNURL_ERROR_UNSUPPORTED ? TOOL_FAILURE : TOOL_USAGE, "--device: %s",
                          knurl_error_message());
    }
    (void)knurl_device_zero_on_exit(0); /* before the handler below, which ends a session by the ramp */
    os_on_interrupt(on_signal);
    knurl_device_info_init(&s.info, sizeof s.info);
    code = knurl_device_get_info(s.device, &s.info) ? tool_error(TOOL_FAILURE, "%s", knurl_error_message())
                                                    : exp_run_session(&s);
    knurl_device_close(s.device);
    return code;
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
    if (strcmp(argv[1], "analyse") != 0) {
        return run(argc, argv);
    }
    return argc < 3 ? tool_error(TOOL_USAGE, "analyse: expected at least one CSV, found none")
                    : exp_analyse(argc - 2, argv + 2);
}

int main(int argc, char **argv) {
    tool_name = "knurl_experiment";
    os_begin(&argc, &argv);
    return tool_end(dispatch(argc, argv));
}
