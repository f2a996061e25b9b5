/* A gamepad's motors play a device's force. SPDX-License-Identifier: MIT */
#include "rumble.h"

#include "sound.h"

/* Longer than a frame: motors that are not set again stop, for example if the game hangs. */
static const double SECONDS = 0.1;
static const double LEAST = 0.005; /* of the motors' strength: below it they do not turn */

/* A method of the singleton Input; count: 1 or 4 of pad, weak and strong motor, seconds. */
static void call_input(const char *method, int64_t pad, const double *numbers, uint32_t count) {
    gd_name name = gd_name_new("Input");
    gd_variant arguments[4] = {gd_wrap(GDEXTENSION_VARIANT_TYPE_INT, &pad)};
    for (uint32_t i = 1; i < count; i++) {
        arguments[i] = gd_wrap(GDEXTENSION_VARIANT_TYPE_FLOAT, &numbers[i - 1]);
    }
    gd_variant nothing = gd_call_named(gd.global_get_singleton(&name), method, arguments, count);
    gd.variant_destroy(&nothing);
    gd_name_end(&name);
}

void rumble_play(device *d) {
    double bands[2]; /* slow and fast motor */
    if (d->rumble < 0 || (!d->rumble_of && knurl_session_get_sound(d->session, sound_mix_rate(), &d->rumble_of)) ||
        knurl_sound_get_rumble(d->rumble_of, bands)) {
        return;
    }
    if (bands[0] > LEAST || bands[1] > LEAST) {
        const double numbers[3] = {bands[1], bands[0], SECONDS};
        call_input("start_joy_vibration", d->rumble, numbers, 4);
        d->rumbles = 1;
    } else if (d->rumbles) {
        call_input("stop_joy_vibration", d->rumble, NULL, 1);
        d->rumbles = 0;
    }
}

void rumble_stop(device *d) {
    if (d->rumbles) {
        call_input("stop_joy_vibration", d->rumble, NULL, 1);
        d->rumbles = 0;
    }
    knurl_sound_release(d->rumble_of);
    d->rumble_of = NULL;
}
