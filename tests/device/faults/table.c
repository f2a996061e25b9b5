/* Rows of the table of faults. SPDX-License-Identifier: MIT */
#include "table.h"

#include <stdio.h>
#include <string.h>

typedef struct cells {
    char text[6][96];
} cells;

static void put_time(char *to, size_t size, double ms) {
    if (ms < 0.0) {
        (void)snprintf(to, size, "-");
    } else {
        (void)snprintf(to, size, "%.1f", ms);
    }
}

static void put_codes(char *to, size_t size, const outcome *o) {
    int used = snprintf(to, size, "%s", o->code_count == 0 ? "nothing" : "");
    for (int i = 0; i < o->code_count && used < (int)size; i++) {
        used += snprintf(to + used, size - (size_t)used, "%s%s", i ? ", " : "", knurl_fault_name(o->codes[i]));
    }
}

static cells cells_of(const row *r) {
    cells c;
    (void)snprintf(c.text[0], sizeof c.text[0], "%s", r->device);
    (void)snprintf(c.text[1], sizeof c.text[1], "%s", r->fault);
    put_codes(c.text[2], sizeof c.text[2], &r->result);
    if (r->what) {
        (void)snprintf(c.text[2], sizeof c.text[2], "%s", r->what);
    }
    put_time(c.text[3], sizeof c.text[3], r->result.seen);
    put_time(c.text[4], sizeof c.text[4], r->result.zero);
    (void)snprintf(c.text[5], sizeof c.text[5], "%s", r->back ? r->back : r->result.is_back ? "yes" : "no");
    return c;
}

static const cells titles = {{"device", "fault", "what happens", "seen after ms", "zero after ms", "comes back"}};

static void print_line(FILE *to, const cells *c, const int widths[6], const char *between, const char *edge) {
    (void)fprintf(to, "%s", edge);
    for (int i = 0; i < 6; i++) {
        (void)fprintf(to, "%s%-*s", i ? between : "", widths[i], c->text[i]);
    }
    (void)fprintf(to, "%s\n", edge[0] ? " |" : "");
}

void table_print(const row *rows, int count, const char *markdown_path) {
    int widths[6];
    for (int i = 0; i < 6; i++) {
        widths[i] = (int)strlen(titles.text[i]);
        for (int k = 0; k < count; k++) {
            const cells c = cells_of(&rows[k]);
            const int length = (int)strlen(c.text[i]);
            widths[i] = length > widths[i] ? length : widths[i];
        }
    }
    FILE *markdown = fopen(markdown_path, "w");
    print_line(stdout, &titles, widths, "  ", "");
    if (markdown) {
        print_line(markdown, &titles, widths, " | ", "| ");
        (void)fprintf(markdown, "|---|---|---|---|---|---|\n");
    }
    for (int k = 0; k < count; k++) {
        const cells c = cells_of(&rows[k]);
        print_line(stdout, &c, widths, "  ", "");
        if (markdown) {
            print_line(markdown, &c, widths, " | ", "| ");
        }
    }
    (void)printf("times: from the fault to its event, from the event to motors without force\n");
    if (markdown) {
        (void)fclose(markdown);
    }
}
