/* Entry point of the extension. SPDX-License-Identifier: MIT */
#include "device.h"
#include "effect.h"
#include "register.h"
#include "signals.h"
#include "sound.h"

#include <string.h>

/* The class reference, embedded from doc_classes/ by the build: XML documents, ended by null. */
extern const char *const knurl_godot_documents[];

static const gd_class *const classes[] = {&grating_class,      &surface_class,        &device_class, &effect_class,
                                          &sound_stream_class, &sound_playback_class, &teller_class};

enum { CLASS_COUNT = sizeof classes / sizeof *classes };

static GDExtensionInterfaceGetProcAddress get_function;
static int is_registered;

static void show_documents(void) {
    GDExtensionsInterfaceEditorHelpLoadXmlFromUtf8Chars load = NULL;
    const GDExtensionInterfaceFunctionPtr found = get_function("editor_help_load_xml_from_utf8_chars");
    memcpy(&load, &found, sizeof load);
    for (const char *const *document = knurl_godot_documents; load && *document; document++) {
        load(*document);
    }
}

static void initialize(void *user, GDExtensionInitializationLevel level) {
    (void)user;
    if (level == GDEXTENSION_INITIALIZATION_SCENE && gd_load_classes()) {
        is_registered = 1;
        for (int i = 0; i < CLASS_COUNT; i++) {
            gd_register(classes[i]);
        }
        signals_begin(device_tell);
    } else if (level == GDEXTENSION_INITIALIZATION_EDITOR && is_registered) {
        show_documents();
    }
}

static void deinitialize(void *user, GDExtensionInitializationLevel level) {
    (void)user;
    if (level == GDEXTENSION_INITIALIZATION_SCENE && is_registered) {
        is_registered = 0;
        for (int i = 0; i < DEVICE_SLOTS; i++) {
            if (devices[i]) {
                device_end(devices[i]);
            }
        }
        signals_end();
        for (int i = CLASS_COUNT; i-- > 0;) {
            gd_unregister(classes[i]);
        }
    }
}

#if defined(_WIN32)
#define EXPORTED __declspec(dllexport)
#else
#define EXPORTED __attribute__((visibility("default")))
#endif

EXPORTED GDExtensionBool knurl_godot_init(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library,
                                          GDExtensionInitialization *initialization);

GDExtensionBool knurl_godot_init(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library,
                                 GDExtensionInitialization *initialization) {
    if (!gd_load(get, library)) {
        return 0;
    }
    get_function = get;
    initialization->minimum_initialization_level = GDEXTENSION_INITIALIZATION_SCENE;
    initialization->userdata = NULL;
    initialization->initialize = initialize;
    initialization->deinitialize = deinitialize;
    return 1;
}
