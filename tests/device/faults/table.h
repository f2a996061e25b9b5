/* The table of faults, as it is printed. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TABLE_H
#define KNURL_TEST_TABLE_H

#include <knurl/device.h>

/** Result of one try. Times in ms. */
typedef struct outcome {
    double seen; /**< from the injection to the event; < 0: no event */
    double zero; /**< from the event to zero force, 0 if it was already zero; < 0: the force stayed */
    int is_back; /**< the force came back after all was well again */
    int32_t codes[8];
    int code_count;
} outcome;

typedef struct row {
    const char *device;
    const char *fault;
    const char *what; /**< effect of the fault, or null: its events */
    const char *back; /**< how it comes back, or null: yes or no */
    outcome result;
} row;

/** Aligned columns on stdout, and Markdown into a file. */
void table_print(const row *rows, int count, const char *markdown_path);

#endif
