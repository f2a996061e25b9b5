/* The machine's name, and programs in the folder of this one. SPDX-License-Identifier: MIT */
#include "machine.h"

#include <windows.h>

#include <stdio.h>
#include <string.h>

void machine_name(char *name, size_t size) {
    char processor[128] = "";
    DWORD length = sizeof processor;
    SYSTEM_INFO system;
    GetSystemInfo(&system);
    const LSTATUS failed = RegGetValueA(HKEY_LOCAL_MACHINE, "HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0",
                                        "ProcessorNameString", RRF_RT_REG_SZ, NULL, processor, &length);
    (void)snprintf(name, size, "%s, %lu cores", failed ? "unknown" : processor + strspn(processor, " "),
                   (unsigned long)system.dwNumberOfProcessors);
    for (char *c = name; *c; c++) {
        *c = *c == '"' || *c == '\\' || (unsigned char)*c < 0x20 || (unsigned char)*c > 0x7e ? ' ' : *c;
    }
}

int machine_program(const char *name, char *path, size_t size) {
    wchar_t wide[4096];
    char self[4096];
    const DWORD length = GetModuleFileNameW(NULL, wide, sizeof wide / sizeof *wide);
    const int got = length > 0 && length < sizeof wide / sizeof *wide &&
                    WideCharToMultiByte(CP_UTF8, 0, wide, -1, self, sizeof self, NULL, NULL) > 0;
    const char *slash = got ? strrchr(self, '\\') : NULL;
    const int written = slash ? snprintf(path, size, "%.*s%s.exe", (int)(slash + 1 - self), self, name) : -1;
    if (written < 0 || (size_t)written >= size) {
        path[0] = 0;
        return 1;
    }
    return !MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, sizeof wide / sizeof *wide) ||
           GetFileAttributesW(wide) == INVALID_FILE_ATTRIBUTES;
}
