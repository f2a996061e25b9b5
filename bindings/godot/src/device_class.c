/* KnurlDevice as the engine sees it: properties, methods, signals. SPDX-License-Identifier: MIT */
#include "device.h"
#include "device_state.h"
#include "explain.h"
#include "ray.h"
#include "rumble.h"
#include "signals.h"
#include "sound.h"
#include "status.h"
#include "trace.h"
#include "warnings.h"

#include <knurl/gltf.h>
#include <knurl/vibration.h>

#include <stdlib.h>
#include <string.h>

static char *copy(const char *text) {
    char *made = malloc(strlen(text) + 1);
    if (made) {
        memcpy(made, text, strlen(text) + 1);
    }
    return made;
}

static int init(void *self) {
    device *d = self;
    d->uri = copy("fake");
    d->stroke = copy("");
    d->response = copy("");
    d->rate = 1000.0;
    d->workspace_scale = d->gain = 1.0;
    d->layers = 1;
    d->rumble = -1;
    d->autostart = d->reconnect = d->clamp = 1;
    d->slot = -1;
    return d->uri && d->stroke && d->response;
}

static void finish(void *self) {
    device *d = self;
    device_release(d);
    knurl_session_destroy(d->session);
    free(d->uri);
    free(d->stroke);
    free(d->response);
}

static void set_processing(device *d, uint8_t on) {
    gd_call(gd_method.Node_set_process_internal, d->base.object, &on, NULL);
}

static void pause(void *self) {
    const device *d = self;
    if (d->session) {
        knurl_session_set_paused(d->session, d->paused || d->tree_paused);
    }
}

static void explain_anew(void *self) {
    const device *d = self;
    if (gd_is_in_editor()) {
        warnings_refresh(&d->base);
        warnings_refresh_all();
    }
}

static void change_scale(void *self) {
    device *d = self;
    d->moved = 1; /* applied in the next frame, like the node's moves */
    explain_anew(d);
}

static void change_gain(void *self) {
    const device *d = self;
    if (d->session) {
        (void)knurl_session_set_gain(d->session, d->gain);
    }
}

static void change_force(void *self) {
    device_apply_force(self);
}

static void change_clutch(void *self) {
    device *d = self;
    if (d->runs && !d->is_leaving) {
        device_move_workspace(d); /* a scale set while the clutch is on zooms about the HIP */
        (void)knurl_session_set_clutch(d->session, d->clutch);
    }
}

static void change_sound(void *self, const void *value) {
    device *d = self;
    sound_stop(d);
    memcpy(&d->sound, value, sizeof d->sound);
    device_apply_sound(d);
}

static void change_rumble(void *self, const void *value) {
    device *d = self;
    rumble_stop(d);
    memcpy(&d->rumble, value, sizeof d->rumble);
}

static void get_rumble(void *self, void *value) {
    memcpy(value, &((const device *)self)->rumble, sizeof(int64_t));
}

static void get_sound(void *self, void *value) {
    *(uint8_t *)value = ((const device *)self)->sound;
}

static void change_layers(void *self) {
    device *d = self;
    explain_anew(d);
    if (d->runs) {
        device_put_surfaces(d);
    }
}

static void place(device *d) {
    const uint8_t notify = 1;
    d->next_placed = placed_devices;
    placed_devices = d;
    gd_call(gd_method.Node3D_set_notify_transform, d->base.object, &notify, NULL);
    explain_anew(d);
}

static void unplace(const device *d) {
    device **at = &placed_devices;
    while (*at && *at != d) {
        at = &(*at)->next_placed;
    }
    if (*at) {
        *at = d->next_placed;
    }
}

/* Only in a game. It starts in its first frame, when the scene is complete; a device that was reparented within a frame
 * keeps running. */
static void enter(device *d) {
    d->has_failed = 0;
    d->retries_in = 0.0;
    d->wants_start = d->autostart && !d->runs;
    set_processing(d, 1);
    if (d->is_leaving) {
        d->is_leaving = 0;
        d->moved = 1;
        device_apply_sound(d); /* its player left the tree with it, and stopped */
    }
}

static void get_warnings(void *self, const void *const *arguments, void *result) {
    char text[512];
    (void)arguments;
    explain_device(self, text, sizeof text);
    warnings_append(text, result);
}

