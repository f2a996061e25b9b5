/* `knurl sweep`: the response of a known device, the bounds of its force, and its ends.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "tool/plate.h"

#include "sweep.h"

#include <knurl/device_functions.h>

#define PI 3.141592653589793

/* --- a device whose forces are looked at: a mass in a hand --- */

typedef struct watched {
    double position, velocity, force; /* m, m/s, N: along y */
    double most, fastest;             /* N, N a tick */
    double begin;                     /* N: the most of the first 20 forces that are not zero */
    uint64_t forces;                  /* how many were not zero */
    uint64_t reads, fails_at;         /* the read at which `wrong` happens; 0: none */
    enum { LOST, NOT_A_NUMBER, LET_GO } wrong;
    double after; /* N: the most of all forces from 25 ticks after that on */
} watched;

static void get_info(void *user, knurl_device_info *info) {
    (void)user;
    info->max_force = 3.3;
    info->mass = 0.045;
}

static knurl_result read_watched(void *user, knurl_device_sample *sample) {
    watched *w = user;
    const int is_wrong = w->fails_at > 0 && ++w->reads >= w->fails_at;
    for (int i = 0; i < 100; i++) { /* of a tick of 1 ms */
        w->velocity += 1e-5 * (w->force - 700.0 * w->position - 5.0 * w->velocity) / 0.045;
        w->position += 1e-5 * w->velocity;
    }
    sample->position[1] =
        w->position + (is_wrong && w->wrong == LET_GO ? 1e-4 * (double)(w->reads - w->fails_at) : 0.0);
    sample->position[2] = is_wrong && w->wrong == NOT_A_NUMBER ? (double)NAN : 0.0;
    return is_wrong && w->wrong == LOST ? KNURL_ERROR_DEVICE_LOST : KNURL_OK;
}

static knurl_result write_watched(void *user, const double force[3]) {
    watched *w = user;
    w->most = fmax(w->most, fabs(force[1]));
    w->forces += force[1] != 0.0;
    w->begin = w->forces <= 20 ? w->most : w->begin;
    w->fastest = fmax(w->fastest, fabs(force[1] - w->force));
    w->after = w->fails_at > 0 && w->reads > w->fails_at + (w->wrong == LET_GO ? 400 : 25)
                   ? fmax(w->after, fabs(force[1]))
                   : w->after;
    assert_true(force[0] == 0.0 && force[2] == 0.0);
    w->force = force[1];
    return KNURL_OK;
}

static volatile sig_atomic_t no_signal;

static knurl_result sweep_watched(watched *w, sweep *result) {
    knurl_device *device = NULL;
    knurl_device_functions functions;
    knurl_device_functions_init(&functions, sizeof functions);
    functions.user = w;
    functions.get_info = get_info;
    functions.read = read_watched;
    functions.write = write_watched;
    functions.motors_known = 1;
    assert_int_equal(knurl_device_open_functions(&functions, &device), KNURL_OK);
    const knurl_result code = sweep_run(device, 1000.0, 1, &no_signal, result);
    knurl_device_close(device);
    return code;
}

/* A sine of 0.8 N at 403 Hz turns by 1.53 N a tick at most; nothing else is faster. It fades in by half a cosine of
 * 100 ms, beside a slow sine of 0.2 N at 2 Hz. */
TEST(the_force_is_at_most_a_newton_faded_in_and_zero_in_the_end) {
    watched w = {.force = 0.0};
    static sweep result;
    assert_int_equal(sweep_watched(&w, &result), KNURL_OK);
    assert_int_equal(result.row_count, 27);
    assert_true(w.most <= 1.0 && w.most > 0.9);
    assert_true(w.fastest <= 2.0 * 0.8 * sin(PI * 0.403) + 0.01);
    assert_true(w.begin <= 0.4 * (1.0 - cos(PI * 0.2)) + 0.2 * sin(2.0 * PI * 2.0 * 0.02) + 0.01);
    CHECK_SAME(w.force, 0.0);
    for (uint32_t i = 0; i < result.row_count; i++) {
        const double a = PI * result.rows[i].hz / 1000.0;
        const double omega = 2000.0 * a;
        const double expected = sin(a) / a / hypot(700.0 - 0.045 * omega * omega, 5.0 * omega);
        CHECK_CLOSE(result.rows[i].gain, expected, 0.01 * expected);
    }
}

TEST(a_fault_and_a_grip_that_goes_away_end_it_without_force_or_rows) {
    static const char *const sentences[] = {"found: the device is gone", "found: a position was not a number",
                                            "held within 30 mm"};
    for (int wrong = LOST; wrong <= LET_GO; wrong++) {
        watched w = {.fails_at = 4000};
        static sweep result;
        result.row_count = 7;
        memcpy(&w.wrong, &wrong, sizeof w.wrong);
        assert_true(sweep_watched(&w, &result) < 0);
        check_message(sentences[wrong]);
        assert_int_equal(result.row_count, 7);
        CHECK_SAME(w.after, 0.0);
        CHECK_SAME(wrong == LOST ? 0.0 : w.force, 0.0); /* nothing reaches a device that is gone */
        assert_true(w.reads < 10000);
    }
}

TEST(a_signal_ends_it) {
    watched w = {.force = 0.0};
    static sweep result;
    no_signal = 2;
    assert_int_equal(sweep_watched(&w, &result), KNURL_ERROR_CANCELLED);
    no_signal = 0;
    CHECK_SAME(w.force, 0.0);
}

