/* A trial of the paper's experiments as played: timing tick by tick, the device's forces, the answers.
 * SPDX-License-Identifier: MIT */
#include "support/close.h"
#include "support/paper.h"

#include "device/driver.h"
#include "experiment.h"

#include <unistd.h>

/* --- a trial, tick by tick --- */

static long double paper_value(int32_t method, uint64_t tick, int64_t milliticks, long double amplitude) {
    if (method == KNURL_WAVE_T1) {
        return amplitude * (long double)paper_square(tick, (uint64_t)milliticks, 1000);
    }
    return method == KNURL_WAVE_T2 ? paper_t2(tick, milliticks, amplitude) : paper_t3(tick, milliticks, amplitude);
}

/* Section IV-A4, as a list of each vibration's start and end, in ms. */
static long double scheduled(const exp_trial *trial, uint64_t ms) {
    static const uint64_t starts[6] = {0, 1500, 3000, 5000, 6500, 8000};
    double periods[3];
    exp_neighbours(trial->period, periods);
    for (int i = 0; i < 6; i++) {
        if (ms >= starts[i] && ms < starts[i] + 1000) {
            return paper_value(trial->methods[i / 3], ms - starts[i], (int64_t)(1000.0 * periods[i % 3]),
                               (long double)trial->amplitude);
        }
    }
    return 0.0L;
}

TEST(every_trial_s_force_is_the_paper_s_schedule) {
    for (int32_t e = 1; e <= 2; e++) {
        exp_trial trials[EXP_MAX_TRIALS];
        (void)exp_plan(exp_design_of(e), 3, 0, 0, trials);
        for (uint32_t i = 0; i < 24; i++) { /* one block: every cell */
            exp_stimulus stimulus;
            assert_int_equal(exp_stimulus_init(&trials[i], &stimulus), TOOL_OK);
            for (uint64_t t = 0; t < 9100; t++) {
                CHECK_CLOSE(exp_stimulus_force(&stimulus, t), scheduled(&trials[i], t), 1e-12L);
            }
        }
    }
}

/* --- a device that records its forces and whose buttons the test presses --- */

typedef struct bench {
    knurl_device device; /* first: the driver's functions get it */
    double written[60000][3];
    uint64_t reads, writes, loops;
    uint64_t starts[8];         /* writes before each loop */
    uint64_t press_at, move_at; /* reads; UINT64_MAX: never */
    uint32_t held, pressed;     /* buttons before and from press_at on */
    uint32_t first;             /* at press_at alone, if not 0 */
} bench;

static bench *of(knurl_device *base) {
    return (bench *)(void *)base; /* its first member */
}

static void close_it(knurl_device *device) {
    (void)device;
}

static void get_info(const knurl_device *device, knurl_device_info *info) {
    info->max_force = device->max_force;
    info->continuous_force = (double)INFINITY; /* schedules go as printed: its motors stay cool */
    info->heat_time = 1.0;
}

static knurl_result start(knurl_device *device, double rate) {
    bench *b = of(device);
    b->starts[b->loops++ % COUNT_OF(b->starts)] = b->writes;
    CHECK_SAME(rate, 1000.0);
    return KNURL_OK;
}

static knurl_result read_it(knurl_device *device, knurl_device_sample *sample) {
    bench *b = of(device);
    memset(sample, 0, sizeof *sample);
    sample->buttons = b->first && b->reads == b->press_at ? b->first : b->reads >= b->press_at ? b->pressed : b->held;
    sample->position[0] = b->reads == b->move_at ? 0.021 : 0.0; /* out of the sphere, once */
    b->reads++;
    return KNURL_OK;
}

static knurl_result write_it(knurl_device *device, const double force[3]) {
    bench *b = of(device);
    memcpy(b->written[b->writes++ % COUNT_OF(b->written)], force, sizeof b->written[0]);
    return KNURL_OK;
}

static const knurl_driver bench_driver = {
    .uri = "bench", .close = close_it, .get_info = get_info, .start = start, .read = read_it, .write = write_it};
static bench device;

static exp_session begin(int32_t experiment, int32_t answers) {
    exp_session s;
    memset(&device, 0, sizeof device);
    memset(&s, 0, sizeof s);
    knurl_device_init(&device.device, &bench_driver);
    device.device.max_force = 3.3;
    device.press_at = device.move_at = UINT64_MAX;
    s.design = exp_design_of(experiment);
    s.uri = "bench";
    s.device = &device.device;
    s.info.max_force = 3.3;
    s.answers = answers;
    s.fast = answers == EXP_SIMULATED;
    return s;
}

