/* Serial ports with termios. SPDX-License-Identifier: MIT */
#include "device/rawhid/serial.h"

#if !defined(_WIN32)

#include "device/driver.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#define PORTS 10 /* /dev/ttyACM0 to 9 */

typedef struct tty {
    int descriptor;
} tty;

static int tty_write(void *self, const char *text, size_t size) {
    const tty *t = self;
    return write(t->descriptor, text, size) == (ssize_t)size;
}

/* A port that is gone polls as readable; read() then fails or returns 0. */
static int tty_read(void *self, char *text, size_t room, int milliseconds) {
    const tty *t = self;
    struct pollfd ready = {t->descriptor, POLLIN, 0};
    if (poll(&ready, 1, milliseconds) <= 0) {
        return 0;
    }
    const ssize_t got = read(t->descriptor, text, room);
    return got > 0 ? (int)got : got < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : -1;
}

static void tty_close(void *self) {
    tty *t = self;
    (void)close(t->descriptor);
    free(t);
}

/* Raw bytes in both directions; USB ignores the speed. */
static int set_raw(int descriptor) {
    struct termios settings;
    if (tcgetattr(descriptor, &settings)) {
        return 0;
    }
    settings.c_iflag = 0;
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL;
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    (void)cfsetispeed(&settings, B115200);
    (void)cfsetospeed(&settings, B115200);
    return tcsetattr(descriptor, TCSANOW, &settings) == 0 && tcflush(descriptor, TCIOFLUSH) == 0;
}

/* Locks a port against other programs that lock it, so that two do not drive the same motors. */
static int lock(int descriptor) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
        return 1;
    }
    errno = errno == EWOULDBLOCK ? EBUSY : errno;
    return 0;
}

static int tty_open(void *user, const char *path, knurl_serial_wire *wire, char *why, size_t why_size) {
    (void)user;
    tty *made = malloc(sizeof *made);
    if (!made) {
        (void)snprintf(why, why_size, "no memory");
        return 0;
    }
    made->descriptor = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (made->descriptor < 0 || !lock(made->descriptor) || !set_raw(made->descriptor)) {
        (void)snprintf(why, why_size, "%s%s", strerror(errno),
                       errno == EACCES   ? "; " KNURL_PERMISSION_ADVICE
                       : errno == EBUSY  ? "; end other programs that use it"
                       : errno == ENOTTY ? "; expected a serial port"
                                         : "");
        if (made->descriptor >= 0) {
            (void)close(made->descriptor);
        }
        free(made);
        return 0;
    }
    const knurl_serial_wire opened = {made, tty_write, tty_read, tty_close};
    *wire = opened;
    return 1;
}

/* Linux lists a port's USB device in /sys. */
static int tty_find(void *user, char *path, size_t size) {
    (void)user;
    for (int i = 0; i < PORTS; i++) {
        char name[64];
        char line[64] = "";
        unsigned vendor = 0;
        unsigned product = 0;
        (void)snprintf(name, sizeof name, "/sys/class/tty/ttyACM%d/device/uevent", i);
        FILE *file = fopen(name, "r");
        while (file && fgets(line, sizeof line, file)) {
            if (strncmp(line, "PRODUCT=", 8) == 0) {
                char *end = NULL;
                vendor = (unsigned)strtoul(line + 8, &end, 16);
                product = *end == '/' ? (unsigned)strtoul(end + 1, NULL, 16) : 0;
            }
        }
        if (file) {
            (void)fclose(file);
        }
        if (vendor == KNURL_SERIAL_VENDOR && product == KNURL_SERIAL_PRODUCT) {
            (void)snprintf(path, size, "/dev/ttyACM%d", i);
            return 1;
        }
    }
    return 0;
}

const knurl_serial_ports *knurl_serial_system(void) {
    static const knurl_serial_ports ports = {NULL, tty_find, tty_open};
    return &ports;
}

#endif
