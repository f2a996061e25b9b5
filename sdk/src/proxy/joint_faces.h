/* Contact with all faces nearby at once, of any surface. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_JOINT_FACES_H
#define KNURL_SRC_JOINT_FACES_H

#include "proxy/joint_search.h"

/* Finds contact with all faces nearby, by a god-object that moves from the last tick's proxy towards the HIP. Needs
 * knurl_joint_collect_all() first. Sets the search's results, or `unknown`. Adds to *flags: KNURL_TICK_SQUEEZED. */
void knurl_joint_search_faces(knurl_joint_search *search, uint32_t *flags) KNURL_NONBLOCKING;

#endif
