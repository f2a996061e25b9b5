/* The table of the tool's commands and their options. SPDX-License-Identifier: MIT */
#ifndef KNURL_HELP_TABLE_H
#define KNURL_HELP_TABLE_H

#define HELP_OPTIONS_MAX 26

typedef struct help_option {
    const char *name;
    const char *argument; /* or "" */
    const char *text;
} help_option;

typedef struct help_command {
    const char *name;
    const char *arguments; /* positional */
    const char *text;
    help_option options[HELP_OPTIONS_MAX]; /* ended by a null name */
    const char *details;
    const char *(*more)(void); /* or null: further details */
} help_command;

#define HELP_DEVICES "touch, falcon, rawhid, serial, dhd, inverse3"

#define HELP_STUDIES                                                                                                   \
    "signals, coverage, temporal, device, gratings, preferences, tradeoff, velocity, tracking, even, half_cycles,\n"   \
    "transitions, smooth, creases, failures, stability"

extern const help_command help_commands[]; /* ended by a null name */

/* An option's argument, or its values with bars in between; valid until the next call. */
const char *help_argument(const help_option *o);

#endif
