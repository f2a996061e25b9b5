/* Windows. SPDX-License-Identifier: MIT */
#define _CRT_RAND_S /* rand_s(); NOLINT(bugprone-reserved-identifier) */
#include "os.h"

#include "say.h"

#include <windows.h> /* before shellapi.h, which needs it */

#include <conio.h>
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#define PATH_ROOM 4096 /* characters */

/* Sets errno from the system's error. */
static int fail(void) {
    static const struct {
        DWORD code;
        int number;
    } known[] = {{ERROR_FILE_NOT_FOUND, ENOENT},
                 {ERROR_PATH_NOT_FOUND, ENOENT},
                 {ERROR_INVALID_NAME, ENOENT},
                 {ERROR_FILE_EXISTS, EEXIST},
                 {ERROR_ALREADY_EXISTS, EEXIST},
                 {ERROR_ACCESS_DENIED, EACCES},
                 {ERROR_SHARING_VIOLATION, EBUSY},
                 {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
                 {ERROR_DISK_FULL, ENOSPC},
                 {ERROR_DIRECTORY, ENOTDIR},
                 {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
                 {ERROR_WRITE_PROTECT, EROFS},
                 {ERROR_NO_UNICODE_TRANSLATION, EILSEQ},
                 {ERROR_INSUFFICIENT_BUFFER, ENAMETOOLONG}};
    const DWORD code = GetLastError();
    errno = EIO;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        errno = known[i].code == code ? known[i].number : errno;
    }
    return -1;
}

static int widen(const char *path, wchar_t wide[PATH_ROOM]) {
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, PATH_ROOM) ? 0 : fail();
}

/* --- the process --- */

/* The command line in UTF-8: main()'s is in the system's code page, which cannot represent every path. Never freed.
 * Null: out of memory. */
static char **read_arguments(int *count) {
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), count);
    char **all = wide ? calloc((size_t)*count + 1, sizeof *all) : NULL;
    for (int i = 0; all && i < *count; i++) {
        const int size = WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, NULL, 0, NULL, NULL);
        all[i] = calloc((size_t)size + 1, 1);
        if (!all[i]) {
            return NULL; /* the process ends */
        }
        (void)WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, all[i], size, NULL, NULL);
    }
    (void)LocalFree((HLOCAL)wide);
    return all;
}

static UINT code_page_before;

static void restore_code_page(void) {
    (void)SetConsoleOutputCP(code_page_before);
}

