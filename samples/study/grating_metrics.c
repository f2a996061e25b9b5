/* Metrics of scans over gratings. SPDX-License-Identifier: MIT */
#include "grating_metrics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI       3.141592653589793
#define ROUNDING 1e-9 /* of a cycle: sums of a million ticks stay well within */
#define IMAGES                                                                                                         \
    10 /* multiples of the update rate up to which the held spectrum is summed: 99 % of a square wave's images */
#define MIX_CYCLES 2.4 /* 6 ticks of 2.5 ticks a cycle */

double study_event_cycles(const knurl_vibration_event *event) {
    return event->kind == KNURL_EVENT_MIXED ? MIX_CYCLES : 1.0;
}

int study_plays_event(const knurl_grating *grating, const knurl_grating_output *out) {
    return out->event != KNURL_NO_EVENT && (grating->method == KNURL_METHOD_S2);
}

void study_motion_line(const double start[2], const double velocity[2], double update_rate_hz, study_motion *motion,
                       size_t ticks) {
    for (size_t k = 0; k < ticks; k++) {
        for (int i = 0; i < 2; i++) {
            motion[k].position[i] = start[i] + velocity[i] * ((double)k / update_rate_hz);
            motion[k].velocity[i] = velocity[i];
        }
    }
}

static int allocate(size_t ticks, double update_rate_hz, study_scan *scan) {
    memset(scan, 0, sizeof *scan);
    scan->ticks = ticks;
    scan->update_rate_hz = update_rate_hz;
    scan->height = calloc(ticks + 1, sizeof *scan->height);
    scan->crossed = calloc(ticks + 1, sizeof *scan->crossed);
    scan->played = calloc(ticks + 1, sizeof *scan->played);
    scan->within = calloc(ticks + 1, sizeof *scan->within);
    scan->cycles = calloc(ticks + 1, sizeof *scan->cycles);
    if (scan->height && scan->crossed && scan->played && scan->within && scan->cycles) {
        return 1;
    }
    study_scan_free(scan);
    return 0;
}

void study_scan_free(study_scan *scan) {
    free(scan->height);
    free(scan->crossed);
    free(scan->played);
    free(scan->within);
    free(scan->cycles);
    memset(scan, 0, sizeof *scan);
}

/* 1 if the height's sign differs from that of the last height other than 0. */
static int turns(double height, double *last) {
    const int turned = height * *last < 0.0;
    *last = height != 0.0 ? height : *last;
    return turned;
}

static double crossed_in_a_tick(const knurl_grating *grating, const double velocity[2], int crossed) {
    const double *fs = grating->spatial_frequency;
    return (crossed == STUDY_CROSSED_PATH ? knurl_grating_frequency(fs, velocity)
                                          : fs[0] * fabs(velocity[0]) + fs[1] * fabs(velocity[1])) /
           grating->update_rate_hz;
}

int study_scan_run(const knurl_grating *grating, const study_motion *motion, size_t ticks, int crossed,
                   study_scan *scan) {
    knurl_grating_state state;
    double last = 0.0;
    if (!allocate(ticks, grating->update_rate_hz, scan)) {
        return 0;
    }
    memset(&state, 0, sizeof state);
    for (size_t k = 0; k < ticks; k++) {
        knurl_grating_output out;
        knurl_grating_step(grating, &state, motion[k].position, motion[k].velocity, &out);
        const int turned = turns(out.height, &last);
        scan->height[k] = out.height;
        scan->crossed[k + 1] = scan->crossed[k] + crossed_in_a_tick(grating, motion[k].velocity, crossed);
        if (!study_plays_event(grating, &out)) {
            scan->played[k] += turned ? 0.5 : 0.0;
            scan->played[k + 1] = scan->played[k];
            scan->whole = k + 1;
            scan->within[k] = -1.0;
        } else {
            scan->within[k] = (double)(state.next_tick - 1) / state.event.length;
            scan->cycles[k] = study_event_cycles(&state.event);
            scan->played[k + 1] = scan->played[k] + scan->cycles[k] / state.event.length;
            scan->whole = state.playing ? scan->whole : k + 1;
        }
    }
    scan->events = state.event_count;
    return 1;
}

int study_scan_of_values(const double *values, size_t ticks, double period_ticks, double update_rate_hz,
                         study_scan *scan) {
    double last = 0.0;
    if (!allocate(ticks, update_rate_hz, scan)) {
        return 0;
    }
    memcpy(scan->height, values, ticks * sizeof *values);
    scan->whole = ticks;
    for (size_t k = 0; k < ticks; k++) {
        scan->within[k] = -1.0;
        scan->played[k] += turns(values[k], &last) ? 0.5 : 0.0;
        scan->played[k + 1] = scan->played[k];
        scan->crossed[k + 1] = (double)(k + 1) / period_ticks;
    }
    return 1;
}

