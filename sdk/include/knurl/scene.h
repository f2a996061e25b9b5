/* Knurl: scenes of surfaces with gratings, and the tick that renders their forces.
 * A scene is created, filled with surfaces and committed [game thread]. From then on each HIP is ticked by one haptic
 * thread, while any other thread may add, remove, move and change surfaces. Editing threads wait for each other; a tick
 * never waits. A tick uses an edit completely or not at all, and always the newest one. Frames are right-handed (as in
 * glTF), units are SI. `in` and `out` are from the library's point of view.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_SCENE_H
#define KNURL_SCENE_H

#include <knurl/contact.h>
#include <knurl/grating.h>
#include <knurl/motion.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct knurl_scene knurl_scene;

/** The id of a surface in a scene; 0 is never an id. An id is stale (KNURL_ERROR_STALE_ID) if its surface was removed,
 * or in another scene. The numbers are reused only after 2^23 surfaces in one place, or 2^20 scenes. */
typedef uint64_t knurl_surface_id;

/** Surfaces that one HIP can touch at once. */
#define KNURL_CONTACTS_MAX 4

/** Range of a HIP's update rate, Hz. */
#define KNURL_UPDATE_RATE_MIN 100.0
#define KNURL_UPDATE_RATE_MAX 10000.0

/** A surface's haptic properties. K, A and fs are per scene metre. */
typedef struct knurl_material_desc {
    uint32_t struct_size;        /**< set by knurl_material_desc_init() */
    int32_t method;              /**< KNURL_METHOD_; DEFAULT is BANDLIMITED */
    double spatial_frequency[2]; /**< fsx, fsy: cycles/m along the surface's x and y, 0 to 1e9; [0, 0] is smooth */
    double amplitude;            /**< A: m, half peak to peak of the square wave, 0 to 1e6 */
    double stiffness;            /**< K: N/m, > 0 */
    double damping;              /**< B: N s/m along the normal, >= 0 */
    double friction; /**< Coulomb coefficient mu, >= 0. The HIP drags a point of the surface by a spring of stiffness K;
                          the point slips if the spring's force exceeds mu K max(0, -z). The grating's height is
                          ignored */
    double orientation; /**< rad: rotates x and y counter-clockwise about the normal */
} knurl_material_desc;

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
    double axis[3];                      /**< the grating's x in the surface's frame (any length, each within
                                              KNURL_COORDINATE_MAX); 0, 0, 0: a plane's x, a mesh's tangents, else its
                                              uvs. With an axis, surface coordinates are
                                              metres from the surface's origin along it */
    knurl_surface_id shape_of; /**< a surface of this scene to share its shape and axis, instead of giving a plane or
                                  mesh. The shape is stored once, until its last user is removed; 0: not shared */
} knurl_surface_desc;

/** The protections of a HIP, all on by default. */
enum {
    KNURL_PROTECT_ENTRY = 1, /**< entry ramp: the depth in Eq. 9 grows at most at KNURL_ENTRY_SPEED_MAX */
    KNURL_PROTECT_SLEW = 2,  /**< the device's force grows and turns at most at slew_rate, except for the texture's own
                                steps; after KNURL_TICK_SQUEEZED it also falls at most at that rate */
    KNURL_PROTECT_HEAT = 4,  /**< the force is reduced towards continuous_force as the motors warm up */
    KNURL_PROTECT_PASSIVITY = 8, /**< a wall is softened if it makes the hand oscillate */
    KNURL_PROTECT_ALL = 15
};

/** m/s: the fastest growth of the depth under the entry ramp. If a wall appears around the HIP, it pushes the HIP out
 * gradually. */
#define KNURL_ENTRY_SPEED_MAX 0.5

/** Default visits of a tick. The worst scenes known, most of which use them all, were measured at 8 to 11 us a tick
 * (99th percentile) and 9 to 16 us (99.9th) without interruptions. Tuned: with 600, the proxy was inside in 2 of 70,000
 * presses into moving meshes; with 800, in 0 of 1,050,000 presses in rooms of 15 kinds. */
