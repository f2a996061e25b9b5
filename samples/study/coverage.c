/* Figure 3: the frequencies that even, odd and mixed periods reach, and the steps between them.
 * SPDX-License-Identifier: MIT */
#include "coverage.h"

#include "say.h"
#include "study.h"

#include <math.h>

#define LOWEST_HZ     20.0
#define SPEED_MM_S    250.0 /* the fastest common scanning speed (section IV-B6) */
#define PAPERS_WEBER  0.38  /* haptic, "approximately" */
#define PRINTED_WEBER 0.383 /* from the printed 461 Hz: 333.3 Hz x 1.383 */

static const char *const set_names[STUDY_SETS] = {"even", "odd", "mixed"};
static const char *const set_words[STUDY_SETS] = {"even periods only", "with odd periods", "with the mixed case"};
static const char *const kind_names[3] = {"even", "odd", "mixed"};
static const double rates[] = {1000.0, 2000.0};
static const double webers[] = {PAPERS_WEBER, 0.20};

size_t study_reachable(double update_rate_hz, double lowest_hz, int set, study_reach *reach) {
    size_t count = 0;
    knurl_vibration_event event;
    int32_t last = 0;
    /* Algorithm 6 rounds to quarters of a tick: these periods give all possible events */
    for (int32_t quarters = 8; quarters <= 4.0 * update_rate_hz / lowest_hz * (1.0 + 1e-9); quarters++) {
        if (knurl_vibration_event_prepare(0.25 * quarters, 1.0, &event) || event.length * 4 + event.kind == last) {
            continue;
        }
        last = event.length * 4 + event.kind;
        const double ticks = event.kind == KNURL_EVENT_MIXED ? 2.5 : event.length;
        if (event.kind <= set && ticks * lowest_hz <= update_rate_hz * (1.0 + 1e-9) && count < STUDY_MAX_REACH) {
            const study_reach one = {update_rate_hz / ticks, ticks, event.kind};
            reach[count++] = one;
        }
    }
    for (size_t i = 0; i < count / 2; i++) { /* ascending in frequency */
        const study_reach swap = reach[i];
        reach[i] = reach[count - 1 - i];
        reach[count - 1 - i] = swap;
    }
    return count;
}

size_t study_gaps(const study_reach *reach, size_t count, double weber, int rule, study_gap *gaps) {
    size_t found = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        const double above = reach[i + 1].frequency;
        const study_gap gap = {reach[i].frequency * (1.0 + weber),
                               rule == STUDY_GAP_NEIGHBOUR ? above : above / (1.0 + weber)};
        if (gap.high > gap.low * (1.0 + 1e-9)) {
            gaps[found++] = gap;
        }
    }
    return found;
}

double study_no_gap_up_to(const study_reach *reach, size_t count, double weber) {
    study_gap gaps[STUDY_MAX_REACH];
    return study_gaps(reach, count, weber, STUDY_GAP_NEIGHBOUR, gaps) ? gaps[0].low : reach[count - 1].frequency;
}

static void write_rows(FILE *csv, double rate, int set, double weber) {
    study_reach reach[STUDY_MAX_REACH];
    const size_t count = study_reachable(rate, LOWEST_HZ, set, reach);
    for (size_t i = 0; i < count; i++) {
        const double f = reach[i].frequency;
        const double above = i + 1 < count ? reach[i + 1].frequency : NAN;
        const double cells[] = {reach[i].ticks, f, f / (1.0 + weber), f * (1.0 + weber), above};
        fprintf(csv, "%g,%s,%g,%s", rate, set_names[set], weber, kind_names[reach[i].kind]);
        for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
            fprintf(csv, ",%.12g", cells[c]);
        }
        fprintf(csv, ",%d\n", above > f * (1.0 + weber) * (1.0 + 1e-9));
    }
}

static void write_gaps(json_writer *json, const char *key, const study_reach *reach, size_t count, double weber,
                       int rule) {
    study_gap gaps[STUDY_MAX_REACH];
    const size_t found = study_gaps(reach, count, weber, rule, gaps);
    json_open(json, key, '[');
    for (size_t i = 0; i < found; i++) {
        const double gap[] = {gaps[i].low, gaps[i].high};
        json_numbers(json, NULL, gap, 2, 1);
    }
    json_close(json, ']');
}

/* One set at one Weber fraction: its limit, and its gaps by both rules. */
static void write_weber(json_writer *json, const study_reach *reach, size_t count, double weber) {
    json_open(json, NULL, '{');
    json_number(json, "weber", weber);
    json_number(json, "no_gap_up_to_hz", study_no_gap_up_to(reach, count, weber));
    write_gaps(json, "gaps_hz", reach, count, weber, STUDY_GAP_NEIGHBOUR);
    write_gaps(json, "unreached_hz", reach, count, weber, STUDY_GAP_UNREACHED);
    json_close(json, '}');
}

