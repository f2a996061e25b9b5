/* knurl verify's reports: JSON, and a page without scripts or anything from elsewhere.
 * SPDX-License-Identifier: MIT */
#include "json.h"
#include "machine.h"
#include "say.h"
#include "verify.h"

#include <math.h>
#include <string.h>

#define PI 3.141592653589793

static void write_finding(json_writer *json, const verify_finding *f) {
    const double expected[] = {f->least, f->most};
    json_open(json, NULL, '{');
    json_string(json, "step", f->step);
    json_string(json, "what", f->what);
    json_string(json, "unit", f->unit);
    json_numbers(json, "expected", expected, 2, 1);
    json_string(json, "source", f->source);
    json_number(json, "measured", f->measured);
    json_string(json, "verdict", f->verdict == VERIFY_FAIL ? "fail" : verify_verdicts[f->verdict]);
    json_string(json, "note", f->note);
    json_close(json, '}');
}

void verify_write_json(const verify *v, FILE *stream, const char *uri, int pretty) {
    json_writer json;
    char machine[128];
    machine_name(machine, sizeof machine);
    json_start(&json, stream, pretty);
    json_open(&json, NULL, '{');
    json_string(&json, "device", v->info.name);
    json_string(&json, "uri", uri);
    json_string(&json, "knurl", knurl_version_string());
    json_string(&json, "machine", machine);
    json_flag(&json, "simulated", v->simulated);
    json_number(&json, "force_max_n", v->newtons);
    json_number(&json, "mass_kg", v->mass);
    json_number(&json, "passed", verify_count(v, VERIFY_PASS));
    json_number(&json, "failed", verify_count(v, VERIFY_FAIL));
    json_number(&json, "not_measured", verify_count(v, VERIFY_NOT_MEASURED));
    json_open(&json, "findings", '[');
    for (int i = 0; i < v->finding_count; i++) {
        write_finding(&json, &v->findings[i]);
    }
    json_close(&json, ']');
    json_open(&json, "response", '[');
    for (uint32_t i = 0; i < v->response.row_count; i++) {
        const double row[] = {v->response.rows[i].hz, v->response.rows[i].gain};
        json_numbers(&json, NULL, row, 2, 1);
    }
    json_close(&json, ']');
    json_close(&json, '}');
}

/* --- the page --- */

static const char head[] =
    "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<style>\n"
    ":root { color-scheme: light dark; --back: #fbfbf9; --ink: #1d2528; --dim: #5b666b; --line: #d8dcda;\n"
    "  --good: #1a7046; --bad: #b3261e; --open: #6a6f73; --band: #cfe6d8; --accent: #1f6fb2 }\n"
    "@media (prefers-color-scheme: dark) { :root { --back: #14181a; --ink: #e4e8e6; --dim: #9aa5a9; --line: #30383b;\n"
    "  --good: #5fc793; --bad: #ff8a80; --open: #9aa5a9; --band: #24523a; --accent: #74b7ee } }\n"
    "body { margin: 2rem auto; max-width: 70rem; padding: 0 1rem; background: var(--back); color: var(--ink);\n"
    "  font: 15px/1.4 system-ui, sans-serif }\n"
    "h1 { font-size: 1.5rem; margin: 0 0 .2rem } p { margin: .2rem 0; color: var(--dim) }\n"
    ".sum { font-size: 1.1rem; margin: .8rem 0; color: var(--ink) } table { width: 100%; border-collapse: collapse }\n"
    "th { text-align: left; padding: 1rem 0 .2rem } td { padding: .2rem .8rem .2rem 0; vertical-align: top;\n"
    "  border-top: 1px solid var(--line) } td:first-child { font-weight: 600; white-space: nowrap }\n"
    "td:nth-child(2) { min-width: 12rem } td:nth-child(3) { white-space: nowrap } td:nth-child(4) { width: 175px }\n"
    "td:last-child { width: 22rem }\n"
    "small { display: block; color: var(--dim) } .pass { color: var(--good) } .fail { color: var(--bad) }\n"
    ".open { color: var(--open) } svg text { fill: var(--dim); font-size: 11px } svg { vertical-align: middle }\n"
    "@media (max-width: 50rem) { td, th { display: block; border: 0; padding: 0 } tr { display: block;\n"
    "  padding: .4rem 0; border-top: 1px solid var(--line) } td:nth-child(n) { width: auto } }\n"
    "</style>\n";

