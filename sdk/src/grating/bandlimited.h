/* The height of the method BANDLIMITED. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_BANDLIMITED_H
#define KNURL_SRC_BANDLIMITED_H

#include "grating/method.h"

knurl_height knurl_bandlimited_height;

#endif
