/* The client of Haply's service connects only to this machine's port: it follows neither a redirect nor a proxy of the
 * environment. Over real sockets. SPDX-License-Identifier: MIT */
#include "support/close.h"

#include <arpa/inet.h>
#include <knurl/device.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <unistd.h>

/* A port of this machine. */
typedef struct listener {
    int descriptor, port;
} listener;

static listener listen_somewhere(void) {
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    socklen_t size = sizeof at;
    listener made = {socket(AF_INET, SOCK_STREAM, 0), 0};
    if (made.descriptor < 0) {
        fail_msg("no socket");
        return made;
    }
    assert_int_equal(bind(made.descriptor, (struct sockaddr *)&at, sizeof at), 0);
    assert_int_equal(listen(made.descriptor, 8), 0);
    assert_int_equal(getsockname(made.descriptor, (struct sockaddr *)&at, &size), 0);
    made.port = ntohs(at.sin_port);
    return made;
}

/* 1: a client has connected, or does within this time. */
static int has_caller(const listener *l, int ms) {
    struct pollfd ready = {l->descriptor, POLLIN, 0};
    return poll(&ready, 1, ms) > 0;
}

static struct {
    listener here, elsewhere;
    const char *location; /* a format for a port; null: answers nothing */
    int calls;            /* at the right port */
} it;

/* Redirects one caller. */
static void *answer(void *nothing) {
    char text[1024];
    (void)nothing;
    if (!has_caller(&it.here, 1500)) {
        return NULL;
    }
    const int caller = accept(it.here.descriptor, NULL, NULL);
    it.calls++;
    if (it.location && read(caller, text, sizeof text) > 0) {
        int length = snprintf(text, sizeof text, "HTTP/1.1 302 Found\r\nContent-Length: 0\r\nLocation: ");
        length += snprintf(text + length, 256, "%s%d/\r\n\r\n", it.location, it.elsewhere.port);
        (void)(write(caller, text, (size_t)length) == length);
    }
    (void)has_caller(&it.elsewhere, 1200);
    (void)close(caller);
    return NULL;
}

/* 1: the client followed. */
static int goes_elsewhere(const char *location) {
    char uri[64];
    pthread_t thread;
    knurl_device *device = NULL;
    it.here = listen_somewhere();
    it.elsewhere = listen_somewhere();
    it.location = location;
    it.calls = 0;
    assert_int_equal(pthread_create(&thread, NULL, answer, NULL), 0);
    (void)snprintf(uri, sizeof uri, "inverse3:?port=%d", it.here.port);
    CHECK_REFUSED(knurl_device_open(uri, &device), KNURL_ERROR_DEVICE_LOST, device);
    check_message("does not answer at localhost:");
    const int went = has_caller(&it.elsewhere, 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    (void)close(it.here.descriptor);
    (void)close(it.elsewhere.descriptor);
    return went;
}

TEST(a_redirect_is_not_followed) {
    assert_int_equal(goes_elsewhere("http://127.0.0.1:"), 0);
    assert_int_equal(it.calls, 1);
}

TEST(a_proxy_of_the_environment_is_not_used) {
    static const char *const names[] = {"http_proxy", "socks_proxy"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        char where[32];
        const listener proxy = listen_somewhere();
        (void)snprintf(where, sizeof where, "127.0.0.1:%d", proxy.port);
        assert_int_equal(setenv(names[i], where, 1), 0);
        (void)goes_elsewhere(NULL);
        assert_int_equal(unsetenv(names[i]), 0);
        const int is_asked = has_caller(&proxy, 0);
        (void)close(proxy.descriptor);
        if (is_asked || it.calls != 1) {
            fail_msg("%s: %d calls to the service, %s proxy", names[i], it.calls,
                     is_asked ? "and one to the" : "none to a");
        }
    }
}
