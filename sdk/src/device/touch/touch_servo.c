/* A Touch on HD's scheduler thread: one frame per tick. If that thread hangs, HD's own device driver is assumed to zero
 * the force by its watchdog. SPDX-License-Identifier: MIT */
#include "device/touch/touch_device.h"

#include "base/atomic.h"
#include "base/system.h"
#include "base/vec3.h"
#include "device/quaternion.h"

#include <string.h>

touch_slot knurl_touch_slots[TOUCH_ROOM];

static touch *of(knurl_device *device) {
    return (touch *)(void *)device; /* first member */
}

static touch_slot *slot_of(hd_device handle) {
    const uint32_t key = handle + 1u; /* 0 if HD_NO_DEVICE */
    for (int i = 0; i < TOUCH_ROOM && key; i++) {
        if (knurl_load_acquire(&knurl_touch_slots[i].key) == key) {
            return &knurl_touch_slots[i];
        }
    }
    return NULL;
}

uint32_t knurl_touch_take_errors(const hd_api *hd, touch_slot *own) {
    hd_error errors[HD_ERRORS_AT_ONCE];
    uint32_t oldest = 0;
    for (int i = 0, count = knurl_hd_take_errors(hd, errors); i < count; i++) {
        const uint32_t code = errors[i].code;
        touch_slot *about = slot_of(errors[i].device);
        about = about ? about : own;
        oldest = about == own ? code : oldest;
        if (about && knurl_hd_error_is_loss(code)) {
            knurl_store_release(&about->loss, code);
        } else if (about && knurl_hd_error_is_refusal(code)) {
            knurl_store_release(&about->refusal, code);
        } else if (about) {
            (void)__atomic_fetch_add(&about->others, 1, __ATOMIC_RELAXED);
        }
    }
    return oldest;
}

/* Called outside a frame. HD adopts a new reference, such as the inkwell's, only on request. */
static void keep_calibration(touch *t) {
    if (t->until_check > 0) {
        t->until_check--;
        return;
    }
    t->until_check = TOUCH_CHECK_FRAMES - 1;
    hd_enum state = t->hd->check_calibration();
    if (state == HD_CALIBRATION_STALE && t->style) {
        t->hd->update_calibration(t->style);
        state = t->hd->check_calibration();
    }
    if (state != HD_CALIBRATED && !t->uncalibrated) {
        knurl_events_report(&t->base.events, KNURL_FAULT_UNCALIBRATED, 0.0);
    }
    t->uncalibrated = state != HD_CALIBRATED;
}

/* If HD fails, the position stays NaN. If any thread initialises a device, that one becomes current; the values may
 * then be of that device, so they are read again. */
static void read_frame(touch *t) {
    double position[3] = {NAN, NAN, NAN};
    double transform[16] = {0.0};
    double joints[6] = {NAN, NAN, NAN, NAN, NAN, NAN};
    int32_t buttons = 0;
    for (int attempt = 0; attempt < 2; attempt++) {
        t->hd->get_doubles(HD_POSITION, position);
        t->hd->get_integers(HD_BUTTONS, &buttons);
        t->hd->get_doubles(HD_TRANSFORM, transform);
        t->hd->get_doubles(HD_JOINTS, joints);
        t->hd->get_doubles(HD_GIMBAL, joints + 3);
        if (t->hd->current() == t->handle) {
            break;
        }
        t->hd->make_current(t->handle);
    }
    memset(&t->sample, 0, sizeof t->sample);
    vec3_scale(1e-3, position, t->sample.position);
    t->sample.buttons = (uint32_t)buttons;
    t->sample.joint_count = 6;
    memcpy(t->sample.joints, joints, sizeof joints);
    quaternion_from_axes(&transform[0], &transform[4], &transform[8], t->sample.orientation);
    memset(t->force, 0, sizeof t->force); /* without a write in the tick there is no force */
}

/* If this returns 0, the loop may already be destroyed. */
static int call_tick(touch *t) {
    knurl_store_release(&t->frame_thread, knurl_system_thread_id());
    const int more = t->tick(t->argument) != 0;
    knurl_store_release(&t->frame_thread, (uintptr_t)0);
    if (!more) {
        t->tick = NULL;
    }
    return more;
}

