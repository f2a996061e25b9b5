/* emulate_serial LINK -- COMMAND...: runs COMMAND while the path LINK leads to a pseudo terminal behind which is an
 * emulated WoodenHaptics with the Teensy 4.0 firmware, whose hand strokes along x, 1 mm below y = 0 at the middle of
 * its workspace. Exits with COMMAND's code. SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include "device/rawhid/serial_sim.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double seconds(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Answers complete lines; returns the number of bytes of an incomplete one. */
static size_t answer(hid_sim *sim, int terminal, char *text, size_t count) {
    text[count] = '\0';
    for (char *end = strchr(text, ']'); end; end = strchr(text, ']')) {
        char said[128];
        end[0] = '\0';
        char line[SERIAL_SIM_LINE + 1];
        (void)snprintf(line, sizeof line, "%.120s]", text);
        const int length = serial_sim_hear(sim, seconds(), line, said, sizeof said);
        (void)!write(terminal, said, (size_t)length);
        count -= (size_t)(end + 1 - text);
        memmove(text, end + 1, count + 1);
    }
    return count;
}

static void serve(hid_sim *sim, int terminal, pid_t child, int *status) {
    char text[1024];
    size_t count = 0;
    while (waitpid(child, status, WNOHANG) == 0) {
        struct pollfd ready = {terminal, POLLIN, 0};
        if (poll(&ready, 1, 20) > 0 && (ready.revents & POLLIN)) {
            const ssize_t got = read(terminal, text + count, sizeof text - 1 - count);
            count = got > 0 ? answer(sim, terminal, text, count + (size_t)got) : count;
        }
    }
}

int main(int argc, char **argv) {
    hid_sim sim;
    knurl_stroke_desc stroke;
    int status = 0;
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    if (argc < 4 || strcmp(argv[2], "--") != 0 || terminal < 0 || grantpt(terminal) || unlockpt(terminal)) {
        (void)fprintf(stderr, "usage: %s LINK -- COMMAND...\n", argv[0]);
        return 2;
    }
    const int kept = open(ptsname(terminal), O_RDWR | O_NOCTTY); /* keeps the terminal open between two commands */
    (void)unlink(argv[1]);
    if (kept < 0 || symlink(ptsname(terminal), argv[1])) {
        perror(argv[1]);
        return 2;
    }
    knurl_stroke_desc_init(&stroke, sizeof stroke);
    (void)knurl_stroke_check(&stroke); /* the default is right; this resolves its speed */
    serial_sim_init(&sim, &stroke);
    sim.time = sim.heard_at = sim.limp_from = seconds();
    const pid_t child = fork();
    if (child == 0) {
        (void)execvp(argv[3], argv + 3);
        perror(argv[3]);
        _exit(127);
    }
    serve(&sim, terminal, child, &status);
    (void)unlink(argv[1]);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}
