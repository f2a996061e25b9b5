/* knurl study device: figure 11 (appendix A) on a simulated Touch whose HIP is fixed to a force sensor. The sensor's
 * reading is the force of the spring and damper that hold the plant, from its position at 40 kHz.
 * SPDX-License-Identifier: MIT */
#include "device_bench.h"
#include "study.h"
#include "wave_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PERIODS  35 /* 2, 2.5, 3, 4 ... 35 ticks: 29 to 500 Hz */
#define ODD      17 /* number of odd ones: 3, 5 ... 35 */
#define FIXTURES 4

/* Stiffness of fixture and drive (N/m), and damping of the drive (N s/m): neither is published. The first is damped
 * enough not to ring; it is fitted to the paper's words (amplitudes "often well below the desired value"), because no
 * numbers are printed. The others have the fake device's damping, and ring. */
static const double fixtures[FIXTURES][2] = {{40e3, 60.0}, {10e3, 0.5}, {40e3, 0.5}, {160e3, 0.5}};

typedef struct device_row {
    double period;       /* ticks */
    double commanded[3]; /* T1, T2, T3: dominant amplitude of the command, N */
    double dominant[3];  /* of the measured force, N */
    double frequency[3]; /* Hz, of the measured force's dominant component */
    double net_asked[3]; /* mean of the command, N */
    double net[3];       /* measured, bias subtracted as in the appendix, N */
    double net_raw[3];   /* measured, without subtraction, N */
    double pcc[3];       /* T1-T2, T1-T3, T2-T3, measured */
} device_row;

static double period_at(int i) {
    return i == 0 ? 2.0 : i == 1 ? 2.5 : (double)(i + 1);
}

static int measure_method(const bench_fixture *fixture, int method, device_row *row, study_signal *measured) {
    knurl_wave wave;
    study_signal command;
    study_line line;
    bench_reading reading;
    if (knurl_wave_prepare(KNURL_WAVE_T1 + method, row->period / BENCH_UPDATE_RATE, 1.0, BENCH_UPDATE_RATE, &wave) ||
        !study_signal_of_wave(&wave, BENCH_UPDATE_RATE, &command)) {
        return 0;
    }
    int done = study_dominant(&command, &line);
    row->commanded[method] = line.amplitude;
    row->net_asked[method] = study_net(&command);
    done = done && bench_measure(fixture, &command, measured, &reading);
    study_signal_free(&command);
    if (done && study_dominant(measured, &line)) {
        row->dominant[method] = line.amplitude;
        row->frequency[method] = line.frequency;
        row->net_raw[method] = study_net(measured);
        row->net[method] = row->net_raw[method] - 0.5 * (reading.before + reading.after);
        return 1;
    }
    return 0;
}

static int measure_row(const bench_fixture *fixture, device_row *row) {
    study_signal measured[3];
    int done = 1;
    memset(measured, 0, sizeof measured);
    for (int method = 0; done && method < 3; method++) {
        done = measure_method(fixture, method, row, &measured[method]);
    }
    if (done) {
        row->pcc[0] = study_pcc(&measured[0], &measured[1]);
        row->pcc[1] = study_pcc(&measured[0], &measured[2]);
        row->pcc[2] = study_pcc(&measured[1], &measured[2]);
    }
    for (int method = 0; method < 3; method++) {
        study_signal_free(&measured[method]);
    }
    return done;
}

static void write_csv(FILE *csv, const bench_fixture *fixture, const device_row *row) {
    for (int m = 0; m < 3; m++) {
        const double cells[] = {row->commanded[m], row->dominant[m], row->frequency[m],
                                row->net_asked[m], row->net[m],      row->net_raw[m]};
        out_number(csv, fixture->stiffness);
        fputc(',', csv);
        out_number(csv, fixture->viscous);
        fputc(',', csv);
        out_number(csv, row->period);
        fprintf(csv, ",%s", wave_method_name(KNURL_WAVE_T1 + m));
        for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) {
            fputc(',', csv);
            out_number(csv, cells[i]);
        }
        fputc('\n', csv);
    }
}

