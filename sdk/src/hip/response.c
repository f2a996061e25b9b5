/* Gains for even sensation from a device's response: its file, its model, and the strength of ridges.
 * SPDX-License-Identifier: MIT */
#include "base/base.h"
#include "base/number.h"
#include "base/rule.h"

#include <knurl/hip.h>

#include <math.h>
#include <string.h>

#define PI        3.141592653589793
#define ROWS_MAX  1024
#define BYTES_MAX 65536
#define LOWEST_HZ 25.0  /* ridges are even from here */
#define EVEN_HZ   300.0 /* to here */
#define LEVEL_HZ  310.0 /* and are as strong as the weakest up to here, so that EVEN_HZ is not between two gains */

#define HAND_STIFFNESS 700.0 /* N/m: the fake device's hand, a light grip */
#define HAND_DAMPING   5.0   /* N s/m */

typedef struct response {
    knurl_gain rows[ROWS_MAX];
    uint32_t count;
} response;

/* Straight in both logarithms between two rows, constant beyond. */
static double response_at(const response *r, double hz) {
    const knurl_gain *row = r->rows;
    uint32_t i = 0;
    while (i < r->count && row[i].hz < hz) {
        i++;
    }
    if (i == 0 || i == r->count) {
        return row[i == 0 ? 0 : i - 1].gain;
    }
    const double share = log(hz / row[i - 1].hz) / log(row[i].hz / row[i - 1].hz);
    return row[i - 1].gain * pow(row[i].gain / row[i - 1].gain, share);
}

/* How much of a motion a fingertip feels, 1 at 250 Hz: the detection threshold is flat to 40 Hz, falls by 12 dB an
 * octave to 250 Hz and rises by 12 above (Verrillo 1963, as quoted by Gescheider and Verrillo 1979). */
static double sensitivity(double hz) {
    const double share = fmax(hz, 40.0) / 250.0;
    return fmin(share * share, 1.0 / (share * share));
}

/* Of a square wave's harmonics, as far as the response is known. */
static double strength_at(const response *r, double hz) {
    const double last = r->count > 0 ? r->rows[r->count - 1].hz : 0.0;
    double power = 0.0;
    for (int n = 1; n == 1 || n * hz <= last; n += 2) {
        const double felt = response_at(r, n * hz) * sensitivity(n * hz) / n;
        power += felt * felt;
    }
    return sqrt(power);
}

static double hz_of(uint32_t i) {
    return 20.0 * exp2(i / 16.0);
}

static void find_gains(const response *r, knurl_gain *gains) {
    double weakest = HUGE_VAL;
    for (uint32_t i = 0; i < KNURL_GAINS; i++) {
        gains[i].hz = hz_of(i);
        gains[i].gain = strength_at(r, gains[i].hz);
        weakest = gains[i].hz >= LOWEST_HZ && gains[i].hz <= LEVEL_HZ ? fmin(weakest, gains[i].gain) : weakest;
    }
    for (uint32_t i = 0; i < KNURL_GAINS; i++) {
        gains[i].gain = fmin(1.0, weakest / gains[i].gain);
    }
}

knurl_result knurl_gains_from_plant(double mass, double viscous, double update_rate_hz, knurl_gain *gains) {
    KNURL_RULE(NOT_HAPTIC, NULL);
    response r = {.count = KNURL_GAINS};
    if (KNURL_IS_NULL(gains)) {
        return KNURL_ERROR_ARGUMENT;
    }
    if (!knurl_is_within(mass, 0.001, 10.0) || !knurl_is_within(viscous, 0.0, 1000.0)) {
        return knurl_fail(
            KNURL_ERROR_ARGUMENT,
            "expected a mass of 0.001 to 10 kg and viscous friction of 0 to 1000 N s/m, found %g and %g%s", mass,
            viscous, mass == 0.0 ? ": this device's mass is not known; measure its response" : "");
    }
    if (!knurl_is_within(update_rate_hz, KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update_rate_hz: expected %g to %g Hz, found %g Hz",
                          KNURL_UPDATE_RATE_MIN, KNURL_UPDATE_RATE_MAX, update_rate_hz);
    }
    for (uint32_t i = 0; i < KNURL_GAINS; i++) {
        const double hz = hz_of(i);
        const double w = 2.0 * PI * hz;
        const double held = PI * fmin(hz / update_rate_hz, 0.5); /* each force is held for a tick */
        r.rows[i].hz = hz;
        r.rows[i].gain = sin(held) / held / hypot(HAND_STIFFNESS - mass * w * w, (HAND_DAMPING + viscous) * w);
    }
    find_gains(&r, gains);
    return KNURL_OK;
}

typedef struct text_line {
    const char *at;
    size_t length;
    unsigned number;
} text_line;

