/* The catalogue's rows, its traces and its page. SPDX-License-Identifier: MIT */
#include "failures.h"
#include "study.h"

#include <math.h>
#include <string.h>

const failure failures[] = {
    {"s1_pushes", "S1", "pushes where it should only vibrate",
     "With an odd number of ticks per cycle, one more is up than down.", "a mean force of %.3f K A at 333 Hz",
     "1/N at N ticks", "S2 or bandlimited; or a faster loop: at 10 kHz it is a tenth", "ms", failure_s1_pushes},
    {"s1_silent", "S1", "falls silent", "At f_t = f_h every tick samples the same phase.",
     "%.0f %% of the half cycles are lost at 1000 Hz", "all, at every multiple of f_h",
     "f_t below f_h/2; otherwise KNURL_TICK_ABOVE_NYQUIST is set", "ms", failure_s1_silent},
    {"s1_alias", "S1", "plays another frequency", "Above f_h/2 the ticks sample an alias.",
     "%.0f Hz are felt where 900 Hz are crossed", "f_h - f_t", "the same", "ms", failure_s1_alias},
    {"s1_felt", "S1", "is felt as another vibration",
     "The square wave's harmonics fold to frequencies that touch feels better.",
     "%.0f %% of what is felt is not the ridges' at 389 Hz", "lines of the sampled square wave",
     "bandlimited: 1 %; or a faster loop", "ms", failure_s1_felt},
    {"s1_counts", "S1", "pushes through counts on fine ridges",
     "A ridge and a groove of 0.5 mm are 9.09 counts of 0.055 mm: mostly 9 without smoothing, 5 or 4 of them up.",
     "a mean force of %.3f K A over a cycle, at 10 kHz too", "(1/10 + 1/8.33)/2",
     "knurl_velocity_track(), as scenes do, or bandlimited; a faster loop does not help", "ms", failure_s1_counts},
    {"s1_diagonal", "S1", "is smooth along a grid's diagonal",
     "Through the cells' centres both cosines of Eq. 11 change sign together.", "%.0f of 50 cycles are felt", "none",
     "S2 or bandlimited on a grid: Eq. 12 has no such line", "ms", failure_s1_diagonal},
    {"s1_grid", "S1", "loses cycles of a grid", "Two edges within one tick cancel.",
     "%.1f %% of the cycles at 100 mm/s, in the worst direction", "measured over 89 directions",
     "S2 or bandlimited; or a faster loop", "ms", failure_s1_grid},
    {"s2_freezes", "S2", "freezes while the hand sets off",
     "The event that begins at 1 mm/s is played to its end, even if the hand accelerates.",
     "%.3f s without a ridge, over 2 mm ridges", "1 / (fs 1 mm/s)", "bandlimited: it follows the position", "s",
     failure_s2_freezes},
    {"s2_drifts", "S2", "plays other cycles than are crossed",
     "A period is rounded to whole ticks, without a correction.", "%+.1f %% just below 3.5 ticks", "3.5/3 - 1",
     "bandlimited, or a faster loop", "ms", failure_s2_drifts},
    {"s2_loses_step", "S2", "loses step with what is seen", "Each event keeps its initial speed to its end.",
     "%.0f cycles out within 10 s of strokes up to 480 Hz on 1 mm", "measured",
     "bandlimited: within a count of the position", "s", failure_s2_loses_step},
    {"s2_outlives", "S2", "vibrates on after the hand has stopped", "A begun event is played to its end.",
     "%.0f ms at 20 Hz", "T less a tick", "bandlimited: it has no events", "ms", failure_s2_outlives},
    {"grazed", "S2", "pushes where it is only grazed",
     "Contact is one-sided (Eq. 9): crests above the HIP are felt, troughs are not.",
     "a mean force of %.3f K A at no depth and 333 Hz", "sqrt(2)/3",
     "press deeper than the troughs: 1.41 A, in the 400 Hz mix 1.73 A; bandlimited's are 1.27 A deep", "ms",
     failure_grazed},
    {"band_wavers", "bandlimited", "wavers near half the update rate", "Samples beat with their image at f_h - f_t.",
     "the rms in 12 ms varies by %.0f %% of itself at 480 Hz", "of a cosine in 12 ticks; 8 % at most to 440 Hz",
     "a faster loop: none at 2 kHz", "ms", failure_band_wavers},
    {"band_image", "bandlimited", "is felt with its image",
     "A held wave has an image at f_h - f_t, which is nearly as strong near f_h/2.",
     "%.0f %% of what is felt is not the ridges' at 480 Hz",
     "the hold, the device and the threshold at 520 Hz against those at 480 Hz; 8 % at 440 Hz",
     "a faster loop; coarser ridges", "ms", failure_band_image},
    {"band_counts", "bandlimited", "is impure at a count a tick",
     "Steps of 0.055 mm beat slowly with the ticks; a mean over 20 ms does not remove all of it.",
     "%.1f %% of the power is not the ridges' at 111 Hz on 0.5 mm",
     "measured; half on 1 mm, almost none with exact positions", "a faster loop, or a finer encoder", "ms",
     failure_band_counts},
    {"band_pitch", "bandlimited", "plays f_h/2 above it", "It omits all waves of higher frequencies.",
     "%.0f Hz are felt where 700 Hz are crossed", "f_h/2", "a faster loop; KNURL_TICK_ABOVE_NYQUIST is set", "ms",
     failure_band_pitch},
    {"band_loop", "bandlimited", "loses ridges round a corner",
     "Phase continues when the dominant axis changes: back at the same place by another path, it differs.",
     "%.2f cycle out after a loop of 10.3 x 5.1 mm", "31 cycles less 2 (10.3 + 5.1)",
     "ridges along one axis; S1, if place matters more than a clean tone", "mm", failure_band_loop},
    {"difference", "velocity", "first differences of counts are noise",
     "One count more or less in a tick is a quantum times f_h.", "f_t jumps by %.0f Hz at a steady 100 Hz",
     "0.055 mm x 1 kHz x 1000/m", "FOAW (the default if the resolution is known)", "ms", failure_difference},
    {"foaw_pulses", "velocity", "slow motion comes in bursts", "Counts are further apart than the window is long.",
     "%.2f mm/s at a steady 1 mm/s", "a quantum in the 11 ms between the thirds of FOAW's window",
     "a finer encoder; bandlimited follows the position", "ms", failure_foaw_pulses},
    {"wall_runaway", "wall", "runs away",
     "A sampled wall generates energy; if it exceeds the losses of device and hand, motion grows.",
     "%.1f mm of swing: a Touch without dry friction, held loosely, 1020 N/m", "K above (b + B)/(T/2 + td)",
     "the default protections: they soften it (KNURL_TICK_PASSIVITY); knurl_scene_check_surface() warns beforehand",
     "ms", failure_wall_runaway},
    {"wall_delay", "wall", "bears less for every tick of delay", "A delayed force acts on an older position.",
     "a tick of delay costs a factor of %.1f", "(T/2 + td)/(T/2)",
     "a faster loop; a device that responds in the same tick", "ticks of delay", failure_wall_delay},
    {"wall_quantised", "wall", "buzzes between two counts",
     "The balancing force lies between those of two counts, and dry friction holds neither.",
     "%.0f um to and fro, though it is passive", "a limit cycle for fc/(K quantum) below 1/2",
     "a finer encoder, a softer wall", "ms", failure_wall_quantised},
    {"force_limit", "wall", "is clipped by its motors",
     "A texture above max_force loses its crests, and so changes its mean force.",
     "%.2f N less than meant, in the paper's Experiment 3 as printed (0.7 N/mm, 2.7 mm)", "(2 K A - 3.3 N)/2",
     "K A below half of max_force; knurl_scene_check_surface() warns, clamp limits it", "ms", failure_force_limit},
    {"heat", "wall", "weakens as its motors warm up", "Motors cannot sustain their peak force.",
     "after %.1f s of 2 N a Touch comes down to its 0.88 N",
     "-tau ln(1 - theta (Fc/F)^2); theta = 0.97: the limit reaches 2 N; tau = 60 s is assumed",
     "press less; KNURL_TICK_HEAT is set", "s", failure_heat},
    {"contact_crack", "contact", "falls into a crack",
     "A HIP that slips off a rim is held again if it reaches another surface within 5 ms.",
     "below %.0f mm/s a HIP 1 mm deep falls into a crack of 0.2 mm", "0.2 mm in 5 ms, in whole ticks",
     "join the meshes, or let them overlap; T-junctions and cracks of up to 0.1 um are closed", "mm",
     failure_contact_crack},
    {"contact_winding", "contact", "falls through mixed winding",
     "If half of a mesh faces the other way and it touches itself, its front is undefined.",
     "%.0f %% of presses fall through a sheet with a T-junction, each second triangle facing down",
     "measured; 0 % without the T-junction", "recalculate the normals; KNURL_LIMIT_WINDING warns at load", "mm",
     failure_contact_winding},
    {"contact_crowd", "contact", "lags in a crowd of meshes",
     "A tick visits at most 800 triangles and nodes; in a crowd the proxy advances in short steps.",
     "the proxy stays %.0f mm behind, 13 mm along 32 spheres in one place at 100 mm/s",
     "measured; at most the distance travelled", "fewer than 16 meshes in one place (KNURL_LIMIT_VISITS warns at load)",
     "ms", failure_contact_crowd},
    {"contact_visits", "contact", "reaches the limit of visits",
     "With crests as high as a mesh is wide, any triangle may be the nearest.",
     "%.0f %% of the ticks from 20 mm above a sphere of 10 mm to its middle, with crests of 20 mm", "measured",
     "lower crests or fewer triangles; KNURL_LIMIT_VISITS warns at load", "mm from the middle", failure_contact_visits},
    {"contact_squeezed", "contact", "ends contact where surfaces close",
     "When the proxy has no room left, the moving surface releases the HIP.",
     "%.2f N, 4 mm above a floor on which a lid comes down, fall to 0 within 5 ms",
     "K 4 mm less a tick of the lid's 100 mm/s", "a gap between moving surfaces; KNURL_TICK_SQUEEZED is set", "ms",
     failure_contact_squeezed},
    {"contact_wedge", "contact", "leaves the HIP in a narrow wedge",
     "Surfaces that close at an angle push the proxy by 1/tan(angle) times their motion; above 5 times is a squeeze.",
     "below %.1f degrees it is squeezed", "atan(1/5)", "the same", "degrees", failure_contact_wedge},
    {0}};

