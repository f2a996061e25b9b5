/* knurl bench: times ticks on this machine. SPDX-License-Identifier: MIT */
#include "bench.h"
#include "machine.h"
#include "os.h"
#include "tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_CASES 64

static volatile sig_atomic_t interrupted;

static void on_signal(int number) {
    interrupted = number;
}

/* One line of the report. */
typedef struct row {
    const bench_case *timed;
    int outcome; /* BENCH_DONE or _SKIPPED */
    char why[256];
    bench_result result;
} row;

typedef struct report {
    char machine[128];
    double timer_ns, step_ns;
    row rows[MAX_CASES];
    size_t count;
} report;

static const bench_case *find_case(const char *name) {
    const bench_case *c = bench_cases;
    while (c->name && strcmp(c->name, name) != 0) {
        c++;
    }
    return c->name ? c : NULL;
}

static int unknown_case(const char *name) {
    char known[2048] = "";
    for (const bench_case *c = bench_cases; c->name; c++) {
        (void)strncat(known, c == bench_cases ? "" : ", ", sizeof known - strlen(known) - 1);
        (void)strncat(known, c->name, sizeof known - strlen(known) - 1);
    }
    return tool_error(TOOL_USAGE, "bench: --case: expected one of %s, found '%s'", known, name);
}

/* Runs all cases except those on request, or only one: TOOL_OK, or TOOL_FAILURE after printing the reason. Earlier
 * results stay in the report. */
static int measure(bench *b, const bench_case *only, report *out) {
    for (const bench_case *c = bench_cases; c->name && out->count < MAX_CASES; c++) {
        if (only ? only != c : bench_is_on_request(c)) {
            continue;
        }
        row *r = &out->rows[out->count];
        say_progress("%s", c->name);
        r->timed = c;
        r->outcome = bench_run(b, c, &r->result);
        say_progress_end();
        if (r->outcome == BENCH_INTERRUPTED) {
            return tool_error(TOOL_INTERRUPTED + interrupted,
                              "bench: interrupted in %s; the cases before it are printed", c->name);
        }
        if (r->outcome == BENCH_FAILED) {
            return tool_library_error(TOOL_FAILURE, c->name);
        }
        if (r->outcome == BENCH_SKIPPED) {
            (void)snprintf(r->why, sizeof r->why, "%s", knurl_error_message());
            tool_tell("note", "%s is skipped: %s", c->name, r->why);
        }
        out->count++;
    }
    return TOOL_OK;
}

static void print_result(json_writer *json, const row *r) {
    json_open(json, NULL, '{');
    json_string(json, "case", r->timed->name);
    json_number(json, "p50_ns", r->result.p50_ns);
    json_number(json, "p99_ns", r->result.p99_ns);
    json_number(json, "p999_ns", r->result.p999_ns);
    json_number(json, "max_ns", r->result.max_ns);
    if (r->result.batch_ns > 0.0) {
        json_number(json, "batch_ns", r->result.batch_ns);
    }
    if (r->result.edits_per_s > 0.0) {
        json_number(json, "edits_per_s", r->result.edits_per_s);
    }
    json_number(json, "bytes", r->result.bytes);
    json_number(json, "build_ms", r->result.build_ms);
    json_number(json, "triangles", r->result.triangles);
    json_number(json, "ticks", r->result.ticks);
    json_number(json, "contact", r->result.contact);
    if (bench_is_worst(r->timed->shape)) {
        json_number(json, "visit_limit", r->result.visit_limit);
    }
    if (r->timed->paced) {
        json_number(json, "overruns", r->result.overruns);
    }
    json_close(json, '}');
}

static void print_json(const report *out) {
    json_writer json;
    json_start(&json, stdout, 0);
    json_open(&json, NULL, '{');
    json_string(&json, "version", knurl_version_string());
    json_number(&json, "timer_ns", out->timer_ns);
    json_number(&json, "clock_step_ns", out->step_ns);
    json_string(&json, "machine", out->machine);
    json_open(&json, "cases", '[');
    for (size_t i = 0; i < out->count; i++) {
        if (out->rows[i].outcome == BENCH_DONE) {
            print_result(&json, &out->rows[i]);
        }
    }
    json_close(&json, ']');
    json_open(&json, "skipped", '[');
    for (size_t i = 0; i < out->count; i++) {
        if (out->rows[i].outcome == BENCH_SKIPPED) {
            json_open(&json, NULL, '{');
            json_string(&json, "case", out->rows[i].timed->name);
            json_string(&json, "why", out->rows[i].why);
            json_close(&json, '}');
        }
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

static void print_table(const report *out) {
    say(stdout, "%s; ns a tick, less %g of the timer, whose steps are %g; in batches: without it\n", out->machine,
        out->timer_ns, out->step_ns);
    say(stdout, "%-20s %8s %8s %8s %8s %10s %10s %12s %6s %9s\n", "case", "batch", "p50", "p99", "p99.9", "max",
        "ticks", "bytes", "/tri", "build ms");
    for (size_t i = 0; i < out->count; i++) {
        const row *r = &out->rows[i];
        const bench_result *t = &r->result;
        if (r->outcome == BENCH_SKIPPED) {
            say(stdout, "%-20s skipped\n", r->timed->name);
            continue;
        }
        say(stdout, "%-20s %8.1f %8.0f %8.0f %8.0f %10.0f %10.0f %12.0f ", r->timed->name, t->batch_ns, t->p50_ns,
            t->p99_ns, t->p999_ns, t->max_ns, t->ticks, t->bytes);
        if (t->triangles > 0.0) {
            say(stdout, "%6.1f ", t->bytes / t->triangles);
        } else {
            say(stdout, "%6s ", "");
        }
        say(stdout, "%9.2f\n", t->build_ms);
        if (bench_is_worst(r->timed->shape)) {
            say(stdout, "%-20s %.1f %% of the ticks met the limit of visits\n", "", 100.0 * t->visit_limit);
        }
        if (r->timed->paced) {
            say(stdout, "%-20s %.0f overruns\n", "", t->overruns);
        }
    }
}

int cmd_bench(int argc, char **argv) {
    int as_json = 0;
    const char *name = NULL;
    double ticks = 0.0;
    const tool_option options[] = {{"--json", TOOL_FLAG, &as_json, 0, 0, ""},
                                   {"--case", TOOL_TEXT, &name, 0, 0, ""},
                                   {"--ticks", TOOL_NUMBER, &ticks, 1.0, 1e8, ""}};
    if (tool_parse(argc, argv, options, sizeof options / sizeof *options, NULL) != TOOL_OK) {
        return TOOL_USAGE;
    }
    const bench_case *only = name ? find_case(name) : NULL;
    if (name && !only) {
        return unknown_case(name);
    }
    os_on_interrupt(on_signal);
    bench b;
    memset(&b, 0, sizeof b);
    b.interrupted = &interrupted;
    b.ticks = floor(ticks);
    report *out = calloc(1, sizeof *out);
    if (!out || bench_start(&b)) {
        free(out);
        return tool_error(TOOL_FAILURE, "bench: no memory for the times of %g ticks", fmax(b.ticks, BENCH_TICKS));
    }
    machine_name(out->machine, sizeof out->machine);
    out->timer_ns = b.timer_ns;
    out->step_ns = b.step_ns;
    int code = measure(&b, only, out);
    if (as_json) {
        print_json(out);
    } else {
        print_table(out);
    }
    if (only && out->count == 1 && out->rows[0].outcome == BENCH_SKIPPED) {
        code = TOOL_FAILURE; /* the requested case was skipped; a note gave the reason */
    }
    bench_end(&b);
    free(out);
    return code;
}
