/* WebSockets with libwebsockets, which is loaded at run time: the version of its header, whose structures it shares.
 * The calling thread handles its events. SPDX-License-Identifier: MIT */
#include "device/inverse3/channel.h"

#include <stdio.h>

#ifndef KNURL_HAVE_INVERSE3

const knurl_inverse3_service *knurl_inverse3_websocket(char *why, size_t why_size) {
    (void)snprintf(why, why_size,
                   "this build has no libwebsockets and jsmn: install their headers (Debian: libwebsockets-dev, "
                   "libjsmn-dev), configure with KNURL_INVERSE3=ON and build again");
    return NULL;
}

#elif !defined(_WIN32) /* channel_winhttp.c */

#include "base/base.h"
#include "device/dynlib.h"
#include "device/inverse3/pool.h"

#include <libwebsockets.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#define CONNECT_NS 1000000000
#define FD_LIMIT   16 /* per context; by default it allocates as many as the process may open */

typedef struct websocket {
    struct lws_context *context;
    struct lws *wsi;
    lws_sorted_usec_list_t timer;
    int is_open, is_gone, is_late; /* is_late: the timer has expired */
    char why[128];
    /* to be sent */
    unsigned char out[LWS_PRE + KNURL_INVERSE3_COMMAND];
    size_t out_size;
    /* messages: the last complete one, and the one being received */
    char *texts[2];
    size_t sizes[2];
    int coming;      /* index of the one being received */
    int is_too_long; /* of the one being received */
    int count;       /* complete ones since the last call */
    knurl_inverse3_filter filter;
    knurl_pool pool;
} websocket;

/* Functions loaded from libwebsockets. */
#define FUNCTIONS(X)                                                                                                   \
    X(callback_on_writable)                                                                                            \
    X(cancel_service)                                                                                                  \
    X(client_connect_via_info)                                                                                         \
    X(context_destroy)                                                                                                 \
    X(create_context)                                                                                                  \
    X(get_library_version)                                                                                             \
    X(is_final_fragment)                                                                                               \
    X(remaining_packet_payload)                                                                                        \
    X(service)                                                                                                         \
    X(set_allocator)                                                                                                   \
    X(set_log_level)                                                                                                   \
    X(sul_schedule)                                                                                                    \
    X(write)

typedef struct lws_functions {
/* NOLINTNEXTLINE(bugprone-macro-parentheses): a member's name */
#define FIELD(name) __typeof__(&lws_##name) name;
    FUNCTIONS(FIELD)
#undef FIELD
} lws_functions;

static lws_functions lib; /* null until loaded */

/* --- its memory --- */

static KNURL_THREAD_LOCAL websocket *calling; /* by this thread; null while the host itself calls libwebsockets */

static void *allocate(void *memory, size_t size, const char *reason) {
    (void)reason;
    return knurl_pool_realloc(calling ? &calling->pool : NULL, memory, size);
}

/* When this library is unloaded, the host may still use libwebsockets: restores the C library's realloc(), which
 * ignores the third argument. */
__attribute__((destructor)) static void give_back(void) {
    if (lib.set_allocator) {
        lib.set_allocator((void *(*)(void *, size_t, const char *))(void (*)(void))realloc);
    }
}

/* --- callbacks of libwebsockets --- */

static void take_part(websocket *w, const char *part, size_t size, int is_last) {
    const int at = w->coming;
    w->is_too_long |= size > KNURL_INVERSE3_LONGEST - w->sizes[at];
    if (!w->is_too_long) {
        memcpy(w->texts[at] + w->sizes[at], part, size);
        w->sizes[at] += size;
    }
    if (is_last) {
        w->sizes[at] = w->is_too_long ? 0 : w->sizes[at];
        w->is_too_long = 0;
        if (!w->filter.takes || w->filter.takes(w->filter.self, w->texts[at], w->sizes[at])) {
            w->coming = !at;
            w->count++;
        }
        w->sizes[w->coming] = 0;
    }
}

