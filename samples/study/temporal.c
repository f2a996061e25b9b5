/* Figure 4: dominant component, net force and correlation of T1, T2 and T3 from 2 to 35 ms, A = 1 N at 1 kHz; over
 * whole numbers of the actual period, and also over the paper's window. SPDX-License-Identifier: MIT */
#include "study.h"
#include "wave_options.h"

#include <math.h>
#include <stdlib.h>

#define RATE_HZ     1000.0
#define AMPLITUDE   1.0
#define FIRST       20  /* tenths of a millisecond: 2 ms */
#define LAST        350 /* 35 ms */
#define WINDOW      40  /* periods, as in the paper */
#define OVERSAMPLED 40  /* samples per tick: 40 kHz, as in the paper */
#define PI          3.141592653589793

/* The paper's periods are whole milliseconds and 2.5 ms; the tenths in between are ours. */
static int on_papers_grid(int tenths) {
    return tenths % 10 == 0 || tenths == 25;
}

typedef struct measured {
    study_signal signal;
    study_line dominant;
    double net;
    double rms;
    double spurious;       /* share of power outside the dominant line and its odd harmonics */
    double spurious_asked; /* outside the requested line and its odd harmonics */
    double window_net;     /* the paper's window; NaN off its grid */
    study_line window_dominant;
} measured;

/* Findings over all points. */
typedef struct findings {
    double worst_net[3];      /* largest |net|, our rule */
    double worst_net_at[3];   /* ms */
    double false_net[3];      /* largest |window's net - net| */
    double false_net_at[3];   /* ms */
    double rms_error;         /* largest |rms - A| on the paper's grid */
    double least_pcc_t1_t3;   /* on the whole periods */
    double least_dominant[3]; /* on the paper's grid */
    double least_dominant_at[3];
} findings;

/* 40 periods of T from tick 0, held and sampled at 40 kHz, DFT: T2's and T3's actual periods need not fit. */
static int measure_window(const knurl_wave *wave, int tenths, measured *m) {
    const size_t ticks = (size_t)tenths * WINDOW / 10; /* whole on the paper's grid */
    double *held = malloc(ticks * OVERSAMPLED * sizeof *held);
    study_signal signal;
    for (size_t i = 0; held && i < ticks * OVERSAMPLED; i++) {
        held[i] = knurl_wave_value(wave, i / OVERSAMPLED);
    }
    int done = held && study_signal_of_values(held, ticks * OVERSAMPLED, RATE_HZ * OVERSAMPLED, &signal);
    free(held);
    if (!done) {
        return 0;
    }
    done = study_dominant(&signal, &m->window_dominant);
    const double x = PI * m->window_dominant.frequency / signal.update_rate_hz;
    m->window_dominant.amplitude *= x / sin(x); /* a DFT of samples: undoes the second hold in study_dominant() */
    m->window_net = study_net(&signal);
    study_signal_free(&signal);
    return done;
}

static int measure(int32_t method, int tenths, measured *m) {
    knurl_wave wave;
    m->signal.values = NULL;
    m->window_net = NAN;
    m->window_dominant.amplitude = NAN;
    m->window_dominant.frequency = NAN;
    if (knurl_wave_prepare(method, tenths / 10.0 / RATE_HZ, AMPLITUDE, RATE_HZ, &wave) ||
        !study_signal_of_wave(&wave, RATE_HZ, &m->signal) || !study_dominant(&m->signal, &m->dominant)) {
        return 0;
    }
    m->net = study_net(&m->signal);
    m->rms = study_rms(&m->signal);
    m->spurious = study_spurious(&m->signal, m->dominant.frequency);
    m->spurious_asked = study_spurious(&m->signal, 10.0 * RATE_HZ / tenths);
    return !on_papers_grid(tenths) || measure_window(&wave, tenths, m);
}

static void write_row(FILE *csv, int tenths, const measured m[3], int i) {
    const double cells[] = {1e3 * (double)m[i].signal.length / RATE_HZ,
                            m[i].dominant.amplitude,
                            1e3 / m[i].dominant.frequency,
                            m[i].net,
                            m[i].rms,
                            study_pcc(&m[i].signal, &m[0].signal),
                            study_pcc(&m[i].signal, &m[1].signal),
                            study_pcc(&m[i].signal, &m[2].signal),
                            m[i].spurious,
                            m[i].spurious_asked,
                            m[i].window_dominant.amplitude,
                            1e3 / m[i].window_dominant.frequency,
                            m[i].window_net};
    fprintf(csv, "T%d,%g,%d", i + 1, tenths / 10.0, on_papers_grid(tenths));
    for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
        fputc(',', csv);
        out_number(csv, cells[c]);
    }
    fputc('\n', csv);
}

static void write_numbers(json_writer *json, const char *const *keys, const double *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        json_number(json, keys[i], values[i]);
    }
}