#define KNURL_VISITS_MAX 800

/** One haptic interaction point (HIP): its update rate, its workspace in the scene, its device's limits. */
typedef struct knurl_hip_desc {
    uint32_t struct_size;    /**< set by knurl_hip_desc_init() */
    int32_t velocity_method; /**< KNURL_VELOCITY_; default AUTO */
    double update_rate_hz;   /**< KNURL_UPDATE_RATE_MIN to _MAX; 0 (default): the loop's; 1000 if there is no loop */
    double resolution; /**< the device's position quantum, 1e-9 to 0.01 m; 0: not quantised; negative (default): the
                          loop's device's; 0.055e-3 (Touch) if there is no loop */
    double max_force;  /**< 0.01 to 1e6 N; longer forces are shortened to it, and to the loop's device's; 0 (default):
                          the loop's device's; 3.3 (Touch) if there is no loop */
    const knurl_workspace *workspace; /**< device to scene; null (default): no rotation, scale 1, the device's origin at
                                           the centre of all surfaces' bounds */
    double continuous_force;          /**< 0.01 to 1000 N that the motors can hold indefinitely; 0 (default): the loop's
                                         device's; 0.88 (Touch) if there is no loop; INFINITY: no limit but max_force */
    double heat_time; /**< time constant of the motors' heating, 0.001 to 1e6 s; 0 (default): the loop's device's; the
                         Touch's if there is no loop */
    double viscous;   /**< the device's viscous friction, 0 to 1000 N s/m, for knurl_scene_check_surface() and the
                           passivity controller; negative (default): the loop's device's; the Touch's if there is no
                           loop */
    double delay; /**< ticks from a force written to a force felt, 0 to 16; negative (default): the loop's device's; 1
                     if there is no loop */
    double max_stiffness; /**< the stiffest wall in the device maker's specification, 1 to 1e9 N/m; INFINITY: not
                             specified; 0 (default): the loop's device's; the Touch's if there is no loop */
    double slew_rate; /**< the fastest change of the force in device axes, 0.01 to 1e9 N/s, except for the texture's own
                         steps and a fall (unless after KNURL_TICK_SQUEEZED): it is measured from the last force,
                         shortened to the new one's length. INFINITY: no limit; 0 (default): max_force within 5 ms */
    uint32_t protections; /**< KNURL_PROTECT_ bits; default KNURL_PROTECT_ALL */
    uint32_t clamp; /**< 1: stiffness and amplitude are clamped to the limits of knurl_scene_check_surface(); default 0:
                       rendered as given */
    uint32_t max_visits; /**< limit of contact's cost in a tick, in visits of triangles, planes and nodes of meshes'
                            hierarchies. Expensive ones count more: the closest point of a triangle is five visits, or
                            ten if the proxy walks to it. 0 (default): KNURL_VISITS_MAX */
    uint32_t reserved;   /**< 0 */
} knurl_hip_desc;

/** A scene leaves out work that its surfaces do not need. Each bit switches one such reduction off, to compare. */
enum {
    KNURL_FULL_MESHES = 1,  /**< flat meshes stay meshes, instead of planes with an outline */
    KNURL_FULL_SEARCH = 2,  /**< every tick tests all surfaces, instead of nearby ones */
    KNURL_FULL_GRATING = 4, /**< smooth surfaces run the grating stage, instead of skipping it */
    KNURL_FULL_ALL = 7
};

typedef struct knurl_scene_desc {
    uint32_t struct_size;             /**< set by knurl_scene_desc_init() */
    uint32_t max_surfaces;            /**< capacity, 1 to 2^20; default 4096 */
    uint32_t hip_count;               /**< HIPs, 1 to 8; default 1 */
    uint32_t full_model;              /**< KNURL_FULL_ bits: reductions to switch off; default 0 */
    const knurl_allocator *allocator; /**< copied; null: malloc and free */
} knurl_scene_desc;

