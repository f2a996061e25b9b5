/* Compares surfaces with a device's limits at load time. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "base/base.h"
#include "base/format.h"
#include "base/rule.h"
#include "contact/mesh_query.h"
#include "grating/method.h"

#include <string.h>

/* The inputs of a check, and its result. */
typedef struct inspection {
    const knurl_bounds *bounds;
    const knurl_material_desc *material;
    const char *name;
    const knurl_shape_facts *facts;
    knurl_surface_check *check;
    int32_t clamped; /* 1: the guard clamps walls to the limits */
} inspection;

void knurl_surface_check_init(knurl_surface_check *check, uint32_t size) {
    const knurl_surface_check defaults = {0};
    knurl_desc_write(&defaults, sizeof defaults, check, size);
}

/* Adds a line about an exceeded limit: the excess (printf style), and advice unless the guard clamps to the limit
 * anyway. Text beyond the buffer is cut off. */
KNURL_PRINTF(4, 5)
static void say(const inspection *on, uint32_t limit, const char *advice, const char *format, ...) {
    const size_t length = strlen(on->check->message);
    char sentence[256], name[44];
    va_list arguments;
    va_start(arguments, format);
    (void)knurl_format_arguments(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    (void)knurl_text_line(name, sizeof name, on->name);
    (void)knurl_format(on->check->message + length, sizeof on->check->message - length, "%ssurface '%s': %s; %s",
                       length > 0 ? "\n" : "", name, sentence,
                       on->clamped && limit < KNURL_LIMIT_PERIOD ? "it is felt at its limit" : advice);
    on->check->exceeded |= limit;
}

static void check_wall(const inspection *on) {
    const double k = on->check->stiffness;
    const double stable = knurl_bounds_stability(on->bounds, on->material->damping);
    if (k > stable) {
        say(on, KNURL_LIMIT_STABILITY, "lower it, run faster, or clamp",
            "stiffness %.4g N/m is %.2g times the %.4g N/m that stay stable at this rate, delay and "
            "friction",
            k, k / stable, stable);
    }
    if (k > on->bounds->max_stiffness) {
        say(on, KNURL_LIMIT_STIFFNESS, "lower it, or clamp",
            "stiffness %.4g N/m is %.2g times the %.4g N/m that the device is made for", k,
            k / on->bounds->max_stiffness, on->bounds->max_stiffness);
    }
}

static void check_texture(const inspection *on, double stiffness) {
    const double rms = stiffness * on->material->amplitude;
    const double swing = rms * knurl_methods[on->material->method].swing;
    const double *fs = on->material->spatial_frequency;
    const double period = 1.0 / fmax(fs[0], fs[1]);
    char advice[64];
    (void)knurl_format(advice, sizeof advice, "lower it to %.3g m, or clamp", on->check->amplitude_limit);
    if (swing > on->bounds->max_force) {
        say(on, KNURL_LIMIT_AMPLITUDE, advice,
            "amplitude %.4g m swings the force by %.3g N, %.2g times the device's %.3g N", on->material->amplitude,
            swing, swing / on->bounds->max_force, on->bounds->max_force);
    }
    if (rms > on->bounds->continuous_force) {
        say(on, KNURL_LIMIT_HEAT, advice,
            "amplitude %.4g m is %.3g N rms, %.2g times the %.3g N that its motors can hold", on->material->amplitude,
            rms, rms / on->bounds->continuous_force, on->bounds->continuous_force);
    }
    if (period < 2.0 * on->bounds->quantum) {
        say(on, KNURL_LIMIT_PERIOD, "lower spatial_frequency",
            "ridges %.3g m apart are finer than the %.3g m of two position steps", period, 2.0 * on->bounds->quantum);
    }
}

/* Share of the area without ridges, as its uvs have no area, that causes a warning: a few such triangles are common. */
#define COLLAPSED_MAX 0.01

/* Compares the ridges per metre that are felt along x or y with the material's. A surface with an axis or projected
 * coordinates is skipped: it uses no uvs, and its ridges stand as if planes cut them. */
static void check_stretch(const inspection *on, const knurl_surface_data *surface) {
    const knurl_material_desc *m = on->material;
    const int has_axis = vec3_dot(surface->axis, surface->axis) > 0.0;
    if (!knurl_methods[m->method].follows_position || has_axis) {
        return;
    }
    if (surface->shape.has_flat_uvs) {
        say(on, KNURL_LIMIT_STRETCH, "unwrap it, give it an axis, or ask for box coordinates",
            "its uvs have no area, as a palette's, so ridges are projected along its axes");
    }
    if (surface->shape.is_projected) {
        return;
    }
    for (int i = 0; i < 2; i++) {
        const double *tagged = m->spatial_frequency;
        const double fs = m->orientation == 0.0 ? tagged[i] : fmax(tagged[0], tagged[1]); /* rotated, both may apply */
        const double *stretch = on->facts->stretch[i];
        if (fs > 0.0 && (stretch[2] > KNURL_STRETCH_MAX || stretch[0] * KNURL_STRETCH_MAX < 1.0)) {
            say(on, KNURL_LIMIT_STRETCH, "unwrap it evenly, give it an axis or box coordinates, or use S2",
                "its uvs stretch: the %.4g/m along %c are felt as %.4g to %.4g/m, more than an octave off on "
                "%.2g %% of its area",
                fs, "uv"[i], stretch[0] * fs, stretch[2] * fs, 100.0 * on->facts->uneven);
        }
    }
    if (on->facts->collapsed > COLLAPSED_MAX && (m->spatial_frequency[0] > 0.0 || m->spatial_frequency[1] > 0.0)) {
        say(on, KNURL_LIMIT_STRETCH, "unwrap it, give it an axis or box coordinates, or use S2",
            "its uvs have no area on %.2g %% of its area, where no ridges are felt", 100.0 * on->facts->collapsed);
    }
}

/* Positions too far out to be felt: a mistaken unit, or a stray vertex. */
static void check_place(const inspection *on, const knurl_surface_data *surface) {
    double low[3];
    double high[3];
    double farthest = 0.0;
    knurl_surface_bounds(surface, &surface->record->motion, HUGE_VAL, low, high);
    for (int i = 0; i < 3; i++) {
        farthest = fmax(farthest, fmax(fabs(low[i]), fabs(high[i])));
    }
    if (!(farthest <= KNURL_FAR)) {
        say(on, KNURL_LIMIT_FAR, "look for a stray vertex, or a unit other than metres",
            "it reaches %.3g m from the origin, where float32 leaves %.2g m between positions", farthest,
            farthest * 0x1p-24);
    }
}

/* Crests that reach farther than a mesh is wide, or stacks of overlapping triangles. */
static void check_visits(const inspection *on, const knurl_surface_data *surface, uint32_t max_visits) {
    const knurl_shape *shape = &surface->shape;
    if (shape->mesh && knurl_mesh_exceeds_visits(shape->mesh, surface->record->reach, max_visits)) {
        say(on, KNURL_LIMIT_VISITS,
            "use fewer triangles, remove those that lie over one another, or lower the crests below the mesh's width",
            "in places contact looks at more than the %u triangles and nodes that a tick has time for",
            (unsigned)max_visits);
    }
}

/* Number of meshes within CROWD_REACH (m) of one point that is reported: over 16 spheres of 9,216 triangles a fifth of
 * the ticks of a stroke of 100 mm/s reaches the limit of visits, over 8 of them one in 80. */
#define CROWD       16
#define CROWD_REACH 0.001

/* Counting ends here, which bounds the time to check each of thousands of meshes in one place. */
#define CROWD_MAX 64

static uint32_t is_mesh_near(const knurl_surface_data *surface, const double point[3], double now) {
    knurl_contact nearest;
    knurl_pose pose;
    double own[3];
    if (!surface || surface->shape.plane) {
        return 0;
    }
    knurl_motion_at(&surface->record->motion, now, &pose);
    knurl_pose_to_own(&pose, point, own);
    return (uint32_t)knurl_mesh_closest(surface->shape.mesh, own, CROWD_REACH, NULL, NULL, &nearest);
}

/* Counts the meshes within CROWD_REACH of a point, to CROWD_MAX. */
static uint32_t count_meshes_near(const knurl_scene *scene, const double point[3]) {
    const knurl_broad_index *index = scene->broad_phase.index; /* null before the commit */
    const double now = knurl_scene_time(scene);
    uint32_t places[CROWD_MAX], count = 0;
    double low[3], high[3];
    knurl_bvh_bound(point, point, CROWD_REACH, low, high);
    const knurl_broad_query query = {low, high, now, 0, 1};
    const uint32_t found = index ? knurl_broad_phase_find(index, &query, CROWD_MAX, places) : 0;
    for (uint32_t i = 0; i < found && found <= CROWD_MAX; i++) {
        count += is_mesh_near(index->items[places[i]], point, now);
    }
    for (uint32_t i = 0; i < scene->surfaces.count && found > CROWD_MAX && count < CROWD_MAX;
         i++) { /* some are planes */
        count += is_mesh_near(knurl_surfaces_at(&scene->surfaces, i), point, now);
    }
    return count;
}

/* Overlapping meshes at the anchor, where a hand would meet the surface first. */
static void check_crowd(const inspection *on, const knurl_scene *scene, const knurl_surface_data *surface) {
    knurl_contact anchor;
    knurl_pose pose;
    double point[3];
    knurl_motion_at(&surface->record->motion, knurl_scene_time(scene), &pose);
    knurl_shape_anchor(&surface->shape, pose.rotation, &anchor);
    knurl_pose_to_parent(&pose, anchor.proxy, point);
    const uint32_t count = surface->shape.plane ? 0 : count_meshes_near(scene, point);
    if (count >= CROWD) {
        say(on, KNURL_LIMIT_VISITS, "join them to one mesh, or move them apart",
            "%u meshes come within 1 mm of [%.4g, %.4g, %.4g], more than a tick has time for if the hand moves fast "
            "there",
            (unsigned)count, point[0], point[1], point[2]);
    }
}

/* Triangles that share an edge and face opposite ways. */
static void check_winding(const inspection *on, const knurl_surface_data *surface) {
    const knurl_shape_facts *facts = on->facts;
    const uint32_t count = knurl_shape_triangles(&surface->shape);
    if (facts->reversed_twins > 0 && facts->reversed_twins < count) {
        say(on, KNURL_LIMIT_WINDING, "merge or delete the doubled faces in the editor",
            "%u of its %u triangles have a reversed twin, %s", (unsigned)facts->reversed_twins, (unsigned)count,
            surface->double_sided ? "so all of it is felt from both sides" : "which was left out");
    }
    if (facts->turned > 0) {
        say(on, KNURL_LIMIT_WINDING, "recalculate the normals in the editor",
            "%u of its %u triangles were wound against their neighbours, and were turned over", (unsigned)facts->turned,
            (unsigned)count);
    }
    if (facts->mixed > 0 && !surface->double_sided) {
        say(on, KNURL_LIMIT_WINDING, "recalculate the normals in the editor, or make each part a mesh of its own",
            "%u of its %u triangles are wound against their neighbours, and may let the HIP through: too many "
            "triangles touch there to find the right side",
            (unsigned)facts->mixed, (unsigned)count);
    }
}

static void check_normals(const inspection *on, const knurl_surface_data *surface) {
    const knurl_shape_facts *facts = on->facts;
    if (facts->bad_normals > 0 && !facts->has_computed_normals) {
        say(on, KNURL_LIMIT_NORMALS, "recalculate the normals in the editor",
            "%u of its %u triangles are felt flat, because their normals are not of unit length, more than "
            "60 degrees off the triangle, or fold the surface",
            (unsigned)facts->bad_normals, (unsigned)knurl_shape_triangles(&surface->shape));
    }
}

static void inspect(const knurl_scene *scene, const knurl_hip *hip, const knurl_surface_data *surface,
                    knurl_surface_check *check) {
    const knurl_material_desc *m = &surface->record->material;
    knurl_workspace workspace;
    knurl_bounds bounds; /* not the guard's: their scale changes on the haptic thread */
    const inspection on = {&bounds, m, surface->name, knurl_shape_get_facts(&surface->shape), check, hip->guard.clamp};
    knurl_wall wall;
    memset(check, 0, sizeof *check);
    knurl_workspace_target(&hip->move, &hip->workspace, &workspace);
    knurl_bounds_init(&bounds, &hip->facts, workspace.scale);
    knurl_wall_init(&wall, m, m->amplitude, 0.0, NULL);
    if (on.clamped) {
        knurl_guard_limit_wall(&bounds, &wall);
    }
    check->stiffness = m->stiffness * on.bounds->scale;
    check->stiffness_limit = knurl_bounds_stiffness(on.bounds, m->damping);
    check->amplitude = m->amplitude;
    check->lowest_gain = hip->even.on ? hip->even.lowest : 1.0;
    check->lowered_hz[0] = hip->even.on ? hip->even.lowered_hz[0] : 0.0;
    check->lowered_hz[1] = hip->even.on ? hip->even.lowered_hz[1] : 0.0;
    check->amplitude_limit = knurl_bounds_amplitude(on.bounds, wall.stiffness, m->method);
    check_wall(&on);
    check_place(&on, surface);
    check_visits(&on, surface, hip->contacts.budget.max);
    check_crowd(&on, scene, surface);
    check_winding(&on, surface);
    check_normals(&on, surface);
    if (surface->record->amplitude > 0.0) {
        check_texture(&on, wall.stiffness);
        check_stretch(&on, surface);
    }
}

knurl_result knurl_scene_check_surface(const knurl_scene *scene, uint32_t hip, knurl_surface_id surface,
                                       knurl_surface_check *check) {
    KNURL_RULE(NOT_HAPTIC, scene);
    if (KNURL_BAD_HANDLE(scene, SCENE) || KNURL_IS_NULL(check)) {
        return KNURL_ERROR_ARGUMENT;
    }
    knurl_surface_check made;
    knurl_surface_data *data;
    knurl_result result = knurl_scene_check_hip(scene, hip);
    result = result ? result : knurl_scene_lock_surface(scene, surface, &data);
    if (result) {
        return result;
    }
    inspect(scene, &scene->hips[hip], data, &made);
    knurl_scene_unlock(scene);
    result = knurl_desc_return("knurl_surface_check", &made, sizeof made, check);
    if (!result) {
        knurl_desc_end_text(check, offsetof(knurl_surface_check, message),
                            offsetof(knurl_surface_check, message) + sizeof check->message);
    }
    return result;
}
