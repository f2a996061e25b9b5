/* Help and the man page, by the table of commands. SPDX-License-Identifier: MIT */
#include "help.h"

#include "help_table.h"

#include <knurl/knurl.h>

#include <stdio.h>
#include <string.h>

#define INDENT 30

static const char exit_codes[] =
    "Exit codes: 0 done, 1 failed, 2 wrong usage, unknown method or unknown device, 3 inspect --check or verify found\n"
    "a problem, 4 a simulated run that touched nothing or hardly moved (its output is still written), 128 + N ended by\n"
    "signal N (130: Ctrl-C; nothing is written then, except by verify).\n";

static const help_command *find(const char *name) {
    const help_command *c = help_commands;
    while (c->name && strcmp(c->name, name) != 0) {
        c++;
    }
    return c->name ? c : NULL;
}

static void print_overview(void) {
    fputs("knurl: feel the gratings of a glTF scene, with or without a device\n\n", stdout);
    for (const help_command *c = help_commands; c->name; c++) {
        printf("  knurl %-8s %-6s %s\n", c->name, c->arguments, c->text);
    }
    fputs("\n  knurl help COMMAND     its options, columns and keys (also: knurl COMMAND --help)\n"
          "  knurl man              a man page: knurl man | man -l -\n"
          "  knurl completion SHELL a script for bash, zsh or fish: source <(knurl completion bash)\n"
          "  knurl --version\n\n",
          stdout);
    fputs(exit_codes, stdout);
}

int help_print(const char *command) {
    const help_command *c = command ? find(command) : NULL;
    if (!c) {
        if (!command) {
            print_overview();
        }
        return command != NULL;
    }
    printf("usage: knurl %s%s%s [options]: %s\n\n", c->name, c->arguments[0] ? " " : "", c->arguments, c->text);
    for (const help_option *o = c->options; o->name; o++) {
        const int width = printf("  %s %s", o->name, help_argument(o));
        printf("%*s%s\n", width < INDENT ? INDENT - width : 1, "", o->text);
    }
    printf("\n%s\n%s", c->details, c->more ? c->more() : "");
    return 0;
}

void help_print_fake_keys(void) {
    fputs(knurl_fake_keys(), stdout);
}

/* Filled by man: only the end of a sentence ends a line. */
static void print_roff(const char *text) {
    for (const char *c = text; *c; c++) {
        fputs(*c == '-' ? "\\-" : *c == '\\' ? "\\e" : "", stdout);
        if (*c == '\n' && c[1]) {
            fputs(c > text && strchr(".:", c[-1]) ? "\n.br\n" : "\n", stdout);
        } else if (*c != '-' && *c != '\\') {
            putchar(*c);
        }
    }
}

void help_print_man(void) {
    printf(".TH KNURL 1 \"\" \"knurl %s\"\n.SH NAME\nknurl \\- feel the gratings of a glTF scene\n.SH SYNOPSIS\n",
           knurl_version_string());
    for (const help_command *c = help_commands; c->name; c++) {
        printf(".B \"knurl %s\"\n[options] %s\n.br\n", c->name, c->arguments);
    }
    for (const help_command *c = help_commands; c->name; c++) {
        printf(".SH \"knurl %s\"\n", c->name);
        print_roff(c->text);
        for (const help_option *o = c->options; o->name; o++) {
            fputs("\n.TP\n.B ", stdout);
            print_roff(o->name);
            printf(" %s\n", help_argument(o));
            print_roff(o->text);
        }
        fputs("\n.PP\n", stdout);
        print_roff(c->details);
        fputs(c->more ? ".nf\n" : "\n", stdout); /* details of such a command end a line */
        if (c->more) {
            fputs(c->more(), stdout);
            fputs(".fi\n", stdout);
        }
    }
    fputs("\n.SH \"EXIT CODES\"\n", stdout);
    print_roff(exit_codes);
}
