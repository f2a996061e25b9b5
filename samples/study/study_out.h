/* Shared by the studies: files, numbers, progress. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_OUT_H
#define KNURL_STUDY_OUT_H

#include "json.h"
#include "options.h"
#include "out.h"

/** Opens FOLDER/NAME, creating the folder (its parent must exist); end with out_keep() or out_discard(). 0, or 1 after
 * printing the reason. */
int study_open(out_file *file, const char *folder, const char *name);

/** Writes FOLDER/NAME.csv and FOLDER/NAME.json, one object, by one function, which returns 0, 1 if memory runs out
 * (reported here), or 2 after printing the reason. Either both files are complete, or there is neither. 0, or 1 after
 * printing the reason. */
int study_write(const char *folder, const char *name, int (*write)(FILE *csv, json_writer *json, void *user),
                void *user);

/** The rest of a row of CSV: a comma before each number, then the end of the line. Numbers that are not finite become
 * empty cells.
 */
void study_end_row(FILE *csv, const double *cells, size_t count);

/** "  name: 40 %" on a terminal; nothing in a pipe. share: 0..1; 1 ends the line. */
void study_progress(const char *name, double share);

#endif
