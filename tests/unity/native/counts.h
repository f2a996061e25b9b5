/* Counts of a process's resources that may leak. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_UNITY_COUNTS_H
#define KNURL_TEST_UNITY_COUNTS_H

#include <stdint.h>

#if defined(_WIN32)
#include <windows.h>

#include <psapi.h>
#include <tlhelp32.h>
#else
#include <dirent.h>
#include <malloc.h>
#include <stdio.h>
#endif

typedef struct counts {
    int64_t threads;
    int64_t handles; /* or files */
    int64_t bytes;   /* on the heap */
    int64_t maps;    /* pieces of address space; 0 on Windows */
} counts;

#if defined(_WIN32)

static inline int64_t count_threads(void) {
    int64_t threads = 0;
    THREADENTRY32 entry = {.dwSize = sizeof entry};
    HANDLE all = CreateToolhelp32Snapshot(TH32CS_SNAPTHREAD, 0);
    for (BOOL more = Thread32First(all, &entry); more; more = Thread32Next(all, &entry)) {
        threads += entry.th32OwnerProcessID == GetCurrentProcessId();
    }
    CloseHandle(all);
    return threads;
}

/* Bytes in use on a heap of the process. */
static inline int64_t heap_bytes(HANDLE heap) {
    int64_t bytes = 0;
    PROCESS_HEAP_ENTRY entry = {0};
    HeapLock(heap);
    while (HeapWalk(heap, &entry)) {
        bytes += entry.wFlags & PROCESS_HEAP_ENTRY_BUSY ? (int64_t)entry.cbData : 0;
    }
    HeapUnlock(heap);
    return bytes;
}

static inline counts count_all(void) {
    counts c = {count_threads(), 0, 0, 0};
    DWORD handles = 0;
    HANDLE heaps[64];
    const DWORD heap_count = GetProcessHeaps(64, heaps);
    GetProcessHandleCount(GetCurrentProcess(), &handles);
    c.handles = handles;
    for (DWORD i = 0; i < heap_count && i < 64; i++) {
        c.bytes += heap_bytes(heaps[i]);
    }
    return c;
}

#else

#if !__GLIBC_PREREQ(2, 33)
#define mallinfo2 mallinfo /* in ints, which differences of less than 2 GB get over */
#endif

static inline int64_t count_entries(const char *folder) {
    int64_t entries = 0;
    DIR *dir = opendir(folder);
    while (dir && readdir(dir)) {
        entries++;
    }
    if (dir) {
        (void)closedir(dir);
    }
    return entries;
}

static inline int64_t count_lines(const char *path) {
    int64_t lines = 0;
    FILE *file = fopen(path, "r");
    for (int c = file ? fgetc(file) : EOF; c != EOF; c = fgetc(file)) {
        lines += c == '\n';
    }
    if (file) {
        (void)fclose(file);
    }
    return lines;
}

static inline counts count_all(void) {
    const counts c = {count_entries("/proc/self/task"), count_entries("/proc/self/fd"), (int64_t)mallinfo2().uordblks,
                      count_lines("/proc/self/maps")};
    return c;
}

#endif
#endif
