/* A KnurlDevice's life: open, run, stop. SPDX-License-Identifier: MIT */
#include "world.h"

#include <stdlib.h>
#include <string.h>

/* s: a game that gives no sign of life for so long is not to hold anybody's hand. */
#define HEARTBEAT 0.25

device *devices[DEVICE_SLOTS];

int64_t device_fail(const char *where, knurl_result result) {
    enum {
        FAILED = 1,
        UNAVAILABLE = 2,
        UNCONFIGURED = 3,
        UNAUTHORIZED = 4,
        OUT_OF_MEMORY = 6,
        FILE_CANT_READ = 14,
        FILE_CORRUPT = 16,
        CANT_CONNECT = 25,
        INVALID_PARAMETER = 31
    };
    gd_error(where, "%s: %s", where, knurl_error_message());
    switch (result) {
    case KNURL_ERROR_ARGUMENT:
    case KNURL_ERROR_UNKNOWN:
        return INVALID_PARAMETER;
    case KNURL_ERROR_STATE:
        return UNCONFIGURED;
    case KNURL_ERROR_MEMORY:
        return OUT_OF_MEMORY;
    case KNURL_ERROR_UNSUPPORTED:
        return UNAVAILABLE;
    case KNURL_ERROR_IO:
        return FILE_CANT_READ;
    case KNURL_ERROR_FORMAT:
        return FILE_CORRUPT;
    case KNURL_ERROR_DEVICE_LOST:
    case KNURL_ERROR_DEVICE_NOT_READY:
        return CANT_CONNECT;
    case KNURL_ERROR_SYSTEM:
        return UNAUTHORIZED;
    default:
        return FAILED;
    }
}

static knurl_result take_slot(device *d) {
    for (int i = 0; i < DEVICE_SLOTS; i++) {
        if (!devices[i]) {
            devices[i] = d;
            d->slot = i;
            return KNURL_OK;
        }
    }
    return knurl_fail(KNURL_ERROR_FULL, "expected at most %d devices that run at once", DEVICE_SLOTS);
}

/* Where the node stands, the workspace is; its scale is a property, not the node's. */
static knurl_result place(device *d) {
    gd_transform transform;
    pose at;
    gd_call(gd_method.Node3D_get_global_transform, d->base.object, NULL, &transform);
    if (!pose_split(&transform, &at)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "expected a transform with axes, found one that is scaled to nothing");
    }
    knurl_workspace_init(&d->workspace);
    memcpy(d->workspace.origin, at.position, sizeof at.position);
    memcpy(d->workspace.rotation, at.rotation, sizeof at.rotation);
    d->workspace.scale = d->workspace_scale;
    return KNURL_OK;
}

static knurl_result open_device(device *d) {
    const char *uri = d->uri ? d->uri : "";
    if (strcmp(uri, "mouse") != 0) {
        return knurl_device_open(uri, &d->device);
    }
    d->mouse = calloc(1, sizeof *d->mouse);
    return d->mouse ? mouse_open(d->mouse, &d->device) : knurl_fail(KNURL_ERROR_MEMORY, "no memory for the mouse");
}

knurl_result device_open_scene(device *d) {
    return d->scene ? KNURL_OK : knurl_scene_create(NULL, &d->scene);
}

static knurl_result configure(device *d) {
    knurl_hip_desc desc;
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.workspace = &d->workspace;
    desc.clamp = d->clamp;
    return knurl_scene_configure_hip(d->scene, 0, &desc);
}

static knurl_result fill_scene(device *d) {
    for (surface *s = surfaces; s; s = s->next) {
        follow_add(d, s);
    }
    d->gratings_seen = grating_changes;
    const knurl_result result = d->is_committed ? KNURL_OK : knurl_scene_commit(d->scene);
    d->is_committed = d->is_committed || !result;
    return result;
}

knurl_result device_prepare(device *d) {
    uint8_t is_inside = 0;
    gd_call(gd_method.Node_is_inside_tree, d->base.object, NULL, &is_inside);
    if (!is_inside) {
        return knurl_fail(KNURL_ERROR_STATE, "expected a node inside a scene tree, found one outside");
    }
    knurl_result result = take_slot(d);
    d->board = result ? NULL : calloc(1, sizeof *d->board);
    result = result || d->board ? result : knurl_fail(KNURL_ERROR_MEMORY, "no memory for what is felt");
    result = result ? result : place(d);
    result = result ? result : open_device(d);
    result = result ? result : device_open_scene(d);
    result = result ? result : fill_scene(d);
    result = result ? result : configure(d);
    if (!result && d->uri && strncmp(d->uri, "fake", strlen("fake")) == 0) {
        result = stroke_lay(d);
    }
    return result;
}

knurl_result device_make_loop(device *d, double heartbeat_s) {
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.device = d->device;
    desc.scene = d->scene;
    desc.update_rate_hz = d->rate;
    desc.tick_callback = board_take;
    desc.user = d->board;
    desc.reconnect = d->reconnect;
    desc.heartbeat_s = heartbeat_s;
    return knurl_loop_create(&desc, &d->loop);
}

void device_release(device *d) {
    knurl_loop_destroy(d->loop);
    knurl_device_close(d->device);
    d->loop = NULL;
    d->device = NULL;
    if (d->slot >= 0) {
        for (surface *s = surfaces; s; s = s->next) {
            if (s->ids[d->slot] && d->has_files) {
                (void)knurl_scene_remove_surface(d->scene, s->ids[d->slot]);
            }
            s->ids[d->slot] = 0;
        }
        devices[d->slot] = NULL;
        d->slot = -1;
    }
    if (!d->has_files) {
        knurl_scene_destroy(d->scene);
        d->scene = NULL;
        d->is_committed = 0;
    }
    free(d->board);
    free(d->mouse);
    d->board = NULL;
    d->mouse = NULL;
    d->buttons = 0;
}

int64_t device_start(device *d) {
    enum { OK = 0, UNAVAILABLE = 2 };
    d->wants_start = 0;
    if (d->loop) {
        return OK;
    }
    if (gd_is_in_editor()) {
        gd_error("KnurlDevice.start", "KnurlDevice.start: devices run in a running game, not in the editor");
        return UNAVAILABLE;
    }
    knurl_result result = device_prepare(d);
    result = result ? result : device_make_loop(d, HEARTBEAT);
    result = result ? result : knurl_loop_start(d->loop);
    if (result) {
        const int64_t error = device_fail("KnurlDevice.start", result);
        device_release(d);
        return error;
    }
    return OK;
}

void device_stop(device *d) {
    d->wants_start = 0;
    if (d->loop) {
        device_release(d);
        signals_let_go(d); /* last: a handler finds a device that is stopped, and may start it */
    }
}

void device_process(device *d) {
    if (d->wants_start) {
        (void)device_start(d);
    }
    if (!d->loop) {
        return;
    }
    board_tick sent;
    knurl_loop_heartbeat(d->loop);
    board_read(d->board, &sent);
    follow_all(d, sent.tick);
    const int is_over = (int)knurl_loop_wait(d->loop, 0.0); /* before its last events are told */
    signals_tell(d);
    if (d->loop && is_over) {
        device_stop(d);
    }
}