/* Moves to the next line; 0 after the last. */
static int next_line(text_line *line, const char *end) {
    line->at += line->length;
    line->at += line->number > 0 && line->at < end; /* the last one's line end */
    line->number++;
    if (line->at == end) {
        return 0;
    }
    const char *stop = memchr(line->at, '\n', (size_t)(end - line->at));
    line->length = (size_t)((stop ? stop : end) - line->at);
    return 1;
}

/* Without the carriage return that Windows puts before a line's end. */
static size_t shown(const text_line *line) {
    return line->length > 0 && line->at[line->length - 1] == '\r' ? line->length - 1 : line->length;
}

static int is_text(const text_line *line, const char *text) {
    return shown(line) == strlen(text) && memcmp(line->at, text, strlen(text)) == 0;
}

static knurl_result refuse(const text_line *line, const char *expected) {
    char found[64];
    const size_t length = shown(line) < sizeof found - 1 ? shown(line) : sizeof found - 1;
    memcpy(found, line->at, length);
    found[length] = '\0';
    return knurl_fail(KNURL_ERROR_FORMAT, "line %u: expected %s, found '%s'", line->number, expected, found);
}

static knurl_result read_row(const text_line *line, response *r) {
    const char *comma = memchr(line->at, ',', shown(line));
    knurl_gain row;
    if (!comma || !knurl_number(line->at, (size_t)(comma - line->at), &row.hz) ||
        !knurl_number(comma + 1, shown(line) - (size_t)(comma + 1 - line->at), &row.gain)) {
        return refuse(line, "a frequency and a gain, two numbers of at most 15 digits with a comma between");
    }
    if (!knurl_is_within(row.hz, 0.001, 1e5) || (r->count > 0 && !(row.hz > r->rows[r->count - 1].hz))) {
        return refuse(line, "frequencies that rise, from 0.001 to 100000 Hz");
    }
    if (!knurl_is_within(row.gain, 1e-12, 1e12)) {
        return refuse(line, "a gain above 0, 1e-12 to 1e12");
    }
    if (r->count == ROWS_MAX) {
        return knurl_fail(KNURL_ERROR_FORMAT, "line %u: expected at most %d rows, found more", line->number, ROWS_MAX);
    }
    r->rows[r->count++] = row;
    return KNURL_OK;
}

static knurl_result read_rows(const char *text, const char *end, response *r) {
    static const char mark[] = "# knurl response ";
    text_line line = {text, 0, 0};
    (void)next_line(&line, end);
    if (line.length < sizeof mark - 1 || memcmp(line.at, mark, sizeof mark - 1) != 0) {
        return refuse(&line, memchr(text, 0, (size_t)(end - text)) ? "UTF-8 text that begins with '# knurl response 1'"
                                                                   : "'# knurl response 1'");
    }
    if (!is_text(&line, "# knurl response 1")) {
        return refuse(&line, "version 1");
    }
    int has_header = 0;
    knurl_result result = KNURL_OK;
    while (!result && next_line(&line, end)) {
        if (shown(&line) == 0 || line.at[0] == '#') {
            continue;
        }
        if (!has_header) {
            has_header = is_text(&line, "frequency_hz,gain");
            result = has_header ? KNURL_OK : refuse(&line, "the header frequency_hz,gain");
        } else {
            result = read_row(&line, r);
        }
    }
    return result;
}

static knurl_result parse(const char *file, uint64_t size, response *r) {
    const uint64_t mark = size >= 3 && memcmp(file, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; /* a byte order mark */
    if (size == mark || size > BYTES_MAX) {
        return knurl_fail(KNURL_ERROR_FORMAT, "expected a response of 1 to %d bytes, found %llu", BYTES_MAX,
                          (unsigned long long)(size - mark));
    }
    const char *end = file + size;
    const knurl_result result = read_rows(file + mark, end, r);
    if (result) {
        return result;
    }
    if (end[-1] != '\n') {
        return knurl_fail(KNURL_ERROR_FORMAT,
                          "expected a line end after the last row, found none: is the file cut short?");
    }
    if (r->count < 2 || r->rows[0].hz > LOWEST_HZ || r->rows[r->count - 1].hz < EVEN_HZ) {
        return knurl_fail(KNURL_ERROR_FORMAT,
                          "expected rows from %g Hz or less to %g Hz or more, found %u from %g to %g Hz", LOWEST_HZ,
                          EVEN_HZ, (unsigned)r->count, r->count ? r->rows[0].hz : 0.0,
                          r->count ? r->rows[r->count - 1].hz : 0.0);
    }
    return KNURL_OK;
}

knurl_result knurl_gains_from_response(const char *file, uint64_t size, knurl_gain *gains) {
    KNURL_RULE(NOT_HAPTIC, NULL);
    response r = {.count = 0};
    if (KNURL_IS_NULL(file) || KNURL_IS_NULL(gains)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = parse(file, size, &r);
    if (!result) {
        find_gains(&r, gains);
    }
    return result;
}