/** A surface as built by the scene. An output: set struct_size with knurl_surface_info_init() first. */
typedef struct knurl_surface_info {
    uint32_t struct_size;
    uint32_t triangle_count;    /**< 0 for a plane */
    uint32_t dropped_triangles; /**< left out: without area, or duplicates */
    uint32_t double_sided;      /**< 1: as given, or because triangles with a reversed twin are more than a tenth of the
                                   mesh's area (fewer are taken for mistakes), or because mixed winding leaves it
                                   without a front (halves of the same area, a Moebius strip) */
    const char *name;           /**< the scene's, valid while the surface exists */
    const char *shape;          /**< "plane" or "mesh", as given; static */
    const char *model;          /**< the model that ticks use: "plane", "plane+outline" or "mesh+bvh"; static */
    uint64_t bytes; /**< memory of this surface in the scene; if its shape is shared (knurl_surface_desc.shape_of), its
                       part of it */
    double bounds_min[3];    /**< scene axes, m */
    double bounds_max[3];    /**< scene axes, m */
    double anchor[3];        /**< a point on the surface near the middle of its bounds, scene, m */
    double anchor_x[3];      /**< unit, scene: the grating's x at the anchor */
    double anchor_normal[3]; /**< unit, scene: the outward normal at the anchor */
    double anchor_reach[4]; /**< m from the anchor in a straight line along +x, -x, +y, -y to the edge of the bounds: an
                               upper limit of a flat surface's extent. Not for curved surfaces; see
                               knurl_fake_lay_stroke() */
    double stretch[3];      /**< min, mean and max of d(surface coordinate)/d(distance on the surface) along x, before
                               `orientation`; 1: undistorted. S1 and BANDLIMITED render fs times it */
    const char *why;        /**< the reason for this model, a sentence; static */
    double model_error;     /**< m: an upper bound of the model's distance from the given surface */
    uint32_t reversed_twins;   /**< triangles left out because another one has the same corners and faces the opposite
                                    side */
    uint32_t turned_triangles; /**< mixed winding: triangles turned over to face like most of their connected component,
                                  by area. If other triangles touch too closely to decide, they stay as they are: see
                                  knurl_scene_check_surface() */
    double axis[3];            /**< unit, the surface's frame: the given axis; 0 if not given */
    double stretch_y[3];       /**< as stretch, along y */
    double seam;               /**< m: edges closer than this count as connected; from the mesh's size and float32's
                                    precision */
    uint64_t touching_pairs;   /**< pairs of the mesh's triangles that touch, but not at a shared edge: T-junctions,
                                    seams, intersecting parts. Ticks near them take longer; 0: a clean mesh. A lower
                                    bound: counting ends after 96 tests, or 4 pairs, for each triangle */
} knurl_surface_info;

/** The input of one tick. */
typedef struct knurl_tick_input {
    double position[3];    /**< device frame, m */
    double velocity[3];    /**< device frame, m/s; used if has_velocity is 1 */
    uint32_t has_velocity; /**< 0: the HIP's own estimator gives the velocity */
    uint32_t absent;       /**< 1: no position: the force is 0, contacts end, and the next tick counts as the first */
    double attenuation; /**< the share of the force to take away, 0 (default) to 1; NaN or out of range: 1. It applies
                             to the force that the device can play, before the slew limit; outputs, counts and heat are
                             those of the rest. While it is 1, the force is 0 at once, and depths restart at 0, as on
                             entry */
    uint32_t paused; /**< 1: the HIP's position and velocity are reported, but it touches no surface: contacts end, the
                        force is 0, and the next tick counts as the first */
    uint32_t reserved[9]; /**< 0 */
} knurl_tick_input;

