/* WebSockets on Windows with its WinHTTP, which calls back on threads of its own; loaded only if an Inverse3 is opened.
 * SPDX-License-Identifier: MIT */
#include "device/inverse3/channel.h"

#if defined(_WIN32) && defined(KNURL_HAVE_INVERSE3)

#include "base/atomic.h"
#include "base/base.h"
#include "base/mailbox.h"
#include "base/system.h"
#include "device/dynlib.h"

#include <windows.h> /* before winhttp.h, which needs it */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <winhttp.h>

#define CONNECT_MS 1000
#define CLOSE_MS   1000
#define PART       16384 /* bytes received at once */

enum { SESSION, CONNECTION, REQUEST, UPGRADED, HANDLES };

typedef struct websocket {
    HINTERNET handles[HANDLES];
    HANDLE news; /* an event: one of the atomics has changed, or a message has come */
    char out[KNURL_INVERSE3_COMMAND];
    /* messages: received by WinHTTP's threads, one at a time */
    knurl_mailbox box;
    char *texts[3];
    size_t sizes[3];
    size_t size; /* of the message that is being received */
    int is_too_long;
    knurl_inverse3_filter filter;
    char part[PART];
    /* atomics */
    uint32_t is_open, is_gone, is_sending;
    uint32_t count;    /* messages since the last call */
    uint32_t to_close; /* handles that WinHTTP has not reported closed yet */
    uint32_t last_error;
} websocket;

#define FUNCTIONS(X)                                                                                                   \
    X(CloseHandle)                                                                                                     \
    X(Connect)                                                                                                         \
    X(Open)                                                                                                            \
    X(OpenRequest)                                                                                                     \
    X(ReceiveResponse)                                                                                                 \
    X(SendRequest)                                                                                                     \
    X(SetOption)                                                                                                       \
    X(SetStatusCallback)                                                                                               \
    X(WebSocketCompleteUpgrade)                                                                                        \
    X(WebSocketReceive)                                                                                                \
    X(WebSocketSend)

typedef struct winhttp_functions {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a member's name */
#define FIELD(name) __typeof__(&WinHttp##name) name;
    FUNCTIONS(FIELD)
#undef FIELD
} winhttp_functions;

static winhttp_functions lib; /* null until loaded */

/* --- on WinHTTP's threads --- */

static void CALLBACK on_event(HINTERNET handle, DWORD_PTR context, DWORD status, void *info, DWORD size);

static void end(websocket *w, DWORD error) {
    knurl_store_relaxed(&w->last_error, (uint32_t)error);
    knurl_store_release(&w->is_gone, 1u);
}

static void receive_more(websocket *w) {
    HINTERNET handle = knurl_load_acquire(&w->handles[UPGRADED]); /* null while it is being closed */
    const DWORD error = handle ? lib.WebSocketReceive(handle, w->part, sizeof w->part, NULL, NULL) : NO_ERROR;
    if (error != NO_ERROR) {
        end(w, error);
    }
}

static void take_part(websocket *w, const WINHTTP_WEB_SOCKET_STATUS *part) {
    const size_t size = part->dwBytesTransferred;
    if (part->eBufferType == WINHTTP_WEB_SOCKET_CLOSE_BUFFER_TYPE) {
        end(w, NO_ERROR);
        return;
    }
    w->is_too_long |= size > KNURL_INVERSE3_LONGEST - w->size;
    if (!w->is_too_long) {
        memcpy(w->texts[w->box.back] + w->size, w->part, size);
        w->size += size;
    }
    if (part->eBufferType == WINHTTP_WEB_SOCKET_UTF8_MESSAGE_BUFFER_TYPE ||
        part->eBufferType == WINHTTP_WEB_SOCKET_BINARY_MESSAGE_BUFFER_TYPE) {
        const uint32_t at = w->box.back;
        w->sizes[at] = w->is_too_long ? 0 : w->size;
        w->is_too_long = 0;
        w->size = 0;
        if (!w->filter.takes || w->filter.takes(w->filter.self, w->texts[at], w->sizes[at])) {
            knurl_mailbox_post(&w->box);
            (void)__atomic_fetch_add(&w->count, 1, __ATOMIC_RELEASE);
        }
    }
    receive_more(w);
}

