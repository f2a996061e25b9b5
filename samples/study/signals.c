/* Figure 2: signals of T1, T2 and T3 at even, odd, 400 Hz and other periods, and the two parts of a mixed signal.
 * SPDX-License-Identifier: MIT */
#include "say.h"
#include "study.h"
#include "wave_options.h"

#include <math.h>

#define RATE_HZ   1000.0
#define AMPLITUDE 1.0
#define TICKS     60

static const double periods_ms[] = {4.0, 3.0, 5.0, 2.5, 3.3};
static const char *const period_kinds[] = {"even", "odd", "odd", "mixed", "other"};
#define PERIODS (sizeof periods_ms / sizeof *periods_ms)

/* The one or two square waves that sum to a signal: T2's are in the wave; the mixed case is Eq. 8's. 0 for T1, and for
 * a T3 event that is not mixed. */
static int parts_of(const knurl_wave *wave, knurl_vibration_event parts[2]) {
    if (wave->method == KNURL_WAVE_T2) {
        parts[0] = wave->parts[0];
        parts[1] = wave->parts[1];
        return wave->part_count;
    }
    if (wave->method == KNURL_WAVE_T3 && wave->parts[0].kind == KNURL_EVENT_MIXED) {
        const double root = sqrt(13.0);
        return knurl_vibration_event_prepare(2.0, 2.0 * AMPLITUDE / root, &parts[0]) ||
                       knurl_vibration_event_prepare(3.0, 3.0 * AMPLITUDE / root, &parts[1])
                   ? 0
                   : 2;
    }
    return 0;
}

static double part_value(const knurl_vibration_event *part, uint64_t tick) {
    return knurl_vibration_event_height(part, (int32_t)(tick % (uint64_t)part->length));
}

/* tick, value, and the parts if the signal is a sum of two. */
static void write_rows(FILE *csv, const knurl_wave *wave, double period_ms) {
    knurl_vibration_event parts[2];
    const int count = parts_of(wave, parts);
    for (uint64_t tick = 0; tick < TICKS; tick++) {
        fprintf(csv, "%s,%g,%d,", wave_method_name(wave->method), period_ms, (int)tick);
        out_number(csv, knurl_wave_value(wave, tick));
        for (int i = 0; i < 2; i++) {
            fputc(',', csv);
            if (count == 2) {
                out_number(csv, part_value(&parts[i], tick));
            }
        }
        fputc('\n', csv);
    }
}

static void write_parts(json_writer *json, const knurl_wave *wave) {
    knurl_vibration_event parts[2];
    const int count = parts_of(wave, parts);
    json_open(json, "parts", '[');
    for (int i = 0; i < count && count == 2; i++) {
        const double ap = parts[i].positive;
        const double an = parts[i].negative;
        const double rms = sqrt((ap * ap * parts[i].positive_ticks + /* half peak to peak, from Eq. 6 inverted */
                                 an * an * (parts[i].length - parts[i].positive_ticks)) /
                                parts[i].length);
        json_open(json, NULL, '{');
        json_number(json, "period_ms", 1e3 * parts[i].length / RATE_HZ);
        json_number(json, "amplitude", rms);
        json_close(json, '}');
    }
    json_close(json, ']');
}

/* 0, or 1 if memory runs out. */
static int write_cell(json_writer *json, const knurl_wave *wave, size_t index) {
    static const char *const keys[] = {"net", "rms", "dominant_amplitude", "dominant_hz", "actual_period_ms", "peak"};
    study_signal signal;
    study_line line;
    double peak = 0.0;
    if (!study_signal_of_wave(wave, RATE_HZ, &signal) || !study_dominant(&signal, &line)) {
        study_signal_free(&signal);
        return 1;
    }
    for (size_t i = 0; i < signal.length; i++) {
        peak = fmax(peak, fabs(signal.values[i]));
    }
    const double cells[] = {study_net(&signal),
                            study_rms(&signal),
                            line.amplitude,
                            line.frequency,
                            1e3 * (double)signal.length / RATE_HZ,
                            peak};
    json_open(json, NULL, '{');
    json_string(json, "method", wave_method_name(wave->method));
    json_number(json, "period_ms", periods_ms[index]);
    json_string(json, "kind", period_kinds[index]);
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
        json_number(json, keys[c], cells[c]);
    }
    write_parts(json, wave);
    json_close(json, '}');
    if (wave->method != KNURL_WAVE_T2 && (periods_ms[index] == 3.0 || periods_ms[index] == 2.5)) {
        say(stdout, "%s at %g ms: net %.4f N, peak %.4f N, dominant %.4f N at %.1f Hz, repeats after %zu ms\n",
            wave_method_name(wave->method), periods_ms[index], fabs(cells[0]) < 1e-12 ? 0.0 : cells[0], peak,
            line.amplitude, line.frequency, signal.length);
    }
    study_signal_free(&signal);
    return 0;
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    fputs("method,period_ms,tick,value,part1,part2\n", csv);
    json_string(json, "study", "signals");
    json_number(json, "figure", 2);
    json_number(json, "update_rate_hz", RATE_HZ);
    json_number(json, "amplitude", AMPLITUDE);
    json_open(json, "cells", '[');
    for (size_t p = 0; p < PERIODS; p++) {
        for (int32_t method = KNURL_WAVE_T1; method <= KNURL_WAVE_T3; method++) {
            knurl_wave wave;
            if (knurl_wave_prepare(method, 1e-3 * periods_ms[p], AMPLITUDE, RATE_HZ, &wave) ||
                write_cell(json, &wave, p)) {
                return tool_error(2, "study: signals: %s at %g ms cannot be measured", wave_method_name(method),
                                  periods_ms[p]);
            }
            write_rows(csv, &wave, periods_ms[p]);
        }
    }
    json_close(json, ']');
    return 0;
}

int study_signals(const char *folder) {
    return study_write(folder, "signals", write_all, NULL);
}
