/* The machine's name, and programs in the folder of this one. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_MACHINE_H
#define KNURL_SAMPLES_MACHINE_H

#include <stddef.h>

/** The processor's name, without characters that JSON would have to escape. */
void machine_name(char *name, size_t size);

/** The path of a program in the running program's folder. 0, or 1 if it does not exist or cannot be run; the path is
 * set all the same, empty if it does not fit. */
int machine_program(const char *name, char *path, size_t size);

#endif
