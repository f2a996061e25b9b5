/* The table of faults, as it is printed. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_TABLE_H
#define KNURL_TEST_TABLE_H

#include <knurl/device.h>

/** What one try came to. Times in ms. */
typedef struct outcome {
    double seen; /**< from the injection to the event; < 0: there was none */
    double zero; /**< from the event to motors without force, 0 where they had none by then; < 0: they kept it */
    int is_back; /**< the force came back after all was well again */
    int32_t codes[8];
    int code_count;
} outcome;

typedef struct row {
    const char *device;
    const char *fault;
    const char *what; /**< what happens, or null: its events */
    const char *back; /**< how it comes back, or null: yes or no */
    outcome result;
} row;

/** Aligned columns on stdout, and Markdown into a file. */
void table_print(const row *rows, int count, const char *markdown_path);

#endif
