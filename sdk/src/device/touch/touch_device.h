/* The insides of a Touch. HD's scheduler thread calls a slot, which outlives its device, so that a late call does not
 * use freed memory.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SRC_TOUCH_DEVICE_H
#define KNURL_SRC_TOUCH_DEVICE_H

#include "device/driver.h"
#include "device/touch/hd_load.h"
#include "device/uri.h"

typedef struct touch touch;

typedef struct touch_slot {
    touch *owner; /* null: free; under the lock of touch.c */
    /* atomics */
    touch *device;      /* which the scheduler's next call serves; or null */
    uint32_t inside;    /* 1: a call is under way */
    uint32_t scheduled; /* 1: HD has it on its list */
    uint32_t key;       /* the device of these errors: its handle + 1; 0: none */
    uint32_t loss;      /* the error by which it got lost, 0: it is there */
    uint32_t refusal;   /* the latest error by which it did not play a force, 0: none */
    uint64_t others;    /* errors of other kinds */
} touch_slot;

struct touch {
    knurl_device base;
    const hd_api *hd;
    touch_slot *slot;
    hd_device handle;
    char uri[KNURL_URI_ROOM + 8]; /* for messages: "touch" or "touch:NAME" */
    char name[KNURL_URI_ROOM];    /* as opened; "": the default device */
    char title[128];              /* for people: model and versions */
    knurl_device_info info;
    hd_enum style;            /* of calibration, one; 0: none is known */
    uint32_t trouble;         /* the error that getting it ready brought, 0: none */
    uint32_t uses_scheduler;  /* 1: counted among its users */
    hd_scheduler_code task;   /* what it is scheduled as */
    uint32_t (*tick)(void *); /* null: it returned 0, or there is none */
    void *argument;
    /* the servo thread's */
    knurl_device_sample sample; /* this frame's */
    double force[3];            /* this frame's, N */
    uint32_t until_check;       /* frames until the calibration is looked at again */
    uint32_t pause;             /* frames without force after the device refused one */
    uint32_t uncalibrated;      /* 1: it does not know where it is, and that was reported */
    uint32_t told_loss;         /* 1: read has said that it is lost */
    /* atomics */
    uintptr_t frame_thread; /* the thread that may read and write now; 0: none */
};

/* Frames between two looks at the calibration. */
#define TOUCH_CHECK_FRAMES 100u

/* Frames for which no force goes out after one was refused: a burst of refusals is one fault. */
#define TOUCH_PAUSE_FRAMES 100u

/* touch_servo.c: the servo thread. */
uint32_t HD_CALL touch_servo(void *slot);
knurl_result touch_read(knurl_device *device, knurl_device_sample *sample);
knurl_result touch_write(knurl_device *device, const double force[3]);

/* Takes HD's errors and leaves each with the device that it is about; those about none are `own`'s (null: only told).
 * Returns the oldest that is not another's, 0: there is none. [any thread] */
uint32_t touch_take_errors(const hd_api *hd, touch_slot *own);

/* 1: the scheduler stands still because another device is being opened. Atomic. */
extern uint32_t touch_is_paused;

/* touch_info.c: asks what the device is, for info and title; current, and not in a frame. */
void touch_ask_info(touch *t);

/* touch_connect.c; all but touch_detach() under the lock of touch.c.
 * Finds the device and has it ready to play forces, and gives HD its device back. Errors as knurl_device_open(). */
knurl_result touch_connect(touch *t);
void touch_disconnect(touch *t);

/* The tick is called from now on, or is taken off HD's list. Errors: KNURL_ERROR_SYSTEM. */
knurl_result touch_schedule(touch *t);
void touch_unschedule(touch *t);

/* From now on the scheduler's calls find nothing. 0: one goes on. [not the servo thread] */
int touch_detach(touch *t);

/* The slot whose device has this handle, or (HD_NO_DEVICE) a free one; null: there is none. */
touch_slot *touch_find_slot(hd_device handle);

/* More than anyone has on the desk. */
#define TOUCH_ROOM 8
extern touch_slot touch_slots[TOUCH_ROOM];

#endif
