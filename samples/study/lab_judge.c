/* The verdict on a run of the laboratory, from its signals. SPDX-License-Identifier: MIT */
#include "lab.h"

#include <kiss_fft.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI    3.141592653589793
#define BANDS 15 /* of a third of an octave: 20 to 508 Hz */

/* Runaways are compared with the reference, whose texture may itself bang and swing. */
#define BANGS_FEW     6.0 /* three full swings from the force limit to no contact and back may be the hand's arrival */
#define SWING_SMALL   0.001 /* m: twenty quanta; a limit cycle of quantisation and dry friction is one or two */
#define GROWTH_STEADY 1.5   /* times the reference's, if that grows */

/* Felt: above the threshold of detection, and not masked by the texture: the Weber fraction of a
 * vibration's amplitude is 0.1 to 0.3 (common). */
#define MASKED 1.2

double lab_threshold(double hz) {
    /* Of a stylus held as a pen (Israr, Choi and Tan 2006; common): about 0.2 um at the most sensitive frequency, four
     * times as much at half that frequency, and in proportion to the frequency above. */
    return 0.2e-6 * fmax(pow(250.0 / hz, 2.0), hz / 250.0);
}

const char *lab_outcome_name(int outcome) {
    static const char *const names[] = {"rest", "vibration", "limit cycle", "unstable"};
    return names[outcome];
}

/* Mean squares in the bands, of two signals at once: the real and the imaginary part of one transform. */
static int band_powers(const double *one, const double *other, size_t count, double rate, double powers[2][BANDS]) {
    kiss_fft_cfg plan = kiss_fft_alloc((int)count, 0, NULL, NULL);
    kiss_fft_cpx *in = malloc(2 * count * sizeof *in);
    kiss_fft_cpx *out = in + count;
    double mean[2] = {0.0, 0.0};
    double window = 0.0;
    if (!plan || !in) {
        free(plan);
        free(in);
        return 1;
    }
    for (size_t i = 0; i < count; i++) {
        mean[0] += one[i] / (double)count;
        mean[1] += other[i] / (double)count;
    }
    for (size_t i = 0; i < count; i++) { /* in um or mN, to avoid loss in single precision */
        const double hann = 0.5 - 0.5 * cos(2.0 * PI * ((double)i + 0.5) / (double)count);
        in[i].r = (float)(1e6 * hann * (one[i] - mean[0]));
        in[i].i = (float)(1e6 * hann * (other[i] - mean[1]));
        window += hann * hann;
    }
    kiss_fft(plan, in, out);
    memset(powers, 0, 2 * sizeof powers[0]);
    for (size_t k = 1; k < (count + 1) / 2; k++) {
        const int band = (int)floor(3.0 * log2((double)k * rate / (double)count / 20.0) + 0.5);
        if (band >= 0 && band < BANDS) {
            const double a = 0.5 * ((double)out[k].r + (double)out[count - k].r);
            const double b = 0.5 * ((double)out[k].i - (double)out[count - k].i);
            const double c = 0.5 * ((double)out[k].i + (double)out[count - k].i);
            const double d = 0.5 * ((double)out[count - k].r - (double)out[k].r);
            powers[0][band] += 2e-12 * (a * a + b * b) / (window * (double)count);
            powers[1][band] += 2e-12 * (c * c + d * d) / (window * (double)count);
        }
    }
    free(in);
    free(plan);
    return 0;
}

static double beyond(double powers[2][BANDS], int band) {
    return fmax(0.0, powers[0][band] - powers[1][band]);
}

static int activities(const lab_signals *s, double rate, lab_result *r) {
    const size_t count = (s->count - s->judged) / 100 * 100; /* no large prime in the transform's length */
    const size_t from = s->count - count;
    double motion[2][BANDS];
    double force[2][BANDS];
    if (band_powers(s->height + from, s->reference + from, count, rate, motion) ||
        band_powers(s->motor + from, s->reference_force + from, count, rate, force)) {
        return 1;
    }
    for (int band = 0; band < BANDS; band++) {
        const double least = lab_threshold(20.0 * pow(2.0, band / 3.0));
        r->activity_motion += beyond(motion, band);
        r->activity_force += beyond(force, band);
        r->activity += beyond(motion, band) / (least * least);
        r->felt += motion[0][band] / (least * least);
        r->asked += motion[1][band] / (least * least);
    }
    r->activity_motion = sqrt(r->activity_motion);
    r->activity_force = sqrt(r->activity_force);
    r->activity = sqrt(r->activity);
    r->felt = sqrt(r->felt);
    r->asked = sqrt(r->asked);
    return 0;
}