void os_begin(int *argc, char ***argv) {
    DWORD mode = 0;
    int count = 0;
    char **arguments = read_arguments(&count);
    if (!arguments) {
        say(stderr, "knurl: no memory for the arguments\n");
        exit(1);
    }
    *argc = count;
    *argv = arguments;
    (void)_setmode(_fileno(stdin), _O_BINARY);
    (void)_setmode(_fileno(stdout), _O_BINARY);
    (void)_setmode(_fileno(stderr), _O_BINARY);
    code_page_before = GetConsoleOutputCP(); /* of the console, which outlives this process */
    if (code_page_before && SetConsoleOutputCP(CP_UTF8)) {
        (void)atexit(restore_code_page);
    }
    HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
    if (GetConsoleMode(console, &mode)) { /* for progress, which rewrites its line: "\r\033[K" */
        (void)SetConsoleMode(console, mode | ENABLE_PROCESSED_OUTPUT | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
    }
}

static void (*volatile on_interrupt)(int number);
static void (*volatile before_end)(void);
static volatile int is_waiting; /* for the program that runs instead: it handles the event */

static BOOL WINAPI on_console(DWORD event) {
    const int is_key = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
    if (is_key && (is_waiting || on_interrupt)) {
        if (!is_waiting) {
            on_interrupt(SIGINT);
        }
        return TRUE;
    }
    if (before_end) {
        before_end();
    }
    return FALSE; /* continue with earlier handlers; the last one ends the process */
}

static void handle_console(void) {
    static int is_handled;
    is_handled = is_handled || SetConsoleCtrlHandler(on_console, TRUE);
}

void os_on_interrupt(void (*handler)(int number)) {
    on_interrupt = handler;
    handle_console();
}

void os_before_end(void (*handler)(void)) {
    before_end = handler;
    handle_console();
}

/* Waits for it: Windows cannot replace a process. It gets the same command line, character by character. */
int os_run_instead(const char *program, char **argv) {
    wchar_t path[PATH_ROOM];
    STARTUPINFOW startup;
    PROCESS_INFORMATION child;
    DWORD code = 1;
    wchar_t *line = _wcsdup(GetCommandLineW()); /* it is written to */
    (void)argv;
    memset(&startup, 0, sizeof startup);
    startup.cb = sizeof startup;
    is_waiting = 1;
    handle_console();
    if (!line || widen(program, path) ||
        !CreateProcessW(path, line, NULL, NULL, TRUE, 0, NULL, NULL, &startup, &child)) {
        free(line);
        return fail();
    }
    free(line);
    (void)WaitForSingleObject(child.hProcess, INFINITE);
    (void)GetExitCodeProcess(child.hProcess, &code);
    (void)CloseHandle(child.hThread);
    (void)CloseHandle(child.hProcess);
    return code <= 255 ? (int)code : code == (DWORD)STATUS_CONTROL_C_EXIT ? 128 + SIGINT : 1;
}

int os_wait_for_key(void) {
    HANDLE in = GetStdHandle(STD_INPUT_HANDLE);
    unsigned char byte = 0;
    DWORD mode = 0;
    DWORD count = 1;
    const int is_console = GetConsoleMode(in, &mode) != 0;
    if (is_console && _kbhit()) {
        return _getche();
    }
    if (is_console || (PeekNamedPipe(in, NULL, 0, NULL, &count, NULL) && count == 0)) {
        Sleep(5);
        return 0;
    }
    return ReadFile(in, &byte, 1, &count, NULL) && count == 1 ? byte : -1;
}

void os_forget_keys(void) {
    (void)FlushConsoleInputBuffer(GetStdHandle(STD_INPUT_HANDLE)); /* fails if it is not a console */
}

/* --- files --- */

static int identify(HANDLE handle, os_file *found) {
    BY_HANDLE_FILE_INFORMATION info;
    memset(found, 0, sizeof *found);
    if (GetFileType(handle) != FILE_TYPE_DISK) {
        return handle == INVALID_HANDLE_VALUE ? fail() : 0;
    }
    if (!GetFileInformationByHandle(handle, &info)) {
        return fail();
    }
    found->device = info.dwVolumeSerialNumber;
    found->number = (uint64_t)info.nFileIndexHigh << 32 | info.nFileIndexLow;
    found->is_regular = !(info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY);
    return 0;
}

/* Other processes may use, remove and rename the file meanwhile, as on other systems. */
static HANDLE open_wide(const char *path, DWORD access, DWORD creation) {
    wchar_t wide[PATH_ROOM];
    return widen(path, wide) ? INVALID_HANDLE_VALUE
                             : CreateFileW(wide, access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                                           creation, FILE_FLAG_BACKUP_SEMANTICS, NULL);
}

int os_identify(const char *path, os_file *found) {
    HANDLE handle = open_wide(path, 0, OPEN_EXISTING);
    if (handle == INVALID_HANDLE_VALUE) {
        return fail();
    }
    const int result = identify(handle, found);
    (void)CloseHandle(handle);
    return result;
}

int os_identify_stream(FILE *stream, os_file *found) {
    /* NOLINTNEXTLINE(performance-no-int-to-ptr): the C library's interface */
    HANDLE handle = (HANDLE)_get_osfhandle(_fileno(stream));
    /* A write-only handle may not be identifiable, such as wine's if a shell has opened it. */
    return identify(handle, found) && handle == INVALID_HANDLE_VALUE ? -1 : 0;
}

/* Takes ownership of the handle. */
static FILE *stream_of(HANDLE handle, int flags, const char *mode) {
    const int number = handle == INVALID_HANDLE_VALUE ? -1 : _open_osfhandle((intptr_t)handle, flags | _O_BINARY);
    FILE *stream = number >= 0 ? _fdopen(number, mode) : NULL;
    if (!stream && number >= 0) {
        (void)_close(number);
    } else if (!stream && handle != INVALID_HANDLE_VALUE) {
        (void)CloseHandle(handle);
    }
    return stream;
}

FILE *os_open_input(const char *path, const char **why) {
    os_file found;
    HANDLE handle = open_wide(path, GENERIC_READ, OPEN_EXISTING);
    if (handle == INVALID_HANDLE_VALUE || identify(handle, &found)) {
        (void)fail();
        *why = strerror(errno);
    } else if (!found.is_regular && GetFileType(handle) != FILE_TYPE_PIPE) {
        *why = GetFileType(handle) == FILE_TYPE_DISK ? "expected a file, found a directory"
                                                     : "expected a file, found a device";
    } else {
        FILE *stream = stream_of(handle, _O_RDONLY, "rb");
        *why = stream ? *why : strerror(errno);
        return stream;
    }
    if (handle != INVALID_HANDLE_VALUE) {
        (void)CloseHandle(handle);
    }
    return NULL;
}

FILE *os_create(const char *path) {
    HANDLE handle = open_wide(path, GENERIC_WRITE, CREATE_NEW);
    if (handle == INVALID_HANDLE_VALUE) {
        (void)fail();
        return NULL;
    }
    return stream_of(handle, 0, "wb");
}

FILE *os_open_output(const char *path) {
    wchar_t wide[PATH_ROOM];
    return widen(path, wide) ? NULL : _wfopen(wide, L"wb");
}

FILE *os_open_stdout(void) {
    (void)fflush(stdout);
    const int copy = _dup(_fileno(stdout));
    FILE *stream = copy >= 0 ? _fdopen(copy, "wb") : NULL;
    if (!stream && copy >= 0) {
        (void)_close(copy);
    }
    return stream;
}

int os_remove(const char *path) {
    wchar_t wide[PATH_ROOM];
    return widen(path, wide) ? -1 : DeleteFileW(wide) ? 0 : fail();
}

int os_replace(const char *path, const char *with) {
    wchar_t to[PATH_ROOM];
    wchar_t from[PATH_ROOM];
    return widen(path, to) || widen(with, from) ? -1 : MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING) ? 0 : fail();
}

int os_sync(FILE *stream) {
    return fflush(stream) != 0 || _commit(_fileno(stream)) != 0 ? -1 : 0;
}

int os_make_folder(const char *path) {
    wchar_t wide[PATH_ROOM];
    return widen(path, wide) ? -1 : CreateDirectoryW(wide, NULL) ? 0 : fail();
}

int os_random(uint64_t *number) {
    unsigned high = 0;
    unsigned low = 0;
    const int failed = rand_s(&high) || rand_s(&low);
    *number = (uint64_t)high << 32 | low;
    return failed ? -1 : 0;
}

const char *os_base_name(const char *path) {
    const char *base = path;
    for (const char *c = path; *c; c++) {
        base = *c == '/' || *c == '\\' || *c == ':' ? c + 1 : base;
    }
    return base;
}