/** Bits of knurl_tick_output.flags. */
enum {
    KNURL_TICK_CONTACT = 1, /**< the HIP is in contact: closer to a surface than the height of its grating's crests */
    KNURL_TICK_FORCE_LIMIT = 2,    /**< the force was shortened to max_force */
    KNURL_TICK_ABOVE_NYQUIST = 4,  /**< f_t is above f_h/2: the grating is too fine at this speed for the update rate */
    KNURL_TICK_NOT_FINITE = 8,     /**< the HIP is beyond KNURL_COORDINATE_MAX or faster than 1e15 m/s, or an input or a
                                        result was NaN or infinite: the force is 0 and all contacts end */
    KNURL_TICK_CONTACTS_FULL = 16, /**< more surfaces were in contact than KNURL_CONTACTS_MAX */
    KNURL_TICK_ENTRY = 32,         /**< the entry ramp limited a depth */
    KNURL_TICK_SLEW = 64,          /**< the slew rate limited the force */
    KNURL_TICK_HEAT = 128,         /**< the force was shortened because the motors are warm */
    KNURL_TICK_PASSIVITY = 256,    /**< a wall was softened because it made the HIP oscillate */
    KNURL_TICK_ABSENT = 512,       /**< the input was `absent` */
    KNURL_TICK_SQUEEZED = 1024, /**< the proxy was caught between two surfaces, one of which moved over it: that one no
                                     longer holds the HIP, and the force falls at slew_rate. If the angle between them
                                     is above 11 degrees, the proxy is pushed out instead */
    KNURL_TICK_VISIT_LIMIT = 2048 /**< contact reached knurl_hip_desc.max_visits: a surface that holds the HIP is
                                       replaced by the plane through its last contact; a contact may begin late, or not
                                       at the nearest point */
};

/** The output of one tick, in scene axes unless noted; every number is finite. If there are several contacts, the
 * deepest is reported. */
typedef struct knurl_tick_output {
    double device_force[3]; /**< the force for the device: device axes, N, limited */
    double force[3];        /**< the same in scene axes, N */
    double hip[3];          /**< HIP position, m */
    double hip_velocity[3]; /**< m/s */
    double proxy[3];  /**< the proxy: the point on the surface that holds the HIP, m; without contact the HIP itself */
    double normal[3]; /**< outward, unit; 0 without contact */
    double surface_velocity[2]; /**< vx, vy of the HIP relative to the surface in the surface's frame, m/s */
    double depth;  /**< -z: penetration depth, m; negative if the HIP is outside and only the grating's crests reach it;
                      0 without contact */
    double height; /**< H: m; 0 without contact */
    double spatial_frequency;  /**< fs: cycles/m in the direction of motion */
    double temporal_frequency; /**< f_t: Hz, of the motion over the grating, not clamped */
    int64_t event;             /**< number of the playing event, from 0 at the start of contact, or KNURL_NO_EVENT */
    knurl_surface_id surface;  /**< the surface in contact, or 0 */
    uint64_t tick;             /**< 0, 1, ... since the HIP was configured */
    uint32_t flags;            /**< KNURL_TICK_ bits */
    uint32_t contacts;         /**< surfaces in contact, 0 to KNURL_CONTACTS_MAX */
    double cycles[2]; /**< position on the grating: the surface's coordinates times fsx and fsy, cycles from its origin;
                         0 without a grating or coordinates */
    uint64_t reserved[6]; /**< 0 */
} knurl_tick_output;

