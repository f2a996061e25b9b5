/* The distance that a run moved in contact, and a diagnosis if it is close to zero. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_TRAVEL_H
#define KNURL_TOOL_TRAVEL_H

#include "tool.h"

#include <knurl/knurl.h>

typedef struct travel {
    double period;        /* s a tick */
    double metres;        /* moved over surfaces in contact; by the haptic thread */
    double stroke_length; /* m of the hand's stroke; 0: it does not move */
    int32_t stroke;       /* KNURL_STROKE_, or 0: a trace, or a user's hand */
} travel;

/* A tick. [haptic thread] */
void travel_add(travel *t, const knurl_tick_output *output);

/* After a whole run of `seconds`: TOOL_OK, or TOOL_NO_CONTACT after printing the reason on stderr. A hand's run of less
 * than a second is not judged: it has only just reached the surface. */
int travel_check(const travel *t, const knurl_scene *scene, knurl_surface_id surface, double seconds);

#endif
