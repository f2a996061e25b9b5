/* A caller's home-built device: functions over a struct. The test's thread sets its behaviour and reads a record of its
 * calls. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_HOME_H
#define KNURL_TEST_HOME_H

#include "support/close.h"
#include "support/double.h"
#include "support/wait.h"

#include "base/atomic.h"
#include "base/system.h"

#include <knurl/device_functions.h>

#define HOME_FORCE 5.0 /* N that it can play */
#define HOME_LOG   16384

typedef struct home {
    /* behaviour; atomics */
    int32_t fault;      /* DOUBLE_ */
    int64_t takes_ns;   /* of a read */
    double position[3]; /* m */
    double speed;       /* m/s along x since `moves_from`, in steps of 1 ms */
    int64_t moves_from; /* ns; 0: it does not move */
    uint32_t buttons;
    knurl_result read_gives, write_gives, start_gives, reopen_gives;
    int64_t hangs_for; /* ns, at most, with DOUBLE_HANG */
    int64_t mute_ns;   /* of a read without a result */
    /* record of calls; atomics */
    uint64_t infos, starts, reads, writes, reopens, closes;
    uint64_t order;       /* calls so far */
    uint64_t write_order; /* index of the last write and close: */
    uint64_t close_order;
    uint32_t inside; /* threads that read or write now */
    uint32_t crowds; /* times that there was more than one */
    uint32_t late_calls;
    uint32_t strangers; /* reads and writes on other threads than the first one's */
    uintptr_t thread;
    double rate;        /* Hz, of the last start */
    double motor[3];    /* N */
    int64_t limp_since; /* ns; 0: they have a force */
    double strongest;   /* N: the largest force ever written */
    /* used by the I/O thread; read it after its end */
    struct {
        int64_t at;
        double force[3];
    } log[HOME_LOG];
} home;

static inline home *home_of(void *user) {
    return user;
}

static inline int64_t now_ns(void) {
    return knurl_system_now_ns();
}

static inline void sleep_ns(int64_t ns) {
    knurl_system_sleep_until_ns(now_ns() + ns);
}

/** Injects `fault`. */
static inline void home_inject(home *h, int fault) {
    __atomic_store_n(&h->fault, fault, __ATOMIC_SEQ_CST);
}

static inline void home_place(home *h, double x, double y, double z) {
    knurl_store_double(&h->position[0], x);
    knurl_store_double(&h->position[1], y);
    knurl_store_double(&h->position[2], z);
}

static inline void home_info(void *user, knurl_device_info *info) {
    knurl_count_up(&home_of(user)->infos);
    (void)strcpy(info->name, "built at home");
    info->max_force = HOME_FORCE;
}

static inline knurl_result home_start(void *user, double rate) {
    home *h = user;
    knurl_count_up(&h->starts);
    knurl_count_up(&h->order);
    knurl_store_double(&h->rate, rate);
    return knurl_load_relaxed(&h->start_gives);
}

static inline void home_enter(home *h) {
    const uintptr_t me = knurl_system_thread_id();
    if (knurl_load_relaxed(&h->thread) == 0) {
        knurl_store_relaxed(&h->thread, me);
    }
    h->strangers += knurl_load_relaxed(&h->thread) != me;
    if (__atomic_fetch_add(&h->inside, 1, __ATOMIC_RELAXED) > 0) {
        (void)__atomic_fetch_add(&h->crowds, 1, __ATOMIC_RELAXED);
    }
    (void)__atomic_fetch_add(&h->order, 1, __ATOMIC_RELAXED);
}

static inline knurl_result home_leave(home *h, knurl_result result) {
    (void)__atomic_fetch_sub(&h->inside, 1, __ATOMIC_RELAXED);
    return result;
}

static inline void home_hang(home *h) {
    const int64_t until = now_ns() + knurl_load_relaxed(&h->hangs_for);
    while (knurl_load_acquire(&h->fault) == DOUBLE_HANG && now_ns() < until) {
        sleep_ns(200000);
    }
}

/** Its present position. */
static inline void home_measure(const home *h, knurl_device_sample *sample) {
    const int fault = knurl_load_acquire(&h->fault);
    const int64_t from = knurl_load_relaxed(&h->moves_from);
    memset(sample, 0, sizeof *sample);
    for (int axis = 0; axis < 3; axis++) {
        sample->position[axis] = knurl_load_double(&h->position[axis]);
    }
    if (from > 0) {
        sample->position[0] += knurl_load_double(&h->speed) * 1e-3 * (double)((now_ns() - from) / 1000000);
    }
    sample->position[0] += fault == DOUBLE_JUMP ? 0.05 : 0.0;
    sample->position[1] = fault == DOUBLE_NAN ? (double)NAN : sample->position[1];
    sample->buttons = knurl_load_relaxed(&h->buttons);
}

static inline knurl_result home_read(void *user, knurl_device_sample *sample) {
    home *h = user;
    const int64_t takes = knurl_load_relaxed(&h->takes_ns);
    home_enter(h);
    knurl_count_up(&h->reads);
    if (takes > 0) {
        sleep_ns(takes);
    }
    switch (knurl_load_acquire(&h->fault)) {
    case DOUBLE_UNPLUG:
        if (knurl_load_relaxed(&h->limp_since) == 0) {
            knurl_store_release(&h->limp_since, now_ns());
        }
        return home_leave(h, KNURL_ERROR_DEVICE_LOST);
    case DOUBLE_HANG:
        home_hang(h);
        return home_leave(h, KNURL_ERROR_DEVICE_NOT_READY);
    case DOUBLE_MUTE:
        sleep_ns(knurl_load_relaxed(&h->mute_ns));
        return home_leave(h, KNURL_ERROR_DEVICE_NOT_READY);
    case DOUBLE_LATE: /* 20 ms, in four calls that each return within their 5 ms */
        sleep_ns(5000000);
        if (++h->late_calls % 4 != 0) {
            return home_leave(h, KNURL_ERROR_DEVICE_NOT_READY);
        }
        break;
    default:
        break;
    }
    home_measure(h, sample);
    return home_leave(h, knurl_load_relaxed(&h->read_gives));
}

