/* The newest value from one writer to one reader. Neither waits or retries: there are three slots, of which the writer
 * owns one, the reader one, and the third is exchanged.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MAILBOX_H
#define KNURL_SRC_MAILBOX_H

#include <stdint.h>

typedef struct knurl_mailbox {
    uint32_t middle; /* atomic: the slot that changes hands, and whether it is fresh */
    uint32_t back;   /* the writer's slot */
    uint32_t front;  /* the reader's slot */
} knurl_mailbox;

#define KNURL_MAILBOX_FRESH 4u

static inline void knurl_mailbox_init(knurl_mailbox *mailbox) {
    mailbox->middle = 0;
    mailbox->back = 1;
    mailbox->front = 2;
}

/* The writer has filled in slot `back`; from now on it is another one. */
static inline void knurl_mailbox_post(knurl_mailbox *mailbox) {
    mailbox->back = __atomic_exchange_n(&mailbox->middle, mailbox->back | KNURL_MAILBOX_FRESH, __ATOMIC_ACQ_REL) & 3u;
}

/* 1: slot `front` is another one, with what was posted last; 0: nothing was posted since. */
static inline int knurl_mailbox_take(knurl_mailbox *mailbox) {
    if (!(__atomic_load_n(&mailbox->middle, __ATOMIC_RELAXED) & KNURL_MAILBOX_FRESH)) {
        return 0;
    }
    mailbox->front = __atomic_exchange_n(&mailbox->middle, mailbox->front, __ATOMIC_ACQ_REL) & 3u;
    return 1;
}

#endif
