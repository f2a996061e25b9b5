/* The commands of the tool and their options. SPDX-License-Identifier: MIT */
#include "help_table.h"

#include "materials.h"
#include "verify.h"

#include <knurl/fake.h>
#include <knurl/knurl.h>

#include <stdio.h>
#include <string.h>

#define METHODS "METHOD" /* replaced by the names of the library's table, */
#define STEPS   "STEP"   /* and by those of verify's */
#define BUDGET  {"--budget", "NAME=N,...", "limits of loading: surfaces, bytes, vertices, triangles, seconds"}
#define PRETTY  {"--pretty", "", "JSON over several lines"}
#define FULL    {"--full-model", "", "without reductions: flat meshes stay meshes, every tick tests all surfaces"}
#define EVEN                                                                                                           \
    {"--even", "", "ridges equally strong from 25 to 300 Hz, by a model of the device in a hand"},                     \
        {"--response", "CSV", "the same, by a response that knurl sweep measured"}
#define WAVE                                                                                                           \
    {"--method", "T1|T2|T3", "the temporal method"}, {"--period-ms", "P", "period, ms"},                               \
        {"--amplitude", "A", "half peak to peak; default 1"}, {"--rate", "HZ", "update rate; default 1000"}

const help_command help_commands[] = {
    {"inspect",
     "FILE",
     "describe a file's tagged surfaces as JSON",
     {PRETTY,
      FULL,
      BUDGET,
      EVEN,
      {"--check", "", "exit with 3 if a surface exceeds a Touch's limits, is stretched, or is out of its reach"}},
     "JSON: surfaces [{name, shape, model, triangles, dropped_triangles, reversed_twins, turned_triangles, bytes, why,\n"
     "model_error, seam, touching_pairs, smooth, curved_triangles, bad_normals, bulge, in_reach, double_sided,\n"
     "coordinates, uneven, projection_seams, material, stretch, stretch_y, edges, hard_edges, facet_angle {mean, max},\n"
     "felt_angle {mean, max}}], skipped,\n"
     "even {lowest_gain, from_hz, to_hz}, bytes, hint. Angles are in rad, between the triangles at an edge, and\n"
     "between what is felt there; hard_edges are felt as edges. Triangles that are neither curved nor of bad_normals are\n"
     "flat: within 0.1 degrees and 1 um of the smooth surface, or of a mesh that is not smooth.",
     NULL},
    {"tag",
     "FILE",
     "set, change, remove or list the tags of a glTF file",
     {{"--material", "NAME", "the object to tag, by name or index; default: the file's only material"},
      {"--mesh", "NAME", "a mesh instead, whose tag overrides its materials' key by key"},
      {"--node", "NAME", "a node instead, whose tag overrides both"},
      {"--preset", "NAME", "the tag of an everyday material, see below; other options change it"},
      {"--ridges", "LENGTH[,LENGTH]", "from ridge to ridge: 1mm; two for a grid: 1mm,2mm; none: a smooth surface"},
      {"--amplitude", "LENGTH", "half of peak to peak: 0.2mm"},
      {"--stiffness", "N/M", "of the wall, N/m"},
      {"--friction", "MU", "Coulomb coefficient"},
      {"--damping", "NS/M", "along the normal, N s/m"},
      {"--orientation", "ANGLE", "turns the ridges about the normal: 45deg or 0.5rad"},
      {"--axis", "X,Y,Z", "the direction across the ridges in object space, instead of the UVs'"},
      {"--coordinates", "auto|box", "box: ridges by positions instead of UVs"},
      {"--method", METHODS, "the spatial method"},
      {"--smooth", "yes|no", "no: as its triangles, though the mesh has normals; yes: smooth, though it has none"},
      {"--from-texture", "", "finds the ridges in the material's normal, occlusion or base colour texture"},
      {"--from-picture", "FILE", "finds them in a PNG or JPEG picture: a photograph, a scan, a height or normal map"},
      {"--picture-size", "LENGTH[,LENGTH]", "the picture's width, and height, on the surface: 40mm"},
      {"--picture-depth", "LENGTH", "the picture is a height map, and so deep from white to black"},
      {"--drawing", "SVG", "draws the ridges over the picture, and its spectrum"},
      {"--remove", "", "removes the tag"},
      {"--list", "", "prints what can be tagged, and its tags, as JSON"},
      {"--out", "FILE", "writes the tagged file there"},
      {"--in-place", "", "replaces the file itself"},
      PRETTY},
     "Lengths have a unit: m, cm, mm, um or in. Only the tagged object's extras change; every other byte stays.\n"
     "External buffers are not copied: write beside them.\n"
     "JSON (--list): [{in, index, name, tag}].\n"
     "--from-texture and --from-picture without --out and --in-place print what they find as JSON: {picture, read_as,\n"
     "width, height (pixels), regular, confidence, ridges: [{apart (m), direction (rad), amplitude (m, or null), share,\n"
     "evenness}], tag}. If there is no regular pattern, nothing is written and the exit code is 3.\n"
     "Presets:\n",
     materials_text},
    {"run",
     "FILE",
     "load a scene, feel or stroke it, and summarise as JSON",
     {{"--device", "URI", "fake (default), " HELP_DEVICES "; see 'knurl devices'"},
      {"--reconnect", "", "search for a lost device instead of ending"},
      {"--surface", "NAME", "the surface to stroke; default: the first"},
      {"--stroke", "line|sweep|circle|press|rest", "of the fake device's hand, 1 mm deep; default line"},
      {"--trace", "CSV", "the fake device plays positions t,x,y,z (s, m) instead of a hand; - is standard input"},
      {"--exact", "", "--trace's positions are exact, even if they look like an encoder's counts"},
      {"--seconds", "S",
       "run time by the clock, with fake by its ticks; default 5 (with --view 600), or the trace's length"},
      {"--rate", "HZ", "update rate, 100 to 10000; default 1000"},
      {"--method", METHODS, "for all surfaces, instead of their own"},
      {"--fast", "", "fake only: as fast as the machine can, with the same forces"},
      {"--out", "CSV", "writes a row per tick; - is standard output, and the summary goes to standard error"},
      {"--wav", "FILE", "writes the sound of what is felt: mono, 48 kHz, 16 bits"},
      {"--view", "", "serves a page on 127.0.0.1 that shows what is felt, and prints its address"},
      FULL,
      BUDGET,
      {"--clamp", "", "limits walls and textures to what the device can do"},
      EVEN,
      PRETTY},
     "CSV in (--trace): columns t, x, y, z by name, in any order; scene metres. Positions in an encoder's counts are\n"
     "recognised and felt through an estimator of velocity for counts; resolution_m in the JSON is 0 if they are exact.\n"
     "CSV out (--out): t,x,y,z,vx,vy,surface,depth,fs,ft,height,fx,fy,fz. x..z and f in scene axes (m, N), v in the\n"
     "surface's frame (m/s), surface a name or none. An apostrophe is put before a name that is 'none', begins with\n"
     "an apostrophe, or would be a formula in a spreadsheet (= + - @).\n"
     "JSON: device, rate_hz, resolution_m, ticks, contact_s, events, metres, half_cycles_crossed,\n"
     "half_cycles_played, overruns, watchdogs, absences, force_limit_ticks, above_nyquist_ticks, non_finite_ticks,\n"
     "entry_ticks, slew_ticks, heat_ticks, passivity_ticks, squeezed_ticks, visit_limit_ticks, heat, force_max_n,\n"
     "even {lowest_gain, from_hz, to_hz}, faults, tick_ns and jitter_us {p50, p99, max}.\n"
     "Files are written completely or not at all, and never replace one that is read.\n"
     "Keys of --device fake:?key=value&key=value:\n",
     knurl_fake_keys},
    {"signal", "", "print a temporal vibration as CSV", {WAVE, {"--ticks", "N", "how many"}}, "CSV: tick,value.", NULL},
    {"metrics",
     "",
     "measure a temporal vibration over whole periods, as JSON",
     {WAVE, PRETTY},
     "JSON: actual_period_ms, dominant_hz, dominant_amplitude, net, rms, pcc {T1, T2, T3}.",
     NULL},
    {"scan",
     "",
     "run a grating over given motion, as CSV",
     {{"--method", METHODS, "the spatial method"},
      {"--fs", "FSX,FSY", "spatial frequency along x and y, cycles/m"},
      {"--amplitude", "A", "half peak to peak, m"},
      {"--rate", "HZ", "update rate; default 1000"},
      {"--in", "CSV", "a row per tick: positions x,y (m) or velocities vx,vy (m/s)"}},
     "CSV out: tick,height,fs,ft,event.",
     NULL},
    {"study",
     "NAME",
     "compute the numbers of a figure or chart",
     {{"--out", "DIR", "writes NAME.csv and NAME.json there; samples/study/figures.py draws them"},
      {"--own", "", "tradeoff: charts the method of samples/study/own.c, too"}},
     "Names: " HELP_STUDIES ".",
     NULL},
    {"bench",
     "",
     "time ticks on this machine (about half a minute)",
     {{"--json", "", "as JSON"},
      {"--case", "NAME",
       "one case only; a wrong name lists all. worst_..., mesh_10m and ..._thrashed run by name only"},
      {"--ticks", "N", "ticks to time per case"}},
     "The same ticks of worst_... are run 5 times, and each tick's least time counts, so interruptions do not.\n"
     "JSON: version, timer_ns, clock_step_ns, machine, cases [{case, batch_ns, p50_ns, p99_ns, p999_ns, max_ns, bytes,\n"
     "build_ms, ...}], skipped [{case, why}].",
     NULL},
    {"devices",
     "",
     "list connected devices, problems, and the fake device's keys",
     {{"--json", "", "as JSON"}, PRETTY},
     "JSON: [{uri, name, unusable}].",
     NULL},
    {"calibrate",
     "falcon",
     "find the gain of a Falcon with a known mass",
     {{"--mass", "KG", "that hangs from its grip, 0.05 to 0.4"}, {"--out", "FILE", "file to write the gain to"}},
     "JSON: gain, newtons. KNURL_FALCON_GAIN=FILE corrects the Falcon's forces.",
     NULL},
    {"sweep",
     "",
     "measure a device's response from 20 to 500 Hz, in a hand (two minutes)",
     {{"--device", "URI", "fake (default), or as knurl run"},
      {"--out", "CSV", "file to write the response to, for --response"},
      {"--rate", "HZ", "update rate, 1000 to 10000; default 1000, which reaches 403 Hz"},
      {"--fast", "", "fake only: as fast as the machine can"},
      PRETTY},
     "Sines along y, at most 1 N, one after the other. A fault, Ctrl-C, or a grip that moves by 30 mm ends it.\n"
     "CSV out: a line '# knurl response 1', then frequency_hz,gain (m/N), as far as motions stand out from noise.\n"
     "JSON: device, rate_hz, force_n, seconds, overruns, rows, to_hz.",
     NULL},
    {"verify",
     "",
     "test a device with your help: the first hour with it",
     {{"--device", "URI", "fake (default), or as knurl run"},
      {"--out", "NAME", "writes NAME.html, NAME.json, and NAME.csv for --response"},
      {"--only", STEPS, "these steps only, with commas in between"},
      {"--skip", STEPS, "all but these"},
      {"--mass", "KG", "that can hang from the grip, 0.01 to 0.1: its weight tells the scale of the force"},
      {"--response", "CSV", "a response measured otherwise, as with a force sensor, in place of the sweep"},
      {"--yes", "", "asks nothing: every step begins at once"},
      {"--simulate", "", "a fake device in the hand of a simulated person"},
      {"--json", "", "prints the JSON, and the findings to standard error"},
      PRETTY},
     "At most 1 N is sent (3 N while a mass is weighed), in pulses and ramps; Enter or Ctrl-C during a step ends all with\n"
     "no force. Expected are the device's data as Knurl knows them, and what simulations with these data do.\n"
     "JSON: device, uri, knurl, machine, simulated, force_max_n, mass_kg, passed, failed, not_measured, findings [{step,\n"
     "what, unit, expected [least, most], source, measured, verdict, note}], response [[Hz, m/N]].",
     NULL},
    {NULL, NULL, NULL, {{NULL, NULL, NULL}}, NULL, NULL}};

const char *help_argument(const help_option *o) {
    static char names[256];
    const int is_method = strcmp(o->argument, METHODS) == 0;
    if (!is_method && strcmp(o->argument, STEPS) != 0) {
        return o->argument;
    }
    names[0] = '\0';
    for (int32_t i = 0; is_method ? knurl_method_name(i + 1) != NULL : verify_steps[i].name != NULL; i++) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "",
                       is_method ? knurl_method_name(i + 1) : verify_steps[i].name);
    }
    return names;
}
