/* knurl run --view: serves the browser page and the ticks of a run on 127.0.0.1. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_VIEW_H
#define KNURL_TOOL_VIEW_H

#include <knurl/hip.h>
#include <knurl/query.h>

/* Doubles that a tick has in a message: force (3), HIP (3), proxy (3), depth, height, f_t, cycles (2), 1 in contact,
 * surface index or -1, t, vx, vy, fs, normal (3); the same as in samples/web/web.c. */
#define VIEW_ROW 23

typedef struct view view;

typedef struct view_desc {
    const knurl_scene *scene;
    const char *file;   /* of the scene */
    const char *page;   /* the folder that ./run web fills; it may be missing */
    const char *device; /* its name */
    double rate;        /* ticks per second */
} view_desc;

/* Starts a thread that serves. The desc's scene and file must stay valid until view_close(), its page and device need
 * not. TOOL_OK, or
 * TOOL_FAILURE after printing the reason. */
int view_open(const view_desc *desc, view **opened);

/* The URL to open in a browser. */
const char *view_url(const view *v);

/* Passes a tick on; never waits for a viewer. [haptic thread] */
void view_take(view *v, const knurl_tick_output *output);

/* Ends the thread and disconnects every viewer; reports the number of dropped ticks. Null is allowed. Call it after the
 * last view_take(). */
void view_close(view *v);

#endif
