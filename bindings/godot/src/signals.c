/* Signals of a KnurlDevice: what happened since the last frame. SPDX-License-Identifier: MIT */
#include "signals.h"

static GDExtensionObjectPtr node_of(const device *d, knurl_surface_id id) {
    for (const surface *s = surfaces; s; s = s->next) {
        if (s->ids[d->slot] == id) {
            return s->base.object;
        }
    }
    return NULL;
}

/* The device says it of the surface, and the surface of the device. */
static void emit_contact(const device *d, const char *signal, const char *own, GDExtensionObjectPtr node) {
    gd_variant argument;
    if (node) {
        const gd_variant by = gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &d->base.object);
        argument = gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &node);
        gd_emit(node, own, &by, 1);
    } else {
        gd.variant_new_nil(&argument); /* a surface of a file */
    }
    gd_emit(d->base.object, signal, &argument, 1);
    gd.variant_destroy(&argument);
}

void signals_end_contact(device *d) {
    if (d->touched) {
        const GDExtensionObjectPtr node = d->touched_node;
        d->touched = 0;
        d->touched_node = NULL;
        emit_contact(d, "contact_ended", "released", node);
    }
}

static void start_contact(device *d, knurl_surface_id id) {
    d->touched = id;
    d->touched_node = node_of(d, id);
    emit_contact(d, "contact_started", "touched", d->touched_node);
}

void signals_tell_ridges(device *d, double ridges) {
    const int64_t count = (int64_t)(ridges - d->ridges);
    if (count > 0 && d->touched_node) {
        const gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &d->base.object),
                                         gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &count)};
        d->ridges += (double)count;
        gd_emit(d->touched_node, "ridges_passed", arguments, 2);
    } else if (count > 0) {
        d->ridges = ridges;
    }
}

void signals_tell_failure(const device *d, int64_t error, const char *why) {
    gd_string string;
    gd.string_new_with_utf8_chars(&string, why);
    gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &error),
                               gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string)};
    gd_emit(d->base.object, "start_failed", arguments, 2);
    gd.variant_destroy(&arguments[1]);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
}

static void change_button(const device *d, const knurl_session_event *event) {
    const int64_t index = event->code;
    const uint8_t pressed = event->value != 0.0;
    gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &index),
                               gd_wrap(GDEXTENSION_VARIANT_TYPE_BOOL, &pressed)};
    gd_emit(d->base.object, "button_changed", arguments, 2);
}

static void tell_fault(const device *d, const knurl_session_event *event) {
    char text[256];
    gd_string string;
    const int64_t code = event->code;
    knurl_session_fault_text(event->code, event->value, text, sizeof text);
    gd.string_new_with_utf8_chars(&string, text);
    gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &code),
                               gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING, &string)};
    gd_emit(d->base.object, "fault", arguments, 2);
    gd.variant_destroy(&arguments[1]);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&string);
}

int signals_tell(device *d) {
    knurl_session_event event;
    while (d->runs && knurl_session_next_event(d->session, &event)) {
        switch (event.kind) {
        case KNURL_SESSION_CONTACT_STARTED:
            start_contact(d, event.surface);
            break;
        case KNURL_SESSION_CONTACT_ENDED:
            if (event.surface == d->touched) { /* else it was told when its node left */
                signals_end_contact(d);
            }
            break;
        case KNURL_SESSION_BUTTON:
            change_button(d, &event);
            break;
        case KNURL_SESSION_FAULT:
            tell_fault(d, &event);
            break;
        default: /* it has ended */
            return 1;
        }
    }
    return 0;
}
