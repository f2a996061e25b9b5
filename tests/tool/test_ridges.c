/* Ridges found in drawn patterns, against the formulas that drew them. KNURL_LONG in the environment prints a table of
 * the whole range. SPDX-License-Identifier: MIT */
#include "drawn.h"
#include "ridges.h"
#include "support/close.h"

#include <stdio.h>
#include <string.h>

#define NONE {0.0, 0.0, DRAWN_SINE}

/* A drawing: up to two axes (apart 0: no axis), and disturbances. */
typedef struct drawing {
    uint32_t width, height;
    drawn_axis axes[2];
    double contrast; /* of the axes, against a brightness of 0.5; 0: full */
    double noise;    /* standard deviation of white noise */
    double light;    /* 1: the light falls off to a fifth across the picture */
    int blur;        /* the mean over so many samples to either side */
} drawing;

static double brightness(const drawing *d, double x, double y) {
    const double one = drawn_height(&d->axes[0], x, y);
    const double other = d->axes[1].apart > 0.0 ? drawn_height(&d->axes[1], x, y) : one;
    const double light = 1.0 - d->light * 0.8 * (x / d->width) * (0.5 + 0.5 * y / d->height);
    return light * (0.5 + 0.25 * (d->contrast > 0.0 ? d->contrast : 1.0) * (one + other));
}

static float *draw(const drawing *d, uint64_t seed) {
    float *samples = malloc((size_t)d->width * d->height * sizeof *samples);
    assert_non_null(samples);
    for (uint32_t y = 0; y < d->height; y++) {
        for (uint32_t x = 0; x < d->width; x++) {
            double sum = 0.0;
            for (int j = -d->blur; j <= d->blur; j++) {
                for (int i = -d->blur; i <= d->blur; i++) {
                    sum += brightness(d, (double)x + i + 0.5, (double)y + j + 0.5);
                }
            }
            const double side = 2.0 * d->blur + 1.0;
            samples[(size_t)y * d->width + x] = (float)(sum / side / side + d->noise * drawn_normal(&seed));
        }
    }
    return samples;
}

static ridges find(const drawing *d, uint64_t seed) {
    ridges found;
    float *samples = draw(d, seed);
    const field f = {d->width, d->height, samples, NULL, d->width};
    assert_int_equal(ridges_find(&f, &found), 1);
    free(samples);
    return found;
}

/* The relative error of an axis's frequency, and its direction's in degrees, of the found axis that is nearest. */
static void find_error(const ridges *r, const drawn_axis *drawn, double error[2]) {
    error[0] = error[1] = HUGE_VAL;
    for (int i = 0; i < r->count; i++) {
        const double *f = r->frequency[i];
        const double off = fabs(hypot(f[0], f[1]) * drawn->apart - 1.0);
        const double turned = remainder(360.0 / DRAWN_TURN * atan2(-f[1], f[0]) - drawn->degrees, 180.0);
        if (off + fabs(turned) < error[0] + error[1]) {
            error[0] = off;
            error[1] = fabs(turned);
        }
    }
}

static int is_found(const ridges *r, const drawn_axis *drawn, double most, double most_degrees) {
    double error[2];
    find_error(r, drawn, error);
    return r->confidence >= RIDGES_CONFIDENT && error[0] <= most && error[1] <= most_degrees;
}

static void check_drawing(const drawing *d, double most, double most_degrees) {
    const ridges r = find(d, 1);
    const int axes = d->axes[1].apart > 0.0 ? 2 : 1;
    for (int i = 0; i < axes; i++) {
        if (!is_found(&r, &d->axes[i], most, most_degrees) || r.count != axes) {
            double error[2];
            find_error(&r, &d->axes[i], error);
            fail_msg(
                "%g samples apart at %g degrees: expected %d axes within %g and %g degrees, found %d, off by %g and "
                "%g degrees, confidence %g",
                d->axes[i].apart, d->axes[i].degrees, axes, most, most_degrees, r.count, error[0], error[1],
                r.confidence);
        }
    }
}

TEST(ridges_are_found_from_the_shortest_to_a_fifth_of_the_picture) {
    static const double apart[] = {2.4, 3.0, 4.0, 7.7, 16.0, 31.0, 47.0};
    static const double degrees[] = {0.0, 33.0, 90.0, 145.0};
    for (size_t i = 0; i < COUNT_OF(apart); i++) {
        for (size_t k = 0; k < COUNT_OF(degrees); k++) {
            const drawing d = {240, 250, {{apart[i], degrees[k], DRAWN_SINE}, NONE}, 0, 0, 0, 0};
            check_drawing(&d, 0.004, 0.3);
        }
    }
}