/* The appendix's claims in numbers, for one fixture. */
typedef struct device_claims {
    double t1_t3;         /* smallest ratio of T3's to T1's dominant amplitude, or its inverse */
    double t2_gain;       /* mean over odd periods of T2's transmission (measured / commanded) over T3's */
    double net_t1_3;      /* T1's net force at 3 ms, as measured */
    double net_others;    /* greatest |net| of T2 and T3, as measured */
    double net_corrected; /* and with the bias subtracted */
    double below;         /* share of periods at which T3 is below 0.9 of its command */
    double pcc[2];        /* T1-T3 at 2 and 3 ms */
    double pcc_above_3;   /* least T1-T3 above 3 ms */
} device_claims;

static device_claims judge(const device_row *rows) {
    device_claims c = {.t1_t3 = 1.0, .pcc_above_3 = 1.0};
    for (int i = 0; i < PERIODS; i++) {
        const device_row *r = &rows[i];
        const double ratio = r->dominant[2] / r->dominant[0];
        const int odd = fmod(r->period, 2.0) == 1.0;
        if (r->period != 2.5) {
            c.t1_t3 = fmin(c.t1_t3, fmin(ratio, 1.0 / ratio));
        }
        c.t2_gain += odd ? r->dominant[1] / r->commanded[1] / (r->dominant[2] / r->commanded[2]) / ODD : 0.0;
        c.net_t1_3 = r->period == 3.0 ? r->net_raw[0] : c.net_t1_3;
        c.net_others = fmax(c.net_others, fmax(fabs(r->net_raw[1]), fabs(r->net_raw[2])));
        c.net_corrected = fmax(c.net_corrected, fmax(fabs(r->net[1]), fabs(r->net[2])));
        c.below += r->dominant[2] < 0.9 * r->commanded[2] ? 1.0 / PERIODS : 0.0;
        c.pcc[0] = r->period == 2.0 ? r->pcc[1] : c.pcc[0];
        c.pcc[1] = r->period == 3.0 ? r->pcc[1] : c.pcc[1];
        c.pcc_above_3 = r->period > 3.0 ? fmin(c.pcc_above_3, r->pcc[1]) : c.pcc_above_3;
    }
    return c;
}

static void write_curves(json_writer *json, const device_row *rows) {
    static const char *const pairs[] = {"pcc_T1_T2", "pcc_T1_T3", "pcc_T2_T3"};
    const size_t stride = sizeof *rows / sizeof(double);
    for (int m = 0; m < 3; m++) {
        json_open(json, wave_method_name(KNURL_WAVE_T1 + m), '{');
        json_numbers(json, "commanded", &rows[0].commanded[m], PERIODS, stride);
        json_numbers(json, "dominant", &rows[0].dominant[m], PERIODS, stride);
        json_numbers(json, "dominant_hz", &rows[0].frequency[m], PERIODS, stride);
        json_numbers(json, "net_commanded", &rows[0].net_asked[m], PERIODS, stride);
        json_numbers(json, "net", &rows[0].net[m], PERIODS, stride);
        json_numbers(json, "net_without_bias_correction", &rows[0].net_raw[m], PERIODS, stride);
        json_close(json, '}');
    }
    for (int m = 0; m < 3; m++) {
        json_numbers(json, pairs[m], &rows[0].pcc[m], PERIODS, stride);
    }
}