static inline knurl_result home_write(void *user, const double force[3]) {
    home *h = user;
    home_enter(h);
    const int64_t now = now_ns();
    const double length = sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    if (knurl_load_acquire(&h->fault) == DOUBLE_UNPLUG) {
        if (knurl_load_relaxed(&h->limp_since) == 0) {
            knurl_store_release(&h->limp_since, now);
        }
        return home_leave(h, KNURL_ERROR_DEVICE_LOST);
    }
    for (int axis = 0; axis < 3; axis++) {
        knurl_store_double(&h->motor[axis], force[axis]);
        h->log[h->writes % HOME_LOG].force[axis] = force[axis];
    }
    h->log[h->writes % HOME_LOG].at = now;
    if (!(length > 0.0)) {
        if (knurl_load_relaxed(&h->limp_since) == 0) {
            knurl_store_release(&h->limp_since, now);
        }
    } else {
        knurl_store_release(&h->limp_since, (int64_t)0);
    }
    knurl_store_double(&h->strongest, fmax(knurl_load_double(&h->strongest), length));
    knurl_store_relaxed(&h->write_order, knurl_load_relaxed(&h->order));
    knurl_store_release(&h->writes, h->writes + 1);
    return home_leave(h, knurl_load_relaxed(&h->write_gives));
}

static inline knurl_result home_reopen(void *user) {
    home *h = user;
    knurl_count_up(&h->reopens);
    h->crowds += knurl_load_relaxed(&h->inside) > 0; /* no read or write must be running */
    knurl_store_relaxed(&h->thread, (uintptr_t)0);
    return knurl_load_acquire(&h->fault) == DOUBLE_UNPLUG ? KNURL_ERROR_DEVICE_LOST
                                                          : knurl_load_relaxed(&h->reopen_gives);
}

static inline void home_close(void *user) {
    home *h = user;
    knurl_count_up(&h->closes);
    (void)__atomic_fetch_add(&h->order, 1, __ATOMIC_RELAXED);
    knurl_store_relaxed(&h->close_order, knurl_load_relaxed(&h->order));
}

static inline knurl_device_functions home_functions(home *h, uint32_t blocking) {
    knurl_device_functions f;
    knurl_device_functions_init(&f, sizeof f);
    f.blocking = blocking;
    f.user = h;
    f.get_info = home_info;
    f.start = home_start;
    f.read = home_read;
    f.write = home_write;
    f.reopen = home_reopen;
    f.close = home_close;
    f.motors_known = 1; /* it does not move by a force */
    return f;
}

/** A new one, opened. */
static inline knurl_device *home_open(home *h, uint32_t blocking) {
    knurl_device *device = NULL;
    memset(h, 0, sizeof *h);
    h->limp_since = now_ns();
    h->hangs_for = 300000000;
    h->mute_ns = 4000000;
    const knurl_device_functions f = home_functions(h, blocking);
    const knurl_result result = knurl_device_open_functions(&f, &device);
    if (result) {
        print_error("%s\n", knurl_error_message());
    }
    assert_int_equal(result, KNURL_OK);
    return device;
}

/** The next event that is not `but` (0: any): its code, or 0. */
static inline int32_t next_code(knurl_device *device, int32_t but) {
    knurl_device_event event;
    while (knurl_device_next_event(device, &event)) {
        if (event.code != but) {
            return event.code;
        }
    }
    return 0;
}

/** Checks the codes of all events but those of `but` (0: of none); the last code is 0. */
static inline void check_codes(knurl_device *device, int32_t but, const int32_t *codes, const char *file, int line) {
    for (int i = 0;; i++) {
        const int32_t code = next_code(device, but);
        if (code != codes[i]) {
            print_error("event %d: '%s' instead of '%s'\n", i, code ? knurl_fault_name(code) : "none",
                        codes[i] ? knurl_fault_name(codes[i]) : "none");
            _fail(file, line);
        }
        if (code == 0) {
            return;
        }
    }
}

#define CHECK_CODES(device, but, ...) check_codes(device, but, (const int32_t[]){__VA_ARGS__, 0}, __FILE__, __LINE__)

/** Waits for an event of a code, ignoring others. */
static inline knurl_device_event wait_for_event(knurl_device *device, int32_t code) {
    knurl_device_event event = {0};
    const int64_t until = now_ns() + INT64_C(5000000000);
    while (event.code != code) {
        if (now_ns() > until) {
            fail_msg("no event '%s' within 5 s", knurl_fault_name(code));
        }
        if (!knurl_device_next_event(device, &event)) {
            sleep_ns(200000);
        }
    }
    return event;
}

/** Waits until a counter of a home has reached `value`. */
static inline void wait_for_count(const uint64_t *counter, uint64_t value) {
    WAIT_FOR(knurl_load_acquire(counter) >= value);
}

#endif
