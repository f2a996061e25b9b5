/* Measuring a response. SPDX-License-Identifier: MIT */
#include "sweep.h"

#include "say.h"
#include "watch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI       3.141592653589793
#define FIRST_S  3.0 /* s before the first row: until then the driver has checked the motors' direction */
#define SETTLE_S 0.5 /* s before each row */
#define FADE_S   0.1 /* s: in and out */
#define SHORT_S  2.0 /* s of a row */
#define LONG_S   8.0 /* s, above FINE_HZ: the grip only moves by micrometres */
#define FINE_HZ  160.0
#define SLOW_HZ  2.0  /* of the slow motion */
#define SLOW     0.2  /* its share of the force */
#define HIGHEST  0.42 /* of the update rate: above, the images of the held force are as strong as the line */
#define REACH    0.03 /* m */
#define BESIDE   8    /* bins on either side that tell the noise, from the third on */

/* A row's place in time: `settle` ticks, `window` ticks that are measured, `fade` ticks. */
typedef struct part {
    uint64_t begin, settle, window, end;
    uint64_t cycles; /* in the window */
} part;

typedef struct sweeping {
    double rate, newtons;
    part parts[SWEEP_ROWS];
    uint32_t count;
    uint32_t now; /* the part that is played */
    uint64_t ticks;
    uint64_t seen; /* ticks whose position was stored */
    double start[3];
    float *positions; /* m, along y, from the start; one a tick */
    int is_away;
    knurl_loop *loop;
} sweeping;

static void plan(sweeping *s) {
    const double fade = floor(FADE_S * s->rate);
    uint64_t at = 0;
    for (uint32_t i = 0; i < SWEEP_ROWS; i++) {
        part *p = &s->parts[i];
        const double hz = fmin(500.0, 20.0 * exp2(i / 6.0));
        if (hz > HIGHEST * s->rate) {
            break;
        }
        s->count++;
        p->begin = at;
        p->settle = (uint64_t)floor((i == 0 ? FIRST_S : SETTLE_S) * s->rate);
        p->window = (uint64_t)floor((hz > FINE_HZ ? LONG_S : SHORT_S) * s->rate);
        p->cycles = (uint64_t)floor(hz * (double)p->window / s->rate + 0.5);
        at = p->end = at + p->settle + p->window + (uint64_t)fade;
    }
    s->ticks = at;
}

/* The sine's phase in cycles, 0 at the window's begin. */
static double phase_of(const part *p, uint64_t tick) {
    const uint64_t k = tick - p->begin + p->window - p->settle % p->window;
    return (double)(p->cycles * (k % p->window) % p->window) / (double)p->window;
}

/* 0 to 1 and back within a part. */
static double envelope(const sweeping *s, const part *p, uint64_t tick) {
    const double edge = fmin((double)(tick - p->begin), (double)(p->end - 1 - tick)) / (FADE_S * s->rate);
    return edge < 1.0 ? 0.5 - 0.5 * cos(PI * edge) : 1.0;
}

static void play(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    sweeping *s = user;
    if (tick == 0) {
        memcpy(s->start, sample->position, sizeof s->start);
    }
    for (int axis = 0; axis < 3; axis++) {
        force[axis] = 0.0;
        s->is_away |= !(fabs(sample->position[axis] - s->start[axis]) <= REACH);
    }
    if (s->is_away || tick >= s->ticks) {
        knurl_loop_request_stop(s->loop);
        return;
    }
    s->positions[tick] = (float)(sample->position[1] - s->start[1]);
    s->seen = tick + 1;
    s->now += tick >= s->parts[s->now].end;
    const part *p = &s->parts[s->now];
    const double slow = SLOW * sin(2.0 * PI * fmod(SLOW_HZ * (double)tick / s->rate, 1.0));
    const double newtons =
        s->newtons * ((1.0 - SLOW) * envelope(s, p, tick) * sin(2.0 * PI * phase_of(p, tick)) + slow);
    force[1] = fmin(SWEEP_FORCE_MAX, fmax(-SWEEP_FORCE_MAX, newtons));
}

/* The line of so many cycles a window, m: through Hann's window, so that drift and the slow motion stay off it. */
static double line_of(const sweeping *s, const part *p, uint64_t cycles) {
    const float *at = s->positions + p->begin + p->settle;
    double sum[2] = {0.0, 0.0};
    for (uint64_t k = 0; k < p->window; k++) {
        const double angle = 2.0 * PI * (double)(cycles * k % p->window) / (double)p->window;
        const double value = (double)at[k] * (1.0 - cos(2.0 * PI * (double)k / (double)p->window));
        sum[0] += value * cos(angle);
        sum[1] += value * sin(angle);
    }
    return 2.0 * hypot(sum[0], sum[1]) / (double)p->window;
}

/* Positions are read once a tick, so that the images of the held force fold onto the line. At frequencies that matter
 * here a grip is a mass: z-transform and sinc give its motion over the motion read:
 * sin(a)^3 / (a^3 cos a) at a = pi f / f_h. */
