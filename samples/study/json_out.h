/* JSON of the studies, a little at a time. SPDX-License-Identifier: MIT */
#ifndef KNURL_STUDY_JSON_OUT_H
#define KNURL_STUDY_JSON_OUT_H

#include <stddef.h>
#include <stdio.h>

/** "name": value, with `end` ("," or "") and a new line after it. Not finite: null. */
void study_json_member(FILE *stream, const char *name, double value, const char *end);

/** "name": "text"; the text is plain: no quotes, no control characters. */
void study_json_text(FILE *stream, const char *name, const char *text, const char *end);

/** "name": [values], every `stride`-th from the first on. */
void study_json_array(FILE *stream, const char *name, const double *values, size_t count, size_t stride,
                      const char *end);

#endif
