/* Sets a Falcon up and loads its firmware. Read knurl_falcon_prepare() first. SPDX-License-Identifier: MIT */
#include "device/falcon/firmware.h"

#include "base/regular_file.h"
#include "base/system.h"
#include "device/falcon/frame.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Requests to the FTDI chip. */
enum { PURGE = 0, LINES = 1, FLOW = 2, BAUD = 3, FORMAT = 4, LATENCY = 9 };

typedef struct request {
    uint8_t request;
    uint16_t value;
} request;

static const request normal_mode[] = {{PURGE, 1}, {PURGE, 2}, {LATENCY, 1}, /* ms */
                                      {BAUD, 2},                            /* 1.5 MBaud */
                                      {PURGE, 1}, {PURGE, 2}};
static const request boot_mode[] = {{PURGE, 1},     {PURGE, 2},     {LATENCY, 16}, {BAUD, 0x4138}, /* 9600 Bd */
                                    {FORMAT, 8},                                                   /* 8N1 */
                                    {FLOW, 0},      {LINES, 0x200},                                /* RTS low */
                                    {LINES, 0x100}, {LINES, 0x101}};                               /* DTR low, high */
static const request load_mode[] = {{LINES, 0x100}, {BAUD, 0x15}};                                 /* 140 kBd */

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

#define PROBES      10 /* frames */
#define PROBE_MS    20 /* to wait for an answer to each */
#define LOADS       10
#define GREETINGS   60 /* 1.5 s in total, as in libnifalcon */
#define GREETING_MS 25 /* 7 characters at 9600 Bd, plus the chip's 16 ms */
#define ECHO_MS     500
#define WRITE_MS    200
#define CHUNK       62u

/* --- the image --- */

enum { KEY = 0x08aa, HEADER_BYTES = 2 + 8 * 2 + 4, BLOCK_HEADER_BYTES = 2 + 4 };

static uint32_t word_at(const uint8_t *image, size_t at) {
    return (uint32_t)image[at] | (uint32_t)image[at + 1] << 8;
}

static uint32_t address_at(const uint8_t *image, size_t at) {
    return word_at(image, at) << 16 | word_at(image, at + 2);
}

static knurl_result refuse(const char *path, const char *expected, size_t at) {
    return knurl_fail(KNURL_ERROR_FORMAT, "device 'falcon': firmware '%s': byte %lu: expected %s: it is not a Falcon's",
                      path, (unsigned long)at, expected);
}

static knurl_result check_image(const char *path, const uint8_t *image, size_t size) {
    size_t at = HEADER_BYTES;
    int is_entry_loaded = 0;
    const uint32_t entry = address_at(image, HEADER_BYTES - 4);
    if (word_at(image, 0) != KEY) {
        return refuse(path, "the boot loader's key, aa 08", 0);
    }
    while (at + 2 <= size && word_at(image, at) > 0) {
        const size_t words = word_at(image, at);
        if (size - at < BLOCK_HEADER_BYTES + 2 * words) {
            return refuse(path, "a block that ends within the file", at);
        }
        const uint32_t destination = address_at(image, at + 2);
        is_entry_loaded |= entry >= destination && entry - destination < words;
        at += BLOCK_HEADER_BYTES + 2 * words;
    }
    if (at + 2 != size) {
        return refuse(path, "a block of 0 words, and then the file's end", at);
    }
    return is_entry_loaded ? KNURL_OK : refuse(path, "an entry point in one of the blocks", HEADER_BYTES - 4);
}

/* Reads the image at `path` and checks that the Falcon's processor, a TMS320F281x, would load all of it: the key
 * 0x08AA, 8 reserved words, an entry point, blocks (words, destination, data) and a block of 0 words at the file's end.
 * Words have 16 bits, low byte first; addresses have two, high word first. Source: Texas Instruments SPRU095, "Boot
 * Loader Data Stream Structure". image: room for KNURL_FALCON_IMAGE_MOST + 1 bytes. size: bytes. Errors:
 * KNURL_ERROR_IO, KNURL_ERROR_FORMAT, with the file and, if its content is wrong, the byte. */
static knurl_result read_image(const char *path, uint8_t *image, size_t *size) {
    char why[160];
    uint64_t there = 0;
    FILE *file = knurl_regular_open(NULL, path, &there, why, sizeof why);
    if (!file) {
        return knurl_fail(KNURL_ERROR_IO, "device 'falcon': firmware '%s': %s", path, why);
    }
    const size_t got = fread(image, 1, KNURL_FALCON_IMAGE_MOST + 1, file);
    const int failed = ferror(file);
    (void)fclose(file);
    if (failed) {
        return knurl_fail(KNURL_ERROR_IO, "device 'falcon': firmware '%s' cannot be read", path);
    }
    if (got < KNURL_FALCON_IMAGE_LEAST || got > KNURL_FALCON_IMAGE_MOST) {
        return knurl_fail(KNURL_ERROR_FORMAT,
                          "device 'falcon': firmware '%s': expected an image of %d to %d bytes, found %lu%s", path,
                          KNURL_FALCON_IMAGE_LEAST, KNURL_FALCON_IMAGE_MOST, (unsigned long)got,
                          got > KNURL_FALCON_IMAGE_MOST ? " or more" : "");
    }
    const knurl_result result = check_image(path, image, got);
    if (!result) {
        *size = got;
    }
    return result;
}