static double unfold(double hz, double rate) {
    const double a = PI * hz / rate;
    const double sinc = sin(a) / a;
    return sinc * sinc * sinc / cos(a);
}

static void analyse(const sweeping *s, sweep *result) {
    for (uint32_t i = 0; i < s->count; i++) {
        const part *p = &s->parts[i];
        sweep_row *row = &result->rows[i];
        double power = 0.0;
        for (uint64_t n = 3; n < 3 + BESIDE; n++) {
            power += pow(line_of(s, p, p->cycles - n), 2.0) + pow(line_of(s, p, p->cycles + n), 2.0);
        }
        row->hz = (double)p->cycles * s->rate / (double)p->window;
        const double scale = unfold(row->hz, s->rate) / ((1.0 - SLOW) * s->newtons);
        row->gain = scale * line_of(s, p, p->cycles);
        row->noise = scale * sqrt(power / (2.0 * BESIDE));
    }
    result->row_count = s->count;
    result->rate = s->rate;
    result->newtons = s->newtons;
    result->seconds = (double)s->ticks / s->rate;
}

static knurl_result judge(const sweeping *s, const knurl_loop_stats *stats, int fault, int is_interrupted) {
    if (s->is_away) {
        return knurl_fail(KNURL_ERROR_STATE,
                          "expected a grip that is held within %g mm of its place, found it farther away", 1e3 * REACH);
    }
    if (fault || stats->state == KNURL_LOOP_LOST) {
        return knurl_fail(KNURL_ERROR_DEVICE_NOT_READY, "expected a device without faults, found: %s",
                          knurl_fault_string(fault ? fault : KNURL_FAULT_LOST));
    }
    if (is_interrupted) {
        return knurl_fail(KNURL_ERROR_CANCELLED, "interrupted");
    }
    if (s->seen < s->ticks || stats->heat_ticks > 0) {
        return knurl_fail(
            KNURL_ERROR_DEVICE_NOT_READY, "expected %llu ticks at full force, found %llu, %llu of them with less",
            (unsigned long long)s->ticks, (unsigned long long)s->seen, (unsigned long long)stats->heat_ticks);
    }
    return KNURL_OK;
}

static knurl_result measure(knurl_device *device, sweeping *s, int simulated, volatile sig_atomic_t *interrupted,
                            sweep *result) {
    knurl_loop_desc desc;
    knurl_loop_stats stats;
    knurl_loop_desc_init(&desc, sizeof desc);
    knurl_loop_stats_init(&stats, sizeof stats);
    desc.device = device;
    desc.force_callback = play;
    desc.user = s;
    desc.update_rate_hz = s->rate;
    desc.tick_limit = s->ticks;
    knurl_result failed = knurl_loop_create(&desc, &s->loop);
    failed = failed || simulated ? failed : knurl_loop_start(s->loop);
    if (!failed) {
        const int fault = watch_loop(s->loop, device, s->ticks, s->rate, simulated, interrupted, &stats);
        failed = judge(s, &stats, fault, *interrupted);
    }
    knurl_loop_destroy(s->loop);
    if (!failed) {
        analyse(s, result);
        result->overruns = stats.overruns;
    }
    return failed;
}

knurl_result sweep_run(knurl_device *device, double rate, int simulated, volatile sig_atomic_t *interrupted,
                       sweep *result) {
    sweeping s;
    knurl_device_info info;
    memset(&s, 0, sizeof s);
    knurl_device_info_init(&info, sizeof info);
    knurl_result failed = knurl_device_get_info(device, &info);
    s.rate = rate;
    s.newtons = fmin(SWEEP_FORCE_MAX, fmin(info.max_force, info.continuous_force));
    plan(&s);
    s.positions = s.ticks > 0 ? calloc((size_t)s.ticks, sizeof *s.positions) : NULL;
    failed = failed ? failed
             : s.positions
                 ? measure(device, &s, simulated, interrupted, result)
                 : knurl_fail(KNURL_ERROR_MEMORY, "no memory for %llu positions", (unsigned long long)s.ticks);
    free(s.positions);
    return failed;
}

uint32_t sweep_count_clear(const sweep *s) {
    uint32_t count = 0;
    while (count < s->row_count && s->rows[count].gain > 5.0 * s->rows[count].noise) {
        count++;
    }
    return count;
}

void sweep_write(const sweep *s, FILE *stream, const char *name) {
    say(stream, "# knurl response 1\n");
    say(stream, "# %s: m of motion along y per N, at %g N and %g Hz, in the hand that held it\n", name, s->newtons,
        s->rate);
    say(stream, "frequency_hz,gain\n");
    for (uint32_t i = 0; i < sweep_count_clear(s); i++) {
        say(stream, "%.8g,%.6g\n", s->rows[i].hz, s->rows[i].gain);
    }
}
