/* Functions that Unity calls when it loads and unloads the plugin. Without these calls the plugin works, too, but
 * without log and profiler. All of it runs on the game thread; the haptic thread never calls the engine.
 * SPDX-License-Identifier: MIT */
#include "knurl_unity.h"

#include "unity_abi.h"

#include <stdio.h>

KNURL_API void UNITY_CALL UnityPluginLoad(const unity_interfaces *interfaces);
KNURL_API void UNITY_CALL UnityPluginUnload(void);

static const unity_log *engine_log;
static const unity_profiler *profiler;
static const unity_marker *update_marker; /* null: there is no profiler to show it */

static void forget_engine(void) {
    engine_log = NULL;
    profiler = NULL;
    update_marker = NULL;
}

/* Unity may call it more than once; the last interfaces are used. */
void UNITY_CALL UnityPluginLoad(const unity_interfaces *interfaces) {
    forget_engine();
    if (!interfaces || !interfaces->get_interface_split) {
        return;
    }
    engine_log = interfaces->get_interface_split(UNITY_LOG_HIGH, UNITY_LOG_LOW);
    profiler = interfaces->get_interface_split(UNITY_PROFILER_HIGH, UNITY_PROFILER_LOW);
    if (!profiler || !profiler->is_available() ||
        profiler->create_marker(&update_marker, "Knurl.Update", UNITY_PROFILER_SCRIPTS, UNITY_MARKER_DEFAULT, 0) != 0) {
        update_marker = NULL;
    }
}

/* A haptic thread must not outlive the code that it runs. */
void UNITY_CALL UnityPluginUnload(void) {
    const uint32_t running = knurl_session_close_all();
    if (running > 0 && engine_log) {
        char text[128];
        (void)snprintf(text, sizeof text, "Knurl: the plugin was unloaded while devices ran (%u): they were closed",
                       (unsigned)running);
        engine_log->log(UNITY_LOG_WARNING, text, "plugin.c", __LINE__);
    }
    forget_engine();
}

void knurl_unity_update(knurl_session *session) {
    if (!update_marker) {
        knurl_session_update(session);
        return;
    }
    profiler->emit_event(update_marker, UNITY_BEGIN, 0, NULL);
    knurl_session_update(session);
    profiler->emit_event(update_marker, UNITY_END, 0, NULL);
}
