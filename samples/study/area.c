/* Study `area`: three ways to average a grid, over all directions; and a search for AREA's worst cases.
 * SPDX-License-Identifier: MIT */
#include "area_parts.h"
#include "gratings.h"
#include "metrics.h"
#include "steady.h"
#include "study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI      3.141592653589793
#define FS      1000.0
#define TICKS   1000
#define SPEED   0.15
#define SAMPLES 128 /* of a tick's way, for the mean of Eq. 11 */

/* Ways to play a grid. POINT: Eq. 11, which is S1. PLACE: its mean along the way. WAY: area sampling of Eq. 12's count
 * of the way. AXIS: of the coordinate along which the most cycles go by, which is what the library does. */
enum { POINT, PLACE, WAY, AXIS, CANDIDATES };
static const char *const names[CANDIDATES] = {"point", "place", "way", "axis"};

typedef struct scan {
    double speed, angle; /* m/s, rad */
    double start[2];     /* cycles */
    double quantum;      /* m */
} scan;

typedef struct finding {
    double rms, share, push, unevenness;
} finding;

static double quantise(double x, double quantum) {
    return quantum > 0.0 ? floor(x / quantum + 0.5) * quantum : x;
}

/* The mean of Eq. 11 along a straight way. */
static double mean_of_places(const double from[2], const double to[2]) {
    static const double fs[2] = {FS, FS};
    double sum = 0.0;
    for (int i = 0; i < SAMPLES; i++) {
        const double at = (i + 0.5) / SAMPLES;
        const double place[2] = {from[0] + at * (to[0] - from[0]), from[1] + at * (to[1] - from[1])};
        sum += knurl_grating_s1(place, fs, 1.0);
    }
    return sum / SAMPLES;
}

static void play(int candidate, const scan *s, double heights[TICKS]) {
    const double velocity[2] = {s->speed * cos(s->angle), s->speed * sin(s->angle)};
    const double along[2] = {knurl_grating_frequency((const double[2]){FS, FS}, velocity) / FS, 0.0};
    const knurl_grating line = gratings_make(KNURL_METHOD_AREA, FS, 0.0);
    knurl_grating grid = gratings_make(candidate == AXIS ? KNURL_METHOD_AREA : KNURL_METHOD_S1, FS, FS);
    knurl_grating_state state;
    double last[2] = {0.0, 0.0};
    memset(&state, 0, sizeof state);
    grid.resolution = s->quantum;
    for (int k = -1; k < TICKS; k++) {
        const double t = k / GRATINGS_RATE;
        const double place[2] = {quantise(s->start[0] / FS + velocity[0] * t, s->quantum),
                                 quantise(s->start[1] / FS + velocity[1] * t, s->quantum)};
        const double way[2] = {s->start[0] / FS + along[0] * t, 0.0};
        knurl_grating_output out;
        if (candidate == WAY) {
            knurl_grating_step(&line, &state, way, along, &out);
        } else {
            knurl_grating_step(&grid, &state, place, velocity, &out);
        }
        heights[k > 0 ? k : 0] = candidate == PLACE ? mean_of_places(last, place) : out.height;
        memcpy(last, place, sizeof last);
    }
}

/* The share of the varying power in the strongest line, Hann's window's width of it. NaN: no memory. */
static double strongest_share(const double *heights) {
    double windowed[TICKS];
    study_signal signal;
    double mean = 0.0;
    double all = 0.0;
    double best = 0.0;
    for (int k = 0; k < TICKS; k++) {
        mean += heights[k] / TICKS;
    }
    for (int k = 0; k < TICKS; k++) {
        windowed[k] = (heights[k] - mean) * (0.5 - 0.5 * cos(2.0 * PI * (k + 0.5) / TICKS));
    }
    double *bins = study_signal_of_values(windowed, TICKS, GRATINGS_RATE, &signal) ? study_magnitudes(&signal) : NULL;
    for (int line = 3; bins && line <= TICKS / 2; line++) {
        double power = 0.0;
        for (int i = -2; i <= 2; i++) {
            power += bins[(line + i) % TICKS] * bins[(line + i) % TICKS];
        }
        all += bins[line] * bins[line];
        best = fmax(best, power);
    }
    const double share = bins ? (all > 1e-12 ? best / all : 0.0) : NAN;
    free(bins);
    study_signal_free(&signal);
    return fmin(1.0, share);
}

static int judge(int candidate, const scan *s, finding *found) {
    double heights[TICKS];
    steady_metrics steady;
    play(candidate, s, heights);
    found->rms = 0.0;
    for (int k = 0; k < TICKS; k++) {
        found->rms += heights[k] * heights[k] / TICKS;
    }
    found->rms = sqrt(found->rms);
    found->share = strongest_share(heights);
    const double way[2] = {s->speed * cos(s->angle), s->speed * sin(s->angle)};
    const double frequency = knurl_grating_frequency((const double[2]){FS, FS}, way);
    const int measured = steady_measure(heights, TICKS, GRATINGS_RATE, frequency, &steady);
    found->push = steady.push;
    found->unevenness = steady.unevenness;
    return measured && !isnan(found->share);
}

