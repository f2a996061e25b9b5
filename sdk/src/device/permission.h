/* Advice in messages about devices that may not be opened. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PERMISSION_H
#define KNURL_SRC_PERMISSION_H

#ifdef __linux__
#define KNURL_PERMISSION_ADVICE                                                                                        \
    "copy sdk/udev/70-knurl.rules to /etc/udev/rules.d, run 'udevadm control --reload' and 'udevadm trigger', and "    \
    "plug it in again"
#else /* no rules are needed there */
#define KNURL_PERMISSION_ADVICE "end other programs that use it"
#endif

#endif
