/* The heights of the paper's methods. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_PAPER_H
#define KNURL_SRC_PAPER_H

#include "grating/method.h"

knurl_height knurl_s1_height, knurl_s2_height;

#endif
