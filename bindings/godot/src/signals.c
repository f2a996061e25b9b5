/* Signals of a KnurlDevice: what happened since the last frame. Any of their handlers may stop the device.
 * SPDX-License-Identifier: MIT */
#include "world.h"

#include <stdio.h>
#include <string.h>

static GDExtensionObjectPtr node_of(const device *d, knurl_surface id) {
    for (const surface *s = surfaces; s; s = s->next) {
        if (s->ids[d->slot] == id) {
            return s->base.object;
        }
    }
    return NULL;
}

static void emit_contact(const device *d, const char *signal, GDExtensionObjectPtr node) {
    gd_variant argument;
    if (node) {
        argument = gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &node);
    } else {
        gd.variant_new_nil(&argument); /* a surface of a file */
    }
    gd_emit(d->base.object, signal, &argument, 1);
    gd.variant_destroy(&argument);
}

void signals_let_go(device *d) {
    if (d->touched) {
        const GDExtensionObjectPtr node = d->touched_node;
        d->touched = 0;
        d->touched_node = NULL;
        emit_contact(d, "contact_ended", node);
    }
}

static void touch(device *d, knurl_surface id) {
    signals_let_go(d);
    const char *name;
    if (id && d->loop && !knurl_scene_surface_name(d->scene, id, &name)) {
        d->touched = id;
        d->touched_node = node_of(d, id);
        emit_contact(d, "contact_started", d->touched_node);
    }
}

/* A touch shorter than a frame is told as well; what comes back within a frame was never away. */
static void tell_contacts(device *d) {
    knurl_surface met[BOARD_CHANGES];
    knurl_tick_output now;
    const uint32_t count = board_changes(d->board, met);
    board_tick sent;
    if (knurl_scene_get_tick(d->scene, 0, &now, NULL)) {
        return;
    }
    board_read(d->board, &sent);
    const char *name; /* a tick may lag behind a removal */
    const int is_there =
        !(now.flags & KNURL_TICK_ABSENT) && sent.surface && !knurl_scene_surface_name(d->scene, sent.surface, &name);
    const knurl_surface last = is_there ? sent.surface : 0;
    for (uint32_t i = 0; i < count && d->loop; i++) {
        int is_new = met[i] != 0 && met[i] != d->touched && met[i] != last;
        for (uint32_t j = 0; j < i; j++) {
            is_new = is_new && met[j] != met[i];
        }
        if (is_new) {
            touch(d, met[i]);
        }
    }
    if (d->loop && last != d->touched) {
        touch(d, last);
    }
}

static void tell_buttons(device *d) {
    knurl_device_status status;
    knurl_device_status_init(&status, sizeof status);
    if (!d->loop || knurl_device_get_status(d->device, &status)) {
        return;
    }
    const uint32_t before = d->buttons;
    d->buttons = status.buttons;
    for (int64_t i = 0; i < 32 && d->loop; i++) {
        const uint8_t pressed = status.buttons >> i & 1;
        if ((before >> i & 1) != pressed) {
            gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &i),
                                       gd_wrap(GDEXTENSION_VARIANT_TYPE_BOOL, &pressed)};
            gd_emit(d->base.object, "button_changed", arguments, 2);
        }
    }
}

static void tell_faults(device *d) {
    knurl_device_event event;
    while (d->loop && knurl_device_next_event(d->device, &event)) {
        char text[256];
        gd_string string;
        const int64_t code = event.code;
        const char *sentence = knurl_fault_string(event.code);
        const int length = snprintf(text, sizeof text, "%s", sentence);
        const char *unit = knurl_fault_unit(event.code);
        if (*unit && length > 0 && (size_t)length < sizeof text) {
            (void)snprintf(text + length, sizeof text - (size_t)length, " (%g %s)", event.value, unit);
        }
        gd.string_new_with_utf8_chars(&string, text);
        gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &code),
                                   gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string)};
        gd_emit(d->base.object, "fault", arguments, 2);
        gd.variant_destroy(&arguments[1]);
        gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
    }
}

void signals_tell(device *d) {
    tell_contacts(d);
    tell_buttons(d);
    tell_faults(d);
}
