/* knurl verify: a guided acceptance test of a device. SPDX-License-Identifier: MIT */
#include "os.h"
#include "tool.h"
#include "verify.h"

#include <math.h>
#include <string.h>
#include <time.h>

static volatile sig_atomic_t interrupted;

static void on_signal(int number) {
    interrupted = number;
}

static double now(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* --- a person at the terminal --- */

static int say_only(verify *v, verify_wish wish, const char *sentence) {
    (void)v;
    (void)wish;
    (void)fflush(stdout);
    say(stderr, "    %s.\n", sentence);
    return 0;
}

/* Enter: done; s and Enter: left out, and so at the end of input or after Ctrl-C. */
static int ask(verify *v, verify_wish wish, const char *sentence) {
    int first = 0;
    if (wish >= VERIFY_PULL) {
        return say_only(v, wish, sentence);
    }
    (void)fflush(stdout);
    say(stderr, "    %s; Enter begins, s and Enter leaves it out. ", sentence);
    for (int c = getchar(); c != '\n'; c = getchar()) {
        first = first ? first : c;
        if (c == EOF) {
            return 1;
        }
    }
    return interrupted || first == 's';
}

static const verify_person asked = {ask, NULL, NULL};
static const verify_person told = {say_only, NULL, NULL};

/* --- the reports: NAME.html, NAME.json, and NAME.csv if a response was measured; an older one is removed --- */

enum { PAGE, DATA, RESPONSE, FILES };

static int open_files(out_file files[FILES], const char *name) {
    static const char *const ends[] = {"html", "json", "csv"};
    for (int i = 0; i < FILES && name; i++) {
        char path[4096];
        if ((size_t)snprintf(path, sizeof path, "%s.%s", name, ends[i]) >= sizeof path) {
            return tool_error(TOOL_FAILURE, "verify: --out %s: the name is too long", name);
        }
        if (out_open(&files[i], path)) {
            return TOOL_FAILURE;
        }
    }
    return TOOL_OK;
}

static int write_files(const verify *v, out_file files[FILES], const char *uri) {
    verify_write_page(v, files[PAGE].stream, uri);
    verify_write_json(v, files[DATA].stream, uri, 1);
    if (out_keep(&files[PAGE]) || out_keep(&files[DATA])) {
        return TOOL_FAILURE;
    }
    if (v->response.row_count > 0 && v->response.rows[v->response.row_count - 1].hz >= VERIFY_LAST_HZ) {
        sweep_write(&v->response, files[RESPONSE].stream, v->info.name);
        return out_keep(&files[RESPONSE]) ? TOOL_FAILURE : TOOL_OK;
    }
    if (files[RESPONSE].partial && !v->response_path) { /* which may be that file */
        (void)os_remove(files[RESPONSE].path);
    }
    return TOOL_OK;
}

/* --- the command --- */

typedef struct wishes {
    const char *uri, *opened; /* the same, or with the simulation's keys */
    const char *out;
    int yes, json, pretty;
} wishes;

static int report(const verify *v, const wishes *w, out_file files[FILES]) {
    if (w->json) {
        verify_write_json(v, stdout, w->uri, w->pretty);
    } else {
        say(stdout, "%d passed, %d failed, %d not measured\n", verify_count(v, VERIFY_PASS),
            verify_count(v, VERIFY_FAIL), verify_count(v, VERIFY_NOT_MEASURED));
    }
    if (w->out && write_files(v, files, w->uri)) {
        return TOOL_FAILURE;
    }
    if (interrupted) {
        return TOOL_INTERRUPTED + interrupted;
    }
    if (verify_count(v, VERIFY_NOT_MEASURED) == v->finding_count) {
        return tool_error(TOOL_FAILURE, "verify: nothing was measured, for the reasons above");
    }
    return verify_count(v, VERIFY_FAIL) > 0 ? TOOL_CHECK : TOOL_OK;
}

static int perform(verify *v, const wishes *w) {
    out_file files[FILES];
    memset(files, 0, sizeof files);
    int code = open_files(files, w->out); /* before somebody has spent half an hour */
    if (code == TOOL_OK) {
        (void)knurl_device_zero_on_exit(0);
        os_on_interrupt(on_signal);
        const knurl_result opened = verify_open(w->opened, &v->device);
        const int is_usage = opened == KNURL_ERROR_UNKNOWN || opened == KNURL_ERROR_ARGUMENT;
        code = opened ? tool_library_error(is_usage ? TOOL_USAGE : TOOL_FAILURE, "verify: --device") : TOOL_OK;
        if (!opened && !v->simulated) {
            say(stderr,
                "The motors get at most 1 N (3 N to weigh a mass), in pulses and ramps. Enter or Ctrl-C while a "
                "step runs ends all with no force. Keep your face away from the grip.\n");
        }
    }
    if (code == TOOL_OK && verify_run(v)) {
        code = tool_library_error(TOOL_FAILURE, "verify");
    } else if (code == TOOL_OK) {
        code = report(v, w, files);
    }
    for (int i = 0; i < FILES; i++) {
        out_discard(&files[i]);
    }
    knurl_device_close(v->device);
    return code;
}

static int check(const verify *v, const wishes *w, const char *stray) {
    const char *unknown = verify_unknown(v->only);
    unknown = unknown ? unknown : verify_unknown(v->skip);
    if (stray) {
        return tool_error(TOOL_USAGE, "verify: unexpected argument '%s'", stray);
    }
    if (unknown) {
        return tool_error(TOOL_USAGE, "verify: unknown step '%.*s'; see 'knurl help verify'",
                          (int)strcspn(unknown, ","), unknown);
    }
    if (verify_is_empty(v)) {
        return tool_error(TOOL_USAGE, "verify: --only and --skip leave no step");
    }
    if (w->out && (!w->out[0] || strchr("/\\", w->out[strlen(w->out) - 1]))) {
        return tool_error(TOOL_USAGE, "verify: --out: expected a file's name without its end, found '%s'", w->out);
    }
    if (v->simulated && strncmp(w->uri, "fake", 4) != 0) {
        return tool_error(TOOL_USAGE, "verify: --simulate takes a fake device, found --device %s", w->uri);
    }
    return TOOL_OK;
}

/* The fake device's cable is pulled after every other step's time; it lies still when it is let go. */
static int simulate(verify *v, wishes *w, char *uri, size_t size, verify_hand *hand) {
    const int length = snprintf(uri, size, "%s%stremor=0&lose_at=150", w->uri,
                                strchr(w->uri, '?')                 ? "&"
                                : w->uri[strlen(w->uri) - 1] == ':' ? "?"
                                                                    : ":?");
    if (length < 0 || (size_t)length >= size) {
        return tool_error(TOOL_USAGE, "verify: --device %s: the URI is too long", w->uri);
    }
    w->opened = hand->uri = uri;
    v->person = &verify_hand_person;
    v->hand = hand;
    return TOOL_OK;
}

int cmd_verify(int argc, char **argv) {
    static verify v;
    static char uri[1024];
    static verify_hand hand;
    wishes w = {.uri = "fake"};
    const char *stray = NULL;
    v.mass = NAN;
    const tool_option options[] = {{"--device", TOOL_TEXT, (void *)&w.uri, 0, 0, ""},
                                   {"--out", TOOL_TEXT, (void *)&w.out, 0, 0, ""},
                                   {"--mass", TOOL_NUMBER, &v.mass, 0.01, 0.1, "kg"},
                                   {"--response", TOOL_TEXT, (void *)&v.response_path, 0, 0, ""},
                                   {"--only", TOOL_TEXT, (void *)&v.only, 0, 0, ""},
                                   {"--skip", TOOL_TEXT, (void *)&v.skip, 0, 0, ""},
                                   {"--yes", TOOL_FLAG, &w.yes, 0, 0, ""},
                                   {"--simulate", TOOL_FLAG, &v.simulated, 0, 0, ""},
                                   {"--json", TOOL_FLAG, &w.json, 0, 0, ""},
                                   {"--pretty", TOOL_FLAG, &w.pretty, 0, 0, ""}};
    int code = tool_parse(argc, argv, options, sizeof options / sizeof *options, &stray);
    code = code == TOOL_OK ? check(&v, &w, stray) : code;
    v.interrupted = &interrupted;
    v.seconds = v.simulated ? NULL : now;
    v.person = w.yes ? &told : &asked;
    v.stream = w.json ? stderr : stdout;
    w.opened = w.uri;
    if (code == TOOL_OK && v.simulated) {
        code = simulate(&v, &w, uri, sizeof uri, &hand);
    }
    return code == TOOL_OK ? perform(&v, &w) : code;
}
