/* The table of faults: every device's double, every fault that it can have, and the loop's own, in real loops on
 * virtual time. Asserts the events, zero force within 5 ms of the event, and the return of the force.
 * SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE 1

#include "functions_double.h"
#include "table.h"

#include "device/core/home.h"
#include "device/doubles.h"

#include <knurl/loop.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define ROOM 128

static row rows[ROOM];
static int row_count;

/* ms after an event within which there must be no force. */
#define BOUND 5.0

/* Expectations for a fault on any device. A pulled cable cuts the host off: then the firmware's own behaviour counts.
 */
static const struct {
    const char *text;
    int32_t codes[3]; /* one of these must come; 0: no event may come */
} faults[DOUBLE_FAULT_COUNT] = {
    [DOUBLE_UNPLUG] = {"unplugged", {KNURL_FAULT_LOST}},
    [DOUBLE_MUTE] = {"takes all, never answers", {KNURL_FAULT_SILENT, KNURL_FAULT_LOST}},
    [DOUBLE_HANG] = {"transfers block", {KNURL_FAULT_SILENT, KNURL_FAULT_LOST}},
    [DOUBLE_LATE] = {"answers 20 ms late", {KNURL_FAULT_SILENT, KNURL_FAULT_LATE}},
    [DOUBLE_SHORT] = {"answers cut off", {KNURL_FAULT_CORRUPT, KNURL_FAULT_SILENT}},
    [DOUBLE_SPLIT] = {"answers in pieces", {0}},
    [DOUBLE_CORRUPT] = {"random bytes", {KNURL_FAULT_CORRUPT, KNURL_FAULT_SILENT, KNURL_FAULT_JUMP}},
    [DOUBLE_NAN] = {"position not finite", {KNURL_FAULT_NOT_FINITE, KNURL_FAULT_CORRUPT}},
    [DOUBLE_JUMP] = {"position jumps 50 mm, for good", {KNURL_FAULT_JUMP}},
    [DOUBLE_REFUSE] = {"refuses the force", {KNURL_FAULT_REFUSED}},
    [DOUBLE_UNHOMED] = {"has lost its place", {KNURL_FAULT_UNCALIBRATED}},
    [DOUBLE_OFF] = {"switches its forces off", {KNURL_FAULT_FORCE_OFF}},
};

/* --- a try --- */

typedef struct trial {
    const device_double *on;
    knurl_device *device;
    knurl_loop *loop;
    int64_t injected;   /* ns */
    int64_t seen;       /* ns, of the fault that zeroed it: the last one before the motors had no force */
    int64_t limp;       /* ns; 0: they always had one */
    int64_t stall_ns;   /* atomic: the next tick takes so long */
    uint32_t game_dead; /* 1: no more heartbeats */
    outcome result;
} trial;

static void pull(uint64_t tick, const knurl_device_sample *sample, double force[3], void *user) {
    trial *t = user;
    const int64_t stall = __atomic_exchange_n(&t->stall_ns, 0, __ATOMIC_ACQ_REL);
    (void)tick;
    (void)sample;
    if (stall > 0) {
        sleep_ns(stall);
    }
    force[1] = 1.0;
}

static void begin(trial *t, const device_double *on, double heartbeat) {
    knurl_loop_desc desc;
    memset(t, 0, sizeof *t);
    t->on = on;
    t->device = on->open();
    if (!t->device) {
        fail_msg("%s: %s", on->name, knurl_error_message());
    }
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = t->device;
    desc.force_callback = pull;
    desc.user = t;
    desc.reconnect = 1;
    desc.heartbeat_s = heartbeat;
    assert_int_equal(knurl_loop_create(&desc, &t->loop), KNURL_OK);
    assert_int_equal(knurl_loop_start(t->loop), KNURL_OK);
}

/* Waits for `is_limp`, up to `ms`, with heartbeats. Returns 1 if it was reached. */
static int wait_for_limp(trial *t, int is_limp, int ms) {
    const int64_t until = now_ns() + (int64_t)ms * 1000000;
    while ((t->on->limp_since() > 0) != is_limp && now_ns() < until) {
        if (!t->game_dead) {
            knurl_loop_heartbeat(t->loop);
        }
        sleep_ns(100000);
    }
    return (t->on->limp_since() > 0) == is_limp;
}