TEST(a_harmonic_is_not_taken_for_the_fundamental) {
    static const int shapes[] = {DRAWN_SQUARE, DRAWN_SAW, DRAWN_NO_FUNDAMENTAL};
    for (size_t i = 0; i < COUNT_OF(shapes); i++) {
        const drawing d = {256, 256, {{21.3, 25.0, shapes[i]}, NONE}, 0, 0.05, 0, 0};
        check_drawing(&d, 0.002, 0.1);
    }
}

TEST(a_pattern_of_two_axes_has_both) {
    const drawing grid = {256, 256, {{12.0, 10.0, DRAWN_SQUARE}, {19.0, 100.0, DRAWN_SQUARE}}, 0, 0.02, 0, 0};
    const drawing sheared = {256, 256, {{12.0, 10.0, DRAWN_SINE}, {17.0, 62.0, DRAWN_SINE}}, 0, 0.02, 0, 0};
    check_drawing(&grid, 0.002, 0.2);
    check_drawing(&sheared, 0.002, 0.2);
}

TEST(blur_noise_and_light_do_not_hide_ridges) {
    const drawing blurred = {256, 256, {{9.0, 70.0, DRAWN_SQUARE}, NONE}, 0, 0.02, 0, 3};
    const drawing noisy = {256, 256, {{9.0, 70.0, DRAWN_SINE}, NONE}, 0.1, 0.1, 0, 0}; /* 0.05 in noise of 0.1 */
    const drawing lit = {256, 256, {{9.0, 70.0, DRAWN_SINE}, NONE}, 0.3, 0.02, 1, 0};
    check_drawing(&blurred, 0.002, 0.2);
    check_drawing(&noisy, 0.005, 0.5);
    check_drawing(&lit, 0.002, 0.2);
}

static double confidence_in(const float *samples, uint32_t size, uint32_t stride) {
    ridges found;
    const field f = {size, size, samples, NULL, stride};
    assert_int_equal(ridges_find(&f, &found), 1);
    return found.confidence;
}

/* White, and with power as 1/f^2 and 1/f^3, as photographs of unpatterned surfaces have it. */
static int count_false_alarms(int pictures, uint32_t size) {
    int alarms = 0;
    uint64_t seed = 12345;
    for (int i = 0; i < pictures; i++) {
        float *samples = drawn_fractal(size, i % 3 == 1 ? 0.01 : 0.5, &seed);
        assert_non_null(samples);
        for (size_t k = 0; k < (size_t)size * size && i % 3 == 0; k++) {
            samples[k] = (float)drawn_normal(&seed);
        }
        const uint32_t inside = size - size / 5; /* the torus would repeat at the edges */
        alarms += confidence_in(samples, inside, size) >= RIDGES_CONFIDENT;
        free(samples);
    }
    return alarms;
}

TEST(noise_is_no_grating) {
    const int pictures = getenv("KNURL_LONG") ? 600 : SUITE_SANITIZED ? 6 : 30;
    assert_int_equal(count_false_alarms(pictures, 256), 0);
}

/* Edges, a blob, a slope, nothing at all: strong, but in one place. */
TEST(one_object_is_no_grating) {
    static float samples[5][200 * 200];
    for (int y = 0; y < 200; y++) {
        for (int x = 0; x < 200; x++) {
            const int at = 200 * y + x;
            samples[0][at] = (float)(x + 0.4 * y > 120.0);
            samples[1][at] = (float)(x > 77);
            samples[2][at] = (float)exp(-((x - 90.0) * (x - 90.0) + (y - 70.0) * (y - 70.0)) / 800.0);
            samples[3][at] = (float)(0.004 * x + 1e-5 * y * y);
            samples[4][at] = 0.5F;
        }
    }
    for (int i = 0; i < 5; i++) {
        assert_true(confidence_in(samples[i], 200, 200) < RIDGES_CONFIDENT);
    }
}

/* --- depth --- */

TEST(the_amplitude_of_heights_is_half_of_peak_to_peak) {
    const drawing d = {256, 256, {{12.6, 30.0, DRAWN_SINE}, NONE}, 0.6, 0.01, 0, 0};
    float *samples = draw(&d, 1);
    const field f = {256, 256, samples, NULL, 256};
    const double unit[2] = {1.0, 1.0};
    ridges r;
    profile p;
    assert_int_equal(ridges_find(&f, &r), 1);
    ridges_profile(&f, r.frequency[0], unit, 0, &p);
    CHECK_CLOSE(p.amplitude, 0.3, 0.003); /* 0.25 (1 + 1) times the contrast */
    free(samples);
}

/* h = A sin(k . p): slopes A k cos(k . p), with samples that are twice as high as wide. down_sign: -1: a normal map
 * whose green runs down. */