/* Writes a period of the paper's grid. */
static void write_point(json_writer *json, int tenths, const measured m[3]) {
    static const char *const keys[] = {"dominant_amplitude", "dominant_period_ms", "net", "rms",
                                       "spurious",           "spurious_asked"};
    static const char *const window_keys[] = {"dominant_amplitude", "dominant_period_ms", "net"};
    static const char *const pcc_keys[] = {"T1_T2", "T1_T3", "T2_T3"};
    const double pcc[] = {study_pcc(&m[0].signal, &m[1].signal), study_pcc(&m[0].signal, &m[2].signal),
                          study_pcc(&m[1].signal, &m[2].signal)};
    json_open(json, NULL, '{');
    json_number(json, "period_ms", tenths / 10.0);
    for (int i = 0; i < 3; i++) {
        const double values[] = {
            m[i].dominant.amplitude, 1e3 / m[i].dominant.frequency, m[i].net, m[i].rms, m[i].spurious,
            m[i].spurious_asked};
        const double window[] = {m[i].window_dominant.amplitude, 1e3 / m[i].window_dominant.frequency, m[i].window_net};
        json_open(json, wave_method_name(KNURL_WAVE_T1 + i), '{');
        write_numbers(json, keys, values, 6);
        json_open(json, "papers_window", '{');
        write_numbers(json, window_keys, window, 3);
        json_close(json, '}');
        json_close(json, '}');
    }
    json_open(json, "pcc", '{');
    write_numbers(json, pcc_keys, pcc, 3);
    json_close(json, '}');
    json_close(json, '}');
}

static void keep_findings(int tenths, const measured m[3], findings *f) {
    const double period_ms = tenths / 10.0;
    for (int i = 0; i < 3; i++) {
        if (on_papers_grid(tenths) && fabs(m[i].net) > f->worst_net[i] + 1e-12) {
            f->worst_net[i] = fabs(m[i].net);
            f->worst_net_at[i] = period_ms;
        }
        if (fabs(m[i].window_net - m[i].net) > f->false_net[i] + 1e-12) { /* false if the window's is NaN */
            f->false_net[i] = fabs(m[i].window_net - m[i].net);
            f->false_net_at[i] = period_ms;
        }
        if (on_papers_grid(tenths)) {
            f->rms_error = fmax(f->rms_error, fabs(m[i].rms - AMPLITUDE));
        }
        if (on_papers_grid(tenths) && m[i].dominant.amplitude < f->least_dominant[i] - 1e-9) {
            f->least_dominant[i] = m[i].dominant.amplitude;
            f->least_dominant_at[i] = period_ms;
        }
    }
    if (tenths % 10 == 0) {
        f->least_pcc_t1_t3 = fmin(f->least_pcc_t1_t3, study_pcc(&m[0].signal, &m[2].signal));
    }
}

static void write_findings(json_writer *json, const findings *f) {
    static const char *const keys[] = {"largest_net",  "at_ms",          "window_largest_false_net",
                                       "window_at_ms", "least_dominant", "least_dominant_at_ms"};
    json_open(json, "findings", '{');
    for (int i = 0; i < 3; i++) {
        const double values[] = {f->worst_net[i],    f->worst_net_at[i],   f->false_net[i],
                                 f->false_net_at[i], f->least_dominant[i], f->least_dominant_at[i]};
        json_open(json, wave_method_name(KNURL_WAVE_T1 + i), '{');
        write_numbers(json, keys, values, 6);
        json_close(json, '}');
        printf("T%d: largest net %.4f N", i + 1, f->worst_net[i]);
        if (f->worst_net[i] > 1e-9) {
            printf(" (%g ms)", f->worst_net_at[i]);
        }
        printf(", least dominant %.4f N (%g ms); the paper's window adds up to %.4f N of net\n", f->least_dominant[i],
               f->least_dominant_at[i], f->false_net[i]);
    }
    json_number(json, "largest_rms_error", f->rms_error);
    json_number(json, "least_pcc_T1_T3_at_whole_periods", f->least_pcc_t1_t3);
    json_close(json, '}');
    printf("correlation of T1 and T3 at whole periods: at least %.4f\n", f->least_pcc_t1_t3);
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    findings f = {{0}, {0}, {0}, {0}, 0.0, 1.0, {INFINITY, INFINITY, INFINITY}, {0}};
    fputs("method,period_ms,papers_grid,actual_period_ms,dominant_amplitude,dominant_period_ms,net,rms,pcc_T1,pcc_T2,"
          "pcc_T3,spurious,spurious_asked,window_dominant_amplitude,window_dominant_period_ms,window_net\n",
          csv);
    char window[64];
    (void)snprintf(window, sizeof window, "%d periods of T, held, sampled at %g kHz", WINDOW,
                   1e-3 * RATE_HZ * OVERSAMPLED);
    json_string(json, "study", "temporal");
    json_number(json, "figure", 4);
    json_number(json, "update_rate_hz", RATE_HZ);
    json_number(json, "amplitude", AMPLITUDE);
    json_string(json, "rule", "whole numbers of the actual period, held signal");
    json_string(json, "papers_window", window);
    json_open(json, "points", '[');
    for (int tenths = FIRST; tenths <= LAST; tenths++) {
        measured m[3];
        int done = 1;
        for (int i = 0; i < 3; i++) {
            done = measure(KNURL_WAVE_T1 + i, tenths, &m[i]) && done;
        }
        for (int i = 0; done && i < 3; i++) {
            write_row(csv, tenths, m, i);
        }
        if (done && on_papers_grid(tenths)) {
            write_point(json, tenths, m);
        }
        if (done) {
            keep_findings(tenths, m, &f);
        }
        for (int i = 0; i < 3; i++) {
            study_signal_free(&m[i].signal);
        }
        if (!done) {
            return 1;
        }
        study_progress("temporal", (double)(tenths - FIRST) / (LAST - FIRST));
    }
    json_close(json, ']');
    write_findings(json, &f);
    return 0;
}

int study_temporal(const char *folder) {
    return study_write(folder, "temporal", write_all, NULL);
}