/** Sums over a HIP's ticks since it was configured. */
typedef struct knurl_hip_counts {
    uint64_t ticks;
    uint64_t contact_ticks;       /**< with KNURL_TICK_CONTACT */
    uint64_t events;              /**< events started (S2) or ridges begun (BANDLIMITED) */
    uint64_t force_limit_ticks;   /**< ticks with KNURL_TICK_FORCE_LIMIT */
    uint64_t above_nyquist_ticks; /**< ticks with KNURL_TICK_ABOVE_NYQUIST */
    uint64_t non_finite_ticks;    /**< ticks with KNURL_TICK_NOT_FINITE */
    uint64_t entry_ticks;         /**< ticks with KNURL_TICK_ENTRY */
    uint64_t slew_ticks;          /**< ticks with KNURL_TICK_SLEW */
    uint64_t heat_ticks;          /**< ticks with KNURL_TICK_HEAT */
    uint64_t passivity_ticks;     /**< ticks with KNURL_TICK_PASSIVITY */
    double force_max;             /**< N: the largest force so far */
    double heat;                  /**< heat of the motors: 0 is cold, 1 as warm as continuous_force makes them in the
                                       long run; above 1 only without KNURL_PROTECT_HEAT. A loop's HIP starts with its
                                       device's heat */
    double half_cycles_crossed;  /**< ridges and grooves crossed by the HIP, for every method, not rounded: the sum of 2
                                    f_t / f_h over all ticks and touched surfaces (Eq. 12; a stroke of L metres along x
                                    crosses 2 fsx L). For S1 and BANDLIMITED in the grating's coordinates, for S2 in
                                    metres; 0 without a grating */
    uint64_t half_cycles_played; /**< half cycles rendered: sign changes of the height */
    uint64_t squeezed_ticks;     /**< ticks with KNURL_TICK_SQUEEZED */
    uint64_t visit_limit_ticks;  /**< ticks with KNURL_TICK_VISIT_LIMIT */
    uint64_t reserved[4];        /**< 0 */
} knurl_hip_counts;

/** Fill in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_material_desc_init(knurl_material_desc *desc, uint32_t size);
KNURL_API void knurl_surface_desc_init(knurl_surface_desc *desc, uint32_t size);
KNURL_API void knurl_surface_info_init(knurl_surface_info *info, uint32_t size);
KNURL_API void knurl_hip_desc_init(knurl_hip_desc *desc, uint32_t size);
KNURL_API void knurl_scene_desc_init(knurl_scene_desc *desc, uint32_t size);

/** Creates an empty scene. desc: null for all defaults.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_create(const knurl_scene_desc *desc, knurl_scene **scene);

/** Destroys a scene and frees its memory; null is allowed. A loop that uses the scene ends by itself with zero force,
 * and the memory is freed when the last such loop is destroyed. Do not use the handle or the surfaces' names
 * afterwards, and do not tick the scene. [game thread, or any while no other thread uses the scene] */
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
 * the new surface. The old name becomes invalid.
 * Errors: KNURL_ERROR_STALE_ID and those of knurl_scene_add_surface() except KNURL_ERROR_FULL; the old surface is kept
 * in that case. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_replace_surface(knurl_scene *scene, knurl_surface_id surface,
                                                   const knurl_surface_desc *desc);

/** Changes a surface's material, before or after the commit. A playing event is played to its end. Errors:
 * KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY, and those of a material. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface_id surface,
                                                const knurl_material_desc *material);

/** Moves a surface's origin to `position` (m, within KNURL_COORDINATE_MAX) and rotates it to `rotation` (unit
 * quaternion x, y, z, w), both in scene axes, at constant speed over `seconds` (0 to 10; pass the game's frame time).
 * Then it stays until moved again. The motion is felt: velocities are relative to the surface. With 0 seconds it jumps:
 * it does not touch a HIP in between, and if it held one, that HIP is tested again as on a first tick. Time advances
 * with ticks: without ticks the motion waits; before the commit it is done at once. Errors: KNURL_ERROR_ARGUMENT,
 * KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface_id surface, const double position[3],
                                                 const double rotation[4], double seconds);

/** A surface's current origin (m) and rotation (unit quaternion x, y, z, w), in scene axes, also during a motion.
 * Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_transform(const knurl_scene *scene, knurl_surface_id surface, double position[3],
                                                 double rotation[4]);

/** 1 if the id is a surface of this scene, else 0, without a message. [any thread but the haptic] */
KNURL_API uint32_t knurl_scene_has_surface(const knurl_scene *scene, knurl_surface_id surface);