/* --- the device --- */

static knurl_result gone(const char *doing) {
    return knurl_fail(KNURL_ERROR_DEVICE_LOST, "device 'falcon': it was unplugged while %s", doing);
}

static knurl_result set_up(const knurl_falcon_transport *t, const request *requests, size_t count, const char *mode) {
    for (size_t i = 0; i < count; i++) {
        const int outcome = t->control(t->self, requests[i].request, requests[i].value);
        if (outcome == KNURL_FALCON_GONE) {
            return gone("it was set up");
        }
        if (outcome != KNURL_FALCON_DONE) {
            return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                              "device 'falcon': its USB chip refused step %lu of %lu to %s (request %u, value 0x%x); "
                              "plug it in again",
                              (unsigned long)(i + 1), (unsigned long)count, mode, (unsigned)requests[i].request,
                              (unsigned)requests[i].value);
        }
    }
    return KNURL_OK;
}

static int64_t after_ms(int64_t ms) {
    return knurl_system_now_ns() + ms * 1000000;
}

/* Receives the data of one packet before the deadline. `bytes`: room for a packet. KNURL_FALCON_. */
static int receive(const knurl_falcon_transport *t, int64_t deadline, uint8_t *bytes, size_t *count) {
    for (;;) {
        uint8_t packet[KNURL_FALCON_PACKET];
        size_t size = 0;
        const int64_t left = deadline - knurl_system_now_ns();
        if (left <= 0) {
            return KNURL_FALCON_NOTHING;
        }
        const int outcome = t->read(t->self, packet, &size, (uint32_t)(left / 1000000) + 1);
        if (outcome == KNURL_FALCON_GONE) {
            return outcome;
        }
        if (outcome == KNURL_FALCON_DONE && size > KNURL_FALCON_STATUS) {
            *count = size - KNURL_FALCON_STATUS;
            memcpy(bytes, packet + KNURL_FALCON_STATUS, *count);
            return outcome;
        }
    }
}

/* Sends frames of zero force until one is answered. If the answer's packet also holds the start of another answer,
 * reads that to its end, too. KNURL_FALCON_. */
static int probe(const knurl_falcon_transport *t) {
    static const int16_t none[3] = {0, 0, 0};
    knurl_falcon_decoder decoder = {0};
    uint32_t answers = 0;
    uint8_t frame[KNURL_FALCON_FRAME_BYTES];
    knurl_falcon_encode(none, KNURL_FALCON_HOMING | KNURL_FALCON_RED, frame);
    for (int i = 0; i < PROBES; i++) {
        uint8_t bytes[KNURL_FALCON_PACKET];
        size_t count = 0;
        const int64_t deadline = after_ms(PROBE_MS);
        int outcome = t->write(t->self, frame, sizeof frame, PROBE_MS);
        while (outcome == KNURL_FALCON_DONE && (answers == 0 || decoder.count > 0)) {
            outcome = receive(t, deadline, bytes, &count);
            answers += outcome == KNURL_FALCON_DONE ? knurl_falcon_decode(&decoder, bytes, count) : 0;
        }
        if (outcome == KNURL_FALCON_GONE) {
            return outcome;
        }
        if (answers > 0) {
            return KNURL_FALCON_DONE;
        }
    }
    return KNURL_FALCON_NOTHING;
}

/* Sends greetings until the boot loader replies 0A 44 2C 0D, sometimes after a 00. */
static knurl_result greet(const knurl_falcon_transport *t) {
    static const uint8_t hello[] = {0x0a, 0x43, 0x0d};
    static const uint8_t reply[] = {0x0a, 0x44, 0x2c, 0x0d};
    for (int i = 0; i < GREETINGS; i++) {
        uint8_t heard[2 * KNURL_FALCON_PACKET];
        size_t size = 0;
        const int64_t deadline = after_ms(GREETING_MS);
        int outcome = t->write(t->self, hello, sizeof hello, WRITE_MS);
        while (outcome == KNURL_FALCON_DONE && size < KNURL_FALCON_PACKET) {
            size_t count = 0;
            outcome = receive(t, deadline, heard + size, &count);
            size += count;
            if (size >= sizeof reply && memcmp(heard + size - sizeof reply, reply, sizeof reply) == 0) {
                return KNURL_OK;
            }
        }
        if (outcome == KNURL_FALCON_GONE) {
            return gone("its boot loader was called");
        }
    }
    return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                      "device 'falcon': its boot loader does not answer (expected 0A 44 2C 0D within %d calls); switch "
                      "its power off and on",
                      GREETINGS);
}

