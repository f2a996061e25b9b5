/* The extension's lists of surfaces and devices. SPDX-License-Identifier: MIT */
#include "world.h"

#include "serve.h"

device *devices[DEVICE_SLOTS];
device *placed_devices;
surface *surfaces;
static surface *last_surface;
surface *marked_surfaces;

/* Surfaces outside of a tree have no changes to pass on. */
void surface_mark(surface *s) {
    if (!s->marked_at && s->is_listed) {
        s->next_marked = marked_surfaces;
        s->marked_at = &marked_surfaces;
        if (s->next_marked) {
            s->next_marked->marked_at = &s->next_marked;
        }
        marked_surfaces = s;
    }
}

void surface_unmark(surface *s) {
    if (s->marked_at) {
        *s->marked_at = s->next_marked;
        if (s->next_marked) {
            s->next_marked->marked_at = s->marked_at;
        }
        s->next_marked = NULL;
        s->marked_at = NULL;
    }
}

void surface_list(surface *s) {
    s->previous = last_surface;
    *(last_surface ? &last_surface->next : &surfaces) = s;
    last_surface = s;
    s->is_listed = 1;
}

void surface_unlist(surface *s) {
    if (s->is_listed) {
        surface_unmark(s);
        *(s->previous ? &s->previous->next : &surfaces) = s->next;
        *(s->next ? &s->next->previous : &last_surface) = s->previous;
        s->next = s->previous = NULL;
        s->is_listed = s->is_leaving = 0;
    }
}

device *device_of(GDObjectInstanceID id) {
    return gd_instance_named(gd.object_get_instance_from_id(id), "KnurlDevice");
}

surface *surface_of(GDObjectInstanceID id) {
    return gd_instance_named(gd.object_get_instance_from_id(id), "KnurlSurface");
}

surface *surface_in(const device *d, knurl_surface_id id) {
    for (surface *s = surfaces; s; s = s->next) {
        if (s->ids[d->slot] == id) {
            return s;
        }
    }
    return NULL;
}
