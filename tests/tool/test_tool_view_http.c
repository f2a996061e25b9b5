/* `knurl run --view`: answers of its server. SPDX-License-Identifier: MIT */
#include "view_rig.h"

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

SUITE_FIXTURES(make_folder, remove_folder)
