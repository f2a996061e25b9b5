/* Scenes with effects for tests. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_EFFECTS_H
#define KNURL_TEST_EFFECTS_H

#include "scene/ask.h"

#define KINDS  6
#define AS_ONE 1e-12 /* N: rounding */

/* A committed scene without surfaces, its HIP plain. */
static inline knurl_scene *free_scene(void) {
    knurl_scene *scene = empty_scene(1);
    return commit_plainly(scene);
}

static inline knurl_effect effect_of(int32_t kind) {
    knurl_effect effect;
    assert_int_equal(knurl_effect_prepare(kind, &effect), KNURL_OK);
    effect.damping = 0.0;
    return effect;
}

static inline void set(knurl_scene *scene, const knurl_effect *effects, uint32_t count, double seconds) {
    assert_int_equal(knurl_scene_set_effects(scene, 0, effects, count, seconds), KNURL_OK);
}

#endif
