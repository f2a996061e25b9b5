/* emulate_inverse3 FAULT COMMAND...: runs COMMAND with PORT in its arguments replaced by the port of an emulated Haply
 * Inverse Service on this machine, and exits with its code. The hand strokes along x, 1 mm below y = 0 at the middle of
 * the workspace. FAULT happens 0.1 s after a client has connected, FAULT@SECONDS so much later: none, unplugged,
 * unpowered, unhomed (not calibrated), unready, closed (the service ends), mute, late (20 ms), garbage, short (half a
 * message), long (70 KB), endless (a position that is not finite), jump (by 50 mm). Others apply from the start: old
 * (before 3.5), silent (no first message), strange (a first message that is not JSON), two (another device is listed
 * first). With KNURL_EMULATOR_LOG in its environment it prints every 20 ms what it was told.
 * SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include "device/inverse3/inverse3_sim.h"

#include "base/vec3.h"

#include <libwebsockets.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#define LONG_BYTES 70000
#define LOG_EVERY  20000 /* us */

static struct {
    inverse3_sim sim;
    char fault[32];
    double fault_after;  /* s after a client has connected */
    double connected_at; /* s */
    double zero_since;   /* s: since when the force that it is told is zero; < 0: it is not */
    double greatest;     /* N that it was told */
    int is_greeted;
    unsigned unanswered, heard_count;
    int said_size;
    unsigned char said[LWS_PRE + LONG_BYTES]; /* the newest answer */
} e;

