/* Internals of the stub library: its state, shared by all threads, and functions under its lock.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_STUB_STATE_H
#define KNURL_TEST_STUB_STATE_H

#include "stub_hd.h"

#include "device/fake/hand.h"
#include "device/fake/plant.h"
#include "device/touch/hd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))

#define NONE     (-1)
#define LIST     16
#define ERRORS   64
#define OVERLOAD 1.5 /* times the nominal force, above which a real one complains */

typedef struct simulated {
    double settings[STUB_SETTINGS];
    double answers[STUB_QUESTIONS];
    knurl_plant plant;
    knurl_hand hand;
    double target[3];
    double time; /* s since it was initialised */
    double force[3];
    int64_t limp_since;
    int in_frame;
    int force_output;
} simulated;

typedef struct stub_state {
    knurl_mutex mutex;
    stub_time time;
    simulated devices[STUB_DEVICES];
    double settings[STUB_SETTINGS];
    double answers[STUB_QUESTIONS];
    int current;
    int has_failed; /* the last hdInitDevice() */
    hd_error errors[ERRORS];
    int error_count;
    int64_t errors_taken;
    int64_t endless; /* errors that will never end */
    struct {
        hd_callback callback;
        void *user;
        unsigned long number;
    } list[LIST];
    unsigned long last_number;
    hd_callback asked; /* by hdScheduleSynchronous() */
    void *asked_user;
    knurl_thread *thread;
    uintptr_t thread_id;
    int runs;
    int stops;
    double rate;
    uint64_t random;
} stub_state;

extern stub_state hd;

/* Prototypes, as the vendor's header would have them. */
#define PROTOTYPE(field, symbol, result, arguments) EXPORT result HD_CALL symbol arguments;
HD_FUNCTIONS(PROTOTYPE)
EXPORT void stub_set(int device, int setting, double value);
EXPORT double stub_ask(int device, int question);
EXPORT int64_t stub_limp_since(int device);
EXPORT void stub_mirror(stub_told *to);
EXPORT void stub_turn(uint64_t turns);
EXPORT void stub_reset(void);

EXPORT void stub_use_time(const stub_time *time);

static inline int64_t now_ns(void) {
    return hd.time.now_ns();
}

static inline void nap(int64_t ns) {
    hd.time.sleep_until_ns(now_ns() + ns);
}

static inline void lock(void) {
    knurl_system_mutex_lock(&hd.mutex);
}

static inline void unlock(void) {
    knurl_system_mutex_unlock(&hd.mutex);
}

static inline void push(uint32_t code, int device) {
    if (hd.error_count < ERRORS) {
        const hd_error error = {code, 0, device == NONE ? HD_NO_DEVICE : (hd_device)device};
        hd.errors[hd.error_count++] = error;
    }
}

static inline void misuse(uint32_t code) {
    hd.answers[STUB_MISUSES]++;
    push(code, hd.current);
}

/* Advances a device's time, under the lock. */
void stub_move(simulated *d, double dt);

#endif
