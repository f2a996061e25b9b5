/* The headers' marks, such as [game thread], checked in builds with KNURL_CHECK_THREADS: a call that breaks one ends
 * the program with a sentence on stderr. Otherwise a rule is nothing. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_RULE_H
#define KNURL_SRC_RULE_H

#include <stdint.h>

enum {
    KNURL_RULE_NOT_HAPTIC, /* not within a tick */
    KNURL_RULE_GAME,       /* and one at a time for each object */
    KNURL_RULE_CONFIGURE,  /* and not while the caller's thread ticks the HIP */
    KNURL_RULE_END,        /* not during any other thread's call with the object */
    KNURL_RULE_HAPTIC,     /* one at a time for each object or HIP; its callees are within a tick */
    KNURL_RULE_ONE         /* one at a time for each object; may be within a tick */
};

/* A call that runs, on its caller's stack. */
typedef struct knurl_call {
    struct knurl_call *next;
    const char *function;
    const void *object;
    const void *thread;
    uint32_t hip;
    int rule;
    int begins_tick; /* 1: its thread was not within a tick before */
} knurl_call;

void knurl_rule_enter(knurl_call *call, int rule, const void *object, uint32_t hip, const char *function);
void knurl_rule_leave(knurl_call *call);

#ifdef KNURL_CHECK_THREADS

/* The first line of a public function. object: the handle whose use the rule limits, or null. */
#define KNURL_RULE_OF_HIP(rule, object, hip)                                                                           \
    __attribute__((cleanup(knurl_rule_leave))) knurl_call call_;                                                       \
    knurl_rule_enter(&call_, KNURL_RULE_##rule, (object), (hip), __func__)

#else

#define KNURL_RULE_OF_HIP(rule, object, hip) ((void)0)

#endif

#define KNURL_RULE(rule, object) KNURL_RULE_OF_HIP(rule, object, 0)

#endif
