/* Whether a run felt anything: how far it moved in contact, and what to say where that is next to nothing.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_FELT_H
#define KNURL_TOOL_FELT_H

#include "tool.h"

#include <knurl/knurl.h>

typedef struct felt {
    double period;        /* s a tick */
    double metres;        /* moved over surfaces in contact; by the haptic thread */
    double stroke_length; /* m of the hand's stroke; 0: it stays where it is */
    int32_t stroke;       /* KNURL_STROKE_, or 0: a trace, or somebody's hand */
} felt;

/* A tick. [haptic thread] */
void felt_take(felt *f, const knurl_tick_output *output);

/* After a whole run of `seconds`: TOOL_OK, or TOOL_NOTHING_FELT having said why on stderr. A run of less than a second
 * is not judged: its hand has only just come down. */
int felt_judge(const felt *f, const knurl_scene *scene, knurl_surface_id surface, double seconds);

#endif
