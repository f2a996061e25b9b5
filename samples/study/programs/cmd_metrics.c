/* knurl metrics: metrics of a temporal vibration. SPDX-License-Identifier: MIT */
#include "metrics.h"

#include "json.h"
#include "programs.h"
#include "steady.h"
#include "wave_options.h"

#include <knurl/knurl.h>

#include <math.h>
#include <stdlib.h>

/* Correlations with the other methods' signals at the same period. */
static void print_correlations(json_writer *json, const tool_wave *asked, const study_signal *signal) {
    json_open(json, "pcc", '{');
    for (int32_t i = KNURL_WAVE_T1; i <= KNURL_WAVE_T3; i++) {
        knurl_wave wave;
        study_signal other;
        if (knurl_wave_prepare(i, asked->period_s, asked->amplitude, asked->rate, &wave) ||
            !study_signal_of_wave(&wave, asked->rate, &other)) {
            json_number(json, wave_method_name(i), NAN); /* null: no whole period within reach */
            continue;
        }
        json_number(json, wave_method_name(i), study_pcc(signal, &other));
        study_signal_free(&other);
    }
    json_close(json, '}');
}

/* Metrics for a hand over whole actual periods, 1 s or 20 periods: the line at the frequency, the evenness of its
 * level, and the mean force over 50 ms. */
static int print_steady(json_writer *json, const tool_wave *asked, const study_signal *signal) {
    const double length = (double)signal->length;
    const size_t ticks = signal->length * (size_t)ceil(fmax(1.0, 20.0 * asked->period_s) * asked->rate / length);
    double *values = malloc(ticks * sizeof *values);
    steady_metrics steady;
    for (size_t i = 0; values && i < ticks; i++) {
        values[i] = knurl_wave_value(&asked->wave, i);
    }
    const int measured = values && steady_measure(values, ticks, asked->rate, 1.0 / asked->period_s, &steady);
    if (measured) {
        json_number(json, "level", steady.level);
        json_number(json, "wavering", steady.wavering);
        json_number(json, "push", steady.push);
        json_number(json, "false_tones", steady.false_tones);
        json_number(json, "felt_false_tones", steady.felt_false);
    }
    free(values);
    return measured;
}

int cmd_metrics(int argc, char **argv) {
    tool_wave asked;
    study_signal signal;
    study_line dominant;
    int pretty = 0;
    const tool_option option = {"--pretty", TOOL_FLAG, &pretty, 0, 0, ""};
    const int code = tool_read_wave(argc, argv, &option, &asked);
    if (code != TOOL_OK) {
        return code;
    }
    if (!study_signal_of_wave(&asked.wave, asked.rate, &signal)) {
        return tool_error(TOOL_FAILURE, "metrics: no whole number of periods of %g ms within %d ticks",
                          1e3 * asked.period_s, STUDY_MAX_PERIOD);
    }
    if (!study_dominant(&signal, &dominant)) {
        study_signal_free(&signal);
        return tool_error(TOOL_FAILURE, "metrics: no memory");
    }
    json_writer json;
    json_start(&json, stdout, pretty);
    json_open(&json, NULL, '{');
    json_number(&json, "actual_period_ms", 1e3 * (double)signal.length / asked.rate);
    json_number(&json, "dominant_hz", dominant.frequency);
    json_number(&json, "dominant_amplitude", dominant.amplitude);
    json_number(&json, "net", study_net(&signal));
    json_number(&json, "rms", study_rms(&signal));
    const int done = print_steady(&json, &asked, &signal);
    print_correlations(&json, &asked, &signal);
    json_close(&json, '}');
    study_signal_free(&signal);
    return done ? TOOL_OK : tool_error(TOOL_FAILURE, "metrics: no memory");
}
