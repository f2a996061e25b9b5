/* posix_memalign() and the free() that belongs to it, for a test that is written with them.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_MEMALIGN_H
#define KNURL_TEST_MEMALIGN_H

#include <malloc.h>
#include <stdlib.h>

static inline int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory = _aligned_malloc(size, alignment);
    return *memory ? 0 : 12;
}

#define free _aligned_free

#endif
