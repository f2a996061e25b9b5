/* Compares each call with those that run. A spinning lock, not a system's: ticks call this too.
 * SPDX-License-Identifier: MIT */
#include "base/rule.h"

#include "base/finite.h"

#include <stdio.h>
#include <stdlib.h>

static knurl_call *running; /* guarded by `lock` */
static char lock;
/* Of this thread; the address of the first is the thread's name. */
static __thread const char *ticking; /* the outermost tick that it is in, or null */
static __thread uint32_t depth;      /* of calls within calls */

static const char *const sentences[] = {
    "is for any thread but the haptic",
    "is for the game thread, one call at a time with an object",
    "is for the game thread, while the caller's own thread does not tick that HIP",
    "is for a time in which no other thread uses the object",
    "is for the haptic thread, one at a time for each HIP or object",
    "is for one thread at a time",
};

static void end(const knurl_call *call, const char *how, const char *other) {
    (void)fprintf(stderr, "knurl: %s() %s, and was called on thread %p %s %s() [KNURL_CHECK_THREADS]\n", call->function,
                  sentences[call->rule], call->thread, how, other);
    abort();
}

/* 1 if rule `a` forbids a call of rule `b` with the same object on another thread. */
static int forbids(const knurl_call *a, const knurl_call *b) {
    switch (a->rule) {
    case KNURL_RULE_NOT_HAPTIC:
        return 0;
    case KNURL_RULE_GAME:
        return b->rule == KNURL_RULE_GAME || b->rule == KNURL_RULE_CONFIGURE;
    case KNURL_RULE_CONFIGURE:
        return b->rule == KNURL_RULE_GAME || b->rule == KNURL_RULE_CONFIGURE ||
               (b->rule == KNURL_RULE_HAPTIC && a->hip == b->hip);
    case KNURL_RULE_END:
        return 1;
    default:
        return a->rule == b->rule && a->hip == b->hip;
    }
}

static void acquire(void) {
    while (__atomic_test_and_set(&lock, __ATOMIC_ACQUIRE)) {}
}

static void release(void) {
    __atomic_clear(&lock, __ATOMIC_RELEASE);
}

void knurl_rule_enter(knurl_call *call, int rule, const void *object, uint32_t hip, const char *function) {
    call->function = function;
    call->object = depth++ > 0 ? NULL : object; /* calls within the library need no check */
    call->thread = &ticking;
    call->hip = hip;
    call->rule = rule;
    call->begins_tick = rule == KNURL_RULE_HAPTIC && !ticking;
    if (ticking && rule < KNURL_RULE_END) {
        end(call, "within", ticking);
    }
    acquire();
    for (const knurl_call *other = running; other; other = other->next) {
        if (call->object && other->object == call->object && other->thread != call->thread &&
            (forbids(call, other) || forbids(other, call))) {
            end(call, "during another thread's", other->function);
        }
    }
    call->next = running;
    running = call;
    release();
    ticking = call->begins_tick ? function : ticking;
}

void knurl_rule_leave(knurl_call *call) {
    depth--;
    if (call->begins_tick) {
        ticking = NULL;
    }
    acquire();
    knurl_call **at = &running;
    while (*at != call) {
        at = &(*at)->next;
    }
    *at = call->next;
    release();
}
