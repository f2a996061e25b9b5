/* Dry ticks: ticks on a copy of a HIP, so that the HIP's own next tick finds its code and data in the cache.
 * SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/atomic.h"
#include "motion/velocity.h"

#include <stddef.h>

void knurl_hip_init_dry(const knurl_hip *hip, knurl_hip *scratch) {
    *scratch = *hip;
    knurl_contacts_reset(&scratch->contacts); /* its active contacts pointed to the HIP's own candidates */
}

/* The parts of a HIP that its next tick uses. */
static void fetch(knurl_hip *hip) {
    const knurl_velocity_state *v = knurl_velocity_get_state(&hip->velocity);
    const uint32_t phase = v->phase + 1 < v->stride ? v->phase + 1 : 0;
    knurl_fetch(hip, 0, offsetof(knurl_hip, velocity));
    knurl_fetch(v->history[phase], 0, sizeof v->history[phase]);
    knurl_fetch(v, offsetof(knurl_velocity_state, held), sizeof *v);
    knurl_fetch(hip, offsetof(knurl_hip, guard), offsetof(knurl_hip, given));
    knurl_fetch(&hip->move, 0, offsetof(knurl_workspace_move, motion));
    knurl_fetch(&hip->contacts, 0, offsetof(knurl_contacts, candidates) + offsetof(knurl_candidates, slots));
    for (uint32_t i = 0; i < hip->contacts.candidates.count; i++) {
        knurl_fetch(knurl_candidates_at(&hip->contacts.candidates, i), 0, sizeof(knurl_candidate));
    }
}

void knurl_hip_begin_dry(knurl_scene *scene, knurl_hip *hip, knurl_hip *scratch) {
    knurl_epoch_pin(&scene->epoch, &hip->pinned); /* edits do not know the scratch HIP's */
    fetch(hip);
    scratch->contacts.clock = hip->contacts.clock;
    scratch->workspace = hip->workspace;
    scratch->is_rotated = hip->is_rotated;
}

void knurl_hip_end_dry(knurl_hip *hip) {
    knurl_epoch_unpin(&hip->pinned);
}
