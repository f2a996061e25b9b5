/* CSV input: a header, then numbers. SPDX-License-Identifier: MIT */
#include "tool.h"

#include "in.h"
#include "os.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define MAX_COLUMNS 64

/* Splits the line at its commas; removes spaces and the line end. Returns the number of cells. */
static uint32_t split(char *line, char *cells[MAX_COLUMNS]) {
    uint32_t count = 0;
    char *rest = line;
    while (rest && count < MAX_COLUMNS) {
        char *cell = rest;
        rest = strchr(cell, ',');
        if (rest) {
            *rest++ = 0;
        }
        cell += strspn(cell, " \t");
        cell[strcspn(cell, "\r\n")] = 0;
        for (size_t n = strlen(cell); n > 0 && (cell[n - 1] == ' ' || cell[n - 1] == '\t'); n--) {
            cell[n - 1] = 0;
        }
        cells[count++] = cell;
    }
    return count;
}

static int column_of(char *const *cells, uint32_t count, const char *name) {
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(cells[i], name) == 0) {
            return (int)i;
        }
    }
    return -1;
}

/* Describes a header without the expected names. Does not quote it, because it may be the first line of any file. */
static const char *describe_header(const char *line, char *const *cells, uint32_t count, const char *name) {
    for (uint32_t i = 0; i < count; i++) {
        if (strcasecmp(cells[i], name) == 0) {
            return "it in another case";
        }
    }
    return strchr(line, ';')                       ? "columns separated by ';'"
           : strchr(line, '\t')                    ? "columns separated by tabs"
           : line[strspn(line, "+-.eE0123456789")] ? "none"
                                                   : "numbers instead of names";
}

/* Finds each name's column in the header, which must have it once. */
static int read_header(const char *path, char *line, const char *const *names, uint32_t count, int *columns) {
    char *cells[MAX_COLUMNS];
    line += strncmp(line, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; /* a byte order mark, as spreadsheets write it */
    const uint32_t found = split(line, cells);
    for (uint32_t i = 0; i < count; i++) {
        columns[i] = column_of(cells, found, names[i]);
        if (columns[i] < 0) {
            return tool_error(TOOL_FAILURE, "%s: line 1: expected a header with a column '%s', found %s", path,
                              names[i], describe_header(cells[0], cells, found, names[i]));
        }
        const uint32_t next = (uint32_t)columns[i] + 1;
        if (column_of(cells + next, found - next, names[i]) >= 0) {
            return tool_error(TOOL_FAILURE, "%s: line 1: expected one column '%s', found two", path, names[i]);
        }
    }
    return TOOL_OK;
}

static int read_row(const char *path, uint64_t line_number, char *line, const char *const *names, uint32_t count,
                    const int *columns, double *row) {
    char *cells[MAX_COLUMNS];
    const uint32_t found = split(line, cells);
    for (uint32_t i = 0; i < count; i++) {
        const char *cell = columns[i] >= 0 && columns[i] < (int)found ? cells[columns[i]] : "";
        char *end = NULL;
        row[i] = strtod(cell, &end);
        if (end == cell || *end || !isfinite(row[i])) {
            return tool_error(TOOL_FAILURE, "%s: line %llu: %s: expected a finite number, found '%s'", path,
                              (unsigned long long)line_number, names[i], cell);
        }
    }
    return TOOL_OK;
}

/* Adds a row, doubling the capacity if it is full. */
static int append(const char *path, tool_table *table, uint64_t *capacity, const double *row) {
    const size_t columns = table->columns;
    if (table->row_count == *capacity) {
        const uint64_t wanted = *capacity ? 2 * *capacity : 1024;
        double *more = columns > 0 ? realloc(table->cells, (size_t)wanted * columns * sizeof *more) : NULL;
        if (!more) {
            return tool_error(TOOL_FAILURE, "%s: no memory for %llu rows", path, (unsigned long long)wanted);
        }
        table->cells = more;
        *capacity = wanted;
    }
    memcpy(table->cells + table->row_count * columns, row, columns * sizeof *row);
    table->row_count++;
    return TOOL_OK;
}

static int read_rows(const char *path, FILE *stream, const char *const *names, tool_table *table) {
    int columns[MAX_COLUMNS] = {0};
    double row[MAX_COLUMNS];
    char *line = NULL;
    size_t size = 0;
    uint64_t line_number = 0;
    uint64_t capacity = 0;
    int code = TOOL_OK;
    int too_long = 0;
    while (code == TOOL_OK && in_line(stream, &line, &size, &too_long) != -1) {
        line_number++;
        if (line_number == 1) {
            code = read_header(path, line, names, table->columns, columns);
        } else if (strspn(line, " \t\r\n") < strlen(line)) {
            code = read_row(path, line_number, line, names, table->columns, columns, row);
            code = code == TOOL_OK ? append(path, table, &capacity, row) : code;
        }
    }
    free(line);
    if (too_long) {
        code = tool_error(TOOL_FAILURE, "%s: line %llu: expected at most 65536 bytes, found more", path,
                          (unsigned long long)line_number + 1);
    }
    if (code == TOOL_OK && ferror(stream)) {
        code = tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, strerror(errno));
    }
    if (code == TOOL_OK && table->row_count == 0) {
        code = tool_error(TOOL_FAILURE, "%s: expected a header and at least one row, found %s", path,
                          line_number ? "no row" : "nothing");
    }
    return code;
}

int tool_read_csv(const char *path, const char *const *names, uint32_t count, tool_table *table) {
    memset(table, 0, sizeof *table);
    table->columns = count;
    const char *why = "";
    const int is_stdin = strcmp(path, "-") == 0;
    FILE *stream = is_stdin ? stdin : os_open_input(path, &why);
    if (!stream) {
        return tool_error(TOOL_FAILURE, "%s: cannot be read: %s", path, why);
    }
    out_protect_stream(stream);
    const int code = read_rows(is_stdin ? "standard input" : path, stream, names, table);
    if (!is_stdin) {
        (void)fclose(stream);
    }
    if (code != TOOL_OK) {
        free(table->cells);
        memset(table, 0, sizeof *table);
    }
    return code;
}

int tool_csv_has(const char *path, const char *name) {
    const char *why = "";
    FILE *stream = os_open_input(path, &why);
    char *line = NULL;
    size_t size = 0;
    int found = 0;
    int too_long = 0;
    if (stream && in_line(stream, &line, &size, &too_long) != -1) {
        char *cells[MAX_COLUMNS];
        const uint32_t count = split(line + (strncmp(line, "\xef\xbb\xbf", 3) == 0 ? 3 : 0), cells);
        found = column_of(cells, count, name) >= 0;
    }
    free(line);
    if (stream) {
        (void)fclose(stream);
    }
    return found;
}