/** Stores a caller's pointer with a surface, for example to the game's object; the scene never uses it.
 * knurl_scene_replace_surface() keeps it. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_user_data(knurl_scene *scene, knurl_surface_id surface, void *user_data);

/** The pointer stored by knurl_scene_set_user_data(), or null. Errors: KNURL_ERROR_STALE_ID. [any thread but the
 * haptic] */
KNURL_API knurl_result knurl_scene_get_user_data(const knurl_scene *scene, knurl_surface_id surface, void **user_data);

/** A point on a surface. An output: set struct_size with knurl_surface_point_init() first. */
typedef struct knurl_surface_point {
    uint32_t struct_size;
    uint32_t reserved;        /**< 0 */
    knurl_surface_id surface; /**< 0: no point was found, and all other fields are 0 */
    double distance;          /**< m */
    double position[3];       /**< scene axes, m */
    double normal[3];         /**< unit, scene axes: outward from the front of the triangle or plane */
} knurl_surface_point;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_point_init(knurl_surface_point *point, uint32_t size);

/** Finds the closest point of all surfaces in their current poses to `position` (scene axes, m, within
 * KNURL_COORDINATE_MAX), up to `radius` (m, > 0) away. Ignores gratings. The time grows with the number of surfaces;
 * other editing threads wait, ticks do not. Errors: KNURL_ERROR_ARGUMENT. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_find_closest(const knurl_scene *scene, const double position[3], double radius,
                                                knurl_surface_point *point);

/** Finds the first point at which the straight line from `from` to `to` (scene axes, m, within KNURL_COORDINATE_MAX)
 * passes through a surface in its current pose: through its front or, if it is double-sided, through either side.
 * Ignores gratings. point->distance is measured from `from`. A line that ends on a surface does not pass through it.
 * The time grows with the number of surfaces; other editing threads wait, ticks do not. Errors: KNURL_ERROR_ARGUMENT.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_cast_ray(const knurl_scene *scene, const double from[3], const double to[3],
                                            knurl_surface_point *point);

/** Prepares the scene for ticks: builds the broad phase over its surfaces. Call it once, after adding the first
 * surfaces. Errors: KNURL_ERROR_STATE (committed already), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_commit(knurl_scene *scene);

/** Surfaces in the scene. [any thread] */
KNURL_API uint32_t knurl_scene_get_surface_count(const knurl_scene *scene);

/** The id of surface number `index`, 0 <= index < count, in the order of adding; else 0. [any thread] */
KNURL_API knurl_surface_id knurl_scene_get_surface(const knurl_scene *scene, uint32_t index);

/** Finds a surface by name; if several have it, the one added first. Errors: KNURL_ERROR_UNKNOWN, with the existing
 * names. [any thread] */
KNURL_API knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface_id *surface);

/** A surface's name; the scene's, valid while the surface exists. Errors: KNURL_ERROR_STALE_ID. [any thread] */
KNURL_API knurl_result knurl_scene_get_surface_name(const knurl_scene *scene, knurl_surface_id surface,
                                                    const char **name);

/** A surface's material as rendered: the default method is resolved. material: set its struct_size with
 * knurl_material_desc_init() first. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_material(const knurl_scene *scene, knurl_surface_id surface,
                                                knurl_material_desc *material);

/** Describes a surface as built by the scene. It searches for the anchor: too slow for every frame. Errors:
 * KNURL_ERROR_STALE_ID. [any thread] */
KNURL_API knurl_result knurl_scene_get_surface_info(const knurl_scene *scene, knurl_surface_id surface,
                                                    knurl_surface_info *info);

/** All memory in use by the scene, in bytes, including replaced data that ticks may still use. [any thread but the
 * haptic] */
KNURL_API uint64_t knurl_scene_get_bytes(const knurl_scene *scene);

/** Frees replaced data that ticks can no longer use. Optional: the next edit does it too. [any thread but the
 * haptic] */
KNURL_API void knurl_scene_collect(knurl_scene *scene);

