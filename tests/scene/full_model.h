/* Scenes with single reductions switched off, to compare. SPDX-License-Identifier: MIT */
#ifndef KNURL_TEST_FULL_MODEL_H
#define KNURL_TEST_FULL_MODEL_H

#include "scene/scene.h"

/** bits: KNURL_FULL_. Before surfaces are added. */
static inline void set_full_model(knurl_scene *scene, uint32_t bits) {
    scene->full_model = bits;
    for (uint32_t hip = 0; hip < scene->hip_count; hip++) {
        scene->hips[hip].contacts.test_all = (bits & KNURL_FULL_SEARCH) != 0;
    }
}

#endif
