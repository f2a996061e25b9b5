/* Windows: time, threads, locked memory, libraries. SPDX-License-Identifier: MIT */
#include "base/system.h"

#include "base/atomic.h"

#include <windows.h> /* before timeapi.h, which needs it */

#include <process.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <timeapi.h>

#ifndef CREATE_WAITABLE_TIMER_HIGH_RESOLUTION
#define CREATE_WAITABLE_TIMER_HIGH_RESOLUTION 0x2 /* Windows 10 1803 and later */
#endif

/* The longest that a wait may overrun. High-resolution timers round up to half a millisecond (measured by others, not
 * documented by Microsoft), Sleep() to the millisecond set by timeBeginPeriod(1). */
#define FINE_LATE_NS   600000
#define COARSE_LATE_NS 2000000

#define LOCKED_STACK ((size_t)64 * 1024)

/* Windows rounds any size up; refuse the sizes that POSIX refuses. */
#define STACK_LEAST ((size_t)16 * 1024)

struct knurl_thread {
    HANDLE handle;
    void (*entry)(void *argument);
    void *argument;
    HANDLE timer;     /* created once, not per cycle; null before Windows 10 1803 */
    uint32_t on_time; /* 1: real-time; spins so that waits end on time */
};

static DWORD current_slot = TLS_OUT_OF_INDEXES; /* not __thread: MinGW's allocates, and crash handlers use this */

/* Null in threads not started here. */
static knurl_thread *current_thread(void) {
    return current_slot == TLS_OUT_OF_INDEXES ? NULL : TlsGetValue(current_slot);
}

int64_t knurl_system_now_ns(void) {
    static int64_t ticks_per_s; /* atomic; the same from boot to shutdown */
    int64_t rate = knurl_load_relaxed(&ticks_per_s);
    LARGE_INTEGER number;
    if (rate == 0) {
        (void)QueryPerformanceFrequency(&number); /* cannot fail since XP, nor can the counter */
        rate = number.QuadPart;
        knurl_store_relaxed(&ticks_per_s, rate);
    }
    (void)QueryPerformanceCounter(&number);
    return number.QuadPart / rate * 1000000000 + number.QuadPart % rate * 1000000000 / rate;
}

static HANDLE make_timer(void) {
    return CreateWaitableTimerExW(NULL, NULL, CREATE_WAITABLE_TIMER_HIGH_RESOLUTION, TIMER_ALL_ACCESS);
}

static int wait_by(HANDLE timer, int64_t ns) {
    LARGE_INTEGER due;
    due.QuadPart = -((ns + 99) / 100); /* negative: relative; absolute times follow the wall clock */
    return timer && SetWaitableTimer(timer, &due, 0, NULL, NULL, FALSE) &&
           WaitForSingleObject(timer, INFINITE) == WAIT_OBJECT_0;
}

static void wait_coarsely(int64_t ns) {
    static uint32_t asked; /* atomic */
    if (!knurl_load_relaxed(&asked)) {
        (void)timeBeginPeriod(1); /* once: the call is slow */
        knurl_store_relaxed(&asked, 1u);
    }
    Sleep((DWORD)((ns < 1000000000 ? ns : 1000000000) / 1000000 + 1));
}

/* A real-time thread waits until one margin before the deadline and spins for the rest: 0.1 to 0.6 ms of each period at
 * 1 kHz, and all of it on a Windows without high-resolution timers. Other threads only wait and may be late. */
void knurl_system_sleep_until_ns(int64_t deadline_ns) {
    if (deadline_ns <= knurl_system_now_ns()) {
        return;
    }
    const knurl_thread *thread = current_thread();
    HANDLE timer = thread ? thread->timer : make_timer();
    const int64_t margin = !thread || !thread->on_time ? 0 : timer ? FINE_LATE_NS : COARSE_LATE_NS;
    for (int64_t left; (left = deadline_ns - knurl_system_now_ns()) > 0;) {
        if (left <= margin) {
            YieldProcessor();
        } else if (!wait_by(timer, left - margin)) {
            wait_coarsely(left - margin);
        }
    }
    if (!thread && timer) {
        (void)CloseHandle(timer);
    }
}

/* The caller provides the storage, so that all of a scene's memory comes from its allocator. */
typedef char mutex_fits[sizeof(SRWLOCK) <= sizeof(knurl_mutex) ? 1 : -1];

static SRWLOCK *native(knurl_mutex *mutex) {
    return (SRWLOCK *)(void *)mutex->storage;
}

void knurl_system_mutex_init(knurl_mutex *mutex) {
    InitializeSRWLock(native(mutex));
}

