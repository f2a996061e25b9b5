/* Creating, finding and destroying sessions. SPDX-License-Identifier: MIT */
#include "parts.h"

#include <stdlib.h>
#include <string.h>

/* The process's sessions. A garbage collector may destroy one on a thread of its own, so the list has a lock. It is
 * taken when sessions are made and destroyed, never in a frame: a spin lock is enough. */
static knurl_session *sessions;
static uint32_t is_locked;

static void lock(void) {
    while (__atomic_exchange_n(&is_locked, 1, __ATOMIC_ACQUIRE)) {}
}

static void unlock(void) {
    __atomic_store_n(&is_locked, 0, __ATOMIC_RELEASE);
}

static void enter(knurl_session *session) {
    lock();
    session->next = sessions;
    if (sessions) {
        sessions->previous = session;
    }
    sessions = session;
    unlock();
}

static void leave(knurl_session *session) {
    lock();
    if (session->next) {
        session->next->previous = session->previous;
    }
    *(session->previous ? &session->previous->next : &sessions) = session->next;
    unlock();
}

void knurl_session_desc_init(knurl_session_desc *desc, uint32_t size) {
    if (KNURL_IS_NULL(desc)) {
        return;
    }
    knurl_session_desc defaults;
    memset(&defaults, 0, sizeof defaults);
    defaults.struct_size = size;
    defaults.reconnect = defaults.clamp = 1;
    defaults.device = "fake";
    defaults.stroke = "";
    defaults.update_rate_hz = 1000.0;
    defaults.heartbeat_s = 0.25;
    knurl_workspace_set_identity(&defaults.workspace);
    memcpy(desc, &defaults, size < sizeof defaults ? size : sizeof defaults);
}

knurl_result knurl_session_create(knurl_session **session) {
    if (KNURL_IS_NULL(session)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_session *made = calloc(1, sizeof *made);
    if (!made) {
        return knurl_fail(KNURL_ERROR_MEMORY, "session: could not get %u bytes", (unsigned)sizeof *made);
    }
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 1u << 20; /* the maximum: a scene only takes memory for what is in it */
    const knurl_result result = knurl_scene_create(&desc, &made->scene);
    if (result) {
        free(made);
        return result;
    }
    made->handle = KNURL_HANDLE_SESSION;
    made->gain = 1.0;
    enter(made);
    *session = made;
    return KNURL_OK;
}

void knurl_session_destroy(knurl_session *session) {
    if (session && !KNURL_BAD_HANDLE(session, SESSION)) {
        leave(session); /* first: from here on knurl_session_close_all() does not see it */
        knurl_session_close(session);
        knurl_scene_destroy(session->scene);
        knurl_handle_clear(&session->handle);
        free(session);
    }
}

uint32_t knurl_session_close_all(void) {
    uint32_t running = 0;
    lock();
    for (knurl_session *s = sessions; s; s = s->next) {
        running += s->runs;
        knurl_session_close(s);
    }
    unlock();
    return running;
}

knurl_scene *knurl_session_get_scene(knurl_session *session) {
    return KNURL_BAD_HANDLE(session, SESSION) ? NULL : session->scene;
}

knurl_device *knurl_session_get_device(knurl_session *session) {
    return KNURL_BAD_HANDLE(session, SESSION) ? NULL : session->device;
}

knurl_loop *knurl_session_get_loop(knurl_session *session) {
    return KNURL_BAD_HANDLE(session, SESSION) ? NULL : session->loop;
}
