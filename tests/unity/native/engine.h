/* A stand-in for Unity's plugin interface: it provides interfaces, and records logs and markers. And the plugin as
 * loaded by Unity and C#: a library with functions by name. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_UNITY_ENGINE_H
#define KNURL_TEST_UNITY_ENGINE_H

#include "support/close.h"

#include "base/system.h"
#include "knurl_unity.h"
#include "unity_abi.h"

#include <stdio.h>

#define ENGINE_EVENTS 4096

struct unity_marker {
    char name[64];
    int category;
    int flags;
};

typedef struct engine_event {
    const unity_marker *marker;
    int event;
    uintptr_t thread;
} engine_event;

/** The engine's interfaces, and the recorded calls. */
static struct engine {
    int without_log, without_profiler, unavailable, refuses_markers;
    unity_marker marker;
    int markers; /* created */
    engine_event events[ENGINE_EVENTS];
    int event_count;
    void (*at_event)(int event); /* or null */
    int log_type;
    int log_count;
    char log_text[512];
} engine;

static void UNITY_CALL engine_log(int type, const char *message, const char *file, int line) {
    assert_non_null(file);
    assert_true(line > 0);
    assert_null(strpbrk(file, "/\\")); /* no folders of a developer */
    engine.log_type = type;
    engine.log_count++;
    (void)snprintf(engine.log_text, sizeof engine.log_text, "%s", message);
}

static void UNITY_CALL engine_emit(const unity_marker *marker, uint16_t event, uint16_t data_count, const void *data) {
    assert_int_equal(data_count, 0);
    assert_null(data);
    assert_true(engine.event_count < ENGINE_EVENTS);
    engine.events[engine.event_count++] = (engine_event){marker, event, knurl_system_thread_id()};
    if (engine.at_event) {
        engine.at_event(event);
    }
}

static int UNITY_CALL engine_is_available(void) {
    return !engine.unavailable;
}

static int UNITY_CALL engine_create_marker(const unity_marker **marker, const char *name, uint16_t category,
                                           uint16_t flags, int data_count) {
    assert_int_equal(data_count, 0);
    assert_true(strlen(name) < sizeof engine.marker.name);
    engine.markers++;
    *marker = &engine.marker; /* also if it then fails */
    memcpy(engine.marker.name, name, strlen(name) + 1);
    engine.marker.category = category;
    engine.marker.flags = flags;
    return engine.refuses_markers;
}

static void *UNITY_CALL engine_get(unsigned long long high, unsigned long long low) {
    static unity_log log = {engine_log};
    static unity_profiler profiler = {engine_emit, engine_is_available, engine_is_available, engine_create_marker};
    if (high == 0x9E7507FA5B444D5DULL && low == 0x92FB979515EA83FCULL && !engine.without_log) {
        return &log;
    }
    if (high == 0x2CE79ED8316A4833ULL && low == 0x87076B2013E1571FULL && !engine.without_profiler) {
        return &profiler;
    }
    return NULL;
}

static const unity_interfaces engine_interfaces = {NULL, NULL, engine_get, NULL};

/** The plugin's functions. */
typedef struct plugin {
    knurl_library *library;
    void(UNITY_CALL *UnityPluginLoad)(const unity_interfaces *);
    void(UNITY_CALL *UnityPluginUnload)(void);
    void (*knurl_unity_update)(knurl_session *);
    uint32_t (*knurl_unity_layout)(uint32_t, knurl_unity_layout_row *);
    const char *(*knurl_unity_interface)(void);
    const char *(*knurl_error_message)(void);
    void (*knurl_session_desc_init)(knurl_session_desc *, uint32_t);
    knurl_result (*knurl_session_create)(knurl_session **);
    void (*knurl_session_destroy)(knurl_session *);
    knurl_scene *(*knurl_session_get_scene)(knurl_session *);
    knurl_result (*knurl_session_open)(knurl_session *, const knurl_session_desc *);
    knurl_result (*knurl_session_start)(knurl_session *, char *, uint32_t);
    void (*knurl_session_close)(knurl_session *);
    uint32_t (*knurl_session_next_event)(knurl_session *, knurl_session_event *);
    void (*knurl_session_get_state)(const knurl_session *, knurl_session_state *);
    knurl_result (*knurl_gltf_load_file)(knurl_scene *, const char *, const void *, void *);
} plugin;

#define PLUGIN_FIND(name) assert_int_equal(knurl_system_find_function(p.library, #name, &p.name), 1)

/** Opens the library, before UnityPluginLoad(). */
static inline plugin plugin_open(void) {
    plugin p;
    char why[256] = "";
    memset(&p, 0, sizeof p);
    p.library = knurl_system_load_library(KNURL_TEST_PLUGIN, why, sizeof why);
    assert_string_equal(why, "");
    assert_non_null(p.library);
    PLUGIN_FIND(UnityPluginLoad);
    PLUGIN_FIND(UnityPluginUnload);
    PLUGIN_FIND(knurl_unity_update);
    PLUGIN_FIND(knurl_unity_layout);
    PLUGIN_FIND(knurl_unity_interface);
    PLUGIN_FIND(knurl_error_message);
    PLUGIN_FIND(knurl_session_desc_init);
    PLUGIN_FIND(knurl_session_create);
    PLUGIN_FIND(knurl_session_destroy);
    PLUGIN_FIND(knurl_session_get_scene);
    PLUGIN_FIND(knurl_session_open);
    PLUGIN_FIND(knurl_session_start);
    PLUGIN_FIND(knurl_session_close);
    PLUGIN_FIND(knurl_session_next_event);
    PLUGIN_FIND(knurl_session_get_state);
    PLUGIN_FIND(knurl_gltf_load_file);
    return p;
}

static inline void plugin_close(plugin *p) {
    knurl_system_unload_library(p->library);
}

/** A session of the plugin's whose haptic thread runs. */
static inline knurl_session *plugin_run(const plugin *p) {
    knurl_session *session = NULL;
    knurl_session_desc desc;
    char warning[256];
    p->knurl_session_desc_init(&desc, sizeof desc);
    desc.heartbeat_s = 0.05;
    assert_int_equal(p->knurl_session_create(&session), KNURL_OK);
    assert_int_equal(p->knurl_session_open(session, &desc), KNURL_OK);
    assert_int_equal(p->knurl_session_start(session, warning, sizeof warning), KNURL_OK);
    return session;
}

static inline knurl_session_state plugin_state(const plugin *p, const knurl_session *session) {
    knurl_session_state state;
    p->knurl_session_get_state(session, &state);
    return state;
}

#endif
