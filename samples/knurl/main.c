/* knurl: the command-line tool. SPDX-License-Identifier: MIT */
#include "machine.h"
#include "tool.h"

#include <knurl/knurl.h>

#include <errno.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "knurl: feel the gratings of a glTF scene, with or without a device\n"
    "\n"
    "  knurl inspect FILE [--pretty]       what a file's tagged surfaces come to: models, bytes, why (JSON)\n"
    "      --full-model                    without the reductions: flat meshes stay meshes\n"
    "      --budget NAME=N,...             what loading may cost: surfaces, bytes, vertices, triangles, seconds\n"
    "                                      (knurl/gltf.h has the defaults)\n"
    "  knurl run FILE [options]            load, feel or stroke, tick; a summary (JSON)\n"
    "      --device URI                    fake (default), touch, falcon, rawhid, serial, dhd; see 'knurl devices'\n"
    "      --reconnect                     look for a device that got lost, instead of ending\n"
    "      --surface NAME                  which surface to stroke (default: the first)\n"
    "      --stroke NAME                   of the fake device's hand, 1 mm below the surface: line (default), sweep,\n"
    "                                      circle, press or rest\n"
    "      --trace CSV                     the fake device plays HIP positions t,x,y,z (s, m) without a hand\n"
    "      --seconds S                     of the clock, with fake of its ticks; default 5, or the trace's length\n"
    "      --rate HZ                       update rate, 100 to 10000; default 1000\n"
    "      --method S1|S2|locked|area      for all surfaces, instead of their own\n"
    "      --fast                          as fast as the machine can, the same forces tick for tick\n"
    "      --out CSV                       what was felt, a row a tick; - is standard output. Never a file that is read;\n"
    "                                      there whole or not at all\n"
    "      --wav FILE                      the same as a sound: mono, 48 kHz, 16 bits\n"
    "      --full-model                    without the reductions: to compare what is felt\n"
    "      --budget NAME=N,...             as above\n"
    "      --clamp                         walls and textures within what the device can do\n"
    "      --pretty                        JSON over several lines\n"
    "  knurl signal --method T1|T2|T3 --period-ms P --amplitude A --rate HZ --ticks N\n"
    "                                      a temporal vibration (CSV: tick,value)\n"
    "  knurl metrics --method T1|T2|T3 --period-ms P --amplitude A --rate HZ\n"
    "                                      what such a vibration is worth, over whole actual periods (JSON)\n"
    "  knurl scan --method S1|S2|locked|area --fs FSX,FSY --amplitude A --rate HZ --in CSV\n"
    "                                      a grating under given positions x,y or velocities vx,vy, a row a tick (CSV)\n"
    "  knurl study NAME --out DIR          a figure or chart as CSV and JSON; plot.py draws it\n"
    "  knurl bench [--json] [--case NAME] [--ticks N]\n"
    "                                      what a tick takes on this machine, warm and paced (about half a minute)\n"
    "  knurl devices [--json]              what is connected, what is not and why, and the fake device's settings\n"
    "  knurl --version\n"
    "\n"
    "Exit codes: 0 done, 1 failed, 2 wrong usage, unknown method or unknown device, 4 a simulated run that\n"
    "touched nothing or hardly moved (its output is written all the same), 128 + N ended early by signal N\n"
    "(nothing is written then).\n";

/* The studies, and what analyses signals as they do, are a program of their own: it links a Fourier transform. */
static int run_study_program(int argc, char **argv) {
    char path[4096];
    (void)argc;
    if (machine_program("knurl_study", path, sizeof path) == 0) {
        (void)execv(path, argv - 1); /* as main() was called */
    }
    return tool_error(TOOL_FAILURE, "%s: the program knurl_study, which does this, cannot be run: %s: %s", argv[0],
                      path, strerror(errno));
}

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {{"inspect", cmd_inspect},       {"run", cmd_run},        {"signal", cmd_signal},
                {"metrics", run_study_program}, {"scan", cmd_scan},      {"study", run_study_program},
                {"bench", cmd_bench},           {"devices", cmd_devices}};

static int run_command(int argc, char **argv) {
    if (argc < 2) {
        fputs(help, stderr);
        return TOOL_USAGE;
    }
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[1], "help") == 0 || strcmp(argv[1], "-h") == 0) {
            fputs(help, stdout);
            return TOOL_OK;
        }
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("knurl %s\n", knurl_version_string());
        return TOOL_OK;
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(argv[1], commands[i].name) == 0) {
            return commands[i].run(argc - 1, argv + 1);
        }
    }
    return tool_error(
        TOOL_USAGE,
        "expected a command (inspect, run, signal, metrics, scan, study, bench, devices), found '%s'; see 'knurl --help'",
        argv[1]);
}

int main(int argc, char **argv) {
    return tool_end(run_command(argc, argv));
}
