/* knurl: the command-line tool. SPDX-License-Identifier: MIT */
#include "help.h"
#include "machine.h"
#include "os.h"
#include "tool.h"

#include <knurl/knurl.h>

#include <errno.h>
#include <string.h>

/* The studies and the analysis of signals are a separate program, because they link a Fourier transform. */
static int run_study_program(int argc, char **argv) {
    char path[4096];
    (void)argc;
    const int code = machine_program("knurl_study", path, sizeof path) ? -1 : os_run_instead(path, argv - 1);
    if (code >= 0) {
        return code;
    }
    if (errno == ENOENT) { /* for example after ./run demo */
        return tool_error(TOOL_FAILURE,
                          "%s: the program knurl_study, which does this, was not built: expected %s; install "
                          "libkissfft-dev and build again, or use ./run test",
                          argv[0], path);
    }
    return tool_error(TOOL_FAILURE, "%s: the program knurl_study, which does this, cannot be run: %s: %s", argv[0],
                      path, strerror(errno));
}

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {{"inspect", cmd_inspect},
                {"tag", cmd_tag},
                {"run", cmd_run},
                {"signal", cmd_signal},
                {"metrics", run_study_program},
                {"scan", cmd_scan},
                {"study", run_study_program},
                {"bench", cmd_bench},
                {"devices", cmd_devices},
                {"calibrate", cmd_calibrate},
                {"sweep", cmd_sweep},
                {"verify", cmd_verify}};

/* The command whose help is requested; "": the overview; null: no help requested. */
static const char *help_asked(int argc, char **argv) {
    if (strcmp(argv[1], "help") == 0) {
        return argc > 2 ? argv[2] : "";
    }
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            return i > 1 ? argv[1] : "";
        }
    }
    return NULL;
}

static int unknown_command(const char *name) {
    enum { COUNT = sizeof commands / sizeof *commands };
    const char *names[COUNT];
    char list[256] = "";
    for (size_t i = 0; i < COUNT; i++) {
        const size_t used = strlen(list);
        names[i] = commands[i].name;
        (void)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", names[i]);
    }
    const char *near = tool_nearest(name, names, COUNT);
    return tool_error(TOOL_USAGE, "expected a command (%s), found '%s'%s%s%s; see 'knurl --help'", list, name,
                      near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
}

static int complete(const char *shell) {
    if (!shell) {
        return tool_error(TOOL_USAGE, "completion: expected bash, zsh or fish, found none");
    }
    return help_print_completion(shell) == 0
               ? TOOL_OK
               : tool_error(TOOL_USAGE, "completion: expected bash, zsh or fish, found '%s'", shell);
}

static int show_version(const char *argument) {
    (void)argument;
    say(stdout, "knurl %s\n", knurl_version_string());
    return TOOL_OK;
}

static int show_man(const char *argument) {
    (void)argument;
    help_print_man();
    return TOOL_OK;
}

/* Commands that print information about the tool. most: maximum of argc. */
static const struct {
    const char *name;
    int (*show)(const char *argument);
    int most;
} pages[] = {{"--version", show_version, 2}, {"man", show_man, 2}, {"completion", complete, 3}};

static int run_command(int argc, char **argv) {
    if (argc < 2) {
        return tool_error(TOOL_USAGE, "expected a command, found none; see 'knurl --help'");
    }
    const char *asked = help_asked(argc, argv);
    if (asked) {
        return help_print(asked[0] ? asked : NULL) ? unknown_command(asked) : TOOL_OK;
    }
    for (size_t i = 0; i < sizeof pages / sizeof *pages; i++) {
        if (strcmp(argv[1], pages[i].name) == 0) {
            return argc > pages[i].most ? tool_error(TOOL_USAGE, "%s: unexpected argument '%s'; see 'knurl --help'",
                                                     argv[1], argv[pages[i].most])
                                        : pages[i].show(argc > 2 ? argv[2] : NULL);
        }
    }
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(argv[1], commands[i].name) == 0) {
            return commands[i].run(argc - 1, argv + 1);
        }
    }
    return unknown_command(argv[1]);
}

int main(int argc, char **argv) {
    os_begin(&argc, &argv);
    return tool_end(run_command(argc, argv));
}
