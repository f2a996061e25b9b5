/* Finds USB devices that are plugged in but that this account may not open, because libraries list only those that they
 * can open. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DHD_RIGHTS_H
#define KNURL_SRC_DHD_RIGHTS_H

#include <stddef.h>

/* 1 if there is such a device of this vendor; `text` names it and the remedy. 0 if there is no such device, or if the
 * system is not Linux. */
int knurl_usb_is_denied(unsigned vendor, char *text, size_t size);

#endif