static double seconds(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int is_fault(const char *name) {
    const int begins = strcmp(name, "silent") == 0 || strcmp(name, "strange") == 0;
    return strcmp(e.fault, name) == 0 && (begins || (e.is_greeted && seconds() - e.connected_at > e.fault_after));
}

static void note_force(void) {
    const double force = vec3_length(e.sim.told);
    e.heard_count++;
    e.greatest = fmax(e.greatest, force);
    e.zero_since = force > 0.0 ? -1.0 : e.zero_since >= 0.0 ? e.zero_since : seconds();
}

/* s since the client connected, messages, N told now and at most, N that rose in a message at most, N told while its
 * motors were off, s at which the force became zero. */
static void print_log(void) {
    (void)fprintf(stderr, "%.3f %u %.6f %.6f %.6f %d %.4f\n", seconds() - e.connected_at, e.heard_count,
                  vec3_length(e.sim.told), e.greatest, e.sim.greatest_rise, e.sim.told_while_off,
                  e.zero_since < 0.0 ? -1.0 : e.zero_since - e.connected_at);
}

static void hear(const char *in, size_t size) {
    char message[4096];
    const size_t kept = size < sizeof message ? size : 0;
    memcpy(message, in, kept);
    message[kept] = '\0';
    e.said_size = inverse3_sim_hear(&e.sim, seconds(), message, (char *)e.said + LWS_PRE);
    e.unanswered++;
    note_force();
}

/* One answer, or the first message; -1 closes the connection. */
static int say(struct lws *wsi) {
    char *text = (char *)e.said + LWS_PRE;
    int length = e.said_size;
    if (e.is_greeted) {
        e.unanswered--;
    } else if (is_fault("strange")) {
        length = snprintf(text, 64, "hello, this is another program's");
    } else {
        length = inverse3_sim_greet(&e.sim, seconds(), text);
    }
    e.is_greeted = 1;
    if (is_fault("late")) {
        (void)usleep(20000);
    } else if (is_fault("garbage")) {
        memset(text, '}', (size_t)length);
    } else if (is_fault("short")) {
        length /= 2;
    } else if (is_fault("long")) {
        memset(text + length, ' ', LONG_BYTES - (size_t)length);
        length = LONG_BYTES;
    }
    return lws_write(wsi, e.said + LWS_PRE, (size_t)length, LWS_WRITE_TEXT) < length ? -1 : 0;
}

static int on_event(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in, size_t size) {
    (void)user;
    switch (reason) {
    case LWS_CALLBACK_ESTABLISHED:
        e.connected_at = seconds();
        e.is_greeted = 0;
        e.unanswered = 0;
        if (!is_fault("silent")) {
            (void)lws_callback_on_writable(wsi);
        }
        break;
    case LWS_CALLBACK_RECEIVE:
        hear(in, size);
        if (is_fault("unplugged") && !e.sim.is_gone) {
            inverse3_sim_unplug(&e.sim, seconds());
        }
        if (is_fault("unpowered") && !e.sim.is_unpowered) {
            inverse3_sim_power(&e.sim, seconds(), 0);
        }
        e.sim.is_endless = is_fault("endless");
        e.sim.is_unhomed = is_fault("unhomed");
        e.sim.is_not_ready = is_fault("unready");
        e.sim.jump = is_fault("jump") ? 0.05 : 0.0;
        if (is_fault("closed")) {
            return -1;
        }
        if (!is_fault("mute")) {
            (void)lws_callback_on_writable(wsi);
        }
        break;
    case LWS_CALLBACK_SERVER_WRITEABLE:
        if (say(wsi)) {
            return -1;
        }
        if (e.unanswered > 0) {
            (void)lws_callback_on_writable(wsi);
        }
        break;
    default:
        break;
    }
    return 0;
}

static struct lws_context *serve(int *port) {
    static const struct lws_protocols protocols[] = {{.name = "emulated", .callback = on_event, .rx_buffer_size = 4096},
                                                     {.name = NULL}};
    struct lws_context_creation_info info;
    memset(&info, 0, sizeof info);
    info.port = 0; /* one that is free */
    info.iface = "lo";
    info.protocols = protocols;
    info.fd_limit_per_thread = 64;
    info.options = LWS_SERVER_OPTION_EXPLICIT_VHOSTS;
    lws_set_log_level(LLL_ERR, NULL);
    struct lws_context *made = lws_create_context(&info);
    struct lws_vhost *vhost = made ? lws_create_vhost(made, &info) : NULL;
    *port = vhost ? lws_get_vhost_listen_port(vhost) : 0;
    return made;
}

/* Replaces the first PORT in each argument. */
static void run(char **arguments, int port) {
    for (char **argument = arguments; *argument; argument++) {
        const char *at = strstr(*argument, "PORT");
        char *made = NULL;
        if (at && asprintf(&made, "%.*s%d%s", (int)(at - *argument), *argument, port, at + 4) > 0) {
            *argument = made;
        }
    }
    if (*arguments) {
        (void)execvp(*arguments, arguments);
    }
    perror("emulate_inverse3: the command cannot be run");
    _exit(127);
}

static lws_sorted_usec_list_t timer;

static struct lws_context *context;

/* Wakes the loop, which checks its child. */
static void on_timer(lws_sorted_usec_list_t *at) {
    (void)at;
    lws_cancel_service(context);
}

int main(int argc, char **argv) {
    int port = 0;
    int status = 0;
    double logged_at = 0.0;
    if (argc < 3) {
        (void)fprintf(stderr, "usage: %s FAULT COMMAND...\n", argv[0]);
        return 2;
    }
    e.fault_after = 0.1;
    e.zero_since = 0.0;
    /* NOLINTNEXTLINE(bugprone-unchecked-string-to-number-conversion,cert-err34-c): tests' locale */
    (void)sscanf(argv[1], "%31[^@]@%lf", e.fault, &e.fault_after);
    inverse3_sim_init(&e.sim, seconds(), 1);
    e.sim.is_old = strcmp(e.fault, "old") == 0;
    e.sim.has_second = strcmp(e.fault, "two") == 0;
    context = serve(&port);
    if (port <= 0) {
        (void)fprintf(stderr, "%s: no port\n", argv[0]);
        return 2;
    }
    const pid_t child = fork();
    if (child == 0) {
        run(argv + 2, port);
    }
    while (waitpid(child, &status, WNOHANG) == 0) {
        lws_sul_schedule(context, 0, &timer, on_timer, LOG_EVERY);
        (void)lws_service(context, 0);
        if (getenv("KNURL_EMULATOR_LOG") && e.connected_at > 0.0 && seconds() - logged_at >= 1e-6 * LOG_EVERY) {
            logged_at = seconds();
            print_log();
        }
    }
    lws_context_destroy(context);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}
