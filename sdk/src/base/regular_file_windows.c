/* Regular files on Windows. SPDX-License-Identifier: MIT */
#include "base/regular_file.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <string.h>

static FILE *refuse(const char *reason, char *why, size_t why_size) {
    (void)snprintf(why, why_size, "%s", reason);
    return NULL;
}

/* Joins folder\path as UTF-16; 0 if it is too long or not valid UTF-8. */
static int join(const char *folder, const char *path, wchar_t *wide, int room) {
    int length = 0;
    if (folder) {
        length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, folder, -1, wide, room);
        if (length == 0 || length >= room) {
            return 0;
        }
        wide[length - 1] = L'\\'; /* replaces the terminator */
    }
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide + length, room - length) != 0;
}

/* Below a folder the link itself is opened, not its target, and then refused. */
FILE *knurl_regular_open(const char *folder, const char *path, uint64_t *size, char *why, size_t why_size) {
    wchar_t wide[4096];
    BY_HANDLE_FILE_INFORMATION found;
    if (!join(folder, path, wide, (int)(sizeof wide / sizeof *wide))) {
        return refuse("expected a name in UTF-8 of at most 4095 characters", why, why_size);
    }
    HANDLE handle =
        CreateFileW(wide, GENERIC_READ, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL, OPEN_EXISTING,
                    FILE_FLAG_BACKUP_SEMANTICS | (folder ? FILE_FLAG_OPEN_REPARSE_POINT : 0), NULL);
    if (handle == INVALID_HANDLE_VALUE) {
        const DWORD code = GetLastError();
        return refuse(code == ERROR_FILE_NOT_FOUND || code == ERROR_PATH_NOT_FOUND ? "no such file"
                                                                                   : "it cannot be opened",
                      why, why_size);
    }
    const char *reason = NULL;
    if (GetFileType(handle) != FILE_TYPE_DISK || !GetFileInformationByHandle(handle, &found)) {
        reason = "expected a regular file, found a special file";
    } else if (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) {
        reason = "expected a regular file, found a directory";
    } else if (folder && (found.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT)) {
        reason = "expected a file, found a symbolic link";
    }
    const int number = reason ? -1 : _open_osfhandle((intptr_t)handle, _O_RDONLY | _O_BINARY);
    FILE *file = number >= 0 ? _fdopen(number, "rb") : NULL;
    if (!file) {
        if (number >= 0) {
            (void)_close(number);
        } else {
            (void)CloseHandle(handle);
        }
        return refuse(reason ? reason : "it cannot be opened", why, why_size);
    }
    *size = (uint64_t)found.nFileSizeHigh << 32 | found.nFileSizeLow;
    return file;
}
