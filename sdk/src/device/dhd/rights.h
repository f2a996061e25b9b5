/* USB devices that are plugged in, but that this account may not open: libraries that list only those that they can
 * open leave them out. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_DHD_RIGHTS_H
#define KNURL_SRC_DHD_RIGHTS_H

#include <stddef.h>

/* 1: there is one of this vendor; `text` says which, and what helps. 0: none, or this system does not tell (only Linux
 * does). */
int knurl_usb_is_denied(unsigned vendor, char *text, size_t size);

#endif
