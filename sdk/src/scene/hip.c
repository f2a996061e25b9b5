/* HIPs on the game thread: configure, adopt a device, read the latest tick. SPDX-License-Identifier: MIT */
#include "scene/scene_internal.h"

#include "base/base.h"
#include "base/vec3.h"

#include <string.h>

void knurl_hip_desc_init(knurl_hip_desc *desc, uint32_t size) {
    const knurl_hip_desc defaults = {.resolution = -1.0, .viscous = -1.0, .delay = -1.0};
    knurl_desc_write(&defaults, sizeof defaults, desc, size);
}

static knurl_result check_hip(const knurl_scene *scene, uint32_t hip) {
    if (hip >= scene->hip_count) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "hip: expected below %u (hip_count), found %u",
                          (unsigned)scene->hip_count, (unsigned)hip);
    }
    return KNURL_OK;
}

/* Under the lock: editing threads look at the HIPs' times. Sets a HIP up anew; `rate`, `resolution` and `max_force`
 * stand for what the description leaves open. */
static knurl_result set_up(knurl_scene *scene, knurl_hip *hip, const knurl_hip_desc *d, double rate, double resolution,
                           double max_force) {
    knurl_hip made;
    memset(&made, 0, sizeof made);
    made.given = *d;
    made.given.workspace = NULL; /* the caller's; kept by value below */
    made.rate = d->update_rate_hz != 0.0 ? d->update_rate_hz : rate;
    made.max_force = d->max_force != 0.0 ? d->max_force : max_force;
    if (!(made.rate >= KNURL_UPDATE_RATE_MIN && made.rate <= KNURL_UPDATE_RATE_MAX)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "update rate: expected %g to %g Hz, found %g Hz", KNURL_UPDATE_RATE_MIN,
                          KNURL_UPDATE_RATE_MAX, made.rate);
    }
    if (!(made.max_force > 0.0 && isfinite(made.max_force))) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "max_force: expected a finite number > 0 (N), found %g",
                          made.max_force);
    }
    knurl_result result = d->workspace ? knurl_workspace_check(d->workspace) : KNURL_OK;
    result = result ? result
                    : knurl_velocity_init(d->velocity_method, d->resolution < 0.0 ? resolution : d->resolution,
                                          made.rate, &made.velocity);
    if (result) {
        return result;
    }
    made.period = 1.0 / made.rate;
    made.quantum = d->resolution < 0.0 ? resolution : d->resolution;
    made.time = knurl_scene_time(scene); /* the scene's goes on */
    made.calm = made.left_time = -1.0;
    made.centred = d->workspace == NULL;
    knurl_workspace_init(&made.workspace);
    if (d->workspace) {
        made.workspace = *d->workspace;
    } else if (scene->committed) {
        knurl_scene_centre(scene, made.workspace.origin);
    }
    made.quantum *= 1.7320508075688772 * made.workspace.scale;
    for (int i = 0; i < 9; i++) {
        made.is_turned |= made.workspace.rotation[i] != (i % 4 == 0 ? 1.0 : 0.0);
    }
    *hip = made;
    return KNURL_OK;
}

knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc) {
    knurl_hip_desc d;
    knurl_hip_desc_init(&d, sizeof d);
    knurl_result result = check_hip(scene, hip);
    result = result || !desc ? result : knurl_desc_read("knurl_hip_desc", desc, &d, sizeof d);
    if (!result) {
        knurl_scene_lock(scene);
        result = set_up(scene, &scene->hips[hip], &d, 1000.0, 0.055e-3, 3.3); /* the Touch */
        knurl_scene_unlock(scene);
    }
    return result;
}

knurl_result knurl_scene_adopt_device(knurl_scene *scene, uint32_t hip, double update_rate_hz, double resolution,
                                      double max_force) {
    knurl_result result = check_hip(scene, hip);
    if (result) {
        return result;
    }
    knurl_hip *h = &scene->hips[hip];
    knurl_hip_desc d = h->given;
    const knurl_workspace workspace = h->workspace;
    if (d.update_rate_hz != 0.0 && d.update_rate_hz != update_rate_hz) {
        return knurl_fail(KNURL_ERROR_ARGUMENT,
                          "update rate: HIP %u was configured for %g Hz, its loop for %g Hz; leave one open",
                          (unsigned)hip, d.update_rate_hz, update_rate_hz);
    }
    d.workspace = h->centred ? NULL : &workspace;
    knurl_scene_lock(scene);
    result = set_up(scene, h, &d, update_rate_hz, resolution, max_force);
    knurl_scene_unlock(scene);
    return result;
}

knurl_result knurl_scene_get_workspace(const knurl_scene *scene, uint32_t hip, knurl_workspace *workspace) {
    const knurl_result result = check_hip(scene, hip);
    if (result) {
        return result;
    }
    if (scene->hips[hip].centred && !scene->committed) {
        return knurl_fail(KNURL_ERROR_STATE, "workspace: it is chosen at the commit, and the scene is not committed");
    }
    *workspace = scene->hips[hip].workspace;
    return KNURL_OK;
}

knurl_result knurl_scene_get_tick(const knurl_scene *scene, uint32_t hip, knurl_tick_output *output,
                                  knurl_hip_counts *counts) {
    const knurl_result result = check_hip(scene, hip);
    if (!result) {
        knurl_snapshot snapshot;
        const knurl_hip *h = &scene->hips[hip];
        knurl_seqlock_read(&h->published.sequence, h->published.words, &snapshot, sizeof snapshot);
        if (output) {
            *output = snapshot.output;
        }
        if (counts) {
            *counts = snapshot.counts;
        }
    }
    return result;
}