static void upgrade(websocket *w, HINTERNET request) {
    (void)__atomic_fetch_add(&w->to_close, 1, __ATOMIC_ACQ_REL); /* before the handle exists: see close_channel() */
    HINTERNET made = lib.WebSocketCompleteUpgrade(request, (DWORD_PTR)w);
    if (!made) {
        end(w, GetLastError());
        (void)__atomic_fetch_sub(&w->to_close, 1, __ATOMIC_ACQ_REL);
        return;
    }
    (void)lib.SetStatusCallback(made, on_event, WINHTTP_CALLBACK_FLAG_ALL_NOTIFICATIONS,
                                0); /* if it is not inherited */
    knurl_store_release(&w->handles[UPGRADED], made);
    knurl_store_release(&w->is_open, 1u);
    receive_more(w);
}

static void CALLBACK on_event(HINTERNET handle, DWORD_PTR context, DWORD status, void *info, DWORD size) {
    websocket *w = (websocket *)context; /* NOLINT(performance-no-int-to-ptr): WinHTTP's type */
    (void)size;
    if (!w) {
        return;
    }
    HANDLE news = w->news; /* w may be freed once the last handle is closed */
    switch (status) {
    case WINHTTP_CALLBACK_STATUS_SENDREQUEST_COMPLETE:
        if (!lib.ReceiveResponse(handle, NULL)) {
            end(w, GetLastError());
        }
        break;
    case WINHTTP_CALLBACK_STATUS_HEADERS_AVAILABLE:
        upgrade(w, handle);
        break;
    case WINHTTP_CALLBACK_STATUS_READ_COMPLETE:
        take_part(w, info);
        break;
    case WINHTTP_CALLBACK_STATUS_WRITE_COMPLETE:
        knurl_store_release(&w->is_sending, 0u);
        break;
    case WINHTTP_CALLBACK_STATUS_REQUEST_ERROR:
        end(w, ((const WINHTTP_ASYNC_RESULT *)info)->dwError);
        break;
    case WINHTTP_CALLBACK_STATUS_HANDLE_CLOSING:
        (void)SetEvent(news);
        (void)__atomic_fetch_sub(&w->to_close, 1, __ATOMIC_ACQ_REL);
        return;
    default:
        return;
    }
    (void)SetEvent(news);
}

/* --- a channel --- */

/* A connection that is upgraded just now gets its handle meanwhile. */
static void close_handles(websocket *w) {
    for (int i = HANDLES; i-- > 0;) {
        HINTERNET handle = __atomic_exchange_n(&w->handles[i], NULL, __ATOMIC_ACQ_REL);
        if (handle) {
            (void)lib.CloseHandle(handle);
        }
    }
}

static void close_channel(void *self) {
    websocket *w = self;
    close_handles(w);
    for (int ms = 0; knurl_load_acquire(&w->to_close) > 0; ms++) {
        if (ms == CLOSE_MS) {
            return; /* WinHTTP may still use it */
        }
        Sleep(1);
        close_handles(w);
    }
    (void)CloseHandle(w->news);
    for (int i = 0; i < 3; i++) {
        free(w->texts[i]);
    }
    free(w);
}

static int send_message(void *self, const char *text, size_t size) {
    websocket *w = self;
    if (knurl_load_acquire(&w->is_gone) || knurl_load_acquire(&w->is_sending) || size > sizeof w->out) {
        return 0;
    }
    memcpy(w->out, text, size);
    knurl_store_release(&w->is_sending, 1u);
    const DWORD error =
        lib.WebSocketSend(w->handles[UPGRADED], WINHTTP_WEB_SOCKET_UTF8_MESSAGE_BUFFER_TYPE, w->out, (DWORD)size);
    if (error != NO_ERROR) { /* no callback will clear is_sending */
        end(w, error);
    }
    return error == NO_ERROR;
}

/* Waits until *value is not 0, the connection is gone or the time is over. GetTickCount64() is too coarse: 16 ms. */
static void wait_for(websocket *w, const uint32_t *value, int ms) {
    const int64_t until = knurl_system_now_ns() + ms * INT64_C(1000000);
    int64_t left = until - knurl_system_now_ns();
    while (!knurl_load_acquire(value) && !knurl_load_acquire(&w->is_gone) && left > 0) {
        (void)WaitForSingleObject(w->news, (DWORD)((left + 999999) / 1000000));
        left = until - knurl_system_now_ns();
    }
}