static int send_now(websocket *w) {
    const size_t size = w->out_size;
    w->out_size = 0;
    return size == 0 || lib.write(w->wsi, w->out + LWS_PRE, size, LWS_WRITE_TEXT) >= (int)size ? 0 : -1;
}

/* A result other than 0 closes the connection. */
static int on_event(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
    websocket *w = user;
    switch (reason) {
    case LWS_CALLBACK_CLIENT_ESTABLISHED:
        w->is_open = 1;
        break;
    case LWS_CALLBACK_CLIENT_RECEIVE:
        take_part(w, in, size, lib.is_final_fragment(wsi) && lib.remaining_packet_payload(wsi) == 0);
        break;
    case LWS_CALLBACK_CLIENT_WRITEABLE:
        return send_now(w);
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
        (void)snprintf(w->why, sizeof w->why, "%.*s", in ? (int)size : 0, in ? (const char *)in : "");
        w->is_gone = 1;
        break;
    case LWS_CALLBACK_CLIENT_CLOSED:
        w->is_gone = 1;
        break;
    default:
        break;
    }
    return 0;
}

static void on_timer(lws_sorted_usec_list_t *timer) {
    websocket *w = lws_container_of(timer, websocket, timer);
    w->is_late = 1;
    lib.cancel_service(w->context); /* lws_service() calls this and then waits for events as before */
}

/* --- a channel --- */

static void close_channel(void *self) {
    websocket *w = self;
    calling = w;
    if (w->context) {
        lib.context_destroy(w->context);
    }
    calling = NULL;
    free(w->texts[0]);
    free(w->texts[1]);
    free(w);
}

static int send_message(void *self, const char *text, size_t size) {
    websocket *w = self;
    if (w->is_gone || size > KNURL_INVERSE3_COMMAND) {
        return 0;
    }
    memcpy(w->out + LWS_PRE, text, size);
    w->out_size = size;
    calling = w;
    (void)lib.callback_on_writable(w->wsi);
    (void)lib.service(w->context, -1); /* without waiting */
    calling = NULL;
    const int has_left = w->out_size == 0 && !w->is_gone;
    w->out_size = 0; /* an old force must not be sent later */
    return has_left;
}

/* Handles events until `*until` is not 0, the connection is gone or the time is over. */
static void wait_for(websocket *w, const int *until, int64_t ns) {
    w->is_late = 0;
    calling = w;
    if (ns > 0) {
        lib.sul_schedule(w->context, 0, &w->timer, on_timer, ns / 1000);
        while (!*until && !w->is_gone && !w->is_late && lib.service(w->context, 0) >= 0) {}
        lib.sul_schedule(w->context, 0, &w->timer, on_timer, LWS_SET_TIMER_USEC_CANCEL);
    } else {
        (void)lib.service(w->context, -1);
    }
    calling = NULL;
}

static int receive(void *self, int milliseconds, knurl_inverse3_message *message) {
    websocket *w = self;
    if (w->count == 0 && !w->is_gone) {
        wait_for(w, &w->count, (int64_t)milliseconds * 1000000);
    }
    const int count = w->count;
    if (count == 0) {
        return w->is_gone ? -1 : 0;
    }
    message->text = w->texts[!w->coming];
    message->size = w->sizes[!w->coming];
    w->count = 0;
    return count;
}

/* libwebsockets makes the process ignore SIGPIPE, which is the host's decision. It is not needed, because sockets use
 * MSG_NOSIGNAL. */
static struct lws_context *make_context(const struct lws_context_creation_info *info) {
    struct sigaction was;
    const int is_known = sigaction(SIGPIPE, NULL, &was) == 0;
    struct lws_context *made = lib.create_context(info);
    if (is_known) {
        (void)sigaction(SIGPIPE, &was, NULL);
    }
    return made;
}

