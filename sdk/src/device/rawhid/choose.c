/* Chooses a HID interface. SPDX-License-Identifier: MIT */
#include "device/rawhid/rawhid_device.h"

#include "base/number.h"
#include "device/driver.h"

#include <stdio.h>
#include <string.h>

static const struct {
    uint16_t vendor, product;
    size_t report_bytes;
    const char *name;
} known[] = {{0x1234, 0x0006, 14, "mbed"}, {0x16c0, 0x0486, 64, "Teensy"}};

#define KNOWN_COUNT (sizeof known / sizeof *known)

/* Quality of an interface's fit, in rising order. */
enum { OTHER_DEVICE, OTHER_USAGE, OTHER_SIZE, DENIED, FITS };

static size_t known_bytes(uint16_t vendor, uint16_t product) {
    for (size_t i = 0; i < KNOWN_COUNT; i++) {
        if (known[i].vendor == vendor && known[i].product == product) {
            return known[i].report_bytes;
        }
    }
    return 0;
}

static size_t bytes_of(const knurl_rawhid_wanted *wanted, const knurl_rawhid_found *found) {
    const size_t by_id = known_bytes(found->vendor, found->product);
    return wanted->report_bytes ? wanted->report_bytes
           : found->sizes.in    ? found->sizes.in
           : by_id              ? by_id
                                : KNURL_RAWHID_MOST_BYTES;
}

static int rank(const knurl_rawhid_wanted *wanted, const knurl_rawhid_found *found) {
    const int is_wanted = wanted->vendor || wanted->product
                              ? found->vendor == wanted->vendor && found->product == wanted->product
                              : known_bytes(found->vendor, found->product) > 0;
    if (!is_wanted) {
        return OTHER_DEVICE;
    }
    if (found->usage_page != wanted->usage_page || found->usage != wanted->usage) {
        return OTHER_USAGE;
    }
    const size_t bytes = bytes_of(wanted, found);
    const int tells = found->sizes.in > 0 || found->sizes.out > 0;
    if (bytes < KNURL_RAWHID_LEAST_BYTES || bytes > KNURL_RAWHID_MOST_BYTES ||
        (tells && (found->sizes.in != bytes || found->sizes.out != bytes))) {
        return OTHER_SIZE;
    }
    return found->is_denied ? DENIED : FITS;
}

/* Describes an interface that does not fit. */
static void explain(const knurl_rawhid_wanted *wanted, const knurl_rawhid_found *found, char *text, size_t size) {
    char expected[48] = "14 to 64 bytes, the same both ways";
    if (wanted->report_bytes) {
        (void)snprintf(expected, sizeof expected, "%u bytes both ways", (unsigned)wanted->report_bytes);
    }
    switch (rank(wanted, found)) {
    case OTHER_USAGE:
        (void)snprintf(text, size,
                       "%04x:%04x (%s) is there, but is of usage %04x:%04x; expected %04x:%04x. It runs another "
                       "firmware, or its geometry file has to name its usage_page and usage",
                       found->vendor, found->product, found->path, found->usage_page, found->usage, wanted->usage_page,
                       wanted->usage);
        break;
    case OTHER_SIZE:
        (void)snprintf(text, size,
                       "%04x:%04x (%s) is there, but its reports are of %u bytes in and %u out; expected %s. It runs "
                       "another firmware%s",
                       found->vendor, found->product, found->path, (unsigned)found->sizes.in,
                       (unsigned)found->sizes.out, expected,
                       found->sizes.in == 8 ? ": mbed 1.5's; load the one of woody-experimental of May 2019 or later, "
                                              "whose reports have 14 bytes"
                                            : "");
        break;
    case DENIED:
        (void)snprintf(text, size, "%04x:%04x is there, but permission to open %s is denied: " KNURL_PERMISSION_ADVICE,
                       found->vendor, found->product, found->path);
        break;
    default:
        (void)snprintf(text, size, "%s", "");
        break;
    }
}

