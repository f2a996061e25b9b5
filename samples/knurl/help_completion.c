/* Completions for bash, zsh and fish, by the table of commands. SPDX-License-Identifier: MIT */
#include "help.h"

#include "bench.h"
#include "help_table.h"
#include "materials.h"

#include <stdio.h>
#include <string.h>

static void print_names(const help_command *only) {
    for (const help_command *c = help_commands; !only && c->name; c++) {
        printf("%s ", c->name);
    }
    for (const help_option *o = only ? only->options : NULL; o && o->name; o++) {
        printf("%s ", o->name);
    }
}

/* Prints the names of a table that an option takes one of; false if it takes none. */
static int print_table(const char *option) {
    const int is_case = strcmp(option, "--case") == 0;
    const int is_preset = strcmp(option, "--preset") == 0;
    for (const bench_case *known = bench_cases; is_case && known->name; known++) {
        printf("%s ", known->name);
    }
    for (int i = 0; is_preset && i < MATERIAL_COUNT; i++) {
        printf("%s ", materials[i].name);
    }
    return is_case || is_preset;
}

/* Prints the values of an option, or of a command (option null), with spaces in between; false if it takes a file or a
 * number. */
static int print_values(const help_command *c, const help_option *o) {
    const int is_device = o && strcmp(o->name, "--device") == 0;
    const char *values = is_device                           ? "fake, " HELP_DEVICES
                         : o                                 ? help_argument(o)
                         : strcmp(c->name, "study") == 0     ? HELP_STUDIES
                         : strcmp(c->name, "calibrate") == 0 ? "falcon|"
                                                             : "";
    if (o && print_table(o->name)) {
        return 1;
    }
    if (strchr(values, '=') || !strpbrk(values, o && !is_device ? "|" : "|,")) {
        return 0;
    }
    for (; *values; values++) {
        putchar(strchr("|,\n", *values) ? ' ' : *values);
    }
    return 1;
}

static void bash_values(const help_command *c, const help_option *o) {
    printf("  *:%s:%s) words='", c->name, o ? o->name : "*");
    (void)print_values(c, o);
    fputs("' ;;\n", stdout);
}

/* For bash, and zsh through bashcompinit. Without words, bash completes files. */
static void complete_bash(void) {
    fputs("_knurl() {\n  local word=${COMP_WORDS[COMP_CWORD]} last=${COMP_WORDS[COMP_CWORD-1]} words=\n"
          "  [ \"$last\" != = ] || last=${COMP_WORDS[COMP_CWORD-2]}\n" /* --option=value is three words */
          "  [ \"$word\" != = ] || word=\n"
          "  case $COMP_CWORD:${COMP_WORDS[1]}:$last in\n  1:*) words='help man completion ",
          stdout);
    print_names(NULL);
    fputs("' ;;\n  2:help:*) words='", stdout);
    print_names(NULL);
    fputs("' ;;\n  2:completion:*) words='bash zsh fish' ;;\n", stdout);
    for (const help_command *c = help_commands; c->name; c++) {
        for (const help_option *o = c->options; o->name; o++) {
            if (o->argument[0]) {
                bash_values(c, o);
            }
        }
        bash_values(c, NULL);
    }
    fputs("  esac\n  case $word:${COMP_WORDS[1]} in\n", stdout);
    for (const help_command *c = help_commands; c->name; c++) {
        printf("  -*:%s) words='", c->name);
        print_names(c);
        fputs("--help' ;;\n", stdout);
    }
    fputs("  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n}\ncomplete -o default -F _knurl knurl\n",
          stdout);
}

static void complete_fish(void) {
    fputs("complete -c knurl -n __fish_use_subcommand -f -a \"help man completion\"\n"
          "complete -c knurl -n \"__fish_seen_subcommand_from help\" -f -a \"",
          stdout);
    print_names(NULL);
    fputs("\"\ncomplete -c knurl -n \"__fish_seen_subcommand_from completion\" -f -a \"bash zsh fish\"\n", stdout);
    for (const help_command *c = help_commands; c->name; c++) {
        printf("complete -c knurl -n __fish_use_subcommand -f -a %s -d \"%s\"\n", c->name, c->text);
        printf("complete -c knurl -n \"__fish_seen_subcommand_from %s\" -a \"", c->name);
        (void)print_values(c, NULL);
        fputs("\"\n", stdout);
        for (const help_option *o = c->options; o->name; o++) {
            printf("complete -c knurl -n \"__fish_seen_subcommand_from %s\" -l %s %s-a \"", c->name, o->name + 2,
                   o->argument[0] ? "-r " : "");
            const int has_values = print_values(c, o);
            printf("\" %s-d \"%s\"\n", has_values ? "-f " : "", o->text);
        }
    }
}

int help_print_completion(const char *shell) {
    if (strcmp(shell, "fish") == 0) {
        complete_fish();
        return 0;
    }
    const int is_zsh = strcmp(shell, "zsh") == 0;
    if (!is_zsh && strcmp(shell, "bash") != 0) {
        return 1;
    }
    if (is_zsh) {
        fputs("#compdef knurl\nautoload -U +X bashcompinit && bashcompinit\n", stdout);
    }
    complete_bash();
    if (is_zsh) { /* as a file in fpath it is the body of _knurl(): the first completion has to go on */
        fputs("[ \"${funcstack[1]}\" != _knurl ] || _bash_complete -o default -F _knurl\n", stdout);
    }
    return 0;
}