static int start(websocket *w, int port) {
    static const struct lws_protocols protocols[] = {{.name = "knurl", .callback = on_event, .rx_buffer_size = 16384},
                                                     {.name = NULL}};
    struct lws_context_creation_info info;
    struct lws_client_connect_info to;
    memset(&info, 0, sizeof info);
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.protocols = protocols;
    info.fd_limit_per_thread = FD_LIMIT;
    info.pt_serv_buf_size = 16384;
    info.http_proxy_address = ""; /* otherwise http_proxy and socks_proxy from the environment */
#if defined(LWS_WITH_SOCKS5)
    info.socks_proxy_address = "";
#endif
    w->texts[0] = malloc(KNURL_INVERSE3_LONGEST);
    w->texts[1] = malloc(KNURL_INVERSE3_LONGEST);
    calling = w;
    w->context = w->texts[0] && w->texts[1] ? make_context(&info) : NULL;
    if (!w->context) {
        calling = NULL;
        return 0;
    }
    memset(&to, 0, sizeof to);
    to.context = w->context;
    to.address = "127.0.0.1"; /* this machine only: a haptic loop does not tolerate a network's delays */
    to.port = port;
    to.path = "/";
    to.host = "localhost";
    to.ssl_connection = LCCSCF_HTTP_NO_FOLLOW_REDIRECT;
    to.local_protocol_name = "knurl";
    to.userdata = w;
    to.pwsi = &w->wsi;
    w->is_gone = !lib.client_connect_via_info(&to);
    wait_for(w, &w->is_open, CONNECT_NS);
    return w->is_open && !w->is_gone;
}

static int connect_to(void *user, int port, knurl_inverse3_filter filter, knurl_inverse3_channel *channel, char *why,
                      size_t why_size) {
    websocket *w = calloc(1, sizeof *w);
    (void)user;
    if (w) {
        w->filter = filter;
    }
    if (!w || !start(w, port)) {
        (void)snprintf(why, why_size, "%s", !w || !w->context ? "no memory" : w->why[0] ? w->why : "no answer");
        if (w) {
            close_channel(w);
        }
        return 0;
    }
    const knurl_inverse3_channel opened = {w, send_message, receive, close_channel};
    *channel = opened;
    return 1;
}

/* --- the library --- */

#define SONAME (12 + LWS_LIBRARY_VERSION_MAJOR + LWS_LIBRARY_VERSION_MINOR) /* 4.0 has 16, 4.1 17, 4.2 18, 4.3 19 */

static int load(char *why, size_t why_size) {
    char file[32];
    char version[16];
    const char *const files[] = {file};
    static uint32_t state;
#define FUNCTION(name) {"lws_" #name, &lib.name},
    static const knurl_dynlib_function functions[] = {FUNCTIONS(FUNCTION)};
#undef FUNCTION
    (void)snprintf(file, sizeof file, "libwebsockets.so.%d", SONAME);
    if (!knurl_dynlib_load(&state, files, 1, functions, sizeof functions / sizeof *functions, why, why_size)) {
        return 0;
    }
    (void)snprintf(version, sizeof version, "%d.%d.", LWS_LIBRARY_VERSION_MAJOR, LWS_LIBRARY_VERSION_MINOR);
    if (strncmp(lib.get_library_version(), version, strlen(version)) != 0) {
        (void)snprintf(why, why_size, "expected version %sx, found %.40s", version, lib.get_library_version());
        return 0;
    }
    lib.set_log_level(0, NULL); /* by default it writes to stderr */
    lib.set_allocator(allocate);
    return 1;
}

const knurl_inverse3_service *knurl_inverse3_websocket(char *why, size_t why_size) {
    static const knurl_inverse3_service service = {NULL, connect_to};
    char reason[256];
    if (load(reason, sizeof reason)) {
        return &service;
    }
    (void)snprintf(why, why_size, "libwebsockets cannot be loaded: %s; install it (Debian 12: libwebsockets17)",
                   reason);
    return NULL;
}

#endif
