/* base's use of Windows beyond test_base: real-time threads, libraries, and actions before a process ends. The last
 * starts this program again, which then ends in the requested way. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include "base/system.h"

#include <windows.h>

#include <stdio.h>
#include <stdlib.h>

/* --- real-time threads --- */

#define WAITS 100

typedef struct pace {
    int realtime;
    int priority;
    int early;
} pace;

static void wait_for_deadlines(void *argument) {
    pace *b = argument;
    b->realtime = knurl_system_make_realtime();
    b->priority = GetThreadPriority(GetCurrentThread());
    const int64_t start = knurl_system_now_ns();
    for (int i = 1; i <= WAITS; i++) {
        const int64_t deadline = start + i * (int64_t)1000000;
        knurl_system_sleep_until_ns(deadline);
        b->early += knurl_system_now_ns() < deadline;
    }
}

TEST(a_real_time_thread_is_time_critical_and_never_wakes_before_its_deadline) {
    pace b = {0, 0, 0};
    knurl_thread *thread = knurl_system_start_thread(wait_for_deadlines, &b, (size_t)64 * 1024);
    assert_non_null(thread);
    knurl_system_join_thread(thread);
    assert_int_equal(b.realtime, 1);
    assert_int_equal(b.priority, THREAD_PRIORITY_TIME_CRITICAL);
    assert_int_equal(b.early, 0);
}

/* --- libraries --- */

#define NAME                                                                                                           \
    "Gr\xC3\xB6\xC3\x9F"                                                                                               \
    "e-\xE8\xA7\xA6.dll" /* in no one code page */
#define WIDE_NAME L"Gr\u00f6\u00dfe-\u89e6.dll"

TEST(a_library_is_loaded_by_a_path_in_utf8) {
    char why[256] = "";
    char folder[MAX_PATH];
    char path[MAX_PATH + sizeof NAME];
    int (*answer)(void) = NULL;
    void *other = &why;
    assert_true(CopyFileA(KNURL_TEST_LIBRARY, KNURL_TEST_TMP "/library.dll", FALSE));
    (void)SetCurrentDirectoryA(KNURL_TEST_TMP);
    assert_true(MoveFileExW(L"library.dll", WIDE_NAME, MOVEFILE_REPLACE_EXISTING));
    assert_in_range(GetCurrentDirectoryA(sizeof folder, folder), 1, sizeof folder - 1); /* with its drive */
    (void)snprintf(path, sizeof path, "%s/" NAME, folder);
    knurl_library *library = knurl_system_load_library(path, why, sizeof why);
    assert_string_equal(why, "");
    assert_non_null(library);
    assert_int_equal(knurl_system_find_function(library, "knurl_test_answer", &answer), 1);
    assert_int_equal(answer(), 42);
    assert_int_equal(knurl_system_find_function(library, "knurl_test_question", &other), 0);
    assert_ptr_equal(other, &why);
    knurl_system_unload_library(library);
    assert_true(DeleteFileW(WIDE_NAME)); /* no one holds it any more */
}

/* A planted library: LoadLibrary() would take it out of the current folder. */
TEST(a_bare_name_is_not_looked_for_in_the_current_folder) {
    char why[256] = "";
    (void)CreateDirectoryA(KNURL_TEST_TMP "/planted", NULL);
    assert_true(SetCurrentDirectoryA(KNURL_TEST_TMP "/planted"));
    assert_true(CopyFileA(KNURL_TEST_LIBRARY, "knurl_planted.dll", FALSE));
    assert_null(knurl_system_load_library("knurl_planted.dll", why, sizeof why));
    assert_true(strlen(why) > 5);
    assert_null(knurl_system_load_library("./knurl_planted.dll", why, sizeof why));
    assert_non_null(strstr(why, "expected an absolute path or a bare name"));
    assert_null(knurl_system_load_library("C:knurl_planted.dll", why, sizeof why));
    HMODULE taken = LoadLibraryA("knurl_planted.dll"); /* it is there, and good */
    assert_non_null(taken);
    (void)FreeLibrary(taken);
    knurl_library *system = knurl_system_load_library("version.dll", why, sizeof why);
    assert_non_null(system);
    knurl_system_unload_library(system);
    (void)DeleteFileA("knurl_planted.dll");
    (void)SetCurrentDirectoryA(KNURL_TEST_TMP);
}

