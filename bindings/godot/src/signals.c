/* Signals of a KnurlDevice: events since the last frame. SPDX-License-Identifier: MIT */
#include "signals.h"

#include "serve.h"

#include <stdlib.h>

/* Ended contacts that were not emitted yet, oldest first. */
typedef struct ending {
    struct ending *next;
    GDObjectInstanceID device, surface; /* surface: 0 if from a file */
} ending;

static ending *endings, **last_ending = &endings;
static GDExtensionObjectPtr teller;
static void (*tell_device)(GDObjectInstanceID id);
static GDObjectInstanceID paused_tree; /* the tree whose process_frame the teller is connected to, or 0 */

/* The object of an instance id, or null, as a signal's argument. */
static gd_variant wrap_object(GDObjectInstanceID id) {
    gd_variant argument;
    const GDExtensionObjectPtr object = gd.object_get_instance_from_id(id);
    if (object) {
        return gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &object);
    }
    gd.variant_new_nil(&argument);
    return argument;
}

/* Emits a signal with an object as its argument, unless the emitter has been freed. */
static void emit_about(GDObjectInstanceID from, const char *signal, GDObjectInstanceID about) {
    const GDExtensionObjectPtr object = gd.object_get_instance_from_id(from);
    if (object) {
        gd_variant argument = wrap_object(about);
        gd_emit(object, signal, &argument, 1);
        gd.variant_destroy(&argument);
    }
}

void signals_end_contact(device *d) {
    ending *made = d->touched ? malloc(sizeof *made) : NULL;
    if (made) {
        made->next = NULL;
        made->device = gd.object_get_instance_id(d->base.object);
        made->surface = d->touched_node;
        *last_ending = made;
        last_ending = &made->next;
    } else if (d->touched) {
        gd_error("KnurlDevice.contact_ended", "KnurlDevice.contact_ended: out of memory, signal not emitted");
    }
    d->touched = 0;
    d->touched_node = 0;
}

void signals_tell_ends(void) {
    while (endings) {
        ending *first = endings;
        const ending now = *first;
        endings = now.next;
        last_ending = endings ? last_ending : &endings;
        free(first);
        emit_about(now.surface, "released", now.device);
        emit_about(now.device, "contact_ended", now.surface);
    }
}

/* Emits the surface's signal, then the device's, unless a handler of the first has ended the contact. */
static void start_contact(device *d, knurl_surface_id id) {
    const GDObjectInstanceID me = gd.object_get_instance_id(d->base.object);
    const surface *s = surface_in(d, id);
    const GDObjectInstanceID node = s ? gd.object_get_instance_id(s->base.object) : 0;
    d->touched = id;
    d->touched_node = node;
    emit_about(node, "touched", me);
    d = device_of(me);
    if (d && d->touched == id) {
        emit_about(me, "contact_started", node);
    }
}

void signals_tell_ridges(device *d, double ridges) {
    const int64_t count = (int64_t)(ridges - d->ridges);
    const surface *s = surface_of(d->touched_node);
    if (count > 0 && s) {
        const gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_OBJECT, &d->base.object),
                                         gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &count)};
        d->ridges += (double)count;
        gd_emit(s->base.object, "ridges_passed", arguments, 2);
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

int signals_tell(GDObjectInstanceID id) {
    knurl_session_event event;
    for (device *d = device_of(id); d && d->runs && knurl_session_next_event(d->session, &event); d = device_of(id)) {
        switch (event.kind) {
        case KNURL_SESSION_CONTACT_STARTED:
            start_contact(d, event.surface);
            break;
        case KNURL_SESSION_CONTACT_ENDED:
            if (event.surface == d->touched) { /* otherwise it was emitted when its node left */
                signals_end_contact(d);
                signals_tell_ends();
            }
            break;
        case KNURL_SESSION_BUTTON:
            change_button(d, &event);
            break;
        case KNURL_SESSION_FAULT:
            tell_fault(d, &event);
            break;
        default: /* the run has ended */
            return 1;
        }
    }
    return 0;
}

void signals_tell_later(GDObjectInstanceID id) {
    if (teller) {
        gd_name name = gd_name_new("tell");
        gd_variant arguments[2] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_STRING_NAME, &name),
                                   gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &id)};
        gd_variant nothing = gd_call_named(teller, "call_deferred", arguments, 2);
        gd.variant_destroy(&nothing);
        gd.variant_destroy(&arguments[0]);
        gd_name_end(&name);
    }
}

static void tell(void *self, const void *const *arguments, void *result) {
    GDObjectInstanceID id;
    (void)self;
    (void)result;
    memcpy(&id, arguments[0], sizeof id);
    signals_tell_ends();
    if (id) {
        tell_device(id);
    }
}

void signals_tell_in_pause(const device *d) {
    GDExtensionObjectPtr tree = NULL;
    if (teller && d->runs && d->tree_paused && !paused_tree) {
        gd_variant held = gd_call_named(d->base.object, "get_tree", NULL, 0);
        gd_types[GDEXTENSION_VARIANT_TYPE_OBJECT].from_variant(&tree, &held);
        gd.variant_destroy(&held);
        paused_tree = gd.object_get_instance_id(tree);
        gd_connect(tree, "process_frame", teller, "tell_in_pause");
    }
}

static void tell_in_pause(void *self, const void *const *arguments, void *result) {
    int is_paused = 0;
    (void)self;
    (void)arguments;
    (void)result;
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (devices[i] && devices[i]->tree_paused) {
            is_paused = 1;
            knurl_session_update(devices[i]->session);
            tell_device(gd.object_get_instance_id(devices[i]->base.object));
        }
    }
    const GDExtensionObjectPtr tree = gd.object_get_instance_from_id(paused_tree);
    if (!is_paused && tree) {
        gd_disconnect(tree, "process_frame", teller, "tell_in_pause");
        paused_tree = 0;
    }
}

static int init(void *self) {
    (void)self;
    return 1;
}

static void finish(void *self) {
    (void)self;
}

void signals_begin(void (*tell_news)(GDObjectInstanceID id)) {
    tell_device = tell_news;
    teller = gd_create(gd_unconst(&teller_class));
}

/* The engine skips messages to freed objects. */
void signals_end(void) {
    if (teller) {
        gd.object_destroy(teller);
    }
    teller = NULL;
    paused_tree = 0;
    while (endings) {
        ending *first = endings;
        endings = first->next;
        free(first);
    }
    last_ending = &endings;
}

static const gd_method_row methods[] = {
    {"tell", GDEXTENSION_VARIANT_TYPE_NIL, NULL, tell, 1, {{"device", GDEXTENSION_VARIANT_TYPE_INT, NULL}}},
    {"tell_in_pause", GDEXTENSION_VARIANT_TYPE_NIL, NULL, tell_in_pause, 0, {{0}}},
};

const gd_class teller_class = {
    .name = "KnurlTeller",
    .base = "Object",
    .size = sizeof(gd_instance),
    .init = init,
    .finish = finish,
    .methods = methods,
    .method_count = sizeof methods / sizeof *methods,
    .is_hidden = 1,
};