void knurl_system_mutex_destroy(knurl_mutex *mutex) {
    (void)mutex; /* SRW locks need no cleanup */
}

void knurl_system_mutex_lock(knurl_mutex *mutex) {
    AcquireSRWLockExclusive(native(mutex));
}

void knurl_system_mutex_unlock(knurl_mutex *mutex) {
    ReleaseSRWLockExclusive(native(mutex));
}

static unsigned __stdcall run_thread(void *argument) {
    knurl_thread *thread = argument;
    (void)TlsSetValue(current_slot, thread);
    thread->entry(thread->argument);
    return 0;
}

static BOOL CALLBACK make_slot(INIT_ONCE *once, void *parameter, void **context) {
    (void)once;
    (void)parameter;
    (void)context;
    current_slot = TlsAlloc();
    return current_slot != TLS_OUT_OF_INDEXES;
}

knurl_thread *knurl_system_start_thread(void (*entry)(void *argument), void *argument, size_t stack_bytes) {
    static INIT_ONCE once = INIT_ONCE_STATIC_INIT;
    if (stack_bytes < STACK_LEAST || stack_bytes > UINT32_MAX || !InitOnceExecuteOnce(&once, make_slot, NULL, NULL)) {
        return NULL;
    }
    knurl_thread *thread = calloc(1, sizeof *thread);
    if (!thread) {
        return NULL;
    }
    thread->entry = entry;
    thread->argument = argument;
    thread->timer = make_timer();
    /* NOLINTNEXTLINE(performance-no-int-to-ptr): _beginthreadex() returns an integer */
    thread->handle = (HANDLE)_beginthreadex(NULL, (unsigned)stack_bytes, run_thread, thread,
                                            STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    if (!thread->handle) {
        if (thread->timer) {
            (void)CloseHandle(thread->timer);
        }
        free(thread);
        return NULL;
    }
    return thread;
}

void knurl_system_join_thread(knurl_thread *thread) {
    (void)WaitForSingleObject(thread->handle, INFINITE);
    (void)CloseHandle(thread->handle);
    if (thread->timer) {
        (void)CloseHandle(thread->timer);
    }
    free(thread);
}

uintptr_t knurl_system_thread_id(void) {
    return GetCurrentThreadId();
}

const char *knurl_system_environment(const char *name) {
    return getenv(name);
}

uintptr_t knurl_system_process_id(void) {
    return GetCurrentProcessId();
}

/* The multimedia scheduler raises a thread above its process's highest priority (23 to 26 instead of 15) until the
 * thread ends. If its library is missing, the priority stays. */
static int join_pro_audio(void) {
    typedef HANDLE(WINAPI * function)(const wchar_t *task, DWORD *index);
    HMODULE avrt = LoadLibraryExW(L"avrt.dll", NULL, LOAD_LIBRARY_SEARCH_SYSTEM32); /* stays for the thread's life */
    function join = NULL;
    DWORD index = 0;
    return avrt && knurl_system_find_function((knurl_library *)(void *)avrt, "AvSetMmThreadCharacteristicsW", &join) &&
           join(L"Pro Audio", &index) != NULL;
}

/* A process whose windows are hidden would run slower, and Windows 11 would ignore its timeBeginPeriod(); the process
 * keeps both from now on. A call without a bit gives that kind back to the system, so the last mask has both bits.
 * Windows 10 does not know the second one, refuses that mask and keeps the first. */
static void opt_out_of_throttling(void) {
    static const ULONG masks[] = {PROCESS_POWER_THROTTLING_EXECUTION_SPEED,
                                  PROCESS_POWER_THROTTLING_EXECUTION_SPEED |
                                      PROCESS_POWER_THROTTLING_IGNORE_TIMER_RESOLUTION};
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) {
        PROCESS_POWER_THROTTLING_STATE off = {PROCESS_POWER_THROTTLING_CURRENT_VERSION, masks[i], 0};
        (void)SetProcessInformation(GetCurrentProcess(), ProcessPowerThrottling, &off, sizeof off);
    }
}

int knurl_system_make_realtime(void) {
    knurl_thread *thread = current_thread();
    opt_out_of_throttling();
    if (thread) {
        thread->on_time = 1;
    }
    const int critical = SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL) != 0;
    return join_pro_audio() || critical;
}

/* A process may lock only some 30 pages unless it enlarges its working set first. */
static int make_room(size_t size) {
    static SRWLOCK lock = SRWLOCK_INIT;
    SIZE_T least;
    SIZE_T most;
    const SIZE_T more = size + (size_t)64 * 1024;
    AcquireSRWLockExclusive(&lock);
    const int made = GetProcessWorkingSetSize(GetCurrentProcess(), &least, &most) &&
                     SetProcessWorkingSetSize(GetCurrentProcess(), least + more, most + more);
    ReleaseSRWLockExclusive(&lock);
    return made;
}