/** Sets up one HIP and clears its state and counts, but not its motors' heat (in a loop, its device's). hip: 0 to
 * hip_count - 1. desc: null for all defaults, which apply if this is never called.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (a loop has it). [game thread, while the caller's own thread does not
 * tick that HIP] */
KNURL_API knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc);

/** The workspace map of a HIP, given or chosen by the scene at the commit; if it is moving, its target. Errors:
 * KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (the scene is to choose it, and is not committed). [any thread but the
 * haptic] */
KNURL_API knurl_result knurl_scene_get_workspace(const knurl_scene *scene, uint32_t hip, knurl_workspace *workspace);

/** Moves a HIP's workspace and changes its scale, even while it ticks. It moves evenly over `seconds` (0 to 10) and
 * carries the HIP with it, which touches surfaces on its path. A change of scale moves the HIP too, towards the
 * workspace's origin or away from it. It takes at least 0.2 s for a factor of e, and continues if a later call gives
 * the same scale again. With 0 s position and scale jump: contacts end, and the next tick counts as the first. A loop
 * that is created later keeps the workspace; knurl_scene_configure_hip() replaces it. Errors: KNURL_ERROR_ARGUMENT
 * (hip, workspace, seconds), KNURL_ERROR_STATE (not committed). [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_workspace(knurl_scene *scene, uint32_t hip, const knurl_workspace *workspace,
                                                 double seconds);

/** The limits of a device that a surface can exceed. K s is its stiffness in device metres. */
enum {
    KNURL_LIMIT_STABILITY = 1, /**< K s above the closed-form bound for the HIP's rate, delay and damping */
    KNURL_LIMIT_STIFFNESS = 2, /**< K s above the device's max_stiffness */
    KNURL_LIMIT_AMPLITUDE = 4, /**< the texture's highest force swing, K A times the method's peaks, above max_force */
    KNURL_LIMIT_HEAT = 8,      /**< the texture's rms force K A above the device's continuous_force */
    KNURL_LIMIT_PERIOD = 16,   /**< ridges narrower than two of the device's position quanta */
    KNURL_LIMIT_FAR = 64, /**< farther than KNURL_FAR from the scene's origin: float32 positions are centimetres apart
                               there */
    KNURL_LIMIT_VISITS = 128,  /**< contact reaches knurl_hip_desc.max_visits at one of 65 places of the mesh; or, once
                                  committed, 15 other meshes are within 1 mm of its anchor */
    KNURL_LIMIT_WINDING = 256, /**< mixed winding, turned over (knurl_surface_info.turned_triangles) or not; or reversed
                                  twins of some triangles, but not of all */
    KNURL_LIMIT_STRETCH = 32 /**< uneven uvs: somewhere S1 and BANDLIMITED render more than KNURL_STRETCH_MAX times the
                                material's ridges per metre, or fewer than 1 / KNURL_STRETCH_MAX */
};

/** m: beyond this distance from the origin, the float32 coordinates of meshes and engines are 6 cm apart or more. */
#define KNURL_FAR 1000000.0

/** The stretch that causes a warning: an octave. Hands feel it, and a good unwrapping of uvs stays below it. */
#define KNURL_STRETCH_MAX 2.0

/** A surface's limits on a device. An output: set struct_size with knurl_surface_check_init() first. */
typedef struct knurl_surface_check {
    uint32_t struct_size;
    uint32_t exceeded;      /**< KNURL_LIMIT_ bits; 0: the surface is within all limits */
    double stiffness;       /**< N/m at the device: K times the workspace's scale */
    double stiffness_limit; /**< N/m: the lowest of its bounds */
    double amplitude;       /**< m */
    double amplitude_limit; /**< m: at the device's stiffness */
    char message[1024];     /**< a sentence for each exceeded limit: its name, the excess, the remedy; "" if there is
                                 none */
} knurl_surface_check;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_check_init(knurl_surface_check *check, uint32_t size);