static void write_rate(json_writer *json, double rate) {
    const double top = 0.5 * rate;
    json_open(json, NULL, '{');
    json_number(json, "update_rate_hz", rate);
    json_number(json, "lowest_hz", LOWEST_HZ);
    json_number(json, "highest_hz", top);
    json_number(json, "mixed_hz", rate / 2.5);
    json_number(json, "reach_with_jnd_hz", top * (1.0 + PAPERS_WEBER));
    json_number(json, "smallest_period_mm", SPEED_MM_S / (top * (1.0 + PAPERS_WEBER)));
    json_number(json, "smallest_period_without_jnd_mm", SPEED_MM_S / top);
    json_open(json, "sets", '[');
    for (int set = 0; set < STUDY_SETS; set++) {
        study_reach reach[STUDY_MAX_REACH];
        const size_t count = study_reachable(rate, LOWEST_HZ, set, reach);
        json_open(json, NULL, '{');
        json_string(json, "set", set_names[set]);
        json_number(json, "frequencies", (double)count);
        json_open(json, "haptic", '[');
        for (size_t w = 0; w < sizeof webers / sizeof *webers; w++) {
            write_weber(json, reach, count, webers[w]);
        }
        json_close(json, ']');
        json_close(json, '}');
    }
    json_close(json, ']');
    json_close(json, '}');
}

/* The paper prints the frequency from which steps are audible, but no audible Weber fraction. Around that limit: the
 * reachable neighbours; the fractions (from, below) for which this step is the first audible one; and the fraction if
 * the limit were f(1 + WF), as for 230 and 461 Hz: with that one, much lower steps would be audible, so it is not the
 * paper's rule. */
static void write_audible(json_writer *json, int set, double printed) {
    study_reach reach[STUDY_MAX_REACH];
    const size_t count = study_reachable(1000.0, LOWEST_HZ, set, reach);
    size_t i = 1;
    while (i + 2 < count && reach[i + 1].frequency <= printed) {
        i++;
    }
    const double below = reach[i].frequency;
    const double above = reach[i + 1].frequency;
    json_open(json, NULL, '{');
    json_string(json, "set", set_names[set]);
    json_number(json, "printed_hz", printed);
    json_number(json, "below_hz", below);
    json_number(json, "above_hz", above);
    json_number(json, "weber_from", below / reach[i - 1].frequency - 1.0);
    json_number(json, "weber_below", above / below - 1.0);
    json_number(json, "weber_if_limit_is_f_1_plus_wf", printed / below - 1.0);
    json_close(json, '}');
}

static void write_json(json_writer *json) {
    static const double checks[] = {0.18, 0.20, 0.225, PRINTED_WEBER};
    study_reach reach[STUDY_MAX_REACH];
    const size_t count = study_reachable(1000.0, LOWEST_HZ, STUDY_SET_ODD, reach);
    json_string(json, "study", "coverage");
    json_number(json, "figure", 3);
    json_string(json, "rule", "a gap is a neighbour above f(1 + WF)");
    json_string(json, "unreached_rule", "further than WF from every frequency played, above or below");
    json_number(json, "speed_mm_s", SPEED_MM_S);
    json_open(json, "rates", '[');
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        write_rate(json, rates[r]);
    }
    json_close(json, ']');
    json_open(json, "audible", '[');
    write_audible(json, STUDY_SET_EVEN, 28.8);
    write_audible(json, STUDY_SET_ODD, 43.1);
    json_close(json, ']');
    json_open(json, "whole_periods_at_1_khz", '[');
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        write_weber(json, reach, count, checks[i]);
    }
    json_close(json, ']');
}

static void print_summary(double rate) {
    const double reach_hz = 0.5 * rate * (1.0 + PAPERS_WEBER);
    printf("%g kHz, haptic Weber fraction %g (a gap is a neighbour above f(1 + WF))\n", 1e-3 * rate, PAPERS_WEBER);
    for (int set = 0; set < STUDY_SETS; set++) {
        study_reach reach[STUDY_MAX_REACH];
        const size_t count = study_reachable(rate, LOWEST_HZ, set, reach);
        const double limit = study_no_gap_up_to(reach, count, PAPERS_WEBER);
        say(stdout, "  %-20s %3zu frequencies, no haptic gap up to %.0f Hz", set_words[set], count, limit);
        if (set == STUDY_SET_ODD) {
            printf(" (%.0f with %g)", study_no_gap_up_to(reach, count, PRINTED_WEBER), PRINTED_WEBER);
        }
        fputc('\n', stdout);
    }
    printf("  smallest period at %g mm/s: %.2f mm (%.0f Hz, within the JND of %g), %.2f mm without the JND\n",
           SPEED_MM_S, SPEED_MM_S / reach_hz, reach_hz, 0.5 * rate, SPEED_MM_S / (0.5 * rate));
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    fputs("update_rate_hz,set,weber,kind,period_ticks,frequency_hz,band_low_hz,band_high_hz,neighbour_hz,gap\n", csv);
    for (size_t i = 0; i < 2 * (size_t)STUDY_SETS * 2; i++) {
        write_rows(csv, rates[i / 6], (int)(i / 2 % 3), webers[i % 2]);
    }
    write_json(json);
    return 0;
}

int study_coverage(const char *folder) {
    if (study_write(folder, "coverage", write_all, NULL)) {
        return 1;
    }
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        print_summary(rates[r]);
    }
    return 0;
}