static void write_page_row(FILE *page, const failure *f, double number) {
    char text[160];
    (void)snprintf(text, sizeof text, f->format, number); /* NOLINT(clang-diagnostic-format-nonliteral): the table's */
    fprintf(page, "| %s | **%s.** %s | %s (%s) | %s | `%s` |\n", f->group, f->name, f->what, text, f->expect, f->avoid,
            f->id);
}

static void write_json_row(json_writer *json, const failure *f, double number) {
    char text[160];
    (void)snprintf(text, sizeof text, f->format, number); /* NOLINT(clang-diagnostic-format-nonliteral): the table's */
    json_open(json, NULL, '{');
    json_string(json, "id", f->id);
    json_string(json, "group", f->group);
    json_string(json, "name", f->name);
    json_string(json, "text", text);
    json_string(json, "axis", f->axis);
    json_number(json, "number", number);
    json_close(json, '}');
}

static int write_all(FILE *csv, json_writer *json, FILE *page) {
    size_t count = 0;
    while (failures[count].id) {
        count++;
    }
    fputs("id,series,t,value\n", csv);
    json_string(json, "study", "failures");
    json_string(json, "table", "failures.csv");
    json_open(json, "failures", '[');
    fputs(
        "# Where methods fail\n\n"
        "Written by `knurl study failures`, which measures each number; the test of the same name\n"
        "(`tests/fidelity/test_failures.c`) compares it with the formula or bound in brackets. A is the amplitude, K\n"
        "the stiffness, f_h the update rate (1 kHz here), f_t the temporal frequency.\n\n"
        "![Each failure as a trace](../../assets/pictures/failures.png)\n\n"
        "| method | how it fails | number | how to avoid it | test |\n|---|---|---|---|---|\n",
        page);
    for (size_t i = 0; i < count; i++) {
        const failure_sink sink = {csv, failures[i].id};
        double number = NAN;
        if (!failures[i].measure(&sink, &number)) {
            return 1;
        }
        write_json_row(json, &failures[i], number);
        write_page_row(page, &failures[i], number);
        study_progress("failures", (double)(i + 1) / (double)count);
    }
    json_close(json, ']');
    return 0;
}

int study_failures(const char *folder) {
    out_file files[3];
    json_writer json;
    static const char *const names[3] = {"failures.csv", "failures.json", "failures.md"};
    int failed = 0;
    memset(files, 0, sizeof files);
    for (int i = 0; i < 3 && !failed; i++) {
        failed = study_open(&files[i], folder, names[i]);
    }
    if (!failed) {
        json_start(&json, files[1].stream, 1);
        json_open(&json, NULL, '{');
        failed = write_all(files[0].stream, &json, files[2].stream);
        json_close(&json, '}');
        if (failed) {
            (void)tool_error(1, "study: failures: no memory, or %s", knurl_error_message());
        }
    }
    for (int i = 0; i < 3; i++) {
        failed = failed || out_keep(&files[i]);
        out_discard(&files[i]);
    }
    return failed;
}
