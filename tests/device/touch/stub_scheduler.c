/* The stub library's scheduler: a thread that calls scheduled callbacks, or manual turns. SPDX-License-Identifier: MIT
 */
#include "stub_state.h"

#define STACK_BYTES ((size_t)256 * 1024)

/* Calls every callback once, then advances time. */
static void turn(void) {
    lock();
    hd.errors_taken = 0;
    const hd_callback asked = hd.asked;
    void *asked_user = hd.asked_user;
    unlock();
    if (asked) {
        (void)asked(asked_user);
        lock();
        hd.asked = NULL;
        unlock();
    }
    for (int i = 0; i < LIST; i++) {
        lock();
        const hd_callback callback = hd.list[i].callback;
        void *user = hd.list[i].user;
        const unsigned long number = hd.list[i].number;
        unlock();
        if (callback && callback(user) == HD_DONE) {
            lock();
            if (hd.list[i].number == number) {
                hd.list[i].callback = NULL;
                hd.list[i].number = 0;
            }
            unlock();
        }
    }
    lock();
    hd.answers[STUB_ERRORS_TAKEN] = fmax(hd.answers[STUB_ERRORS_TAKEN], (double)hd.errors_taken);
    for (int i = 0; i < STUB_DEVICES; i++) {
        if (hd.devices[i].answers[STUB_INITIALISED] > 0.0) {
            stub_move(&hd.devices[i], 1.0 / hd.rate);
        }
    }
    unlock();
}

static void run(void *nothing) {
    int64_t next = now_ns();
    (void)nothing;
    lock();
    hd.thread_id = knurl_system_thread_id();
    unlock();
    for (;;) {
        lock();
        const int stops = hd.stops;
        const int calls = hd.settings[STUB_STALL] == 0.0 && hd.settings[STUB_BY_HAND] == 0.0;
        const double rate = hd.rate;
        unlock();
        if (stops) {
            return;
        }
        if (calls) {
            turn();
        }
        next += (int64_t)(1e9 / rate);
        const int64_t now = now_ns();
        next = now > next + 100000000 ? now : next;
        hd.time.sleep_until_ns(next);
    }
}

void HD_CALL hdStartScheduler(void) {
    lock();
    hd.answers[STUB_STARTS]++;
    if (hd.runs) {
        misuse(0x0304);
    } else {
        hd.stops = 0;
        hd.thread = hd.time.start_thread(run, NULL, STACK_BYTES);
        hd.runs = hd.thread != NULL;
    }
    unlock();
}

void HD_CALL hdStopScheduler(void) {
    lock();
    const int ran = hd.runs;
    hd.stops = 1;
    hd.runs = 0;
    if (!ran) {
        misuse(0x0102);
    }
    unlock();
    if (ran) {
        hd.time.join_thread(hd.thread);
    }
}

void HD_CALL hdSetSchedulerRate(unsigned long rate) {
    lock();
    if (hd.settings[STUB_RATE_ERROR] > 0.0) {
        push((uint32_t)hd.settings[STUB_RATE_ERROR], hd.current);
    } else if (rate < 100 || rate > 4000 || (double)rate == hd.settings[STUB_REFUSED_RATE]) {
        push(0x0101, hd.current);
    } else {
        hd.rate = (double)rate;
    }
    unlock();
}

hd_scheduler_code HD_CALL hdScheduleAsynchronous(hd_callback callback, void *user, unsigned short priority) {
    unsigned long number = 0;
    (void)priority;
    lock();
    for (int i = 0; i < LIST && !number; i++) {
        if (!hd.list[i].callback) {
            hd.list[i].callback = callback;
            hd.list[i].user = user;
            hd.list[i].number = number = ++hd.last_number;
        }
    }
    if (!number) {
        push(0x0501, hd.current);
    }
    unlock();
    return number;
}

/* With the lock, which it gives back meanwhile: time for others. */
static void wait_a_little(void) {
    unlock();
    nap(50000);
    lock();
}

/* Manual turns are sequential anyway. */
void HD_CALL hdScheduleSynchronous(hd_callback callback, void *user, unsigned short priority) {
    (void)priority;
    lock();
    const int by_hand = hd.settings[STUB_BY_HAND] > 0.0;
    if (!hd.runs) {
        misuse(0x0102);
    }
    while (hd.runs && !by_hand && hd.asked) { /* one at a time */
        wait_a_little();
    }
    if (hd.runs && !by_hand) {
        hd.asked = callback;
        hd.asked_user = user;
        while (hd.asked == callback && hd.runs) {
            wait_a_little();
        }
        unlock();
    } else {
        unlock();
        (void)callback(user);
    }
}

void HD_CALL hdUnschedule(hd_scheduler_code what) {
    int found = 0;
    lock();
    for (int i = 0; i < LIST && what; i++) {
        if (hd.list[i].number == what) {
            hd.list[i].callback = NULL;
            hd.list[i].number = 0;
            found = 1;
        }
    }
    if (!found) {
        misuse(0x0101);
    }
    unlock();
}

static void turn_in_thread(void *turns) {
    for (uint64_t i = *(const uint64_t *)turns; i > 0; i--) {
        turn();
    }
}

/* Runs in another thread, like a scheduler's, and waits for it. */
void stub_turn(uint64_t turns) {
    knurl_thread *thread = hd.time.start_thread(turn_in_thread, &turns, STACK_BYTES);
    if (thread) {
        hd.time.join_thread(thread);
    }
}