/** Compares a surface's stiffness and amplitude with the limits of the HIP's device. Call it at load time and show the
 * message; knurl_hip_desc.clamp enforces the limits. Errors: KNURL_ERROR_ARGUMENT (hip), KNURL_ERROR_STALE_ID. [any
 * thread but the haptic] */
KNURL_API knurl_result knurl_scene_check_surface(const knurl_scene *scene, uint32_t hip, knurl_surface_id surface,
                                                 knurl_surface_check *check);

/** Runs one tick of one HIP, of length 1/update_rate_hz: position in, force out. For each surface in contact F = max(0,
 * K (H - z) - B vn) along its normal (Eq. 9), plus friction along the surface.
 *
 * Contact: a HIP inside a surface is held by every face that its proxy has not crossed from the front, at most three at
 * once, of any surfaces; each contributes a force that depends on how far it holds the proxy back. Surfaces below the
 * first one are not felt. A HIP that slides off one surface continues on the next if that is at most 1 mm higher, or
 * lower by any amount; cracks are crossed within 5 ms, and ignored up to 0.1 um. If more than 32 surfaces are near one
 * point, some may be missed (KNURL_TICK_CONTACTS_FULL).
 *
 * Bounded time: contact visits at most knurl_hip_desc.max_visits triangles, planes and nodes (half as many more if a
 * contact begins); the search for nearby surfaces visits those that moved lately and few others (all with
 * KNURL_FULL_SEARCH). No heap, lock, system call, clock, log or file, whatever other threads edit. `output` is always
 * filled in, with zero force if the result is not KNURL_OK. Errors: KNURL_ERROR_STATE (not committed, or a loop has the
 * HIP), KNURL_ERROR_ARGUMENT (hip, null or an invalid handle). [haptic thread, one per HIP] */
KNURL_API knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip, const knurl_tick_input *input,
                                        knurl_tick_output *output) KNURL_NONBLOCKING;

/** Runs `count` ticks one after another, each as knurl_scene_tick(), for simulations and for languages in which each
 * call is expensive. inputs, outputs: `count` each, the caller's; all outputs are filled in unless scene, inputs or
 * outputs is invalid. Returns the first error; later ticks still run. Errors: those of knurl_scene_tick(). [haptic
 * thread, one per HIP] */
KNURL_API knurl_result knurl_scene_tick_batch(knurl_scene *scene, uint32_t hip, const knurl_tick_input *inputs,
                                              uint64_t count, knurl_tick_output *outputs) KNURL_NONBLOCKING;

/** A consistent snapshot of a HIP's last tick, for cursors and plots; all zeros before the first tick. output, counts:
 * either may be null.
 * Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_scene_get_tick(const knurl_scene *scene, uint32_t hip, knurl_tick_output *output,
                                            knurl_hip_counts *counts);

/** One of the contacts of a HIP, scene axes. */
typedef struct knurl_hip_contact {
    knurl_surface_id surface;
    double proxy[3];      /**< the point on the surface that holds the HIP, m */
    double normal[3];     /**< outward, unit */
    double depth;         /**< m; negative if only the grating's crests reach the HIP */
    uint64_t reserved[6]; /**< 0 */
} knurl_hip_contact;

/** All contacts of a HIP's last tick; knurl_tick_output has only the deepest. contacts: room for `capacity`, the
 * caller's; may be null if that is 0. Returns the number of contacts, at most KNURL_CONTACTS_MAX; 0 for an invalid
 * handle or HIP. [haptic thread: the one that ticks this HIP, for example in a loop's tick_callback] */
KNURL_API uint32_t knurl_scene_get_contacts(const knurl_scene *scene, uint32_t hip, knurl_hip_contact *contacts,
                                            uint32_t capacity) KNURL_NONBLOCKING;

/** Locks all memory of the scene into RAM (mlock), so that a tick never waits for a page. A loop calls it by itself.
 * Errors: KNURL_ERROR_SYSTEM (the system's limit; the scene still works). [game thread] */
KNURL_API knurl_result knurl_scene_lock_memory(knurl_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