/* Half swings between the force limit and no force. */
static double count_bangs(const double *force, size_t from, size_t count, double max_force) {
    double bangs = 0.0;
    int at_limit = 0;
    for (size_t i = from; i < count; i++) {
        const double size = fabs(force[i]);
        if (at_limit ? size <= 0.0 : size >= 0.98 * max_force) {
            at_limit = !at_limit;
            bangs++;
        }
    }
    return bangs;
}

static double swing(const double *height, size_t from, size_t count) {
    double low = height[from];
    double high = height[from];
    for (size_t i = from; i < count; i++) {
        low = fmin(low, height[i]);
        high = fmax(high, height[i]);
    }
    return high - low;
}

static double rms(const double *values, size_t count) {
    double sum = 0.0;
    double squares = 0.0;
    for (size_t i = 0; i < count; i++) {
        sum += values[i];
    }
    for (size_t i = 0; i < count; i++) {
        squares += (values[i] - sum / (double)count) * (values[i] - sum / (double)count);
    }
    return sqrt(squares / (double)count);
}

/* The last third of the judged part over its first; 1 if nothing moves at first. */
static double growth(const double *height, size_t from, size_t count) {
    const size_t third = (count - from) / 3;
    const double first = rms(height + from, third);
    return first > 0.0 ? rms(height + count - third, third) / first : 1.0;
}

/* A spring whose rest is H stores K (H - z)^2 / 2 in contact; moving H adds to that, which is authorised. The motors'
 * further work is unauthorised. */
void lab_energies(const lab_case *c, const lab_signals *s, lab_result *r) {
    double given = 0.0;
    double authorised = 0.0;
    for (size_t i = 1; i < s->count; i++) {
        const double pressed = fmax(0.0, s->texture[i] - s->height[i]);
        const double before = fmax(0.0, s->texture[i - 1] - s->height[i]);
        given += s->motor[i] * (s->height[i] - s->height[i - 1]);
        r->energy = fmax(r->energy, given);
        r->unauthorised = fmax(r->unauthorised, given - authorised);
        authorised += 0.5 * c->stiffness * (pressed * pressed - before * before);
    }
}

static int decide(const lab_case *c, const lab_result *r) {
    const int beyond_asked = r->activity > 1.0 && hypot(r->asked, r->activity) > MASKED * r->asked;
    const int wide = r->swing > 2.0 * r->reference_swing + SWING_SMALL;
    const int bangs = r->bangs > 2.0 * r->reference_bangs + BANGS_FEW && r->swing > 1.5 * r->reference_swing;
    const int grows = beyond_asked && r->growth > GROWTH_STEADY * fmax(1.0, r->reference_growth);
    if (!isfinite(r->activity) || wide || bangs || grows) {
        return LAB_UNSTABLE;
    }
    if (beyond_asked) {
        return LAB_LIMIT_CYCLE;
    }
    return c->amplitude > 0.0 && r->felt > 1.0 ? LAB_VIBRATION : LAB_REST;
}

int lab_judge(const lab_case *c, const lab_signals *s, double max_force, lab_result *r) {
    const uint32_t guards = KNURL_TICK_ENTRY | KNURL_TICK_SLEW | KNURL_TICK_HEAT | KNURL_TICK_PASSIVITY;
    for (size_t i = 0; i < s->count; i++) {
        r->force_max = fmax(r->force_max, fabs(s->motor[i]));
        r->guarded_ticks += (s->flags[i] & guards) != 0;
    }
    lab_energies(c, s, r);
    r->bangs = count_bangs(s->motor, s->judged, s->count, max_force);
    r->reference_bangs = count_bangs(s->reference_force, s->judged, s->count, max_force);
    r->swing = swing(s->height, s->judged, s->count);
    r->reference_swing = swing(s->reference, s->judged, s->count);
    r->growth = growth(s->height, s->judged, s->count);
    r->reference_growth = growth(s->reference, s->judged, s->count);
    if (activities(s, c->rate, r)) {
        return 1;
    }
    r->outcome = decide(c, r);
    return 0;
}