/* Sends bytes and checks their echo. `at`: their offset in the image. */
static knurl_result send_echoed(const knurl_falcon_transport *t, const uint8_t *bytes, size_t count, size_t at) {
    uint8_t heard[KNURL_FALCON_PACKET];
    size_t echoed = 0;
    const int64_t deadline = after_ms(ECHO_MS);
    int outcome = t->write(t->self, bytes, count, WRITE_MS);
    while (outcome == KNURL_FALCON_DONE && echoed < count) {
        size_t size = 0;
        outcome = receive(t, deadline, heard, &size);
        for (size_t i = 0; i < size; i++, echoed++) {
            if (echoed == count || heard[i] != bytes[echoed]) {
                return knurl_fail(
                    KNURL_ERROR_DEVICE_LOST,
                    "device 'falcon': loading its firmware: the echo of byte %lu is 0x%02x, which was not sent; "
                    "switch its power off and on",
                    (unsigned long)(at + echoed), (unsigned)heard[i]);
            }
        }
    }
    if (outcome == KNURL_FALCON_GONE) {
        return gone("its firmware was loaded");
    }
    return outcome == KNURL_FALCON_DONE
               ? KNURL_OK
               : knurl_fail(KNURL_ERROR_DEVICE_LOST,
                            "device 'falcon': loading its firmware: no echo of byte %lu within %d ms; switch its power "
                            "off and on",
                            (unsigned long)(at + echoed), ECHO_MS);
}

static knurl_result load(const knurl_falcon_transport *t, const uint8_t *image, size_t size) {
    static const uint8_t begin[] = {0x41};
    knurl_result result = set_up(t, boot_mode, COUNT(boot_mode), "reach its boot loader");
    result = result ? result : greet(t);
    result = result ? result : set_up(t, load_mode, COUNT(load_mode), "load its firmware");
    result = result ? result : send_echoed(t, begin, sizeof begin, 0);
    for (size_t at = 0; at < size && !result; at += CHUNK) {
        result = send_echoed(t, image + at, size - at < CHUNK ? size - at : CHUNK, at);
    }
    return result ? result : set_up(t, normal_mode, COUNT(normal_mode), "start its firmware");
}

/* Users of libnifalcon need several attempts before one succeeds. */
static knurl_result load_until_it_answers(const knurl_falcon_transport *t, const char *path, const uint8_t *image,
                                          size_t size) {
    knurl_result result = KNURL_OK;
    for (int i = 0; i < LOADS; i++) {
        result = load(t, image, size);
        const int outcome = result ? KNURL_FALCON_NOTHING : probe(t);
        if (outcome == KNURL_FALCON_DONE) {
            return KNURL_OK;
        }
        if (outcome == KNURL_FALCON_GONE) {
            return gone("it was probed");
        }
        result =
            result ? result
                   : knurl_fail(KNURL_ERROR_FORMAT,
                                "device 'falcon': firmware '%s' was loaded, but nothing answers: it is not a Falcon's",
                                path);
    }
    return result;
}

static knurl_result load_file(const knurl_falcon_transport *t, const char *path) {
    size_t size = 0;
    uint8_t *image = malloc(KNURL_FALCON_IMAGE_MOST + 1);
    if (!image) {
        return knurl_fail(KNURL_ERROR_MEMORY, "device 'falcon': could not get %d bytes for its firmware",
                          KNURL_FALCON_IMAGE_MOST + 1);
    }
    knurl_result result = read_image(path, image, &size);
    if (!result) {
        result = load_until_it_answers(t, path, image, size);
    }
    free(image);
    return result;
}

knurl_result knurl_falcon_prepare(const knurl_falcon_transport *t, const char *path) {
    const knurl_result result = set_up(t, normal_mode, COUNT(normal_mode), "reach its firmware");
    if (result) {
        return result;
    }
    const int outcome = probe(t); /* the previous program may have loaded it */
    if (outcome == KNURL_FALCON_NOTHING && !path[0]) {
        return knurl_fail(
            KNURL_ERROR_DEVICE_LOST,
            "device 'falcon': it is connected but does not answer: after power-on it needs a firmware, which may not be "
            "shipped with Knurl; open 'falcon:?firmware=PATH' or set KNURL_FALCON_FIRMWARE to the path of an image, "
            "such as the nvent_firmware.bin or novint.bin that come with libnifalcon or Novint's drivers");
    }
    if (outcome == KNURL_FALCON_NOTHING) {
        return load_file(t, path);
    }
    return outcome == KNURL_FALCON_GONE ? gone("it was probed") : KNURL_OK;
}
