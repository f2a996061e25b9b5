/* Knurl: scenes of surfaces with gratings: creating, filling and editing them.
 * A scene is created, filled with surfaces and committed [game thread]. From then on each HIP is ticked (hip.h) by one
 * haptic thread, while any other thread may add, remove, move and change surfaces. Editing threads wait for each other;
 * a tick never waits. A tick uses an edit completely or not at all, and always the newest one. Frames are right-handed
 * (as in glTF), units are SI. `in` and `out` are from the library's point of view.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SCENE_H
#define KNURL_SCENE_H

#include <knurl/contact.h>
#include <knurl/grating.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_scene knurl_scene;

/** The id of a surface in a scene; 0 is never an id. An id is stale (KNURL_ERROR_STALE_ID) if its surface was removed,
 * or in another scene. The numbers are reused only after 2^23 surfaces in one place, or 2^20 scenes. */
typedef uint64_t knurl_surface_id;

/** A surface's haptic properties. K, A and fs are per scene metre. */
typedef struct knurl_material_desc {
    uint32_t struct_size;        /**< set by knurl_material_desc_init() */
    int32_t method;              /**< KNURL_METHOD_, or one from knurl_method_add(); DEFAULT is BANDLIMITED */
    double spatial_frequency[2]; /**< fsx, fsy: cycles/m along the surface's x and y, 0 to 1e9; [0, 0] is smooth */
    double amplitude;            /**< A: m, half peak to peak of the square wave, 0 to 1e6 */
    double stiffness;            /**< K: N/m, > 0 */
    double damping;              /**< B: N s/m along the normal, >= 0 */
    double friction; /**< Coulomb coefficient mu, >= 0. The HIP drags a point of the surface by a spring of stiffness K;
                          the point slips if the spring's force exceeds mu K max(0, -z). The grating's height is
                          ignored */
    double orientation; /**< rad: rotates x and y counter-clockwise about the normal */
} knurl_material_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_material_desc_init(knurl_material_desc *desc, uint32_t size);

/** Where a mesh's surface coordinates come from, which say where its ridges are. */
enum {
    KNURL_COORDINATES_AUTO = 0, /**< from the axis; else from uvs and tangents; else as BOX. Uvs that have an area on
                                   less than half of the mesh's (a palette's) count as none */
    KNURL_COORDINATES_BOX = 1   /**< positions in the surface's frame, m, each triangle's projected along the axis that
                                   its normal is closest to. Seen from the front, u runs to the right and v up (+y) on
                                   the four sides; on top and bottom u is +x. At the seams between the sides the phase
                                   of the ridges goes on from where it is */
};

/** A surface: a plane or a mesh, its pose and its material. All data behind pointers is copied. */
typedef struct knurl_surface_desc {
    uint32_t struct_size;                /**< set by knurl_surface_desc_init() */
    uint32_t double_sided;               /**< 1: can be touched from behind too */
    const char *name;                    /**< UTF-8, for reports; null for "" */
    const knurl_plane_desc *plane;       /**< exactly one of plane, mesh and shape_of */
    const knurl_mesh_desc *mesh;         /**< exactly one of plane, mesh and shape_of */
    const knurl_material_desc *material; /**< required */
    double position[3];                  /**< the surface's origin in the scene, m, within KNURL_COORDINATE_MAX */
    double rotation[4];                  /**< surface to scene: unit quaternion x, y, z, w */
    double normal[3];          /**< in place of `rotation`, which stays at its default: where the surface's +z,
                                    a plane's front, faces in the scene (any length). It turns there the
                                    shortest way, to -z about x; 0, 0, 0 (default): not given */
    double axis[3];            /**< the grating's x in the surface's frame (any length, each within
                                    KNURL_COORDINATE_MAX); 0, 0, 0: a plane's x, a mesh's tangents, else its
                                    uvs, else see KNURL_COORDINATES_BOX. With an axis, surface coordinates are
                                    metres from the surface's origin along it */
    knurl_surface_id shape_of; /**< a surface of this scene to share its shape and axis, instead of giving a plane or
                                  mesh. The shape is stored once, until its last user is removed; 0: not shared */
    int32_t coordinates;       /**< KNURL_COORDINATES_, of a mesh; default AUTO. With BOX the axis must be 0, 0, 0 */
    int32_t smooth;            /**< KNURL_SMOOTH_, of a mesh; default AUTO */
} knurl_surface_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_desc_init(knurl_surface_desc *desc, uint32_t size);