double study_scan_drift(const study_scan *scan) {
    const double crossed = scan->crossed[scan->whole];
    return crossed > 0.0 ? scan->played[scan->whole] / crossed - 1.0 : NAN;
}

double study_scan_phase_error(const study_scan *scan) {
    double worst = 0.0;
    for (size_t k = 0; k <= scan->ticks; k++) {
        worst = fmax(worst, fabs(scan->played[k] - scan->crossed[k]));
    }
    return worst;
}

/* State of the felt half cycles; the present one starts at half cycle `half`. */
typedef struct felt {
    double half;   /* counted in the direction of motion; even: high */
    double sign;   /* of the height */
    double cycles; /* of the last tick's event; 0: no event */
    int begun;     /* the count has started */
} felt;

/* Counts one tick of an event; returns its phase error. */
static double feel_event(felt *f, double within, double cycles, double phase) {
    if (within == 0.0) {
        if (!f->begun) {
            f->half = 2.0 * floor(phase + 0.5);
        } else {
            f->half = f->cycles > 0.0 ? f->half + 2.0 * f->cycles : 2.0 * floor(0.5 * (f->half + 1.0));
        }
        f->begun = 1;
    }
    f->cycles = cycles;
    return f->begun ? fabs(0.5 * f->half + within * cycles - phase) : 0.0;
}

/* Counts one tick without an event. Returns the distance of the phase from the felt half cycle. */
static double feel_half(felt *f, double sign, double phase) {
    const double odd = sign < 0.0 ? 1.0 : 0.0;
    if (sign == 0.0) {
        return 0.0;
    }
    if (!f->begun) { /* the middle of a half: (half + 0.5) / 2 */
        f->half = 2.0 * floor(phase - 0.5 * odd + 0.25) + odd;
    } else if (f->cycles > 0.0) {
        f->half += 2.0 * f->cycles - odd; /* the next cycle starts, or the event's second half continues */
    } else if (sign != f->sign) {
        f->half += 1.0;
    }
    f->begun = 1;
    f->cycles = 0.0;
    return fmax(0.0, fmax(0.5 * f->half - phase, phase - 0.5 * (f->half + 1.0)));
}

/* Tick k of a scan, its phase ahead in the direction of motion; `first`: start of the first cycle, NaN before. */
static void take_step(const study_scan *scan, size_t k, double ahead, felt *f, double first[2], study_step *step) {
    const double sign = scan->height[k] > 0.0 ? 1.0 : scan->height[k] < 0.0 ? -1.0 : 0.0;
    const double half = f->half;
    const int begun = f->begun;
    int begins = scan->within[k] == 0.0;
    if (scan->within[k] >= 0.0) {
        step->error = fmax(step->error, feel_event(f, scan->within[k], scan->cycles[k], ahead));
    } else {
        step->error = fmax(step->error, feel_half(f, sign, ahead));
        begins = begun && f->half != half && fmod(f->half, 2.0) == 0.0;
    }
    f->sign = sign != 0.0 ? sign : f->sign;
    if (begins && isnan(first[0])) {
        first[0] = 0.5 * f->half;
        first[1] = ahead;
    }
    if (begins) {
        step->played = 0.5 * f->half - first[0];
        step->crossed = ahead - first[1];
    }
}

study_step study_scan_step(const study_scan *scan, const double *phase) {
    study_step step = {0.0, 0.0, 0.0, 0.0};
    felt f = {0.0, 0.0, 0.0, 0};
    double first[2] = {NAN, NAN};
    double direction = scan->ticks > 1 ? phase[1] - phase[0] : 1.0;
    double length = 0.0;
    for (size_t k = 0; k < scan->ticks; k++) {
        const double way = k > 0 ? phase[k] - phase[k - 1] : 0.0;
        if (way * direction < 0.0) {
            f.begun = 0;
            first[0] = NAN;
        }
        direction = way != 0.0 ? way : direction;
        take_step(scan, k, direction < 0.0 ? 0.5 - phase[k] : phase[k], &f, first, &step);
        length = scan->within[k] < 0.0 ? 0.0 : scan->within[k] == 0.0 ? 1.0 : length + 1.0;
        step.longest = fmax(step.longest, length);
    }
    return step;
}

