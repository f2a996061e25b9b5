/* A view that is served, and viewers that watch it by libwebsockets. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_VIEW_RIG_H
#define KNURL_TEST_VIEW_RIG_H

#include "support/scenes.h"
#include "support/tool.h"

#include "knurl/tick_ring.h"
#include "knurl/view.h"

#include <libwebsockets.h>

#include <arpa/inet.h>
#include <signal.h>
#include <sys/socket.h>

#define PATIENCE_S 30.0

static knurl_scene *scene;
static view *served;
static int port;
static char path[64]; /* "/TOKEN/" */

static inline double now_s(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline void wait_ms(long ms) {
    const struct timespec t = {ms / 1000, ms % 1000 * 1000000};
    (void)nanosleep(&t, NULL);
}

static inline void serve_page(const char *page) {
    surface_parts plane = surface_plane();
    set_grating(&plane, KNURL_METHOD_S1, 700.0, 0.0, 0.0002);
    plane.desc.name = "a \"plate\"";
    scene = empty_scene(1);
    (void)add_surface(scene, &plane);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    write_text(tool_path("scene.glb"), "the scene");
    static char file[1024];
    (void)snprintf(file, sizeof file, "%s", tool_path("scene.glb"));
    char folder[1024]; /* the caller's, who may reuse it */
    (void)snprintf(folder, sizeof folder, "%s", page);
    const view_desc desc = {scene, file, folder, "a device", 1000.0};
    assert_int_equal(view_open(&desc, &served), 0);
    memset(folder, 'x', sizeof folder - 1);
    assert_memory_equal(view_url(served), "http://127.0.0.1:", 17);
    char *rest = NULL;
    port = (int)strtol(view_url(served) + 17, &rest, 10);
    (void)snprintf(path, sizeof path, "%.*s", (int)strcspn(rest, "#"), rest);
    assert_int_equal(strlen(path), 34); /* 128 bits */
}

static inline int serve(void **state) {
    (void)state;
    serve_page(tool_folder);
    return 0;
}

static inline int end(void **state) {
    (void)state;
    view_close(served);
    knurl_scene_destroy(scene);
    served = NULL;
    scene = NULL;
    return 0;
}

/* --- a viewer --- */

typedef struct watcher {
    struct lws_context *context;
    struct lws *wsi;
    int is_open, is_closed, says_something;
    char hello[1024];
    size_t rows;
    double first[VIEW_ROW], last[VIEW_ROW];
} watcher;

static inline int on_client(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
    watcher *w = lws_context_user(lws_get_context(wsi));
    (void)user;
    switch ((int)reason) {
    case LWS_CALLBACK_CLIENT_ESTABLISHED:
        w->is_open = 1;
        if (w->says_something) {
            (void)lws_callback_on_writable(wsi);
        }
        break;
    case LWS_CALLBACK_CLIENT_WRITEABLE: {
        unsigned char text[LWS_PRE + 8] = {0};
        memcpy(text + LWS_PRE, "rubbish", 7);
        return lws_write(wsi, text + LWS_PRE, 7, LWS_WRITE_TEXT) < 0;
    }
    case LWS_CALLBACK_CLIENT_RECEIVE:
        if (!lws_frame_is_binary(wsi)) {
            strncat(w->hello, in, size < sizeof w->hello - 1 - strlen(w->hello) ? size : 0);
        } else {
            assert_int_equal(size % sizeof w->last, 0);
            memcpy(w->rows == 0 ? w->first : w->last, in, sizeof w->first);
            memcpy(w->last, (char *)in + size - sizeof w->last, sizeof w->last);
            w->rows += size / sizeof w->last;
        }
        break;
    case LWS_CALLBACK_CLIENT_CONNECTION_ERROR:
    case LWS_CALLBACK_CLIENT_CLOSED:
        w->is_closed = 1;
        break;
    default:
        break;
    }
    return 0;
}

static inline void connect_as(watcher *w, const char *resource, const char *host, const char *origin) {
    static const struct lws_protocols protocols[] = {{"knurl", on_client, 0, 1 << 18, 0, NULL, 0}, {0}};
    struct lws_context_creation_info info;
    struct lws_client_connect_info to;
    char names[2][64];
    memset(&info, 0, sizeof info);
    info.port = CONTEXT_PORT_NO_LISTEN;
    info.protocols = protocols;
    info.user = w;
    w->context = lws_create_context(&info);
    assert_non_null(w->context);
    memset(&to, 0, sizeof to);
    (void)snprintf(names[0], sizeof names[0], host, port);
    (void)snprintf(names[1], sizeof names[1], origin, port);
    to.context = w->context;
    to.address = "127.0.0.1";
    to.port = port;
    to.path = resource;
    to.host = names[0];
    to.origin = origin[0] ? names[1] : NULL;
    to.protocol = "knurl";
    to.pwsi = &w->wsi;
    (void)lws_client_connect_via_info(&to);
}

static inline void watch(watcher *w) {
    char live[80];
    (void)snprintf(live, sizeof live, "%slive", path);
    connect_as(w, live, "127.0.0.1:%d", "127.0.0.1:%d");
}

#define SERVE_UNTIL(w, condition)                                                                                      \
    for (const double begin_ = now_s(); !(condition);) {                                                               \
        assert_true(now_s() - begin_ < PATIENCE_S);                                                                    \
        (void)lws_service((w)->context, -1); /* pending events */                                                      \
        wait_ms(1);                                                                                                    \
    }

static inline void leave(watcher *w) {
    lws_context_destroy(w->context);
}

static inline void take_ticks(uint64_t from, uint64_t count) {
    knurl_tick_output out;
    memset(&out, 0, sizeof out);
    for (uint64_t k = from; k < from + count; k++) {
        out.tick = k;
        out.force[1] = 0.5 * (double)k;
        out.surface = knurl_scene_get_surface(scene, 0);
        out.flags = KNURL_TICK_CONTACT;
        view_take(served, &out);
    }
}

#endif