typedef struct knurl_scene_desc {
    uint32_t struct_size;  /**< set by knurl_scene_desc_init() */
    uint32_t max_surfaces; /**< capacity, 1 to 2^20; default 4096 */
    uint32_t hip_count;    /**< HIPs, 1 to 8; default 1 */
    uint32_t full_model;   /**< 1: flat meshes stay meshes, every tick tests all surfaces, and smooth ones run
                              the grating stage, to compare; default 0: only the work that surfaces need */
    const knurl_allocator *allocator; /**< copied; null: malloc and free */
} knurl_scene_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_scene_desc_init(knurl_scene_desc *desc, uint32_t size);

/** Creates an empty scene. desc: null for all defaults.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_create(const knurl_scene_desc *desc, knurl_scene **scene);

/** Destroys a scene and frees its memory; null is allowed. A loop that uses the scene ends by itself with zero force,
 * and the memory is freed when the last such loop is destroyed. Do not use the handle afterwards, and
 * do not tick the scene. [game thread, or any while no other thread uses the scene] */
KNURL_API void knurl_scene_destroy(knurl_scene *scene);

/** Checks, copies and adds a surface, before or after the commit.
 * Errors: KNURL_ERROR_ARGUMENT (which field, expected, found), KNURL_ERROR_FULL, KNURL_ERROR_STALE_ID (shape_of),
 * KNURL_ERROR_MEMORY. surface: receives its id; may be null. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc,
                                               knurl_surface_id *surface);

/** Removes a surface, before or after the commit; contacts with it end at the next tick. Its id becomes stale. Its
 * memory is freed by a later edit, when ticks can no longer use it.
 * Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface_id surface);

/** Replaces a surface under the same id, before or after the commit: shape, sides, axis, name, material and pose. A
 * contact continues, as after a jump (knurl_scene_set_transform() with 0 seconds), if the HIP is at most 10 mm behind
 * the new surface.
 * Errors: KNURL_ERROR_STALE_ID and those of knurl_scene_add_surface() except KNURL_ERROR_FULL; the old surface is kept
 * in that case. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_replace_surface(knurl_scene *scene, knurl_surface_id surface,
                                                   const knurl_surface_desc *desc);

/** 1 if the id is a surface of this scene, else 0, without a message. [any thread but the haptic] */
KNURL_API uint32_t knurl_scene_has_surface(const knurl_scene *scene, knurl_surface_id surface);

/** Changes a surface's material, before or after the commit. A playing event is played to its end. Errors:
 * KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY, and those of a material. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface_id surface,
                                                const knurl_material_desc *material);

/** A surface's material as rendered: the default method is resolved. material: set its struct_size with
 * knurl_material_desc_init() first. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_material(const knurl_scene *scene, knurl_surface_id surface,
                                                knurl_material_desc *material);

/** Moves a surface's origin to `position` (m, within KNURL_COORDINATE_MAX) and rotates it to `rotation` (unit
 * quaternion x, y, z, w), both in scene axes, at constant speed over `seconds` (0 to 10; pass the game's frame time).
 * Then it stays until moved again. The motion is felt: velocities are relative to the surface. With 0 seconds it jumps:
 * it does not touch a HIP in between, and if it held one, that HIP is tested again as on a first tick. Time advances
 * with ticks: without ticks the motion waits; before the commit it is done at once. Errors: KNURL_ERROR_ARGUMENT,
 * KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface_id surface, const double position[3],
                                                 const double rotation[4], double seconds);

/** Prepares the scene for ticks: builds the broad phase over its surfaces. Call it once, after adding the first
 * surfaces. Errors: KNURL_ERROR_STATE (committed already), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_commit(knurl_scene *scene);

/** Frees replaced data that ticks can no longer use. Optional: the next edit does it too. [any thread but the
 * haptic] */
KNURL_API void knurl_scene_collect(knurl_scene *scene);

/** All memory in use by the scene, in bytes, including replaced data that ticks may still use. [any thread but the
 * haptic] */
KNURL_API uint64_t knurl_scene_get_bytes(const knurl_scene *scene);

/** Locks all memory of the scene into RAM (mlock), so that a tick never waits for a page. A loop calls it by itself.
 * Errors: KNURL_ERROR_SYSTEM (the system's limit; the scene still works). [game thread] */
KNURL_API knurl_result knurl_scene_lock_memory(knurl_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
