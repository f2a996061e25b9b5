/* Sets up the fake device's stroke or trace for a scene. SPDX-License-Identifier: MIT */
#ifndef KNURL_TOOL_STROKE_H
#define KNURL_TOOL_STROKE_H

#include <knurl/knurl.h>

/* s: the longest run, a day. */
#define RUN_SECONDS_MAX 86400.0

/* If the surface is outside the workspace, moves the workspace to it and prints a note on stderr. TOOL_ codes.
 */
int stroke_place(knurl_scene *scene, knurl_device *device, knurl_surface_id surface);

/* The same, and the fake device's hand strokes the surface, 1 mm below it (knurl_fake_lay_stroke()).
 * *length: m from one end to the other, or once round; 0 if it does not move. TOOL_ codes. */
int stroke_lay(knurl_scene *scene, knurl_device *device, knurl_surface_id surface, int32_t stroke, double *length);

/* Plays a CSV of t,x,y,z in scene metres; *last_t: the time of its last row, s. TOOL_ codes. */
int stroke_play(knurl_scene *scene, knurl_device *device, const char *path, double *last_t);

#endif
