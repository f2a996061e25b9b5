/* Passes the newest value from one writer to one reader. Neither waits or retries: of three slots the writer owns one,
 * the reader one, and the third is exchanged.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_MAILBOX_H
#define KNURL_SRC_MAILBOX_H

#include <stdint.h>

typedef struct knurl_mailbox {
    uint32_t middle; /* atomic: the slot to exchange, and KNURL_MAILBOX_FRESH if the reader has not taken it */
    uint32_t back;   /* the writer's slot */
    uint32_t front;  /* the reader's slot */
} knurl_mailbox;

#define KNURL_MAILBOX_FRESH 4u

static inline void knurl_mailbox_init(knurl_mailbox *mailbox) {
    mailbox->middle = 0;
    mailbox->back = 1;
    mailbox->front = 2;
}

/* Publishes slot `back`, which the writer has filled in; `back` becomes another slot. */
static inline void knurl_mailbox_post(knurl_mailbox *mailbox) {
    mailbox->back = __atomic_exchange_n(&mailbox->middle, mailbox->back | KNURL_MAILBOX_FRESH, __ATOMIC_ACQ_REL) & 3u;
}

/* Returns 1 if `front` is now the slot posted last; 0 if nothing was posted since the last call. */
static inline int knurl_mailbox_take(knurl_mailbox *mailbox) {
    if (!(__atomic_load_n(&mailbox->middle, __ATOMIC_RELAXED) & KNURL_MAILBOX_FRESH)) {
        return 0;
    }
    mailbox->front = __atomic_exchange_n(&mailbox->middle, mailbox->front, __ATOMIC_ACQ_REL) & 3u;
    return 1;
}

#endif