knurl_result knurl_rawhid_want(const char *id, const knurl_rawhid_geometry *geometry, knurl_rawhid_wanted *wanted) {
    const char *colon = strchr(id, ':');
    double vendor = geometry->vendor;
    double product = geometry->product;
    if (id[0] && !(colon && knurl_number_hex(id, (size_t)(colon - id), &vendor) &&
                   knurl_number_hex(colon + 1, strlen(colon + 1), &product))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "device 'rawhid': expected rawhid:VID:PID, each one to four hexadecimal digits, such as "
                          "rawhid:16c0:0486; found 'rawhid:%.100s'",
                          id);
    }
    wanted->vendor = (uint16_t)vendor;
    wanted->product = (uint16_t)product;
    wanted->usage_page = (uint16_t)geometry->usage_page;
    wanted->usage = (uint16_t)geometry->usage;
    wanted->report_bytes = (size_t)geometry->report_bytes;
    return KNURL_OK;
}

static void name_wanted(const knurl_rawhid_wanted *wanted, char *text, size_t size) {
    (void)snprintf(text, size, "%04x:%04x", wanted->vendor, wanted->product);
    for (size_t i = 0; !wanted->vendor && !wanted->product && i < KNOWN_COUNT; i++) {
        const size_t used = i > 0 ? strlen(text) : 0;
        (void)snprintf(text + used, size - used, "%s%04x:%04x (%s)", i > 0 ? " or " : "", known[i].vendor,
                       known[i].product, known[i].name);
    }
}

knurl_result knurl_rawhid_choose(const knurl_rawhid_bus *bus, const knurl_rawhid_wanted *wanted,
                                 knurl_rawhid_found *chosen, size_t *report_bytes) {
    knurl_rawhid_found found[KNURL_RAWHID_FOUND];
    char text[512];
    const size_t count = bus->look(bus->user, wanted->vendor, wanted->product, found, KNURL_RAWHID_FOUND);
    int best = OTHER_DEVICE;
    size_t which = 0;
    for (size_t i = 0; i < count; i++) {
        if (rank(wanted, &found[i]) > best) {
            best = rank(wanted, &found[i]);
            which = i;
        }
    }
    if (best == OTHER_DEVICE) {
        name_wanted(wanted, text, sizeof text);
        return knurl_fail(KNURL_ERROR_DEVICE_LOST,
                          "device 'rawhid': looked for a USB HID device %s and found none; plug it in, or name another "
                          "as rawhid:VID:PID",
                          text);
    }
    if (best != FITS) {
        explain(wanted, &found[which], text, sizeof text);
        return knurl_fail(best == DENIED ? KNURL_ERROR_SYSTEM : KNURL_ERROR_DEVICE_LOST, "device 'rawhid': %s", text);
    }
    *chosen = found[which];
    *report_bytes = bytes_of(wanted, &found[which]);
    return KNURL_OK;
}

static int best_of_its_kind(const knurl_rawhid_wanted *wanted, const knurl_rawhid_found *found, size_t count,
                            size_t which) {
    int best = OTHER_DEVICE;
    for (size_t i = 0; i < count; i++) {
        if (found[i].vendor == found[which].vendor && found[i].product == found[which].product) {
            best = rank(wanted, &found[i]) > best ? rank(wanted, &found[i]) : best;
        }
    }
    return best > OTHER_DEVICE && rank(wanted, &found[which]) == best;
}

void knurl_rawhid_list(const knurl_rawhid_bus *bus, knurl_listings *listings) {
    knurl_rawhid_found found[KNURL_RAWHID_FOUND];
    knurl_rawhid_geometry geometry;
    knurl_rawhid_wanted wanted;
    char text[512];
    char uri[32];
    uint32_t listed = 0;
    knurl_rawhid_geometry_init(&geometry);
    (void)knurl_rawhid_want("", &geometry, &wanted);
    const size_t count = bus->look(bus->user, 0, 0, found, KNURL_RAWHID_FOUND);
    for (size_t i = 0; i < count; i++) {
        if (best_of_its_kind(&wanted, found, count, i)) { /* a Teensy has a second interface with another usage */
            explain(&wanted, &found[i], text, sizeof text);
            (void)snprintf(uri, sizeof uri, "rawhid:%04x:%04x", found[i].vendor, found[i].product);
            knurl_listings_add(listings, uri, found[i].name[0] ? found[i].name : "raw HID device", "%s", text);
            listed++;
        }
    }
    if (listed == 0) {
        name_wanted(&wanted, text, sizeof text);
        knurl_listings_add(listings, "rawhid", "raw HID device (WoodenHaptics)",
                           "not connected (looked for %s): plug it in; another is opened as "
                           "rawhid:VID:PID?geometry=FILE",
                           text);
    }
}