static void notify(void *self, int32_t what) {
    device *d = self;
    switch (what) {
    case GD_ENTER_TREE:
        place(d);
        if (!gd_is_in_editor()) {
            enter(d);
        }
        break;
    case GD_EXIT_TREE:
        unplace(d);
        device_leave(d);
        break;
    case GD_PREDELETE:
        device_end(d);
        signals_tell_later(0);
        break;
    case GD_TRANSFORM_CHANGED:
        d->moved = 1;
        gd_call(gd_method.Engine_is_in_physics_frame, gd_engine, NULL, &d->by_physics);
        explain_anew(d);
        break;
    case GD_PAUSED:
    case GD_UNPAUSED:
        d->tree_paused = what == GD_PAUSED;
        pause(d);
        signals_tell_in_pause(d);
        break;
    case GD_INTERNAL_PROCESS:
        device_process(d);
        break;
    default:
        break;
    }
}

static void start(void *self, const void *const *arguments, void *result) {
    (void)arguments;
    *(int64_t *)result = device_start(self);
}

static void stop(void *self, const void *const *arguments, void *result) {
    (void)arguments;
    (void)result;
    device_stop(self);
}

static void move_hip(void *self, const void *const *arguments, void *result) {
    device *d = self;
    const float *given = arguments[0];
    const double global[3] = {(double)given[0], (double)given[1], (double)given[2]};
    (void)result;
    if (d->runs) {
        (void)knurl_session_move_hip(d->session, global); /* other devices are moved by a hand */
    }
}

static void vibrate(void *self, const void *const *arguments, void *result) {
    device *d = self;
    int64_t method;
    double numbers[3]; /* Hz, N, s */
    const float *given = arguments[4];
    const double direction[3] = {(double)given[0], (double)given[1], (double)given[2]};
    (void)result;
    memcpy(&method, arguments[0], sizeof method);
    for (int i = 0; i < 3; i++) {
        memcpy(&numbers[i], arguments[1 + i], sizeof numbers[i]);
    }
    const knurl_result failed = device_make_session(d) || knurl_session_vibrate(d->session, (int32_t)method, numbers[0],
                                                                                numbers[1], direction, numbers[2]);
    if (failed) {
        (void)device_fail("KnurlDevice.vibrate", KNURL_ERROR_ARGUMENT);
    }
}

static void get_history(void *self, const void *const *arguments, void *result) {
    const device *d = self;
    int64_t count;
    int64_t ignored = 0;
    memcpy(&count, arguments[0], sizeof count);
    count = count < 0 || !d->runs ? 0 : count > KNURL_SESSION_HISTORY ? KNURL_SESSION_HISTORY : count;
    int64_t size = 2 * count;
    const void *given[1] = {&size};
    gd_builtin.PACKED_FLOAT32_ARRAY_resize(result, given, &ignored, 1);
    if (count > 0) {
        size = 2 * (int64_t)knurl_session_get_history(d->session, (uint32_t)count,
                                                      gd.packed_float32_array_operator_index(result, 0));
        gd_builtin.PACKED_FLOAT32_ARRAY_resize(result, given, &ignored, 1);
    }
}

/* Converts a project path to a path on disk; the caller frees it. Null: out of memory. */
static char *globalise(const void *path) {
    gd_name name = gd_name_new("ProjectSettings");
    gd_string global;
    gd.string_new_with_utf8_chars(&global, "");
    gd_call(gd_method.ProjectSettings_globalize_path, gd.global_get_singleton(&name), path, &global);
    char *text = gd_string_copy(&global);
    gd_types[GDEXTENSION_VARIANT_TYPE_STRING].end(&global);
    gd_name_end(&name);
    return text;
}

static void warn_of_tag(void *user, const char *message) {
    gd_warning("KnurlDevice.load_gltf", "KnurlDevice.load_gltf: %s: %s", (const char *)user, message);
}

