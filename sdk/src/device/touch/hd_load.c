/* Finds and loads the HD library. SPDX-License-Identifier: MIT */
#include "device/touch/hd.h"

#include "base/regular_file.h"
#include "base/system.h"

#include <stdio.h>
#include <string.h>

#define PATH_ROOM 512

#if defined(_WIN32)
static const char *const usual[] = {"hd.dll"};
#else
static const char *const usual[] = {"libHD.so", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0"};
#endif

static const char help[] =
    "install 3D Systems' OpenHaptics (for Linux or Windows) and the Touch device driver, set "
    "GTDD_HOME as their instructions say, and name the library by ?library=PATH or KNURL_HD_LIBRARY if it is elsewhere";

/* One library for all devices of the process, because HD has one scheduler. */
static struct {
    hd_api api;
    knurl_library *library;
    uint32_t users;
    char path[PATH_ROOM];
} loaded;

/* Failed attempts, "PATH (why); PATH (why)". */
typedef struct attempts {
    char text[640];
} attempts;

/* Omits the path that the system's reasons often begin with, because it is already in the text. */
static void note(attempts *tried, const char *path, const char *why) {
    const size_t used = strlen(tried->text);
    const size_t length = strlen(path);
    const char *reason = strncmp(why, path, length) == 0 && why[length] == ':' ? why + length + 1 : why;
    reason += strspn(reason, " ");
    (void)snprintf(tried->text + used, sizeof tried->text - used, "%s%.300s (%.240s)", used ? "; " : "", path, reason);
}

/* If a library is for another processor, Linux reports "no such file"; the ELF header has the reason. */
#if defined(__x86_64__)
#define ELF_MACHINE 62
#elif defined(__i386__)
#define ELF_MACHINE 3
#elif defined(__aarch64__)
#define ELF_MACHINE 183
#elif defined(__arm__)
#define ELF_MACHINE 40
#else
#define ELF_MACHINE 0 /* unknown */
#endif

static void look_for_machine(const char *path, char *why, size_t why_size) {
    unsigned char head[20] = {0};
    char place[PATH_ROOM + 16];
    (void)snprintf(place, sizeof place, "%s%.500s", strchr(path, '/') ? "" : "/usr/lib/", path);
    char unread[64];
    uint64_t there = 0;
    FILE *file = knurl_regular_open(NULL, place, &there, unread, sizeof unread);
    const size_t got = file ? fread(head, 1, sizeof head, file) : 0;
    if (file) {
        (void)fclose(file);
    }
    const int machine = head[5] == 2 ? 256 * head[18] + head[19] : 256 * head[19] + head[18]; /* EI_DATA: big-endian */
    if (got == sizeof head && memcmp(head, "\177ELF", 4) == 0 && ELF_MACHINE != 0 && machine != ELF_MACHINE) {
        (void)snprintf(why, why_size, "it is for another processor: ELF machine %d, expected %d", machine, ELF_MACHINE);
    }
}

/* The first symbol that the library lacks, or null if it has all. */
static const char *find_functions(knurl_library *library, hd_api *api) {
#define HD_FIND(field, symbol, result, arguments)                                                                      \
    if (!knurl_system_find_function(library, #symbol, &api->field)) {                                                  \
        return #symbol;                                                                                                \
    }
    HD_FUNCTIONS(HD_FIND)
#undef HD_FIND
    return NULL;
}

/* Returns 1 if it was loaded with all its functions. */
static int try_path(const char *path, attempts *tried) {
    char why[512];
    hd_api api;
    knurl_library *library = knurl_system_load_library(path, why, sizeof why);
    if (!library) {
        look_for_machine(path, why, sizeof why);
        note(tried, path, why);
        return 0;
    }
    const char *missing = find_functions(library, &api);
    if (missing) {
        (void)snprintf(why, sizeof why, "it has no function %s, so it is not OpenHaptics' library, or is too old",
                       missing);
        note(tried, path, why);
        knurl_system_unload_library(library);
        return 0;
    }
    loaded.api = api;
    loaded.library = library;
    (void)snprintf(loaded.path, sizeof loaded.path, "%s", path);
    return 1;
}

knurl_result knurl_hd_acquire(const char *path, const char *device, const hd_api **hd) {
    if (loaded.users == 0) {
        attempts tried = {""};
        const char *named = path[0] ? path : knurl_system_environment("KNURL_HD_LIBRARY");
        int found = 0;
        if (named && named[0]) {
            found = try_path(named, &tried);
        } else {
            for (size_t i = 0; i < sizeof usual / sizeof *usual && !found; i++) {
                found = try_path(usual[i], &tried);
            }
        }
        if (!found) {
            return knurl_fail(KNURL_ERROR_UNSUPPORTED, "device '%s': the HD library cannot be loaded%s: %s; %s", device,
                              path[0]             ? ""
                              : named && named[0] ? " (KNURL_HD_LIBRARY names it)"
                                                  : "",
                              tried.text, help);
        }
    } else if (path[0] && strcmp(path, loaded.path) != 0) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "device '%s': expected the HD library that is in use, '%s', found '%s': all devices of a "
                          "program share one",
                          device, loaded.path, path);
    }
    loaded.users++;
    *hd = &loaded.api;
    return KNURL_OK;
}

void knurl_hd_release(void) {
    if (--loaded.users == 0) {
        knurl_system_unload_library(loaded.library);
    }
}