int knurl_system_lock_memory(void *memory, size_t size) {
    return VirtualLock(memory, size) || (make_room(size) && VirtualLock(memory, size));
}

void knurl_system_unlock_memory(void *memory, size_t size) {
    (void)VirtualUnlock(memory, size);
}

void knurl_system_unlock_stack(uintptr_t start) {
    /* NOLINTNEXTLINE(performance-no-int-to-ptr): the frame is gone, but its pages remain */
    (void)VirtualUnlock((void *)start, LOCKED_STACK);
}

int knurl_system_lock_stack(uintptr_t *start) {
    char pages[LOCKED_STACK];
    volatile char *touched = pages;
    for (size_t i = sizeof pages; i >= 4096; i -= 4096) { /* downwards: a stack grows by its guard page */
        touched[i - 1] = 0;
    }
    touched[0] = 0;
    *start = (uintptr_t)pages;
    return knurl_system_lock_memory(pages, sizeof pages);
}

/* The system's message for an error, in UTF-8 and without the line end. */
static void explain(DWORD error, char *why, size_t why_size) {
    wchar_t text[512];
    DWORD length = FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, NULL, error, 0, text,
                                  (DWORD)(sizeof text / sizeof *text), NULL);
    while (length > 0 && text[length - 1] <= L' ') {
        length--;
    }
    const int bytes = WideCharToMultiByte(CP_UTF8, 0, text, (int)length, why, (int)why_size - 1, NULL, NULL);
    if (length == 0 || bytes <= 0) {
        (void)snprintf(why, why_size, "error %lu", (unsigned long)error);
    } else {
        why[bytes] = '\0';
    }
}

/* Uses a named mutex, which exists as long as a handle to it; nobody needs to own it. */
intptr_t knurl_system_take_node(const char *path) {
    char name[MAX_PATH] = "Global\\knurl-";
    size_t used = strlen(name);
    for (; *path && used + 1 < sizeof name; path++) {
        name[used++] = *path == '\\' ? '/' : *path; /* a backslash separates the namespace */
    }
    name[used] = '\0';
    HANDLE mutex = CreateMutexA(NULL, FALSE, name);
    const DWORD why = GetLastError();
    if (mutex && why != ERROR_ALREADY_EXISTS) {
        return (intptr_t)mutex;
    }
    if (mutex) {
        (void)CloseHandle(mutex);
    }
    return mutex || why == ERROR_ACCESS_DENIED ? 0 : -1; /* denied: created by another account */
}

void knurl_system_give_back_node(intptr_t node) {
    if (node > 0) {
        HANDLE mutex;
        memcpy(&mutex, &node, sizeof mutex);
        (void)CloseHandle(mutex);
    }
}

/* C:\... or \\server\...; slashes become backslashes, which the loader needs. */
static int is_absolute(wchar_t *path) {
    for (wchar_t *c = path; *c; c++) {
        *c = *c == L'/' ? L'\\' : *c;
    }
    return (path[0] && path[1] == L':' && path[2] == L'\\') || (path[0] == L'\\' && path[1] == L'\\');
}

knurl_library *knurl_system_load_library(const char *path, char *why, size_t why_size) {
    wchar_t wide[1024];
    DWORD before = 0;
    if (!MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, (int)(sizeof wide / sizeof *wide))) {
        explain(GetLastError(), why, why_size);
        return NULL;
    }
    const int absolute = is_absolute(wide);
    if (!absolute && wcspbrk(wide, L"\\:")) {
        (void)snprintf(why, why_size, "expected an absolute path or a bare name");
        return NULL;
    }
    (void)SetThreadErrorMode(SEM_FAILCRITICALERRORS, &before); /* no message box */
    HMODULE library = LoadLibraryExW(
        wide, NULL, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS | (absolute ? (DWORD)LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR : 0));
    if (!library) {
        explain(GetLastError(), why, why_size);
    }
    (void)SetThreadErrorMode(before, NULL);
    return (knurl_library *)(void *)library;
}

void knurl_system_unload_library(knurl_library *library) {
    (void)FreeLibrary((HMODULE)(void *)library);
}

int knurl_system_find_function(knurl_library *library, const char *name, void *function) {
    const FARPROC found = GetProcAddress((HMODULE)(void *)library, name);
    if (found) {
        memcpy(function, &found, sizeof found);
    }
    return found != NULL;
}