static void load_gltf(void *self, const void *const *arguments, void *result) {
    device *d = self;
    knurl_gltf_options options;
    knurl_gltf_report report;
    int64_t count = -1;
    char *path = globalise(arguments[0]);
    knurl_gltf_options_init(&options, sizeof options);
    options.wrong_tag = warn_of_tag;
    options.user = path;
    knurl_gltf_report_init(&report, sizeof report);
    knurl_result failed = path ? device_make_session(d) : knurl_fail(KNURL_ERROR_MEMORY, "no memory for a path");
    failed = failed ? failed : knurl_gltf_load_file(knurl_session_get_scene(d->session), path, &options, &report);
    if (failed) {
        (void)device_fail("KnurlDevice.load_gltf", failed);
    } else {
        count = (int64_t)report.surfaces;
    }
    free(path);
    memcpy(result, &count, sizeof count);
}

#define FLOAT   GDEXTENSION_VARIANT_TYPE_FLOAT
#define INT     GDEXTENSION_VARIANT_TYPE_INT
#define BOOL    GDEXTENSION_VARIANT_TYPE_BOOL
#define STRING  GDEXTENSION_VARIANT_TYPE_STRING
#define VECTOR3 GDEXTENSION_VARIANT_TYPE_VECTOR3
#define OBJECT  GDEXTENSION_VARIANT_TYPE_OBJECT
#define NOTHING GDEXTENSION_VARIANT_TYPE_NIL
#define FLOATS  GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT32_ARRAY
#define DOUBLES GDEXTENSION_VARIANT_TYPE_PACKED_FLOAT64_ARRAY

static const gd_property properties[] = {
    {.name = "device",
     .type = STRING,
     .offset = offsetof(device, uri),
     .hint = GD_HINT_SUGGESTIONS,
     .hints = "auto,mouse,fake,touch,falcon,rawhid,serial,dhd,inverse3",
     .changed = explain_anew},
    {.name = "stroke",
     .type = STRING,
     .offset = offsetof(device, stroke),
     .hint = GD_HINT_ENUM,
     .hints = ",line,sweep,circle,press,rest"},
    {.name = "autostart", .type = BOOL, .offset = offsetof(device, autostart)},
    {.name = "sound", .type = BOOL, .get = get_sound, .set = change_sound},
    {"rumble", INT, 0, -1.0, 15.0, 1.0, NULL, 0, get_rumble, change_rumble, NULL},
    {"layers", INT, offsetof(device, layers), 0.0, 255.0, 1.0, "1,2,3,4,5,6,7,8", GD_HINT_FLAGS, NULL, NULL,
     change_layers},
    {.name = "Workspace"},
    {"workspace_scale", FLOAT, offsetof(device, workspace_scale), 0.001, 100.0, 0.001, "or_greater,exp", 0, NULL, NULL,
     change_scale},
    {.name = "clutch", .type = BOOL, .offset = offsetof(device, clutch), .changed = change_clutch},
    {.name = "Force"},
    {"gain", FLOAT, offsetof(device, gain), 0.0, 1.0, 0.01, NULL, 0, NULL, NULL, change_gain},
    {.name = "added_force", .type = VECTOR3, .offset = offsetof(device, added_force), .changed = change_force},
    {.name = "clamp", .type = BOOL, .offset = offsetof(device, clamp)},
    {.name = "even_sensation", .type = BOOL, .offset = offsetof(device, even)},
    {.name = "response_file",
     .type = STRING,
     .offset = offsetof(device, response),
     .hint = GD_HINT_FILE,
     .hints = "*.csv"},
    {.name = "paused", .type = BOOL, .offset = offsetof(device, paused), .changed = pause},
    {.name = "Connection"},
    {"rate", FLOAT, offsetof(device, rate), 100.0, 10000.0, 1.0, "suffix:Hz", 0, NULL, NULL, explain_anew},
    {"retry", FLOAT, offsetof(device, retry), 0.0, 60.0, 0.1, "or_greater,suffix:s", 0, NULL, NULL, NULL},
    {.name = "reconnect", .type = BOOL, .offset = offsetof(device, reconnect)},
    {.name = "State"}, /* of a running game */
    {.name = "hip_position", .type = VECTOR3, .get = device_get_hip_position},
    {.name = "proxy_position", .type = VECTOR3, .get = device_get_proxy_position},
    {.name = "force", .type = VECTOR3, .get = device_get_force},
    {.name = "running", .type = BOOL, .get = device_get_running},
    {.name = "in_contact", .type = BOOL, .get = device_get_in_contact},
    {.name = "velocity", .type = VECTOR3, .get = device_get_velocity},
    {.name = "depth", .type = FLOAT, .get = device_get_depth},
    {.name = "buttons", .type = INT, .get = device_get_buttons},
    {.name = "stylus_rotation", .type = GDEXTENSION_VARIANT_TYPE_QUATERNION, .get = device_get_stylus_rotation},
    {.name = "temporal_frequency", .type = FLOAT, .get = device_get_temporal_frequency},
    {.name = "height", .type = FLOAT, .get = device_get_height},
    {.name = "device_name", .type = STRING, .get = device_get_device_name},
    {.name = "ticks", .type = INT, .get = device_get_ticks},
    {.name = "overruns", .type = INT, .get = device_get_overruns},
};