/* For HTML, in one of two buffers. */
static const char *escaped(const char *text) {
    static char buffers[2][1600];
    static unsigned next;
    char *out = buffers[next++ % 2];
    size_t used = 0;
    for (; *text && used < sizeof buffers[0] - 8; text++) {
        const char *entity = *text == '<'   ? "&lt;"
                             : *text == '>' ? "&gt;"
                             : *text == '&' ? "&amp;"
                             : *text == '"' ? "&quot;"
                                            : NULL;
        if (entity) {
            memcpy(out + used, entity, strlen(entity));
            used += strlen(entity);
        } else {
            out[used++] = *text;
        }
    }
    out[used] = '\0';
    return out;
}

/* The expected range as a band, the measured value as a line. */
static void write_gauge(const verify_finding *f, FILE *stream) {
    const double most = isinf(f->most) ? 1.25 * fmax(f->least, f->measured) : f->most;
    const double low = fmin(f->least, f->measured);
    const double high = fmax(most, f->measured);
    const double pad = high > low ? 0.08 * (high - low) : 1.0;
    const double scale = 170.0 / (high - low + 2.0 * pad);
    say(stream,
        "<svg width=\"170\" height=\"16\" role=\"img\" aria-label=\"expected as a band, measured as a line\">\n");
    say(stream, "<path d=\"M0 8H170\" stroke=\"var(--line)\"/>\n");
    say(stream, "<rect x=\"%.1f\" y=\"3\" width=\"%.1f\" height=\"10\" rx=\"2\" fill=\"var(--band)\"/>\n",
        scale * (f->least - low + pad), fmax(2.0, scale * (most - f->least)));
    say(stream, "<path d=\"M%.1f 0V16\" stroke=\"var(--%s)\" stroke-width=\"3\"/></svg>\n",
        scale * (f->measured - low + pad), f->verdict == VERIFY_PASS ? "good" : "bad");
}

static void write_row(const verify_finding *f, FILE *stream) {
    static const char *const classes[] = {"pass", "fail", "open"};
    char range[64];
    verify_range_text(f, range, sizeof range);
    say(stream, "<tr><td class=\"%s\">%s</td><td>%s", classes[f->verdict], verify_verdicts[f->verdict],
        escaped(f->what));
    if (f->note[0]) {
        say(stream, "<small class=\"%s\">%s</small>", classes[f->verdict], escaped(f->note));
    }
    say(stream, "</td><td>");
    if (!isnan(f->measured)) {
        say(stream, "%.4g %s</td><td>", f->measured, escaped(f->unit));
        write_gauge(f, stream);
        say(stream, "</td><td>%s %s<small>%s</small></td></tr>\n", range, f->unit, escaped(f->source));
    } else {
        say(stream, "</td><td></td><td></td></tr>\n");
    }
}

#define WIDTH  640.0
#define HEIGHT 220.0
#define LEFT   75.0
#define UM_TOP 3.5    /* log10 of um/N at the top, */
#define UM_END (-0.5) /* and at the bottom */

static double chart_x(double hz) {
    return LEFT + (WIDTH - LEFT - 10.0) * log(hz / 20.0) / log(25.0);
}

static double chart_y(double gain) {
    const double y = (HEIGHT - 30.0) * (UM_TOP - log10(1e6 * gain)) / (UM_TOP - UM_END);
    return 5.0 + fmin(HEIGHT - 30.0, fmax(0.0, y));
}

/* Its data in the hand of predictions, each force held for a tick. */
static double plant_gain(const knurl_device_info *i, double hz) {
    const double w = 2.0 * PI * hz;
    const double held = PI * hz / VERIFY_RATE;
    return sin(held) / held / hypot(VERIFY_HAND_STIFFNESS - i->mass * w * w, (VERIFY_HAND_DAMPING + i->viscous) * w);
}