static void write_fixture(json_writer *json, const bench_fixture *fixture, const device_row *rows) {
    const device_claims c = judge(rows);
    json_open(json, NULL, '{');
    json_number(json, "stiffness_n_per_m", fixture->stiffness);
    json_number(json, "damping_n_s_per_m", fixture->damping);
    json_number(json, "viscous_n_s_per_m", fixture->viscous);
    json_number(json, "resonance_hz", bench_resonance(fixture));
    json_numbers(json, "period_ticks", &rows[0].period, PERIODS, sizeof *rows / sizeof(double));
    write_curves(json, rows);
    json_open(json, "claims", '{');
    json_number(json, "t1_t3_least_ratio", c.t1_t3);
    json_number(json, "t2_over_t3_transmission_odd_periods", c.t2_gain);
    json_number(json, "net_t1_3_ticks", c.net_t1_3);
    json_number(json, "net_t2_t3_greatest", c.net_others);
    json_number(json, "net_t2_t3_greatest_bias_subtracted", c.net_corrected);
    json_number(json, "share_of_periods_below_0_9", c.below);
    json_numbers(json, "pcc_t1_t3_2_and_3_ticks", c.pcc, 2, 1);
    json_number(json, "pcc_t1_t3_least_above_3_ticks", c.pcc_above_3);
    json_close(json, '}');
    json_close(json, '}');
    printf(
        "  %.0f N/mm (%.0f Hz), %g N s/m lost:\n"
        "    T3 is below 0.9 of its command at %.0f %% of the periods; T2 at odd periods comes through %.2f times as well;\n"
        "    net force at 3 ms: T1 %.3f N, T2 and T3 anywhere up to %.3f N (bias subtracted as the paper does: %.3f N);\n"
        "    PCC of T1 and T3: %.4f at 2 ms, %.4f at 3 ms, at least %.4f above\n",
        1e-3 * fixture->stiffness, bench_resonance(fixture), fixture->viscous, 100.0 * c.below, c.t2_gain, c.net_t1_3,
        c.net_others, c.net_corrected, c.pcc[0], c.pcc[1], c.pcc_above_3);
}

static void write_settings(json_writer *json) {
    static const char *const differences[] = {
        "The paper fixed the HIP of a Phantom Omni to a 6-axis force sensor (40 kHz, four runs of 10 s). Here it is a"
        " simulation: one mass with viscous and dry friction in a spring and damper; the sensor reads their force.",
        "Mass (45 g) and friction (0.26 N) are the data sheet's, which is unverified; the stiffness of fixture and drive"
        " and what they lose are assumed, hence four settings. The first is fitted to the paper's words.",
        "Subtracting the force at rest before and after a run, as the paper does, subtracts what dry friction holds"
        " in the spring at rest; that alone looks like a net force in every method.",
        "The force sensor does not see the encoders, so their 0.055 mm are left out: resolution 0.",
        "No noise, no clock drift between command and sampling, no configuration-dependent inertia: one run, no"
        " confidence interval. T1 and T3 command the same numbers at 2 ms, so their PCC is 1 there."};
    json_string(json, "study", "device");
    json_number(json, "update_rate_hz", BENCH_UPDATE_RATE);
    json_number(json, "sampling_rate_hz", BENCH_SAMPLING_RATE);
    json_number(json, "amplitude_n", 1.0);
    json_number(json, "mass_kg", BENCH_MASS);
    json_number(json, "coulomb_n", BENCH_COULOMB);
    json_number(json, "fixture_damping_ratio", BENCH_DAMPING_RATIO);
    json_number(json, "resolution_m", 0.0);
    json_open(json, "differs_from_the_paper", '[');
    for (size_t i = 0; i < sizeof differences / sizeof *differences; i++) {
        json_string(json, NULL, differences[i]);
    }
    json_close(json, ']');
}

/* 0: out of memory, or an error of the simulated device */
static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    fputs("stiffness,viscous,period_ticks,method,commanded,dominant,dominant_hz,net_commanded,net,net_raw\n", csv);
    write_settings(json);
    json_open(json, "fixtures", '[');
    for (int f = 0; f < FIXTURES; f++) {
        const bench_fixture fixture = bench_make_fixture(fixtures[f][0], fixtures[f][1]);
        device_row rows[PERIODS];
        memset(rows, 0, sizeof rows);
        for (int i = 0; i < PERIODS; i++) {
            rows[i].period = period_at(i);
            if (!measure_row(&fixture, &rows[i])) {
                return 1;
            }
            write_csv(csv, &fixture, &rows[i]);
            study_progress("device", (f + (i + 1.0) / PERIODS) / FIXTURES);
        }
        write_fixture(json, &fixture, rows);
    }
    json_close(json, ']');
    return 0;
}

int study_device(const char *folder) {
    printf("device: 1 N through a simulated Touch (%g kg, %g N dry friction), fixed to a force sensor\n", BENCH_MASS,
           BENCH_COULOMB);
    return study_write(folder, "device", write_all, NULL);
}
