/* The guard process. Descriptor 0: the socket to the host; 1: the device. It has no other descriptors, blocks signals,
 * and ends when the host ends.
 * SPDX-License-Identifier: MIT */
#include "base/guard_process.h"

#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

enum { HOST = 0, DEVICE = 1, FIRST_OTHER = 2 };

#define LAST_ZEROS 3 /* at the end, sent repeatedly in case one is lost */
#define TIMEOUT_MS 20

static void zero(knurl_guard_order *order) {
    if (order->endpoint) {
        struct usbdevfs_bulktransfer bulk;
        memset(&bulk, 0, sizeof bulk);
        bulk.ep = (unsigned)order->endpoint;
        bulk.len = order->size;
        bulk.timeout = TIMEOUT_MS;
        bulk.data = order->bytes;
        (void)ioctl(DEVICE, USBDEVFS_BULK, &bulk); /* the claim belongs to the open file, which the host shares */
    } else {
        (void)!write(DEVICE, order->bytes, order->size);
    }
}

static void close_others(void) {
#ifdef SYS_close_range
    if (syscall(SYS_close_range, FIRST_OTHER, ~0u, 0) == 0) {
        return;
    }
#endif
    for (int fd = FIRST_OTHER, end = (int)sysconf(_SC_OPEN_MAX); fd < end; fd++) {
        (void)close(fd);
    }
}

/* Forks, so that a host that waits for its children does not wait for the guard. Returns 1 in the guard. */
static int leave_host(void) {
    sigset_t all;
    struct sched_param priority;
    (void)sigfillset(&all);
    (void)sigprocmask(SIG_BLOCK, &all, NULL);
    (void)setsid(); /* away from the terminal's Ctrl-C and Ctrl-Z */
    if (fork() != 0) {
        return 0;
    }
    memset(&priority, 0, sizeof priority);
    priority.sched_priority = 71; /* one above the host's threads, if permitted */
    /* by number: musl's function always fails, and pthread_setschedparam() of glibc before 2.34 needs its library */
    (void)syscall(SYS_sched_setscheduler, 0, SCHED_FIFO, &priority);
    (void)prctl(PR_SET_NAME, "knurl-guard");
    (void)!chdir("/");
    return 1;
}

/* The host's last message; 0 if the host has ended. */
static uint8_t listen_to_host(void) {
    uint8_t word = KNURL_GUARD_ALIVE;
    ssize_t got = recv(HOST, &word, 1, 0);
    while (got == 1 && word != KNURL_GUARD_LEAVE && recv(HOST, &word, 1, MSG_DONTWAIT) == 1) {}
    return got == 1 ? word : 0;
}

static void watch(knurl_guard_order *order) {
    for (;;) {
        struct pollfd host = {HOST, POLLIN, 0};
        if (poll(&host, 1, KNURL_GUARD_SILENCE_MS) <= 0) {
            zero(order);
            continue;
        }
        const uint8_t word = listen_to_host();
        if (word == KNURL_GUARD_LEAVE) {
            return;
        }
        for (int i = 0; word == 0 && i < LAST_ZEROS; i++) {
            zero(order);
            (void)poll(NULL, 0, 2);
        }
        if (word == 0) {
            return;
        }
    }
}

int main(void) {
    knurl_guard_order order;
    close_others();
    if (!leave_host()) {
        return 0;
    }
    if (recv(HOST, &order, sizeof order, 0) == (ssize_t)sizeof order && order.size <= sizeof order.bytes &&
        send(HOST, "", 1, MSG_NOSIGNAL) == 1) {
        watch(&order);
    }
    return 0;
}