TEST(the_device_is_told_the_schedule_shortened_to_what_it_can_do) {
    const exp_trial trial = {1, 2.5, 2.10, {KNURL_WAVE_T3, KNURL_WAVE_T1}, {0, 0}};
    const exp_session s = begin(1, EXP_SIMULATED);
    exp_outcome o;
    uint64_t beyond = 0;
    assert_int_equal(exp_play_temporal(&s, &trial, &o), TOOL_OK);
    for (uint64_t t = 0; t < device.writes; t++) {
        const long double wanted = t < 1000 ? 0.0L : scheduled(&trial, t - 1000); /* a second to get hold of it */
        beyond += fabsl(wanted) > 3.3L;
        CHECK_SAME(device.written[t][0], 0.0L);
        CHECK_CLOSE(device.written[t][1], fmaxl(-3.3L, fminl(3.3L, wanted)), 1e-12L);
        CHECK_SAME(device.written[t][2], 0.0L);
    }
    assert_in_range(device.writes, 10001, 10100); /* the loop's ramp goes from zero to zero */
    assert_int_equal(o.ticks, 10001);
    assert_int_equal(beyond, 166); /* -1.731 x 2.10 N once in 6 ticks of the second that T3 has at 400 Hz */
    assert_int_equal(o.force_limit_ticks, beyond);
}

TEST(leaving_the_sphere_zeroes_the_force_and_begins_the_trial_anew) {
    const exp_trial trial = {1, 5, 1.05, {KNURL_WAVE_T1, KNURL_WAVE_T3}, {0, 0}};
    const exp_session s = begin(1, EXP_SIMULATED);
    exp_outcome o;
    device.move_at = 1500;
    assert_int_equal(exp_play_temporal(&s, &trial, &o), TOOL_OK);
    assert_int_equal(o.restarts, 1);
    assert_int_equal(o.ticks, 10001); /* of the one that counts */
    assert_true(device.written[1499][1] != 0.0);
    CHECK_SAME(device.written[1500][1], 0.0L);
    CHECK_SAME(device.written[1501][1], 0.0L);
}

/* --- training (IV-A4) --- */

/* The medium vibration of each progression in the paper's order. */
TEST(the_demonstration_is_the_paper_s_ten_progressions) {
    static const struct {
        int32_t method;
        int64_t milliticks;
        long double amplitude, push;
    } medium[10] = {{KNURL_WAVE_T1, 30000, 1.05L, 0.0L}, {KNURL_WAVE_T1, 30000, 2.10L, 0.0L},
                    {KNURL_WAVE_T1, 30000, 1.05L, 0.0L}, {KNURL_WAVE_T1, 30000, 2.10L, 0.0L},
                    {KNURL_WAVE_T1, 50000, 1.05L, 0.0L}, {KNURL_WAVE_T2, 29000, 1.05L, 0.0L},
                    {KNURL_WAVE_T1, 30000, 1.05L, 0.5L}, {KNURL_WAVE_T1, 50000, 2.10L, 0.0L},
                    {KNURL_WAVE_T2, 29000, 2.10L, 0.0L}, {KNURL_WAVE_T1, 30000, 2.10L, 0.5L}};
    const exp_session s = begin(1, EXP_SIMULATED);
    int stopped = 0;
    assert_int_equal(exp_demonstrate(&s, &stopped), TOOL_OK);
    assert_false(stopped);
    assert_int_equal(device.loops, 5);
    for (size_t i = 0; i < 10; i++) {
        double (*force)[3] = device.written + device.starts[i / 2] + 1000 + (i % 2 ? 5000 : 0);
        for (uint64_t t = 0; t < 1000; t++) {
            const long double low = paper_value(KNURL_WAVE_T1, t, 50000, medium[i].amplitude);
            const long double high = paper_value(KNURL_WAVE_T1, t, 24000, medium[i].amplitude);
            CHECK_CLOSE(force[t][1], low, 1e-12L);
            CHECK_CLOSE(force[1500 + t][1],
                        medium[i].push + paper_value(medium[i].method, t, medium[i].milliticks, medium[i].amplitude),
                        1e-12L);
            CHECK_CLOSE(force[3000 + t][1], high, 1e-12L);
            CHECK_SAME(force[1000 + t / 2][1], 0.0L); /* the pauses */
            CHECK_SAME(force[2500 + t / 2][1], 0.0L);
        }
    }
}

