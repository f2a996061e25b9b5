/* Memory that edits have replaced: kept until no tick can see it. A tick pins the epoch in which it begins; what is
 * retired in an epoch is freed once every HIP is idle or has begun a tick in a later one. All accesses to `epoch`,
 * `pinned` and the pointers that are swapped are sequentially consistent: either the tick's pin is seen here, or the
 * tick sees the new pointer (Fraser 2004, chapter 5). SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/atomic.h"

/* Under the lock. */
static void collect(knurl_scene *scene) {
    uint64_t oldest = UINT64_MAX; /* epoch that a running tick began in */
    for (uint32_t hip = 0; hip < scene->hip_count && scene->retired; hip++) {
        const uint64_t pinned = __atomic_load_n(&scene->hips[hip].pinned, __ATOMIC_SEQ_CST);
        if (pinned != 0 && pinned < oldest) {
            oldest = pinned;
        }
    }
    knurl_retired **link = &scene->retired;
    while (*link) {
        knurl_retired *retired = *link;
        if (retired->epoch < oldest) {
            *link = retired->next;
            retired->release(&scene->heap, retired);
        } else {
            link = &retired->next;
        }
    }
}

void knurl_scene_retire(knurl_scene *scene, knurl_retired *retired) {
    retired->epoch = __atomic_fetch_add(&scene->epoch, 1, __ATOMIC_SEQ_CST);
    retired->next = scene->retired;
    scene->retired = retired;
    collect(scene);
}

void knurl_scene_collect(knurl_scene *scene) {
    knurl_scene_lock(scene);
    collect(scene);
    knurl_scene_unlock(scene);
}