/* If another thread initialises a device, that one becomes current and may take this force, which is then set again. */
static void set_force(touch *t, const double force[3]) {
    for (int attempt = 0; attempt < 2; attempt++) {
        t->hd->make_current(t->handle); /* the tick took time */
        t->hd->set_doubles(HD_FORCE, force);
        if (t->hd->current() == t->handle) {
            break;
        }
    }
}

static void play(touch *t, int more) {
    double force[3] = {0.0, 0.0, 0.0};
    const double length = vec3_length(t->force);
    if (more && knurl_is_finite(length) && !t->pause && !knurl_load_acquire(&t->base.halted) &&
        !knurl_device_must_be_zero()) {
        vec3_scale(length > t->base.max_force ? t->base.max_force / length : 1.0, t->force, force);
    }
    set_force(t, force);
    t->hd->end_frame(t->handle);
    knurl_store_release(&t->base.quiet, vec3_dot(force, force) > 0.0 ? 0u : 1u);
}

static void look_for_refusal(touch *t) {
    const uint32_t refusal = __atomic_exchange_n(&t->slot->refusal, 0, __ATOMIC_ACQ_REL);
    if (refusal) {
        knurl_device_halt(&t->base);
        if (!t->pause) {
            knurl_events_report(&t->base.events, KNURL_FAULT_REFUSED, refusal);
        }
        t->pause = TOUCH_PAUSE_FRAMES;
    }
}

/* Returns 1 if another frame is to follow. */
static int serve_frame(touch *t) {
    const hd_api *hd = t->hd;
    hd->make_current(t->handle);
    keep_calibration(t);
    hd->begin_frame(t->handle);
    read_frame(t);
    (void)knurl_touch_take_errors(hd, t->slot);
    int more = call_tick(t);
    play(t, more);
    (void)knurl_touch_take_errors(hd, t->slot);
    look_for_refusal(t);
    if (!knurl_load_acquire(&t->slot->loss)) {
        return more;
    }
    if (more && !t->told_loss) { /* lost at the end of the frame, so that no read has returned it */
        (void)call_tick(t);
    }
    knurl_store_release(&t->base.quiet, 1u);
    return 0;
}

uint32_t HD_CALL knurl_touch_servo(void *user) {
    touch_slot *slot = user;
    /* knurl_touch_detach() clears `device` before it reads `inside`, so at least one of the two sees the other's store.
     */
    __atomic_store_n(&slot->inside, 1, __ATOMIC_SEQ_CST);
    touch *t = __atomic_load_n(&slot->device, __ATOMIC_SEQ_CST);
    const int again = t && serve_frame(t);
    if (!again) {
        knurl_store_release(&slot->scheduled, 0u);
        knurl_store_release(&slot->device, (touch *)NULL);
    }
    knurl_store_release(&slot->inside, 0u);
    return again ? HD_AGAIN : HD_DONE;
}

static int in_frame(const touch *t) {
    return knurl_load_acquire(&t->frame_thread) == knurl_system_thread_id();
}

knurl_result knurl_touch_read(knurl_device *device, knurl_device_sample *sample) {
    touch *t = of(device);
    if (!in_frame(t)) {
        return KNURL_ERROR_STATE;
    }
    if (knurl_load_acquire(&t->slot->loss)) {
        t->told_loss = 1;
        return KNURL_ERROR_DEVICE_LOST;
    }
    if (t->pause) {
        t->pause--;
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    if (t->uncalibrated) {
        return KNURL_ERROR_DEVICE_NOT_READY;
    }
    *sample = t->sample;
    return KNURL_OK;
}

knurl_result knurl_touch_write(knurl_device *device, const double force[3]) {
    touch *t = of(device);
    if (!in_frame(t)) {
        return KNURL_ERROR_STATE;
    }
    vec3_copy(force, t->force);
    return knurl_load_acquire(&t->slot->loss) ? KNURL_ERROR_DEVICE_LOST : KNURL_OK;
}