static const gd_method_row methods[] = {
    {"get_warnings", GDEXTENSION_VARIANT_TYPE_PACKED_STRING_ARRAY, NULL, get_warnings, 0, {{0}}},
    {"start", INT, "Error", start, 0, {{0}}},
    {"list_devices", GDEXTENSION_VARIANT_TYPE_ARRAY, NULL, status_list, 0, {{0}}},
    {"get_touched_surface", OBJECT, "KnurlSurface", device_get_touched, 0, {{0}}},
    {"stop", NOTHING, NULL, stop, 0, {{0}}},
    {"move_hip", NOTHING, NULL, move_hip, 1, {{"global_position", VECTOR3, NULL}}},
    {"vibrate",
     NOTHING,
     NULL,
     vibrate,
     5,
     {{"method", INT, "KnurlDevice.Vibration"},
      {"frequency", FLOAT, NULL},
      {"amplitude", FLOAT, NULL},
      {"duration", FLOAT, NULL},
      {"direction", VECTOR3, NULL}}},
    {"get_history", FLOATS, NULL, get_history, 1, {{"count", INT, NULL}}},
    {"load_gltf", INT, NULL, load_gltf, 1, {{"path", STRING, NULL}}},
    {"cast_ray",
     GDEXTENSION_VARIANT_TYPE_DICTIONARY,
     NULL,
     ray_cast,
     2,
     {{"from", VECTOR3, NULL}, {"to", VECTOR3, NULL}}},
    {"play_trace", DOUBLES, NULL, trace_play, 2, {{"rows", DOUBLES, NULL}, {"ticks", INT, NULL}}},
    {"get_status", GDEXTENSION_VARIANT_TYPE_DICTIONARY, NULL, status_tell, 0, {{0}}},
};

static const gd_signal_row signals[] = {
    {"contact_started", 1, {{"surface", OBJECT, "KnurlSurface"}}},
    {"contact_ended", 1, {{"surface", OBJECT, "KnurlSurface"}}},
    {"button_changed", 2, {{"index", INT, NULL}, {"pressed", BOOL, NULL}}},
    {"start_failed", 2, {{"error", INT, NULL}, {"text", STRING, NULL}}},
    {"fault", 2, {{"code", INT, NULL}, {"text", STRING, NULL}}},
};

static const gd_constant_row constants[] = {{"Vibration", "VIBRATION_T1", KNURL_WAVE_T1},
                                            {"Vibration", "VIBRATION_T2", KNURL_WAVE_T2},
                                            {"Vibration", "VIBRATION_T3", KNURL_WAVE_T3},
#define FAULT_ROW(code, number, name, text, unit) {"Fault", &#code[sizeof "KNURL_" - 1], number},
                                            KNURL_FAULTS(FAULT_ROW)
#undef FAULT_ROW
};

const gd_class device_class = {
    .name = "KnurlDevice",
    .base = "Node3D",
    .size = sizeof(device),
    .init = init,
    .finish = finish,
    .notify = notify,
    .warnings = get_warnings,
    .properties = properties,
    .property_count = sizeof properties / sizeof *properties,
    .methods = methods,
    .method_count = sizeof methods / sizeof *methods,
    .signals = signals,
    .signal_count = sizeof signals / sizeof *signals,
    .constants = constants,
    .constant_count = sizeof constants / sizeof *constants,
};
