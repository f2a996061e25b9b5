/* HIPs on the game thread: configuring, adopting a device's properties, reading the last tick.
 * SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/atomic.h"
#include "base/base.h"
#include "base/rule.h"

/* Under the lock, because editing threads read the HIPs' times. */
static knurl_result set_up(knurl_scene *scene, knurl_hip *hip, const knurl_hip_desc *d, const knurl_hip_facts *device,
                           double strongest) {
    const knurl_result result = knurl_hip_set_up(hip, d, device, strongest, knurl_scene_time(scene));
    if (!result) {
        hip->contacts.test_all = (scene->full_model & KNURL_FULL_SEARCH) != 0;
        if (hip->centred && scene->committed) {
            knurl_scene_centre(scene, hip->workspace.origin);
        }
    }
    return result;
}

/* Under the lock. */
static knurl_result refuse_in_use(const knurl_scene *scene, uint32_t hip) {
    if (knurl_load_acquire(&scene->use) >> hip & 1) {
        return knurl_fail(
            KNURL_ERROR_STATE,
            "scene: HIP %u is in use by a loop; configure it before the loop is created or after it is destroyed",
            (unsigned)hip);
    }
    return KNURL_OK;
}

knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc) {
    KNURL_RULE_OF_HIP(CONFIGURE, scene, hip);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_hip_desc d;
    knurl_hip_desc_init(&d, sizeof d);
    knurl_result result = knurl_scene_check_hip(scene, hip);
    result = result || !desc ? result : knurl_desc_read("knurl_hip_desc", desc, &d, sizeof d);
    if (!result) {
        knurl_scene_lock(scene); /* a loop that claims the HIP meanwhile sets it up after this */
        result = refuse_in_use(scene, hip);
        result = result ? result : set_up(scene, &scene->hips[hip], &d, &knurl_touch, HUGE_VAL);
        knurl_scene_unlock(scene);
    }
    return result;
}

knurl_result knurl_scene_set_gains(knurl_scene *scene, uint32_t hip, const knurl_gain *gains, uint32_t count) {
    KNURL_RULE_OF_HIP(CONFIGURE, scene, hip);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_scene_check_hip(scene, hip);
    if (!result) {
        knurl_scene_lock(scene);
        result = refuse_in_use(scene, hip);
        result = result ? result : knurl_even_init(gains, count, &scene->hips[hip].even);
        knurl_scene_unlock(scene);
    }
    return result;
}

static void release_effects(knurl_heap *heap, knurl_retired *effects) {
    knurl_heap_free(heap, effects);
}

/* Swaps a HIP's effects; those before are kept until no tick uses them. Under the lock. */
static knurl_result set_effects(knurl_scene *scene, knurl_hip *hip, const knurl_effect *effects, uint32_t count,
                                double seconds) {
    knurl_effects *before = hip->effects;
    knurl_effects *made = NULL;
    if (count > 0) {
        const knurl_hip_clock *clock = &hip->contacts.clock;
        made = knurl_heap_alloc(&scene->heap, 1, sizeof *made);
        if (!made) {
            return KNURL_ERROR_MEMORY;
        }
        made->retired.release = release_effects;
        knurl_effects_place(made, effects, count, before, knurl_load_double(&clock->time), clock->period, seconds);
    }
    __atomic_store_n(&hip->effects, made, __ATOMIC_SEQ_CST);
    if (before) {
        knurl_epoch_retire(&scene->epoch, &before->retired);
    }
    return KNURL_OK;
}

knurl_result knurl_scene_set_effects(knurl_scene *scene, uint32_t hip, const knurl_effect *effects, uint32_t count,
                                     double seconds) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_scene_check_hip(scene, hip);
    result = result ? result : knurl_effects_check(effects, count);
    if (!result && !knurl_is_within(seconds, 0.0, 10.0)) {
        result = knurl_fail(KNURL_ERROR_ARGUMENT, "seconds: expected 0 to 10, found %g", seconds);
    }
    if (!result) {
        knurl_scene_lock(scene);
        result = set_effects(scene, &scene->hips[hip], effects, count, seconds);
        knurl_scene_unlock(scene);
    }
    return result;
}

knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, const knurl_hip_facts *facts) {
    knurl_hip *h = &scene->hips[hip];
    knurl_result result;
    knurl_scene_lock(scene);
    knurl_hip_desc d = h->given;
    knurl_workspace workspace;
    knurl_workspace_target(&h->move, &h->workspace, &workspace);
    d.workspace = h->centred ? NULL : &workspace;
    if (d.update_rate_hz != KNURL_DEFAULT && d.update_rate_hz != facts->rate) {
        result = knurl_fail(KNURL_ERROR_ARGUMENT,
                            "update rate: HIP %u was configured for %g Hz, its loop for %g Hz; leave one open",
                            (unsigned)hip, d.update_rate_hz, facts->rate);
    } else {
        result = set_up(scene, h, &d, facts, facts->max_force);
    }
    knurl_scene_unlock(scene);
    return result;
}

knurl_result knurl_scene_get_workspace(const knurl_scene *scene, uint32_t hip, knurl_workspace *workspace) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(workspace)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_scene_check_hip(scene, hip);
    if (result) {
        return result;
    }
    knurl_scene_lock(scene);
    if (scene->hips[hip].centred && !scene->committed) {
        result = knurl_fail(KNURL_ERROR_STATE, "workspace: it is chosen at the commit, and the scene is not committed");
    } else {
        knurl_workspace_target(&scene->hips[hip].move, &scene->hips[hip].workspace, workspace);
    }
    knurl_scene_unlock(scene);
    return result;
}

knurl_result knurl_scene_set_workspace(knurl_scene *scene, uint32_t hip, const knurl_workspace *workspace,
                                       double seconds) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(workspace)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_result result = knurl_scene_check_hip(scene, hip);
    result = result ? result : knurl_workspace_check(workspace);
    if (!result && !knurl_is_within(seconds, 0.0, 10.0)) {
        result = knurl_fail(KNURL_ERROR_ARGUMENT, "seconds: expected 0 to 10, found %g", seconds);
    }
    if (result) {
        return result;
    }
    knurl_scene_lock(scene);
    knurl_hip *h = &scene->hips[hip];
    if (!scene->committed) {
        result = knurl_fail(KNURL_ERROR_STATE, "workspace: expected a scene that is committed, found one that is not");
    } else {
        knurl_workspace_go(&h->move, &h->workspace, workspace, knurl_load_double(&h->contacts.clock.time), seconds);
        h->centred = 0;
    }
    knurl_scene_unlock(scene);
    return result;
}

knurl_result knurl_scene_get_tick(const knurl_scene *scene, uint32_t hip, knurl_tick_output *output,
                                  knurl_hip_counts *counts) {
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return KNURL_ERROR_ARGUMENT;
    }
    const knurl_result result = knurl_scene_check_hip(scene, hip);
    if (!result) {
        knurl_snapshot snapshot;
        knurl_snapshot_read(&scene->hips[hip].published, &snapshot);
        if (output) {
            *output = snapshot.output;
        }
        if (counts) {
            *counts = snapshot.counts;
        }
    }
    return result;
}

void knurl_scene_publish_force(knurl_scene *scene, uint32_t hip, const double force[3], const double device_force[3]) {
    knurl_hip *h = &scene->hips[hip];
    knurl_snapshot latest;
    knurl_snapshot_read(&h->published, &latest); /* this thread is the only writer */
    knurl_last_stage_note(&h->last, device_force);
    h->counts.heat = knurl_heat_theta(&h->last.heat);
    vec3_copy(force, latest.output.force);
    vec3_copy(device_force, latest.output.device_force);
    knurl_snapshot_publish(&h->published, &latest.output, &h->counts);
}
