/* Edits from any thread, before and after the commit: adding, removing, moving and changing surfaces. Steps that can
 * fail come first; the swap that ticks see comes last. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/base.h"
#include "base/rule.h"

static knurl_result add(knurl_scene *scene, knurl_surface_data *surface) {
    knurl_result result = knurl_surfaces_add(&scene->surfaces, surface);
    if (!result && scene->committed) {
        result = knurl_broad_phase_add(&scene->broad_phase, surface, knurl_scene_time(scene));
        if (result) {
            knurl_surfaces_undo_add(&scene->surfaces, surface);
        }
    }
    return result;
}

/* Takes long, so the lock is held only while sharing the shape of `shape_of`. */
static knurl_result build(knurl_scene *scene, const knurl_surface_desc *desc, knurl_surface_data **made) {
    knurl_surface_desc d;
    knurl_shared_shape shared;
    knurl_surface_desc_init(&d, sizeof d);
    knurl_result result = knurl_desc_read("knurl_surface_desc", desc, &d, sizeof d);
    if (!result && d.shape_of) {
        knurl_scene_lock(scene);
        const knurl_surface_data *other = knurl_surfaces_get(&scene->surfaces, d.shape_of);
        if (other) {
            knurl_surface_share(other, &shared);
        }
        knurl_scene_unlock(scene);
        result = other ? KNURL_OK : KNURL_ERROR_STALE_ID;
    }
    return result ? result
                  : knurl_surface_build(&scene->heap, &d, scene->full_model, d.shape_of ? &shared : NULL, made);
}

/* Counts one jump more than the old surface, so that ticks notice the new shape. */
static knurl_result replace(knurl_scene *scene, knurl_surface_id surface, knurl_surface_data *made) {
    knurl_surface_data *old = knurl_surfaces_get(&scene->surfaces, surface);
    if (!old) {
        return KNURL_ERROR_STALE_ID;
    }
    made->record->motion.jumps = old->record->motion.jumps + 1;
    made->record->edits = old->record->edits + 1;
    made->moved = 1;
    knurl_surfaces_replace(&scene->surfaces, old, made);
    knurl_broad_phase_replace(&scene->broad_phase, old, made);
    return KNURL_OK;
}

/* Builds a surface and adds it, or replaces surface *id by it. *id: receives its id. */
static knurl_result put(knurl_scene *scene, const knurl_surface_desc *desc, int replaces, knurl_surface_id *id) {
    knurl_surface_data *made = NULL;
    knurl_result result = build(scene, desc, &made);
    if (result) {
        return result;
    }
    knurl_scene_lock(scene);
    result = replaces ? replace(scene, *id, made) : add(scene, made);
    *id = result ? 0 : made->id;
    knurl_scene_unlock(scene);
    if (result) {
        made->retired.release(&scene->heap, &made->retired);
    }
    return result;
}

knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc, knurl_surface_id *surface) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(desc)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_id id = 0;
    const knurl_result result = put(scene, desc, 0, &id);
    if (!result && surface) {
        *surface = id;
    }
    return result;
}

knurl_result knurl_scene_replace_surface(knurl_scene *scene, knurl_surface_id surface, const knurl_surface_desc *desc) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(desc)) {
        return KNURL_ERROR_ARGUMENT;
    }
    return put(scene, desc, 1, &surface);
}

knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface_id surface) {
    KNURL_RULE(NOT_HAPTIC, scene);
    knurl_surface_data *data;
    const knurl_result result = knurl_scene_lock_surface(scene, surface, &data);
    if (!result) {
        knurl_surfaces_remove(&scene->surfaces, data);
        knurl_broad_phase_remove(&scene->broad_phase, data);
        knurl_scene_unlock(scene);
    }
    return result;
}

static knurl_result set_material(knurl_scene *scene, knurl_surface_data *surface, const knurl_material_desc *material) {
    knurl_record *record = knurl_record_copy(&scene->heap, surface->record);
    if (!record) {
        return KNURL_ERROR_MEMORY;
    }
    const knurl_result result = knurl_record_set_material(record, &surface->shape, material, scene->full_model);
    if (result) {
        knurl_heap_free(&scene->heap, record);
        return result;
    }
    knurl_broad_phase_publish(&scene->broad_phase, surface, record, knurl_scene_time(scene));
    return KNURL_OK;
}

knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface_id surface,
                                      const knurl_material_desc *material) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_IS_NULL(material)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_data *data;
    knurl_result result = knurl_scene_lock_surface(scene, surface, &data);
    if (!result) {
        result = set_material(scene, data, material);
        knurl_scene_unlock(scene);
    }
    return result;
}

static knurl_result set_transform(knurl_scene *scene, knurl_surface_data *surface, const knurl_pose *pose,
                                  double seconds) {
    knurl_record *record = knurl_record_copy(&scene->heap, surface->record);
    if (!record) {
        return KNURL_ERROR_MEMORY;
    }
    if (scene->committed) {
        knurl_motion_go(&record->motion, pose, &surface->local, knurl_scene_time(scene), seconds);
        surface->moved = 1;
        scene->broad_phase.moves++;
    } else {
        knurl_motion_place(pose, &surface->local, &record->motion);
    }
    knurl_broad_phase_publish(&scene->broad_phase, surface, record, knurl_scene_time(scene));
    return KNURL_OK;
}

knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface_id surface, const double position[3],
                                       const double rotation[4], double seconds) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_IS_NULL(position) || KNURL_IS_NULL(rotation)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_pose pose;
    knurl_surface_data *data;
    knurl_result result = knurl_surface_check_pose(position, rotation, &pose);
    if (!result && !knurl_is_within(seconds, 0.0, 10.0)) {
        return knurl_fail(KNURL_ERROR_ARGUMENT, "seconds: expected 0 to 10 s, found %g", seconds);
    }
    result = result ? result : knurl_scene_lock_surface(scene, surface, &data);
    if (!result) {
        result = set_transform(scene, data, &pose, seconds);
        knurl_scene_unlock(scene);
    }
    return result;
}

void knurl_scene_collect(knurl_scene *scene) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE)) {
        return;
    }
    knurl_scene_lock(scene);
    knurl_scene_unlock(scene); /* frees replaced objects that no tick can see */
}