/* How many ticks of a stroke there and back, turned anywhere, have another sign at the same place. */
static double turned_share(int candidate) {
    double other = 0.0;
    for (int turn = 0; turn < 100; turn++) {
        const scan s = {0.05, 0.4, {0.037 * turn, 0.011 * turn}, 0.0};
        const double c[2] = {cos(s.angle), sin(s.angle)};
        const knurl_grating grating = gratings_make(KNURL_METHOD_AREA, FS, candidate == WAY ? 0.0 : FS);
        knurl_grating_state state;
        double there[100];
        memset(&state, 0, sizeof state);
        for (int k = 0; k < 199; k++) {
            const int at = k < 100 ? k : 198 - k;
            const double sign = k < 100 ? 1.0 : -1.0;
            const double way = s.speed / GRATINGS_RATE;
            const double place[2] = {s.start[0] / FS + way * at * c[0], s.start[1] / FS + way * at * c[1]};
            const double gone[2] = {s.start[0] / FS + way * k * c[0], 0.0};
            const double velocity[2] = {(candidate == WAY ? 1.0 : sign) * s.speed * c[0],
                                        candidate == WAY ? 0.0 : sign * s.speed * c[1]};
            knurl_grating_output out;
            knurl_grating_step(&grating, &state, candidate == WAY ? gone : place, velocity, &out);
            if (k < 100) {
                there[k] = out.height;
            } else {
                other += out.height * there[at + 1] < 0.0 ? 1.0 / (99 * 100) : 0.0;
            }
        }
    }
    return other;
}

static int write_directions(FILE *csv, json_writer *json) {
    fputs("candidate,angle_deg,rms,share,push\n", csv);
    printf(
        "| 1 mm checkerboard, 150 mm/s, 37 directions, 3 starts | rms, least | strongest line, least (at) | push, worst (at) | "
        "other sign on the way back |\n|---|---|---|---|---|\n");
    json_open(json, "candidates", '[');
    for (int c = 0; c < CANDIDATES; c++) {
        finding worst = {HUGE_VAL, HUGE_VAL, 0.0, 0.0};
        double at[2] = {0.0, 0.0};
        for (int degrees = 0; degrees <= 180; degrees += 5) {
            for (int i = 0; i < 3; i++) {
                const scan s = {SPEED, degrees * PI / 180.0, {0.137 + 0.25 * i, 0.071 + 0.111 * i}, 0.0};
                finding f;
                if (!judge(c, &s, &f)) {
                    return 1;
                }
                fprintf(csv, "%s,%d,%.6g,%.6g,%.6g\n", names[c], degrees, f.rms, f.share, f.push);
                worst.rms = fmin(worst.rms, f.rms);
                at[0] = f.share < worst.share ? degrees : at[0];
                worst.share = fmin(worst.share, f.share);
                at[1] = f.push > worst.push ? degrees : at[1];
                worst.push = fmax(worst.push, f.push);
            }
        }
        const double turned = c == WAY || c == AXIS ? turned_share(c) : 0.0;
        printf("| %s | %.2f A | %.0f %% (%g) | %.3f A (%g) | %.0f %% |\n", names[c], worst.rms, 100.0 * worst.share,
               at[0], worst.push, at[1], 100.0 * turned);
        json_open(json, NULL, '{');
        json_string(json, "name", names[c]);
        json_number(json, "least_rms", worst.rms);
        json_number(json, "least_share", worst.share);
        json_number(json, "worst_push", worst.push);
        json_number(json, "turned", turned);
        json_close(json, '}');
    }
    json_close(json, ']');
    return 0;
}

static double uniform(uint64_t *seed) {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

/* The worst of speed, direction, start and encoder: random steps from the worst so far, that shrink (Luus and Jaakola),
 * from several beginnings. */
static int search(const char *name, int by_push, json_writer *json) {
    uint64_t seed = 88172645463325252u;
    scan best = {0.2, 0.0, {0.0, 0.0}, 0.0};
    double most = 0.0;
    for (int begin = 0; begin < 4; begin++) {
        scan here = {0.02 + 0.43 * uniform(&seed), PI * uniform(&seed), {uniform(&seed), uniform(&seed)}, 0.0};
        double reach = 1.0;
        double top = 0.0;
        for (int i = 0; i < 400; i++, reach *= 0.985) {
            finding f;
            scan s = here;
            s.speed = fmin(0.45, fmax(0.02, s.speed + reach * 0.43 * (uniform(&seed) - 0.5)));
            s.angle += reach * PI * (uniform(&seed) - 0.5);
            s.start[0] += reach * (uniform(&seed) - 0.5);
            s.start[1] += reach * (uniform(&seed) - 0.5);
            s.quantum = fmin(0.055e-3, fmax(0.0, s.quantum + reach * 0.055e-3 * (uniform(&seed) - 0.5)));
            if (!judge(AXIS, &s, &f)) {
                return 1;
            }
            if ((by_push ? f.push : f.unevenness) > top) {
                top = by_push ? f.push : f.unevenness;
                here = s;
            }
        }
        best = top > most ? here : best;
        most = fmax(most, top);
    }
    printf("| worst %s by search | %.3f at %.1f mm/s, %.1f degrees, start %.3f %.3f, encoder %.4f mm |\n", name, most,
           1e3 * best.speed, best.angle * 180.0 / PI, best.start[0], best.start[1], 1e3 * best.quantum);
    json_open(json, name, '{');
    json_number(json, "worst", most);
    json_number(json, "speed", best.speed);
    json_number(json, "angle_deg", best.angle * 180.0 / PI);
    json_number(json, "quantum", best.quantum);
    json_close(json, '}');
    return 0;
}

static int write_all(FILE *csv, json_writer *json, void *user) {
    (void)user;
    json_string(json, "study", "area");
    json_string(json, "table", "area.csv");
    return write_directions(csv, json) || search("push", 1, json) || search("unevenness", 0, json) ||
           area_positions(json) || area_steady(json) || area_levels(json);
}

int study_area(const char *folder) {
    return study_write(folder, "area", write_all, NULL);
}
