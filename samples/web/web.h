/* Shared by the worker's functions. SPDX-License-Identifier: MIT */
#ifndef KNURL_SAMPLES_WEB_H
#define KNURL_SAMPLES_WEB_H

#include <knurl/hip.h>

/* Loads and commits a .glb, and replaces *scene by it. After an error *scene stays. */
knurl_result web_read(const void *data, uint32_t size, const char *name, knurl_scene **scene);

/* Index of a surface, or -1. The last one is tried first. */
double web_find_index(const knurl_scene *scene, knurl_surface_id surface);

/* Takes a tick for actuators, if there is a voice. */
void web_voice_take(const knurl_tick_output *tick);

#endif