static int receive(void *self, int milliseconds, knurl_inverse3_message *message) {
    websocket *w = self;
    wait_for(w, &w->count, milliseconds);
    const uint32_t count = __atomic_exchange_n(&w->count, 0, __ATOMIC_ACQ_REL);
    if (count == 0) {
        return knurl_load_acquire(&w->is_gone) ? -1 : 0;
    }
    (void)knurl_mailbox_take(&w->box);
    message->text = w->texts[w->box.front];
    message->size = w->sizes[w->box.front];
    return (int)count;
}

/* To this machine only: a haptic loop does not tolerate a network's delays. */
static int start(websocket *w, int port) {
    DWORD_PTR context = (DWORD_PTR)w;
    DWORD off = WINHTTP_DISABLE_REDIRECTS;
    HINTERNET *h = w->handles;
    h[SESSION] = lib.Open(L"knurl", WINHTTP_ACCESS_TYPE_NO_PROXY, NULL, NULL, WINHTTP_FLAG_ASYNC);
    h[CONNECTION] = h[SESSION] ? lib.Connect(h[SESSION], L"127.0.0.1", (INTERNET_PORT)port, 0) : NULL;
    h[REQUEST] = h[CONNECTION] ? lib.OpenRequest(h[CONNECTION], L"GET", L"/", NULL, NULL, NULL, 0) : NULL;
    if (!h[REQUEST] || !lib.SetOption(h[REQUEST], WINHTTP_OPTION_CONTEXT_VALUE, &context, sizeof context) ||
        !lib.SetOption(h[REQUEST], WINHTTP_OPTION_DISABLE_FEATURE, &off, sizeof off) ||
        lib.SetStatusCallback(h[REQUEST], on_event, WINHTTP_CALLBACK_FLAG_ALL_NOTIFICATIONS, 0) ==
            WINHTTP_INVALID_STATUS_CALLBACK) {
        return 0;
    }
    knurl_store_release(&w->to_close, 1u);
    if (!lib.SetOption(h[REQUEST], WINHTTP_OPTION_UPGRADE_TO_WEB_SOCKET, NULL, 0) ||
        !lib.SendRequest(h[REQUEST], WINHTTP_NO_ADDITIONAL_HEADERS, 0, NULL, 0, 0, context)) {
        end(w, GetLastError());
    }
    wait_for(w, &w->is_open, CONNECT_MS);
    return knurl_load_acquire(&w->is_open) && !knurl_load_acquire(&w->is_gone);
}

static websocket *allocate(void) {
    websocket *w = calloc(1, sizeof *w);
    int is_full = w != NULL;
    for (int i = 0; i < 3 && w; i++) {
        w->texts[i] = malloc(KNURL_INVERSE3_LONGEST);
        is_full = is_full && w->texts[i];
    }
    if (w) {
        knurl_mailbox_init(&w->box);
        w->news = CreateEventW(NULL, FALSE, FALSE, NULL);
    }
    if (w && !(is_full && w->news)) {
        close_channel(w);
        return NULL;
    }
    return w;
}

static int connect_to(void *user, int port, knurl_inverse3_filter filter, knurl_inverse3_channel *channel, char *why,
                      size_t why_size) {
    websocket *w = allocate();
    (void)user;
    if (w) {
        w->filter = filter;
    }
    if (!w || !start(w, port)) {
        const unsigned long error = w ? knurl_load_relaxed(&w->last_error) : 0;
        (void)snprintf(why, why_size, !w ? "no memory" : error ? "error %lu" : "no answer", error);
        if (w) {
            close_channel(w);
        }
        return 0;
    }
    const knurl_inverse3_channel opened = {w, send_message, receive, close_channel};
    *channel = opened;
    return 1;
}

const knurl_inverse3_service *knurl_inverse3_websocket(char *why, size_t why_size) {
    static const knurl_inverse3_service service = {NULL, connect_to};
    static const char *const file = "winhttp.dll";
    static uint32_t state;
    char reason[256];
#define FUNCTION(name) {"WinHttp" #name, &lib.name},
    static const knurl_dynlib_function functions[] = {FUNCTIONS(FUNCTION)};
#undef FUNCTION
    if (knurl_dynlib_load(&state, &file, 1, functions, sizeof functions / sizeof *functions, reason, sizeof reason)) {
        return &service;
    }
    (void)snprintf(why, why_size, "WebSockets cannot be used: %s", reason);
    return NULL;
}

#else

typedef int nothing_on_other_systems; /* ISO C has no empty translation unit */

#endif