double study_scan_dropout(const study_scan *scan) {
    double next = 0.0; /* the earliest half cycle that is still open */
    double dropped = 0.0;
    double passed = 0.0;
    for (size_t k = 0; k <= scan->ticks; k++) {
        const double at = 2.0 * scan->crossed[k] + ROUNDING;
        while (at >= next + 2.0) {
            /* a half cycle that starts at this tick is too late for it */
            dropped += 1.0;
            next += 1.0;
        }
        while (2.0 * scan->played[k] + ROUNDING >= passed + 1.0) {
            passed += 1.0;
            next += at >= next - 1.0 ? 1.0 : 0.0; /* otherwise it is one too many */
        }
    }
    return next > 0.0 ? dropped / next : NAN;
}

double study_scan_net(const study_scan *scan, double stiffness, double depth) {
    double sum = 0.0;
    for (size_t k = 0; k < scan->whole; k++) {
        sum += fmax(0.0, scan->height[k] + depth);
    }
    return scan->whole > 0 ? stiffness * (sum / (double)scan->whole - fmax(0.0, depth)) : NAN;
}

double study_scan_push(const study_scan *scan, double frequency, double seconds) {
    const double cycles = fmax(1.0, floor(seconds * frequency + 0.5));
    const double ticks = cycles / frequency * scan->update_rate_hz;
    double sum = 0.0;
    double blocks = 0.0;
    for (;; blocks += 1.0) {
        const size_t begin = (size_t)floor(blocks * ticks + 0.5);
        const size_t end = (size_t)floor((blocks + 1.0) * ticks + 0.5);
        double mean = 0.0;
        if (end > scan->ticks) {
            return blocks > 0.0 ? sum / blocks : NAN;
        }
        for (size_t k = begin; k < end; k++) {
            mean += scan->height[k];
        }
        sum += fabs(mean) / (double)(end - begin);
    }
}

/* The windowed height without its windowed mean. Returns its power, 0 if it is constant. */
static double windowed(const study_scan *scan, double *values) {
    const double n = (double)scan->ticks;
    double sum = 0.0;
    double weights = 0.0;
    double power = 0.0;
    for (size_t k = 0; k < scan->ticks; k++) {
        const double weight = 0.5 - 0.5 * cos(2.0 * PI * ((double)k + 0.5) / n);
        sum += weight * scan->height[k];
        weights += weight;
        values[k] = weight;
    }
    for (size_t k = 0; k < scan->ticks; k++) {
        values[k] *= scan->height[k] - sum / weights;
        power += values[k] * values[k];
    }
    return power;
}

/* |DFT|^2 of lines 0 to n/2; cosines: a table of n. */
static void spectrum(const double *values, size_t n, const double *cosines, double *powers) {
    for (size_t line = 0; line <= n / 2; line++) {
        double re = 0.0;
        double im = 0.0;
        size_t at = 0;
        size_t sine = 3 * n / 4; /* cos(x + 3 pi/2) is sin(x); n is a multiple of 4 */
        for (size_t k = 0; k < n; k++) {
            re += values[k] * cosines[at];
            im += values[k] * cosines[sine];
            at = at + line >= n ? at + line - n : at + line;
            sine = sine + line >= n ? sine + line - n : sine + line;
        }
        powers[line] = re * re + im * im;
    }
}

/* The share of power in lines that are far from every odd multiple. powers: lines 0 to n/2 of n. */
static double far_share(const double *powers, size_t n, double cycles, double tolerance) {
    double all = 0.0;
    double far = 0.0;
    for (size_t line = 1; line <= IMAGES * n; line++) {
        const size_t bin = line % n;
        const double x = PI * (double)line / (double)n;
        const double held = sin(x) / x;
        const double power = powers[bin <= n / 2 ? bin : n - bin] * held * held;
        const double order = (double)line / cycles;
        const double odd = fmax(1.0, 2.0 * floor(0.5 * order) + 1.0);
        all += power;
        far += fabs(order - odd) > tolerance ? power : 0.0;
    }
    return far / all;
}

double study_scan_spurious(const study_scan *scan, double frequency, double tolerance) {
    study_scan cut = *scan;
    cut.ticks = scan->ticks / 4 * 4;
    double *work = calloc(3 * cut.ticks + 1, sizeof *work);
    double share = NAN;
    if (work && cut.ticks > 0 && windowed(&cut, work) > 0.0) {
        double *cosines = work + cut.ticks;
        double *powers = cosines + cut.ticks;
        for (size_t k = 0; k < cut.ticks; k++) {
            cosines[k] = cos(2.0 * PI * (double)k / (double)cut.ticks);
        }
        spectrum(work, cut.ticks, cosines, powers);
        share = far_share(powers, cut.ticks, frequency / cut.update_rate_hz * (double)cut.ticks, tolerance);
    }
    free(work);
    return share;
}
