/* JSON of the studies. SPDX-License-Identifier: MIT */
#include "json_out.h"

#include "study.h"

void study_json_member(FILE *stream, const char *name, double value, const char *end) {
    fprintf(stream, "\"%s\": ", name);
    study_json_number(stream, value);
    fprintf(stream, "%s\n", end);
}

void study_json_text(FILE *stream, const char *name, const char *text, const char *end) {
    fprintf(stream, "\"%s\": \"%s\"%s\n", name, text, end);
}

void study_json_array(FILE *stream, const char *name, const double *values, size_t count, size_t stride,
                      const char *end) {
    fprintf(stream, "\"%s\": [", name);
    for (size_t i = 0; i < count; i++) {
        fputs(i > 0 ? ", " : "", stream);
        study_json_number(stream, values[i * stride]);
    }
    fprintf(stream, "]%s\n", end);
}
