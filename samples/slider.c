/* A slider without a surface: the HIP is held on a line from left to right, clicks into a notch every 10 mm, and is
 * heavier beyond 30 mm on either side. Effects of a HIP, changed by the game while it is felt. usage: slider [DEVICE],
 * as knurl_device_open() has it; by default the fake device, whose hand moves to and fro. It runs for three seconds.
 * SPDX-License-Identifier: MIT */
#include <knurl/knurl.h>

#include <math.h>
#include <stdio.h>

#define NOTCH 0.010 /* m */
#define HEAVY 0.030 /* m */
#define FRAME (1.0 / 60.0)

enum { GUIDE, NOTCHES, WEIGHT, EFFECTS };

static knurl_result make_effects(knurl_effect effects[EFFECTS]) {
    knurl_result result = knurl_effect_prepare(KNURL_EFFECT_LINE, &effects[GUIDE]);
    result = result ? result : knurl_effect_prepare(KNURL_EFFECT_DETENT, &effects[NOTCHES]);
    result = result ? result : knurl_effect_prepare(KNURL_EFFECT_DAMPER, &effects[WEIGHT]);
    for (int i = 0; i < EFFECTS && !result; i++) {
        effects[i].axis[0] = 1.0; /* to the right */
        effects[i].axis[1] = 0.0;
    }
    effects[GUIDE].stiffness = 500.0;
    effects[GUIDE].max_force = 3.0;
    effects[NOTCHES].spacing = NOTCH;
    effects[NOTCHES].stiffness = 400.0; /* 0.64 N from notch to notch: K spacing / 2 pi */
    effects[WEIGHT].damping = 0.0;
    return result;
}

/* Each frame: tells the notch, and the weight to the next ticks. */
static knurl_result play(knurl_scene *scene, knurl_loop *loop, knurl_effect effects[EFFECTS]) {
    knurl_result result = KNURL_OK;
    double notch = NAN;
    while (!result && !knurl_loop_wait(loop, FRAME)) {
        knurl_tick_output now;
        result = knurl_scene_get_tick(scene, 0, &now, NULL);
        const double nearest = floor(now.hip[0] / NOTCH + 0.5);
        if (!result && nearest != notch) {
            notch = nearest;
            printf("notch %+3d   x %+6.1f mm   off the line %4.2f mm   force (%+5.2f %+5.2f %+5.2f) N\n", (int)notch,
                   1e3 * now.hip[0], 1e3 * hypot(now.hip[1], now.hip[2]), now.force[0], now.force[1], now.force[2]);
        }
        effects[WEIGHT].damping = fabs(now.hip[0]) > HEAVY ? 6.0 : 0.0; /* N s/m */
        result = result ? result : knurl_scene_set_effects(scene, 0, effects, EFFECTS, FRAME);
    }
    return result;
}

int main(int argc, char **argv) {
    knurl_effect effects[EFFECTS];
    knurl_scene *scene = NULL;
    knurl_device *device = NULL;
    knurl_loop *loop = NULL;
    knurl_loop_desc desc;
    (void)knurl_device_zero_on_exit(0); /* zero force however this program ends */
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.tick_limit = 3000; /* at 1 kHz */
    knurl_result result = make_effects(effects);
    result = result ? result : knurl_scene_create(NULL, &scene);
    result = result ? result : knurl_scene_set_effects(scene, 0, effects, EFFECTS, 0.0);
    result = result ? result : knurl_scene_commit(scene);
    result = result ? result : knurl_device_open(argc > 1 ? argv[1] : "fake", &device);
    desc.scene = scene;
    desc.device = device;
    result = result ? result : knurl_loop_create(&desc, &loop);
    result = result ? result : knurl_loop_start(loop);
    result = result ? result : play(scene, loop, effects);
    if (result) {
        fprintf(stderr, "slider: %s\n", knurl_error_message());
    }
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return result != KNURL_OK;
}
