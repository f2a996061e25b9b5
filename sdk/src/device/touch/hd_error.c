/* Sentences for HD's errors. SPDX-License-Identifier: MIT */
#include "device/touch/hd.h"

#include <stddef.h>

static const struct {
    uint32_t code;
    const char *sentence;
} table[] = {
#define HD_ERROR_ROW(code, sentence) {(code), (sentence)},
    HD_ERRORS(HD_ERROR_ROW)
#undef HD_ERROR_ROW
};

const char *knurl_hd_error_sentence(uint32_t code) {
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (table[i].code == code) {
            return table[i].sentence;
        }
    }
    return code ? "HD reports an error unknown to this version; its own programs may show more"
                : "HD gives no reason; its set-up program (Touch Setup; Linux: Touch_AdvancedConfig) may show more";
}

int knurl_hd_error_is_loss(uint32_t code) {
    return code == 0x0104 || (code >= 0x0300 && code <= 0x0303);
}

int knurl_hd_error_is_refusal(uint32_t code) {
    return code >= 0x0200 && code <= 0x0204;
}

int knurl_hd_take_errors(const hd_api *hd, hd_error errors[HD_ERRORS_AT_ONCE]) {
    int count = 0;
    while (count < HD_ERRORS_AT_ONCE) {
        errors[count] = hd->next_error();
        if (!errors[count].code) {
            break;
        }
        count++;
    }
    return count;
}
