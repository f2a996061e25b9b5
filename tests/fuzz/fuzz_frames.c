/* Devices' messages: frames of a Falcon in packets of any size, reports of a raw HID device, messages of Haply's
 * service. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include "device/falcon/frame.h"
#include "device/inverse3/message.h"
#include "device/rawhid/report.h"

static void try_message(const uint8_t *data, size_t size) {
    knurl_inverse3_state state;
    knurl_inverse3_grip grip;
    EXPECT(knurl_inverse3_read_brake((const char *)data, size, "049D") <= 1);
    if (!knurl_inverse3_read((const char *)data, size, &state)) {
        return;
    }
    knurl_inverse3_find_grip(&state, "", &grip);
    EXPECT(grip.battery >= 0.0 && grip.battery <= 1.0);
    for (int i = 0; i < KNURL_INVERSE3_DEVICES; i++) {
        const knurl_inverse3_entry *entry = &state.entries[i];
        EXPECT(memchr(entry->id, '\0', sizeof entry->id) && !strpbrk(entry->id, "\"\\{}"));
        EXPECT(isfinite(entry->position[0]) && isfinite(entry->position[1]) && isfinite(entry->position[2]));
        EXPECT(isfinite(entry->joints[i % 3]));
        EXPECT(isfinite(grip.orientation[i % 4]) && fabs(grip.orientation[i % 4]) <= 1.0 + 1e-9);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    supply s = {data, size};
    knurl_falcon_decoder decoder;
    uint64_t given = 0;
    uint64_t frames = 0;
    memset(&decoder, 0, sizeof decoder);
    while (s.left > 0) {
        const size_t wanted = 1 + take_byte(&s) % 64;
        const size_t count = wanted < s.left ? wanted : s.left;
        uint8_t *packet = malloc(count ? count : 1);
        EXPECT(packet != NULL);
        memcpy(packet, s.at, count);
        frames += knurl_falcon_decode(&decoder, packet, count);
        given += count;
        free(packet);
        s.at += count;
        s.left -= count;
        EXPECT(decoder.count < KNURL_FALCON_FRAME_BYTES);
        EXPECT(frames * KNURL_FALCON_FRAME_BYTES + decoder.count + decoder.bad_bytes == given);
    }
    knurl_rawhid_in in;
    for (size_t report_bytes = 0; report_bytes <= 64; report_bytes += 16) {
        (void)knurl_rawhid_parse(data, size, report_bytes, &in);
    }
    try_message(data, size);
    return 0;
}
