/* `knurl run --view`: access, a viewer's data, and no delays of ticks by viewers. The client also uses libwebsockets.
 * SPDX-License-Identifier: MIT */
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

static double now_s(void) {
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void wait_ms(long ms) {
    const struct timespec t = {ms / 1000, ms % 1000 * 1000000};
    (void)nanosleep(&t, NULL);
}

static void serve_page(const char *page) {
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

static int serve(void **state) {
    (void)state;
    serve_page(tool_folder);
    return 0;
}

static int end(void **state) {
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

static int on_client(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
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

static void connect_as(watcher *w, const char *resource, const char *host, const char *origin) {
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

static void watch(watcher *w) {
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

static void leave(watcher *w) {
    lws_context_destroy(w->context);
}

static void take_ticks(uint64_t from, uint64_t count) {
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

TEST_WITH(a_viewer_gets_the_surfaces_and_then_each_tick, serve, end) {
    watcher w = {0};
    watch(&w);
    SERVE_UNTIL(&w, w.hello[0]);
    assert_non_null(strstr(w.hello, "\"file\": \"scene.glb\""));
    assert_non_null(strstr(w.hello, "\"name\": \"a \\\"plate\\\"\", \"feel\": [700, 0, 0.0002, 400, 0, 1]"));
    take_ticks(0, 1500);
    SERVE_UNTIL(&w, w.rows == 1500);
    CHECK_SAME(w.first[16], 0.0);
    CHECK_SAME(w.last[1], 0.5 * 1499.0);
    CHECK_SAME(w.last[14], 1.0);
    CHECK_SAME(w.last[15], 0.0);
    CHECK_CLOSE(w.last[16], 1.499, 1e-12);
    leave(&w);
}

TEST_WITH(two_viewers_get_the_same, serve, end) {
    watcher both[2] = {{0}, {0}};
    for (int i = 0; i < 2; i++) {
        watch(&both[i]);
        SERVE_UNTIL(&both[i], both[i].hello[0]);
    }
    take_ticks(0, 100);
    for (int i = 0; i < 2; i++) {
        SERVE_UNTIL(&both[i], both[i].rows == 100);
        leave(&both[i]);
    }
}

TEST_WITH(another_token_origin_or_host_is_refused, serve, end) {
    char wrong[80];
    char right[80];
    (void)snprintf(right, sizeof right, "%slive", path);
    (void)snprintf(wrong, sizeof wrong, "%slive", path);
    wrong[5] = wrong[5] == '0' ? '1' : '0';
    const struct {
        const char *path, *host, *origin; /* http:// is put before it */
    } attempts[] = {{wrong, "127.0.0.1:%d", "127.0.0.1:%d"},    {"/live", "127.0.0.1:%d", "127.0.0.1:%d"},
                    {right, "evil.example:%d", "127.0.0.1:%d"}, {right, "127.0.0.1:%d", "evil.example:%d"},
                    {right, "127.0.0.1:%d", "127.0.0.1:%d0"},   {right, "127.0.0.1:%d", ""}};
    for (size_t i = 0; i < COUNT_OF(attempts); i++) {
        watcher w = {0};
        connect_as(&w, attempts[i].path, attempts[i].host, attempts[i].origin);
        SERVE_UNTIL(&w, w.is_closed);
        assert_int_equal(w.is_open, 0);
        leave(&w);
    }
}

TEST_WITH(a_viewer_that_sends_anything_is_disconnected, serve, end) {
    watcher w = {.says_something = 1};
    watch(&w);
    SERVE_UNTIL(&w, w.is_closed);
    assert_int_equal(w.is_open, 1);
    leave(&w);
}

/* Its sockets fill up: it misses ticks, and a later viewer still gets the newest ones. */
TEST_WITH(a_stalled_viewer_delays_nobody, serve, end) {
    watcher stalled = {0};
    watcher other = {0};
    const uint64_t flood = 100000; /* 18 MB */
    watch(&stalled);
    SERVE_UNTIL(&stalled, stalled.hello[0]);
    for (uint64_t k = 0; k < flood; k += 2000) {
        take_ticks(k, 2000);
        wait_ms(18); /* as long as the server collects ticks for */
    }
    watch(&other);
    SERVE_UNTIL(&other, other.hello[0]);
    take_ticks(flood, 50);
    SERVE_UNTIL(&other, other.rows == 50);
    CHECK_CLOSE(other.last[16], 1e-3 * (double)(flood + 49), 1e-9);
    SERVE_UNTIL(&stalled, stalled.last[16] > 1e-3 * (double)(flood + 48));
    assert_true(stalled.rows < flood);
    leave(&other);
    leave(&stalled);
}

/* libwebsockets has the process ignore it. */
TEST(the_processs_handling_of_SIGPIPE_is_unchanged) {
    void (*const was)(int) = signal(SIGPIPE, SIG_DFL);
    (void)serve(state);
    void (*const now)(int) = signal(SIGPIPE, was);
    (void)end(state);
    assert_true(now == SIG_DFL);
}

static int send_count; /* atomic */

/* Instead of the C library's, for libwebsockets, too. */
__attribute__((visibility("default"))) ssize_t send(int fd, const void *bytes, size_t size, int flags) {
    __atomic_add_fetch(&send_count, 1, __ATOMIC_RELAXED);
    return sendto(fd, bytes, size, flags, NULL, 0);
}

/* In pieces of 256 bytes, as by default, each viewer costs 2000 system calls a second. */
TEST_WITH(the_kernel_gets_a_message_in_one_piece, serve, end) {
    watcher w = {0};
    watch(&w);
    SERVE_UNTIL(&w, w.hello[0]);
    const int before = __atomic_load_n(&send_count, __ATOMIC_RELAXED);
    take_ticks(0, 500); /* 92 kB */
    SERVE_UNTIL(&w, w.rows == 500);
    assert_in_range(__atomic_load_n(&send_count, __ATOMIC_RELAXED) - before, 1, 10);
    leave(&w);
}

TEST(a_full_ring_drops_ticks_and_counts_them) {
    tick_ring ring;
    knurl_tick_output out;
    memset(&out, 0, sizeof out);
    assert_int_equal(tick_ring_create(&ring), 0);
    for (uint64_t k = 0; k < TICK_RING_ROWS + 10; k++) {
        out.tick = k;
        tick_ring_put(&ring, &out);
    }
    assert_int_equal(ring.lost, 10);
    for (uint64_t k = 0; k < TICK_RING_ROWS; k++) {
        assert_int_equal(tick_ring_first(&ring)->tick, k);
        tick_ring_drop(&ring);
    }
    assert_null(tick_ring_first(&ring));
    tick_ring_destroy(&ring);
}

/* --- HTTP --- */

static int connected_socket(void) {
    struct sockaddr_in to;
    memset(&to, 0, sizeof to);
    to.sin_family = AF_INET;
    to.sin_port = htons((uint16_t)port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int s = socket(AF_INET, SOCK_STREAM, 0);
    if (s < 0) {
        fail_msg("no socket");
        return -1;
    }
    assert_int_equal(connect(s, (struct sockaddr *)&to, sizeof to), 0);
    return s;
}

/* The answer to a request, up to the connection's end. */
static const char *ask(const char *request) {
    static char answer[8192];
    const struct timeval patience = {2, 0};
    size_t size = 0;
    const int s = connected_socket();
    (void)setsockopt(s, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    (void)send(s, request, strlen(request), MSG_NOSIGNAL);
    for (ssize_t got = 1; got > 0 && size < sizeof answer - 1; size += got > 0 ? (size_t)got : 0) {
        got = recv(s, answer + size, sizeof answer - 1 - size, 0);
    }
    answer[size] = '\0';
    (void)close(s);
    return answer;
}

static const char *get(const char *resource, const char *host) {
    char request[256];
    (void)snprintf(request, sizeof request, "GET %s HTTP/1.1\r\nHost: %s:%d\r\nConnection: close\r\n\r\n", resource,
                   host, port);
    return ask(request);
}

static const char *get_below(const char *name) {
    char resource[96];
    (void)snprintf(resource, sizeof resource, "%s%s", path, name);
    return get(resource, "127.0.0.1");
}

/** It starts with this status, which may be cut short ("40"), and holds the text. */
static void check_answer(const char *answer, const char *status, const char *text) {
    char line[32];
    (void)snprintf(line, sizeof line, "HTTP/1.1 %s", status);
    if (strncmp(answer, line, strlen(line)) != 0 || !strstr(answer, text)) {
        fail_msg("expected %s with '%s', found: %s", status, text, answer);
    }
}

TEST_WITH(only_the_page_and_the_scene_are_served, serve, end) {
    write_text(tool_path("index.html"), "the page");
    write_text(tool_path("main.js"), "the script");
    write_text(tool_path("secret.txt"), "a secret");
    check_answer(get_below(""), "200", "the page");
    check_answer(get_below("main.js"), "200", "the script");
    check_answer(get_below("scene"), "200", "the scene");
    check_answer(get_below("secret.txt"), "404", "no such file");
    check_answer(get_below("../secret.txt"), "403", "");
    check_answer(get_below("%2e%2e/secret.txt"), "40", "");
    check_answer(get("/", "127.0.0.1"), "403", "not the URL");
    check_answer(get("/index.html", "127.0.0.1"), "403", "not the URL");
    check_answer(get(path, "evil.example"), "403", "not the URL");
    check_answer(get(path, "localhost"), "200", "the page");
    (void)remove(tool_path("index.html"));
    check_answer(get_below(""), "404", "./run web");
}

/* Connections without the token are closed in favour of later ones. */
TEST_WITH(requests_that_never_end_delay_nobody, serve, end) {
    static const char *const beginnings[] = {"", "GET ", "GET / HTTP/1.1\r\nHost: 127",
                                             "GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"};
    int sockets[60];
    watcher early = {0};
    watcher late = {0};
    watch(&early);
    SERVE_UNTIL(&early, early.hello[0]);
    for (size_t i = 0; i < COUNT_OF(sockets); i++) {
        const char *beginning = beginnings[i % COUNT_OF(beginnings)];
        sockets[i] = connected_socket();
        (void)send(sockets[i], beginning, strlen(beginning), MSG_NOSIGNAL);
    }
    const double begin = now_s();
    check_answer(get_below("scene"), "200", "the scene");
    watch(&late);
    SERVE_UNTIL(&late, late.hello[0]);
    assert_true(now_s() - begin < 1.0);
    take_ticks(0, 10);
    SERVE_UNTIL(&early, early.rows == 10);
    for (size_t i = 0; i < COUNT_OF(sockets); i++) {
        (void)close(sockets[i]);
    }
    leave(&late);
    leave(&early);
}

TEST_WITH(every_answer_keeps_browsers_from_other_hosts_and_from_guessing_types, serve, end) {
    static const char *const headers[] = {
        "x-content-type-options: nosniff\r\n",
        "referrer-policy: no-referrer\r\n",
        "cache-control: no-store\r\n",
        "content-security-policy: default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:;",
        "connect-src 'self' data: blob: ws://127.0.0.1:",
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n"};
    write_text(tool_path("index.html"), "the page");
    const struct {
        const char *name, *status;
    } asked[] = {{"", "200"}, {"scene", "200"}, {"gone.txt", "404"}};
    for (size_t i = 0; i < COUNT_OF(asked); i++) {
        for (size_t h = 0; h < COUNT_OF(headers); h++) {
            check_answer(get_below(asked[i].name), asked[i].status, headers[h]);
            check_answer(get("/", "127.0.0.1"), "403", headers[h]);
        }
    }
    (void)remove(tool_path("index.html"));
}

TEST_WITH(rubbish_instead_of_http_ends_its_own_connection, serve, end) {
    (void)ask("\x16\x03\x01\xff rubbish\r\n\r\n");
    (void)ask("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n");
    check_answer(get_below("scene"), "200", "the scene");
}

TEST_WITH(frames_that_are_none_end_their_own_connection, serve, end) {
    char request[512];
    watcher w = {0};
    watch(&w);
    SERVE_UNTIL(&w, w.hello[0]);
    (void)snprintf(request, sizeof request,
                   "GET %slive HTTP/1.1\r\nHost: 127.0.0.1:%d\r\nOrigin: http://127.0.0.1:%d\r\nUpgrade: websocket\r\n"
                   "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
                   "Sec-WebSocket-Protocol: knurl\r\n\r\n\xff\xff\xff\xff\xff\xff\xff\xff\xff rubbish",
                   path, port, port);
    const double begin = now_s();
    check_answer(ask(request), "101", "");
    assert_true(now_s() - begin < 1.9); /* not until ask() gave up */
    take_ticks(0, 10);
    SERVE_UNTIL(&w, w.rows == 10);
    leave(&w);
}

TEST(the_tool_says_where_to_look) {
    const char plate[] = KNURL_TEST_ASSETS "/plate_1d.glb";
    process p = RUN_TOOL("run", plate, "--view", "--seconds", "0.3");
    check_done(&p);
    assert_non_null(strstr(p.err, "open http://127.0.0.1:"));
    process_free(&p);
    p = RUN_TOOL("run", plate, "--view", "--fast");
    check_refused(&p, 2, "--view or --fast", "both");
}

SUITE_FIXTURES(make_folder, remove_folder)
