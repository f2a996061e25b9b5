/* Internals of a Touch. HD's scheduler thread calls a slot, which outlives its device, so that a late call does not use
 * freed memory. SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_TOUCH_DEVICE_H
#define KNURL_SRC_TOUCH_DEVICE_H

#include "device/driver.h"
#include "device/touch/hd.h"

typedef struct touch touch;

typedef struct touch_slot {
    touch *owner; /* null if free; guarded by the lock of touch.c */
    /* atomics */
    touch *device;      /* served by the scheduler's next call; may be null */
    uint32_t inside;    /* 1: a call is in progress */
    uint32_t scheduled; /* 1: on HD's list */
    uint32_t key;       /* the device of these errors: its handle + 1; 0: no device */
    uint32_t loss;      /* the error by which it was lost; 0 if it is not lost */
    uint32_t refusal;   /* the last error by which it refused a force, or 0 */
    uint64_t others;    /* errors of other kinds */
} touch_slot;

struct touch {
    knurl_device base;
    const hd_api *hd;
    touch_slot *slot;
    hd_device handle;
    char uri[KNURL_URI_ROOM + 8]; /* for messages: "touch" or "touch:NAME" */
    char name[KNURL_URI_ROOM];    /* as opened; "": the default device */
    char title[128];              /* for display: model and versions */
    knurl_device_info info;
    hd_enum style;            /* calibration style; 0 if unknown */
    uint32_t trouble;         /* the error while it was prepared, or 0 */
    uint32_t uses_scheduler;  /* 1: counted among its users */
    hd_scheduler_code task;   /* scheduled task */
    uint32_t (*tick)(void *); /* null if it returned 0, or if there is no loop */
    void *argument;
    /* of the servo thread */
    knurl_device_sample sample; /* of this frame */
    double force[3];            /* of this frame, N */
    uint32_t until_check;       /* frames until the next check of the calibration */
    uint32_t pause;             /* frames without force after the device refused one */
    uint32_t uncalibrated;      /* 1: not calibrated, and reported */
    uint32_t told_loss;         /* 1: a read has returned the loss */
    /* atomics */
    uintptr_t frame_thread; /* the thread that may read and write now, or 0 */
};

/* Frames between two checks of the calibration. */
#define TOUCH_CHECK_FRAMES 100u

/* Frames without force after a refusal, so that a burst of refusals is one fault. */
#define TOUCH_PAUSE_FRAMES 100u

/* touch_servo.c: the servo thread. */
uint32_t HD_CALL knurl_touch_servo(void *slot);
knurl_result knurl_touch_read(knurl_device *device, knurl_device_sample *sample);
knurl_result knurl_touch_write(knurl_device *device, const double force[3]);

/* Takes HD's errors and stores each with its device; errors without a device count as `own`'s (not stored if null).
 * Returns the oldest of `own`, or 0. [any thread] */
uint32_t knurl_touch_take_errors(const hd_api *hd, touch_slot *own);

/* 1 while the scheduler is stopped to open another device. Atomic. */
extern uint32_t knurl_touch_is_paused;

/* touch_info.c: queries HD for info and title; the device must be current, and not in a frame. */
void knurl_touch_ask_info(touch *t);

/* touch_connect.c; all except knurl_touch_detach() need the lock of touch.c. Opens the device and prepares it for
 * forces; gives it back to HD. Errors as knurl_device_open(). */
knurl_result knurl_touch_connect(touch *t);
void knurl_touch_disconnect(touch *t);

/* Puts the tick on HD's list, or removes it. Errors: KNURL_ERROR_SYSTEM. */
knurl_result knurl_touch_schedule(touch *t);
void knurl_touch_unschedule(touch *t);

/* Makes further scheduler calls do nothing. Returns 0 if one is still in progress. [not the servo thread] */
int knurl_touch_detach(touch *t);

/* The slot of the device with this handle, or a free one (HD_NO_DEVICE); null if there is no such slot. */
touch_slot *knurl_touch_find_slot(hd_device handle);

/* More devices than fit on a desk. */
#define TOUCH_ROOM 8
extern touch_slot knurl_touch_slots[TOUCH_ROOM];

#endif
