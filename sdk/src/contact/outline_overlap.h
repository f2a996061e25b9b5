/* Tests whether an outline goes around its sheet exactly once. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_OUTLINE_OVERLAP_H
#define KNURL_SRC_OUTLINE_OVERLAP_H

#include "contact/plane.h"

/* 1 if no two edges cross by more than the limit (m), and no edge has the sheet on both sides or twice on one. */
int knurl_outline_is_simple(const knurl_plane *plane, double limit);

#endif
