/* CSV files of motion, as the tool reads them. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "out.h"
#include "tool.h"

#include <stdarg.h>
#include <sys/mman.h>
#include <unistd.h>

/* The tool's, which would print. */
int tool_error(int code, const char *format, ...) {
    char text[4608];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return code;
}

void out_protect_stream(FILE *stream) {
    (void)stream;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const names[] = {"t", "x", "y"};
    static int file = -1;
    static char path[64];
    tool_table table;
    if (file < 0) {
        file = memfd_create("trace", 0);
        (void)snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    }
    EXPECT(ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == (ssize_t)size);
    (void)tool_csv_has(path, "vx");
    if (tool_read_csv(path, names, 3, &table) == TOOL_OK) {
        EXPECT(table.row_count > 0 && table.row_count <= size);
        for (uint64_t i = 0; i < 3 * table.row_count; i++) {
            EXPECT(isfinite(table.cells[i]));
        }
        free(table.cells);
    }
    return 0;
}
