/* Response files of devices. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <knurl/hip.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    knurl_gain gains[KNURL_GAINS];
    char *exact = malloc(size ? size : 1); /* so that a byte too far is seen */
    EXPECT(exact != NULL);
    memcpy(exact, data, size);
    if (knurl_gains_from_response(exact, size, gains) == KNURL_OK) {
        for (int i = 0; i < KNURL_GAINS; i++) {
            EXPECT(gains[i].gain > 0.0 && gains[i].gain <= 1.0);
        }
    }
    free(exact);
    return 0;
}
