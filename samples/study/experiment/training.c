/* The training session (IV-A4): good and deliberately bad progressions, then six easy trials.
 * SPDX-License-Identifier: MIT */
#include "experiment.h"

#include "say.h"

#include <string.h>

#define PUSH 0.5 /* N, upwards */

/* The paper's six progressions of a low, a medium and a high frequency, ms. Even periods are the same in all methods;
 * T2 at 29 ms felt particularly rough. */
static const struct {
    int32_t method;
    double periods[3], push;
} progressions[] = {{KNURL_WAVE_T3, {50, 30, 24}, 0.0},
                    {KNURL_WAVE_T3, {50, 50, 24}, 0.0},
                    {KNURL_WAVE_T2, {50, 29, 24}, 0.0},
                    {KNURL_WAVE_T3, {50, 30, 24}, PUSH}};

/* In the paper's order: the good one at low and high intensity, both again, the bad ones at low, then at high. */
static const struct {
    int progression, high;
} shown[] = {{0, 0}, {0, 1}, {0, 0}, {0, 1}, {1, 0}, {2, 0}, {3, 0}, {1, 1}, {2, 1}, {3, 1}};

#define SHOWN (sizeof shown / sizeof *shown)

static const char introduction[] =
    "Training. You will feel progressions of three vibrations, from low to high. First a good one, at low and at high\n"
    "intensity, twice. Then three bad ones, at each intensity: one that does not rise from low to medium to high, one\n"
    "that feels rough, and one whose medium pushes your hand upwards. Hold the stylus loosely, and still.\n";

/* Text for the subject during each progression. */
static const char *const words[4][2][3] = {
    {{"good, low intensity: low", "good, low intensity: medium", "good, low intensity: high"},
     {"good, high intensity: low", "good, high intensity: medium", "good, high intensity: high"}},
    {{"bad, low intensity: low", "bad, low intensity: not medium", "bad, low intensity: high"},
     {"bad, high intensity: low", "bad, high intensity: not medium", "bad, high intensity: high"}},
    {{"bad, low intensity: low", "bad, low intensity: medium, rough", "bad, low intensity: high"},
     {"bad, high intensity: low", "bad, high intensity: medium, rough", "bad, high intensity: high"}},
    {{"bad, low intensity: low", "bad, low intensity: medium, a push", "bad, low intensity: high"},
     {"bad, high intensity: low", "bad, high intensity: medium, a push", "bad, high intensity: high"}}};

/* user: the number of the first of two progressions. */
static const char *cue(uint64_t tick, void *user) {
    const uint64_t each = EXP_PROGRESSION + EXP_BETWEEN_TICKS;
    const uint64_t step = EXP_VIBRATION_TICKS + EXP_PAUSE_TICKS;
    const size_t i = *(const size_t *)user + (tick >= each);
    const uint64_t within = tick % each;
    return tick >= EXP_TRIAL_TICKS || within >= EXP_PROGRESSION
               ? "..."
               : words[shown[i].progression][shown[i].high][within / step];
}

int exp_demonstrate(const exp_session *session, int *stopped) {
    /* a comparison of gratings takes the smaller vibrations, those of experiment 2 */
    const exp_design *of = exp_has_gratings(session->design) ? exp_design_of(2) : session->design;
    int code = TOOL_OK;
    if (session->answers != EXP_SIMULATED) {
        say_page(stderr, introduction);
    }
    for (size_t i = 0; i < SHOWN && code == TOOL_OK && !*stopped;) {
        exp_stimulus stimulus;
        exp_outcome outcome = {0};
        memset(&stimulus, 0, sizeof stimulus);
        for (size_t k = 0; k < 2 && code == TOOL_OK; k++) {
            const int p = shown[i + k].progression;
            stimulus.push[k] = progressions[p].push;
            code = exp_progression(progressions[p].method, progressions[p].periods, of->amplitudes[shown[i + k].high],
                                   stimulus.waves[k]);
        }
        code = code ? code : exp_play_stimulus(session, &stimulus, cue, &i, NULL, &outcome);
        if (code == TOOL_OK && outcome.stopped) {
            code = exp_rest(session, 0, stopped);
        } else {
            i += 2;
        }
    }
    return code;
}
