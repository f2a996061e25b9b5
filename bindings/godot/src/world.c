/* Surfaces and devices as the extension knows them. SPDX-License-Identifier: MIT */
#include "world.h"

device *devices[DEVICE_SLOTS];
surface *surfaces;
surface *marked_surfaces;

/* Surfaces outside of a tree have nothing to tell. */
void surface_mark(surface *s) {
    if (!s->is_marked && (s->previous || surfaces == s)) {
        s->is_marked = 1;
        s->next_marked = marked_surfaces;
        marked_surfaces = s;
    }
}
