/* Checks the USB devices that Linux lists. SPDX-License-Identifier: MIT */
#include "device/dhd/rights.h"

#include "base/finite.h"
#include "device/driver.h"

#ifndef __linux__

int knurl_usb_is_denied(unsigned vendor, char *text, size_t size) {
    (void)vendor;
    (void)text;
    (void)size;
    return 0;
}

#else

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define DEVICES "/sys/bus/usb/devices"

typedef struct usb_device {
    unsigned vendor, product;
    char node[128]; /* "" for an interface, which has no node */
} usb_device;

static void read_device(const char *name, usb_device *device) {
    char line[128];
    char path[sizeof DEVICES + 256 + sizeof "/uevent"];
    memset(device, 0, sizeof *device);
    (void)snprintf(path, sizeof path, DEVICES "/%.255s/uevent", name);
    FILE *file = fopen(path, "r");
    while (file && fgets(line, sizeof line, file)) {
        if (strncmp(line, "PRODUCT=", 8) == 0) {
            char *end = NULL;
            device->vendor = (unsigned)strtoul(line + 8, &end, 16);
            device->product = *end == '/' ? (unsigned)strtoul(end + 1, NULL, 16) : 0;
        } else if (strncmp(line, "DEVNAME=", 8) == 0) {
            (void)snprintf(device->node, sizeof device->node, "/dev/%.*s", (int)strcspn(line + 8, "\n"), line + 8);
        }
    }
    if (file) {
        (void)fclose(file);
    }
}

int knurl_usb_is_denied(unsigned vendor, char *text, size_t size) {
    int is_denied = 0;
    DIR *folder = opendir(DEVICES);
    const struct dirent *entry = NULL;
    /* NOLINTNEXTLINE(concurrency-mt-unsafe): of a folder that this thread alone has open */
    while (folder && !is_denied && (entry = readdir(folder))) {
        usb_device device;
        read_device(entry->d_name, &device);
        is_denied =
            device.vendor == vendor && device.node[0] && access(device.node, R_OK | W_OK) != 0 && errno == EACCES;
        if (is_denied) {
            (void)snprintf(text, size,
                           "%04x:%04x is there, but permission to open %s is denied: " KNURL_PERMISSION_ADVICE,
                           device.vendor, device.product, device.node);
        }
    }
    if (folder) {
        (void)closedir(folder);
    }
    return is_denied;
}

#endif
