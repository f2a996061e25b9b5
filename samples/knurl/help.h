/* Help, a man page and completions, all by one table (help_table.h). SPDX-License-Identifier: MIT */
#ifndef KNURL_HELP_H
#define KNURL_HELP_H

/* Prints the overview (null) or a command's help. Returns 0, or 1 if there is no such command. */
int help_print(const char *command);

/* Prints the keys of the fake device's URI, one line each. */
void help_print_fake_keys(void);

/* Prints a man page (roff). */
void help_print_man(void);

/* Prints a completion script for bash, zsh or fish. Returns 0, or 1 for another shell. */
int help_print_completion(const char *shell);

#endif