static void write_response(const verify *v, FILE *stream) {
    static const double lines[] = {20.0, 50.0, 100.0, 200.0, 500.0};
    say(stream,
        "<svg viewBox=\"0 0 %g %g\" style=\"width:100%%;max-width:44rem\" role=\"img\" aria-label=\"response\">\n",
        WIDTH, HEIGHT);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        const double x = chart_x(lines[i]);
        say(stream, "<path d=\"M%.1f 5V%g\" stroke=\"var(--line)\"/>", x, HEIGHT - 25.0);
        say(stream, "<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g Hz</text>\n", fmin(x, WIDTH - 25.0),
            HEIGHT - 8.0, lines[i]);
    }
    for (int decade = 0; decade <= 3; decade++) {
        const double y = chart_y(1e-6 * pow(10.0, decade));
        say(stream, "<path d=\"M%g %.1fH%g\" stroke=\"var(--line)\"/>", LEFT, y, WIDTH - 10.0);
        say(stream, "<text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g um/N</text>\n", LEFT - 5.0, y + 4.0,
            pow(10.0, decade));
    }
    if (v->info.mass > 0.0) {
        say(stream, "<path fill=\"none\" stroke=\"var(--dim)\" stroke-dasharray=\"5 4\" d=\"");
        for (int i = 0; i <= 60; i++) {
            const double hz = 20.0 * pow(25.0, i / 60.0);
            say(stream, "%s%.1f %.1f ", i ? "L" : "M", chart_x(hz), chart_y(plant_gain(&v->info, hz)));
        }
        say(stream, "\"/>\n");
    }
    for (uint32_t i = 0; i < v->response.row_count; i++) {
        say(stream, "<circle r=\"3\" fill=\"var(--accent)\" cx=\"%.1f\" cy=\"%.1f\"/>\n",
            chart_x(v->response.rows[i].hz), chart_y(v->response.rows[i].gain));
    }
    say(stream, "</svg><p>Points: the response. Dashed: its mass and viscous friction in " VERIFY_HAND ".</p>\n");
}

static void write_steps(const verify *v, FILE *stream) {
    say(stream, "<table>\n");
    for (const verify_step *s = verify_steps; s->name; s++) {
        int rows = 0;
        for (int i = 0; i < v->finding_count; i++) {
            if (strcmp(v->findings[i].step, s->name) == 0) {
                if (rows++ == 0) {
                    say(stream, "<tr><th colspan=\"5\">%s</th></tr>\n", s->title);
                }
                write_row(&v->findings[i], stream);
            }
        }
    }
    say(stream, "</table>\n");
}

void verify_write_page(const verify *v, FILE *stream, const char *uri) {
    char machine[128];
    machine_name(machine, sizeof machine);
    say_page(stream, head);
    say(stream, "<title>knurl verify: %s</title>\n<main><h1>%s</h1>\n", escaped(v->info.name), escaped(v->info.name));
    say(stream, "<p>%s; Knurl %s%s; %s; at most %.3g N, %.0f Hz</p>\n", escaped(uri), knurl_version_string(),
        v->simulated ? ", simulated" : "", escaped(machine), v->newtons, VERIFY_RATE);
    const int failed = verify_count(v, VERIFY_FAIL);
    say(stream,
        "<p class=\"sum\"><b class=\"pass\">%d passed</b>, <b class=\"%s\">%d failed</b>, %d not measured</p>\n",
        verify_count(v, VERIFY_PASS), failed ? "fail" : "open", failed, verify_count(v, VERIFY_NOT_MEASURED));
    for (int i = 0; i < v->finding_count; i++) {
        const verify_finding *f = &v->findings[i];
        if (f->verdict == VERIFY_FAIL) {
            say(stream, "<p class=\"fail\">%s: %s</p>\n", f->step, escaped(f->note));
        }
    }
    if (v->response.row_count > 0) {
        write_response(v, stream);
    }
    say(stream, "<p>Bands: expected. Lines: measured.</p>\n");
    write_steps(v, stream);
    say(stream, "</main></html>\n");
}