/* --- the command --- */

/* How far the file's gains are off the closed form, dB, up to `to_hz`: mass, spring and damper of a fake device with
 * its hand, each force held for a tick. */
static double worst_db(const char *path, double mass, double viscous, double to_hz) {
    char *csv = read_file(path);
    double worst = 0.0;
    size_t rows = 0;
    const char *line = strstr(csv, "frequency_hz,gain\n");
    assert_non_null(line);
    for (line = strchr(line, '\n') + 1; *line; line = strchr(line, '\n') + 1) {
        char *end = NULL;
        const double hz = strtod(line, &end);
        assert_int_equal(*end, ',');
        const double gain = strtod(end + 1, &end);
        assert_int_equal(*end, '\n');
        const double w = 2.0 * PI * hz;
        const double a = PI * hz / 1000.0;
        const double expected = sin(a) / a / hypot(700.0 - mass * w * w, (5.0 + viscous) * w);
        worst = hz <= to_hz ? fmax(worst, fabs(20.0 * log10(gain / expected))) : worst;
        rows++;
    }
    free(csv);
    assert_true(rows > 20);
    return worst;
}

TEST(a_fake_devices_response_is_its_plants) {
    static const struct {
        const char *uri;
        double mass, viscous, to_hz, db;
    } cases[] = {{"fake:?coulomb=0&resolution=0&tremor=0&exact=1", 0.045, 0.5, 500.0, 0.05},
                 {"fake:?preset=falcon&coulomb=0&resolution=0", 0.2, 1.5, 500.0, 0.3}, /* a tremor is noise */
                 {"fake:?coulomb=0", 0.045, 0.5, 330.0, 1.5}}; /* positions in counts of 0.055 mm: 10 to 0.05 of one */
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *out = tool_path("response.csv");
        RUN_DONE("sweep", "--fast", "--device", cases[i].uri, "--out", out);
        const double db = worst_db(out, cases[i].mass, cases[i].viscous, cases[i].to_hz);
        print_message("%s: %.3f dB\n", cases[i].uri, db);
        assert_true(db < cases[i].db);
    }
}

/* The same gains, from the model and from its measured response. */
TEST(run_and_inspect_tell_the_range_and_the_lowest_gain) {
    const char *written = write_plate("plate.gltf", TAG);
    const char *out = tool_path("response.csv");
    process p = RUN_TOOL("sweep", "--fast", "--device", "fake:?coulomb=0&resolution=0&tremor=0&exact=1", "--out", out);
    check_done(&p);
    process_free(&p);
    const char *const ways[][3] = {{"inspect", "--even", NULL},
                                   {"inspect", "--response", out},
                                   {"run", "--even", "--fast"},
                                   {"run", "--fast", "--response"}};
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        p = RUN_TOOL(ways[i][0], written, ways[i][1], ways[i][2], i == 3 ? out : NULL);
        check_done(&p);
        CHECK_CLOSE(json_number_of(p.out, "lowest_gain"), 0.089, 0.004);
        CHECK_CLOSE(json_number_of(p.out, "from_hz"), 20.0, 1e-9);
        CHECK_CLOSE(json_number_of(p.out, "to_hz"), 295.0, 15.0);
        process_free(&p);
    }
    p = RUN_TOOL("inspect", written);
    check_done(&p);
    assert_null(strstr(p.out, "lowest_gain"));
    process_free(&p);
}

TEST(a_response_that_is_wrong_and_a_device_without_one_are_refused) {
    const char *written = write_plate("plate.gltf", TAG);
    const char *bad = tool_path("bad.csv");
    write_text(bad, "# knurl response 1\nfrequency_hz,gain\n20,1\n30,-1\n");
    static const struct {
        const char *arguments[4];
        int code;
        const char *says;
    } cases[] = {{{"run", "--fast", "--response", "BAD"}, 1, "line 4: expected a gain above 0"},
                 {{"inspect", "--response", "none.csv", NULL}, 1, "none.csv: cannot be read"},
                 {{"sweep", "--fast", NULL, NULL}, 2, "found no --out"},
                 {{"sweep", "--device=touch", "--fast", "--out=x.csv"}, 2, "only the fake device takes --fast"}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        const char *a[5] = {cases[i].arguments[0]};
        const int with_plate = cases[i].arguments[0][0] != 's';
        for (int k = 1; k < 4; k++) {
            a[k] = cases[i].arguments[k] && strcmp(cases[i].arguments[k], "BAD") == 0 ? bad : cases[i].arguments[k];
        }
        process p = with_plate ? RUN_TOOL(a[0], written, a[1], a[2], a[3]) : RUN_TOOL(a[0], a[1], a[2], a[3]);
        check_refused(&p, cases[i].code, cases[i].says, cases[i].arguments[0]);
    }
}

/* 1 mm counts: 20 Hz is all that moves the grip by one. */
TEST(a_response_that_stays_below_the_noise_is_not_written) {
    const char *out = tool_path("noisy.csv");
    process p = RUN_TOOL("sweep", "--fast", "--device", "fake:?resolution=0.002", "--out", out);
    check_refused(&p, 1, "expected motions that stand out to 300 Hz", "sweep");
    assert_int_equal(files_that_end("noisy.csv"), 0);
}

SUITE_FIXTURES(make_folder, remove_folder)