TEST(a_failed_load_has_the_systems_message_in_one_line) {
    static const char *const paths[] = {"C:/none/" NAME, KNURL_TEST_ASSETS "/plate_1d.glb", "bad \xC3\x28.dll"};
    for (size_t i = 0; i < COUNT_OF(paths); i++) {
        char why[256] = "";
        assert_null(knurl_system_load_library(paths[i], why, sizeof why));
        assert_true(strlen(why) > 5);
        assert_null(strpbrk(why, "\r\n"));
        char cut[8];
        assert_null(knurl_system_load_library(paths[i], cut, sizeof cut)); /* too short for a sentence */
        assert_non_null(memchr(cut, '\0', sizeof cut));
    }
}

/* --- ends --- */

static HANDLE told;

static void zero(void) {
    (void)SetEvent(told);
}

static LONG WINAPI hosts_filter(EXCEPTION_POINTERS *what) {
    (void)what;
    TerminateProcess(GetCurrentProcess(), 43);
    return EXCEPTION_CONTINUE_SEARCH;
}

static void read_nothing(void *argument) {
    volatile int *volatile nothing = argument;
    (void)*nothing; /* NOLINT(clang-analyzer-core.NullDereference): intentional */
}

/* The child. */
static int die(const char *how, const char *event) {
    (void)SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
    told = OpenEventA(EVENT_MODIFY_STATE, FALSE, event);
    if (strcmp(how, "filter") == 0) {
        (void)SetUnhandledExceptionFilter(hosts_filter);
    }
    static const knurl_exit_actions actions = {zero, zero, zero};
    if (!told || !knurl_system_on_exit(&actions, 0) || !knurl_system_on_exit(&actions, 0)) {
        return 1;
    }
    if (strcmp(how, "abort") == 0) {
        abort();
    } else if (strcmp(how, "ctrl-c") == 0) {
        (void)GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0); /* to all on this console: itself */
        Sleep(10000);
        return 1;
    } else if (strcmp(how, "thread") == 0) {
        knurl_system_join_thread(knurl_system_start_thread(read_nothing, NULL, (size_t)64 * 1024));
    } else if (strcmp(how, "return") != 0) {
        read_nothing(NULL);
    }
    return 0;
}

/* How the child ended, and whether forces were zeroed before. */
static DWORD end_of(const char *how, int *is_zeroed) {
    char program[1024];
    char line[2048];
    char event[64];
    STARTUPINFOA startup;
    PROCESS_INFORMATION child;
    DWORD code = 0;
    memset(&startup, 0, sizeof startup);
    startup.cb = sizeof startup;
    (void)snprintf(event, sizeof event, "knurl-zero-%lu", (unsigned long)GetCurrentProcessId());
    HANDLE zeroed = CreateEventA(NULL, TRUE, FALSE, event);
    assert_true(GetModuleFileNameA(NULL, program, sizeof program) < sizeof program);
    (void)snprintf(line, sizeof line, "\"%s\" %s %s", program, how, event);
    assert_true(CreateProcessA(NULL, line, NULL, NULL, FALSE, CREATE_NO_WINDOW, NULL, NULL, &startup, &child));
    assert_int_equal(WaitForSingleObject(child.hProcess, 30000), WAIT_OBJECT_0);
    assert_true(GetExitCodeProcess(child.hProcess, &code));
    *is_zeroed = WaitForSingleObject(zeroed, 0) == WAIT_OBJECT_0;
    (void)CloseHandle(child.hThread);
    (void)CloseHandle(child.hProcess);
    (void)CloseHandle(zeroed);
    return code;
}

TEST(a_process_zeroes_forces_before_it_ends_as_it_would_have) {
    static const struct {
        const char *how;
        DWORD code;
    } cases[] = {{"return", 0}, /* and exit() */
                 {"fault", (DWORD)STATUS_ACCESS_VIOLATION},
                 {"thread", (DWORD)STATUS_ACCESS_VIOLATION},
                 {"filter", 43}, /* the host's own filter comes next */
                 {"abort", 3},
                 {"ctrl-c", (DWORD)STATUS_CONTROL_C_EXIT}};
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        int is_zeroed = -1;
        const DWORD code = end_of(cases[i].how, &is_zeroed);
        const int by_wine = code == 0 && cases[i].code == (DWORD)STATUS_CONTROL_C_EXIT; /* it reports no more */
        if ((code != cases[i].code && !by_wine) || is_zeroed != 1) {
            fail_msg("%s: ended with %#lx, zeroed: %d", cases[i].how, (unsigned long)code, is_zeroed);
        }
    }
}

int main(int argc, char **argv) {
    return argc == 3 ? die(argv[1], argv[2]) : suite_run("system");
}