/* Records the events; those before the motors had no force caused it. */
static void take_events(trial *t, int but) {
    knurl_device_event event;
    outcome *r = &t->result;
    while (knurl_device_next_event(t->device, &event)) {
        int is_new = event.code != but && event.time_ns >= t->injected;
        for (int i = 0; i < r->code_count; i++) {
            is_new = is_new && r->codes[i] != event.code;
        }
        if (is_new && r->code_count < 8) {
            r->codes[r->code_count++] = event.code;
        }
        const int before = t->limp == 0 || event.time_ns <= t->limp || t->seen == 0;
        if (event.code < KNURL_FAULT_RESUMED && event.code != but && event.time_ns >= t->injected && before) {
            t->seen = event.time_ns;
        }
    }
}

static int has(const outcome *r, int32_t code) {
    for (int i = 0; i < r->code_count; i++) {
        if (r->codes[i] == code) {
            return 1;
        }
    }
    return 0;
}

static void end(trial *t) {
    outcome *r = &t->result;
    r->seen = t->seen > 0 ? 1e-6 * (double)(t->seen - t->injected) : -1.0;
    r->zero = t->limp == 0 ? -1.0 : t->seen > 0 ? fmax(0.0, 1e-6 * (double)(t->limp - t->seen)) : -1.0;
    knurl_loop_destroy(t->loop);
    t->on->close(t->device);
}

/* Lets it pull for a while, and clears earlier events. */
static void settle(trial *t) {
    assert_int_equal(wait_for_limp(t, 0, 3000), 1);
    const int64_t until = now_ns() + 40000000;
    while (now_ns() < until) {
        knurl_loop_heartbeat(t->loop);
        sleep_ns(1000000);
    }
    (void)next_code(t->device, -1);
    t->injected = now_ns();
}

/* --- faults of devices --- */

static const device_double *tried; /* the next tries are about */

static outcome try_fault(int fault) {
    const device_double *on = tried;
    trial t;
    begin(&t, on, 0.0);
    settle(&t);
    on->inject(fault);
    if (wait_for_limp(&t, 1, fault == DOUBLE_SPLIT ? 100 : 2000)) {
        t.limp = on->limp_since();
        t.limp = t.limp > 0 ? t.limp : now_ns(); /* it came back in between */
    }
    sleep_ns(20000000); /* longer than its last position is valid */
    take_events(&t, KNURL_FAULT_OVERRUN);
    on->inject(DOUBLE_WELL);
    t.result.is_back = wait_for_limp(&t, 0, 5000);
    sleep_ns(5000000);
    const int64_t seen = t.seen;
    take_events(&t, KNURL_FAULT_OVERRUN);
    t.seen = seen;
    end(&t);
    return t.result;
}

static int as_expected(const outcome *r, int fault) {
    const int32_t *codes = faults[fault].codes;
    if (codes[0] == 0) {
        return r->code_count == 0 && r->zero < 0.0;
    }
    const int came = has(r, codes[0]) || (codes[1] && has(r, codes[1])) || (codes[2] && has(r, codes[2]));
    return came && r->is_back && has(r, KNURL_FAULT_RESUMED) && r->zero >= 0.0 &&
           r->zero <= BOUND + (fault == DOUBLE_UNPLUG || fault == DOUBLE_HANG ? tried->alone_ms : 0.0);
}

static row *add_row(const char *device, const char *fault, const char *back) {
    assert_true(row_count < ROOM);
    row *r = &rows[row_count++];
    r->device = device;
    r->fault = fault;
    r->back = back;
    return r;
}

static void check_row(row *r, outcome (*attempt)(int which), int (*is_good)(const outcome *, int which), int which) {
    r->result = attempt(which);
    if (!is_good(&r->result, which)) {
        print_error("%s, %s: not as expected\n", r->device, r->fault);
        table_print(r, 1, KNURL_TEST_TMP "/faults_failed.md");
        fail();
    }
}