TEST(both_buttons_stop_the_force_until_the_trial_begins_anew) {
    const exp_trial trial = {1, 5, 1.05, {KNURL_WAVE_T1, KNURL_WAVE_T3}, {0, 0}};
    const exp_session s = begin(1, EXP_SIMULATED);
    exp_outcome o;
    device.pressed = 3;
    device.press_at = 1500;
    assert_int_equal(exp_play_temporal(&s, &trial, &o), TOOL_OK);
    assert_int_equal(o.stopped, 1);
    assert_true(device.written[1499][1] != 0.0);
    for (uint64_t t = 1500; t < device.writes; t++) {
        CHECK_SAME(device.written[t][1], 0.0L);
    }
}

/* --- answers --- */

static void no_force(exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]) {
    (void)run;
    (void)tick;
    (void)sample;
    (void)force;
}

static const char *no_cue(uint64_t tick, void *user) {
    (void)tick;
    (void)user;
    return "";
}

static exp_run short_run(void) {
    exp_run run;
    memset(&run, 0, sizeof run);
    run.force = no_force;
    run.cue = no_cue;
    run.question = "(a test's question) ";
    run.ready = 1;
    run.question_tick = 50;
    return run;
}

TEST(a_button_answers_when_it_goes_down_after_the_question) {
    const exp_session s = begin(1, EXP_BUTTONS);
    exp_run run = short_run();
    exp_outcome o;
    memset(&o, 0, sizeof o);
    device.held = 2;    /* held down all the time: no answer */
    device.pressed = 1; /* lets go of the second and presses the first */
    device.press_at = 120;
    assert_int_equal(exp_drive(&s, &run, &o), TOOL_OK);
    assert_int_equal(o.chosen, 0);
    CHECK_CLOSE(o.rt_s, 0.070, 0.0015); /* to the tick of the press, whenever that was noticed */
}

/* The question is opened by `ready`, 150 ms after it could be. */
static void ready_later(exp_run *run, uint64_t tick, const knurl_device_sample *sample, double force[3]) {
    (void)sample;
    (void)force;
    if (tick == 200) {
        __atomic_store_n(&run->ready, 1u, __ATOMIC_RELEASE);
    }
}

TEST(the_time_of_an_answer_begins_when_the_question_was_opened) {
    const exp_session s = begin(1, EXP_BUTTONS);
    exp_run run = short_run();
    exp_outcome o;
    memset(&o, 0, sizeof o);
    run.force = ready_later;
    run.ready = 0;
    device.pressed = 2;
    device.press_at = 300;
    assert_int_equal(exp_drive(&s, &run, &o), TOOL_OK);
    assert_int_equal(o.chosen, 1);
    CHECK_CLOSE(o.rt_s, 0.100, 0.0015);
}

TEST(two_buttons_that_go_down_a_tick_apart_stop_the_trial_and_answer_nothing) {
    const exp_session s = begin(1, EXP_BUTTONS);
    exp_run run = short_run();
    exp_outcome o;
    memset(&o, 0, sizeof o);
    o.chosen = 7;
    device.first = 1;
    device.pressed = 3;
    device.press_at = 120;
    assert_int_equal(exp_drive(&s, &run, &o), TOOL_OK);
    assert_int_equal(o.stopped, 1);
    assert_int_equal(o.chosen, 7);
}

TEST(keys_answer_and_the_input_s_end_is_an_error) {
    int ends[2];
    const int kept = dup(STDIN_FILENO);
    const exp_session s = begin(1, EXP_KEYBOARD);
    exp_run run = short_run();
    exp_outcome o;
    memset(&o, 0, sizeof o);
    if (kept < 0 || pipe(ends) != 0) {
        fail_msg("no pipe");
        return;
    }
    assert_int_equal(write(ends[1], "x\n2\n", 4), 4);
    assert_int_equal(close(ends[1]), 0);
    assert_int_equal(dup2(ends[0], STDIN_FILENO), STDIN_FILENO);
    assert_int_equal(exp_drive(&s, &run, &o), TOOL_OK);
    assert_int_equal(o.chosen, 1);
    run = short_run();
    assert_int_equal(exp_drive(&s, &run, &o), TOOL_FAILURE);
    assert_int_equal(dup2(kept, STDIN_FILENO), STDIN_FILENO);
    (void)close(kept);
    (void)close(ends[0]);
}