static double amplitude_from_slopes(double down_sign) {
    static float right[200 * 200], down[200 * 200];
    const double amplitude = 0.2e-3, sample[2] = {0.1e-3, 0.2e-3}; /* m */
    const double k[2] = {DRAWN_TURN / 1.3e-3 * 0.8, DRAWN_TURN / 1.3e-3 * 0.6};
    for (int y = 0; y < 200; y++) {
        for (int x = 0; x < 200; x++) {
            const double slope = amplitude * cos(k[0] * sample[0] * x + k[1] * sample[1] * y);
            right[200 * y + x] = (float)(k[0] * slope);
            down[200 * y + x] = (float)(down_sign * k[1] * slope);
        }
    }
    const field f = {200, 200, right, down, 200};
    ridges r;
    profile p;
    assert_int_equal(ridges_find(&f, &r), 1);
    assert_int_equal(r.count, 1);
    ridges_profile(&f, r.frequency[0], sample, 0, &p);
    return p.amplitude;
}

TEST(slopes_integrate_to_the_amplitude) {
    CHECK_CLOSE(amplitude_from_slopes(1.0), 0.2e-3, 0.004e-3);
    CHECK_CLOSE(amplitude_from_slopes(-1.0), 0.2e-3, 0.004e-3);
}

/* --- the whole range, for the long form --- */

static void print_row(const char *name, const drawing *like) {
    double worst[2] = {0.0, 0.0}, sum = 0.0;
    int found = 0, all = 0;
    for (int step = 0; step < 24; step++) {
        const double apart = 2.3 * pow(1.17, step); /* to 85 */
        for (int way = 0; way < 9; way++) {
            const double degrees = 1.0 + 19.0 * way;
            drawing d = *like;
            double error[2];
            d.axes[0].apart = apart;
            d.axes[0].degrees = degrees;
            d.axes[1].apart = like->axes[1].apart > 0.0 ? 1.4 * apart : 0.0;
            d.axes[1].degrees = degrees + like->axes[1].degrees;
            if (d.axes[1].apart > 0.24 * d.width || (like->blur > 0 && apart < 2.5 * (2 * like->blur + 1))) {
                continue;
            }
            const ridges r = find(&d, 1);
            find_error(&r, &d.axes[0], error);
            all++;
            if (r.confidence >= RIDGES_CONFIDENT && error[0] < 0.02 && error[1] < 2.0) {
                found++;
                worst[0] = fmax(worst[0], error[0]);
                worst[1] = fmax(worst[1], error[1]);
                sum += error[0];
            }
        }
    }
    print_message("%-24s %4d of %4d found; frequency off by %.3f %% in the mean, %.2f %% at most; direction by %.2f "
                  "degrees\n",
                  name, found, all, 100.0 * sum / (found ? found : 1), 100.0 * worst[0], worst[1]);
    assert_true(found >= 0.9 * all);
}

static double smallest_contrast(double noise) {
    for (int step = 0; step < 60; step++) {
        const double contrast = pow(1.12, -step);
        for (uint64_t seed = 1; seed <= 8; seed++) {
            const drawing d = {400, 400, {{11.3, 28.0, DRAWN_SINE}, NONE}, contrast, noise, 0, 0};
            const ridges r = find(&d, seed);
            if (!is_found(&r, &d.axes[0], 0.02, 2.0)) {
                return contrast * 1.12;
            }
        }
    }
    return 0.0;
}

TEST(the_table_of_the_whole_range) {
    static const struct {
        const char *name;
        drawing like;
    } rows[] = {{"sine", {400, 400, {{1, 1, DRAWN_SINE}, NONE}, 0, 0, 0, 0}},
                {"square", {400, 400, {{1, 1, DRAWN_SQUARE}, NONE}, 0, 0, 0, 0}},
                {"saw", {400, 400, {{1, 1, DRAWN_SAW}, NONE}, 0, 0, 0, 0}},
                {"grid", {400, 400, {{1, 1, DRAWN_SQUARE}, {1, 90, DRAWN_SQUARE}}, 0, 0, 0, 0}},
                {"sheared, 55 degrees", {400, 400, {{1, 1, DRAWN_SINE}, {1, 55, DRAWN_SINE}}, 0, 0, 0, 0}},
                {"blurred by 5 samples", {400, 400, {{1, 1, DRAWN_SQUARE}, NONE}, 0, 0.01, 0, 2}},
                {"noise of 0.2", {400, 400, {{1, 1, DRAWN_SINE}, NONE}, 0.5, 0.2, 0, 0}},
                {"light to a fifth", {400, 400, {{1, 1, DRAWN_SINE}, NONE}, 0.3, 0.01, 1, 0}}};
    if (!getenv("KNURL_LONG")) {
        skip();
    }
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        print_row(rows[i].name, &rows[i].like);
    }
    for (int i = 0; i < 5; i++) {
        const double noise = 0.02 * (1 << i);
        print_message("white noise of %.2f: smallest amplitude found %.4f\n", noise, 0.5 * smallest_contrast(noise));
    }
}