TEST(every_fault_of_every_device_zeroes_the_force_within_5_ms_of_its_event_and_is_overcome) {
    for (size_t i = 0; i < double_count; i++) {
        for (int fault = DOUBLE_UNPLUG; fault < DOUBLE_FAULT_COUNT; fault++) {
            if (doubles[i]->faults & 1u << fault) {
                tried = doubles[i];
                check_row(add_row(tried->name, faults[fault].text, NULL), try_fault, as_expected, fault);
            }
        }
    }
}

/* --- backwards motors --- */

static outcome try_backwards(int which) {
    trial t;
    device_double on = *doubles[which];
    on.open = on.open_backwards;
    begin(&t, &on, 0.0);
    assert_int_equal(wait_for_limp(&t, 0, 3000), 1);
    t.injected = now_ns();
    const int64_t until = now_ns() + 4000000000;
    while (now_ns() < until && !has(&t.result, KNURL_FAULT_BACKWARDS_X) && !has(&t.result, KNURL_FAULT_BACKWARDS_Y) &&
           !has(&t.result, KNURL_FAULT_BACKWARDS_Z)) {
        sleep_ns(200000);
        take_events(&t, KNURL_FAULT_OVERRUN);
    }
    t.limp = wait_for_limp(&t, 1, 100) ? on.limp_since() : 0;
    t.limp = t.limp > 0 && t.limp < t.seen ? t.seen : t.limp; /* between two pulses */
    t.result.is_back = wait_for_limp(&t, 0, 200);
    take_events(&t, KNURL_FAULT_OVERRUN);
    end(&t);
    return t.result;
}

static int is_backwards(const outcome *r, int which) {
    (void)which;
    return r->code_count == 1 && r->codes[0] >= KNURL_FAULT_BACKWARDS_X && r->codes[0] <= KNURL_FAULT_BACKWARDS_Z &&
           r->seen <= 1000.0 && r->zero >= 0.0 && r->zero <= BOUND && !r->is_back;
}

TEST(a_motor_that_is_wired_backwards_gets_no_force_until_the_device_is_opened_again) {
    for (size_t i = 0; i < double_count; i++) {
        if (doubles[i]->open_backwards) {
            row *r = add_row(doubles[i]->name, "motors are wired backwards", "when it is opened again");
            check_row(r, try_backwards, is_backwards, (int)i);
        }
    }
}

/* --- the loop's own --- */

static outcome try_stall(const device_double *on, int64_t stall) {
    trial t;
    begin(&t, on, 0.0);
    settle(&t);
    knurl_store_release(&t.stall_ns, stall);
    if (wait_for_limp(&t, 1, 300)) {
        t.limp = on->limp_since();
    }
    sleep_ns(stall / 2);
    take_events(&t, -1);
    t.result.is_back = wait_for_limp(&t, 0, 3000);
    sleep_ns(10000000);
    const int64_t seen = t.seen;
    take_events(&t, -1);
    t.seen = seen ? seen : t.seen;
    end(&t);
    return t.result;
}

static outcome try_overrun(int which) {
    (void)which;
    return try_stall(&functions_double, 4000000);
}

static int is_overrun(const outcome *r, int which) {
    (void)which;
    return has(r, KNURL_FAULT_OVERRUN) && r->code_count == 1 && r->zero < 0.0;
}

static outcome try_late(int which) {
    (void)which;
    return try_stall(&functions_double, 40000000);
}

static int is_late(const outcome *r, int which) {
    (void)which;
    return has(r, KNURL_FAULT_LATE) && has(r, KNURL_FAULT_RESUMED) && r->is_back && r->zero <= BOUND && r->zero >= 0.0;
}

static outcome try_watchdog(int which) {
    (void)which;
    return try_stall(&plain_double, 150000000);
}

static int is_watchdog(const outcome *r, int which) {
    (void)which;
    return has(r, KNURL_FAULT_WATCHDOG) && has(r, KNURL_FAULT_RESUMED) && r->is_back && r->seen >= 50.0;
}

static outcome try_heartbeat(int which) {
    (void)which;
    trial t;
    begin(&t, &functions_double, 0.05);
    settle(&t);
    t.game_dead = 1;
    if (wait_for_limp(&t, 1, 1000)) {
        t.limp = t.on->limp_since();
    }
    take_events(&t, KNURL_FAULT_OVERRUN);
    t.game_dead = 0;
    t.result.is_back = wait_for_limp(&t, 0, 1000);
    take_events(&t, KNURL_FAULT_OVERRUN);
    end(&t);
    return t.result;
}

static int is_heartbeat(const outcome *r, int which) {
    (void)which; /* by the ramp of 20 ms, and not at once */
    return has(r, KNURL_FAULT_HEARTBEAT) && r->is_back && r->seen >= 48.0 && r->zero >= 15.0 && r->zero <= 40.0;
}

/* A caller's function that exceeds its 5 ms: no other thread can write meanwhile. */
static outcome try_block(int which) {
    (void)which;
    trial t;
    begin(&t, &functions_double, 0.0);
    settle(&t);
    functions_double_hang(60000000);
    t.on->inject(DOUBLE_HANG);
    if (wait_for_limp(&t, 1, 1000)) {
        t.limp = t.on->limp_since();
    }
    take_events(&t, KNURL_FAULT_OVERRUN);
    t.on->inject(DOUBLE_WELL);
    t.result.is_back = wait_for_limp(&t, 0, 1000);
    const int64_t seen = t.seen;
    sleep_ns(5000000);
    take_events(&t, KNURL_FAULT_OVERRUN);
    t.seen = seen;
    end(&t);
    return t.result;
}

static int is_block(const outcome *r, int which) {
    (void)which;
    return has(r, KNURL_FAULT_SILENT) && r->is_back && r->seen < 30.0 && r->zero > 20.0;
}

TEST(the_loops_own_faults_are_seen_and_overcome) {
    check_row(add_row(functions_double.name, "read blocks for 60 ms", NULL), try_block, is_block, 0);
    check_row(add_row("any", "a tick comes 4 ms late", "goes on"), try_overrun, is_overrun, 0);
    check_row(add_row("any with an I/O thread", "the haptic thread stands still for 40 ms", NULL), try_late, is_late,
              0);
    check_row(add_row(plain_double.name, "the haptic thread stands still for 150 ms", NULL), try_watchdog, is_watchdog,
              0);
    check_row(add_row("any", "the game gives no sign of life for 50 ms", NULL), try_heartbeat, is_heartbeat, 0);
}

/* --- the process ends --- */

/* In a child, which does not return. */
static void be_ended(int number) {
    const struct rlimit none = {0, 0};
    trial t;
    (void)setrlimit(RLIMIT_CORE, &none);
    (void)signal(number, SIG_DFL); /* a sanitizer's */
    (void)alarm(20);
    begin(&t, &functions_double, 0.0);
    settle(&t);
    (void)knurl_device_zero_on_exit(0);
    *functions_double_mark() = now_ns();
    (void)raise(number);
    _exit(1);
}

static outcome try_end(int number) {
    outcome o;
    int status = 0;
    memset(&o, 0, sizeof o);
    functions_double.close(functions_double.open()); /* the memory that is shared */
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        be_ended(number);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    const int64_t limp = functions_double.limp_since();
    o.is_back = WIFSIGNALED(status) && WTERMSIG(status) == number; /* it is over, and by that */
    o.zero = limp > 0 ? 1e-6 * (double)(limp - *functions_double_mark()) : -1.0;
    return o;
}

static int is_end(const outcome *r, int number) {
    (void)number;
    return r->is_back && r->zero >= 0.0 && r->zero <= BOUND;
}

TEST(a_process_that_ends_zeroes_the_force_first) {
    static const struct {
        int number;
        const char *text;
    } signals[] = {{SIGSEGV, "crash (SIGSEGV)"}, {SIGTERM, "told to end (SIGTERM)"}};
    for (size_t i = 0; i < COUNT_OF(signals); i++) {
        row *r = add_row("any with an I/O thread", signals[i].text, "-");
        r->what = "the process ends";
        check_row(r, try_end, is_end, signals[i].number);
    }
}

int main(void) {
    const int failed = suite_run("faults");
    if (row_count > 0) {
        table_print(rows, row_count, KNURL_TEST_TMP "/faults.md");
    }
    return failed;
}
