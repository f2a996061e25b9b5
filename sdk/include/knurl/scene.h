/* Knurl: scenes of surfaces with gratings, and the tick that renders their forces.
 * A scene is created, filled with surfaces and committed [game thread]. From then on each HIP is ticked by one haptic
 * thread, while any other thread may add, remove, move and change surfaces. Editing threads wait for each other; a tick
 * never waits. A tick sees an edit completely or not at all, and always the newest one.
 * Frames are right-handed (as in glTF), units are SI. `in` and `out` are seen from the library.
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

/** The id of one surface of one scene; 0 is no surface. After its surface is removed, or in another scene, an id is
 * stale (KNURL_ERROR_STALE_ID). The numbers are reused only after 2^23 surfaces in one place, or 2^20 scenes. */
typedef uint64_t knurl_surface_id;

/** Surfaces that one HIP can touch at once. */
#define KNURL_CONTACTS_MAX 4

/** Update rates that a HIP can tick at, Hz. */
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
    double friction;             /**< Coulomb coefficient mu, >= 0. The HIP drags a point of the surface by a spring of
                                      stiffness K; the point slips where the spring's force exceeds mu K max(0, -z). The
                                      grating's height does not count */
    double orientation;          /**< rad: rotates x and y counter-clockwise about the normal */
} knurl_material_desc;

/** One surface: a plane or a mesh, its pose and its material. Everything pointed to is copied. */
typedef struct knurl_surface_desc {
    uint32_t struct_size;                /**< set by knurl_surface_desc_init() */
    uint32_t double_sided;               /**< 1: can be touched from behind as well */
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
    knurl_surface_id shape_of;           /**< a surface of this scene whose shape and axis this one shares, instead of a
                                              plane or mesh of its own. The shape is stored once, until its last user is
                                              removed; 0: none */
} knurl_surface_desc;

/** The protections of a HIP, all on by default. Studies switch single ones off. */
enum {
    KNURL_PROTECT_ENTRY = 1,     /**< entry ramp: the depth in Eq. 9 grows at most at KNURL_ENTRY_SPEED_MAX */
    KNURL_PROTECT_SLEW = 2,      /**< the device's force grows and turns at most at slew_rate, except for the texture's
                                      own steps; after KNURL_TICK_SQUEEZED it also falls at most so fast */
    KNURL_PROTECT_HEAT = 4,      /**< the force is reduced towards continuous_force as the motors warm up */
    KNURL_PROTECT_PASSIVITY = 8, /**< a wall that makes the hand oscillate is softened */
    KNURL_PROTECT_ALL = 15
};

/** m/s: the fastest growth of the depth under the entry ramp. A wall that appears around the HIP pushes it out
 * gradually. */
#define KNURL_ENTRY_SPEED_MAX 0.5

/** Visits of a tick by default. The worst scenes known, most of which use them all, were measured at 8 to 11 us a tick
 * (99th percentile) and 9 to 16 us (99.9th) where nothing interrupts it. Tuned: with 600, the proxy was inside in 2 of
 * 70,000 presses into moving meshes; with 800, in none of 1,050,000 presses in rooms of 15 kinds. */
#define KNURL_VISITS_MAX 800

/** One haptic interaction point (HIP): its update rate, its workspace in the scene, its device's limits. */
typedef struct knurl_hip_desc {
    uint32_t struct_size;    /**< set by knurl_hip_desc_init() */
    int32_t velocity_method; /**< KNURL_VELOCITY_; default AUTO */
    double update_rate_hz;   /**< KNURL_UPDATE_RATE_MIN to _MAX; 0 (default): the loop's, without one 1000 */
    double resolution; /**< the device's position quantum, 1e-9 to 0.01 m; 0: not quantised; negative (default): as
                            the loop's device says, without one 0.055e-3 (Touch) */
    double max_force;  /**< 0.01 to 1e6 N; longer forces are shortened to it, and to the loop's device's; 0
                            (default): as the loop's device says, without one 3.3 (Touch) */
    const knurl_workspace *workspace; /**< device to scene; null (default): no rotation, scale 1, the device's origin at
                                           the centre of all surfaces' bounds */
    double continuous_force; /**< 0.01 to 1000 N that the motors can hold for ever; 0 (default): as the loop's device
                                  says, without one 0.88 (Touch); INFINITY: no limit but max_force */
    double heat_time;        /**< time constant of the motors' warming, 0.001 to 1e6 s; 0 (default): as the loop's
                                  device says, without one the Touch's */
    double viscous;          /**< the device's viscous friction, 0 to 1000 N s/m, for knurl_scene_check_surface() and
                                  the passivity controller; negative (default): as the loop's device says, without one the
                                  Touch's */
    double delay;            /**< ticks from a force written to a force felt, 0 to 16; negative (default): as the
                                  loop's device says, without one 1 */
    double max_stiffness;    /**< the stiffest wall that the device's maker promises, 1 to 1e9 N/m; INFINITY: none; 0
                                  (default): as the loop's device says, without one the Touch's */
    double slew_rate;        /**< the fastest change of the force in device axes, 0.01 to 1e9 N/s, except for the
                                  texture's own steps and a fall (unless after KNURL_TICK_SQUEEZED): it is measured from
                                  the latest force, made as short as the new one. INFINITY: any; 0 (default): max_force
                                  within 5 ms */
    uint32_t protections;    /**< KNURL_PROTECT_ bits; default KNURL_PROTECT_ALL */
    uint32_t clamp;          /**< 1: stiffness and amplitude are clamped to the limits of knurl_scene_check_surface();
                                  default 0: rendered as asked for */
    uint32_t max_visits; /**< how many triangles, planes and nodes of meshes' hierarchies contact looks at in a tick,
                              at most; what costs more counts more: the closest point of a triangle is five visits,
                              or ten where the proxy walks to it. 0 (default): KNURL_VISITS_MAX */
    uint32_t reserved;   /**< 0 */
} knurl_hip_desc;

/** A scene's reductions: it leaves out what its surfaces do not need. Each bit switches one reduction off, to compare.
 */
enum {
    KNURL_FULL_MESHES = 1,  /**< flat meshes stay meshes; otherwise they become planes with an outline */
    KNURL_FULL_SEARCH = 2,  /**< every tick tests all surfaces; otherwise nearby surfaces only */
    KNURL_FULL_GRATING = 4, /**< smooth surfaces run the grating stage; otherwise they skip it */
    KNURL_FULL_ALL = 7
};

typedef struct knurl_scene_desc {
    uint32_t struct_size;             /**< set by knurl_scene_desc_init() */
    uint32_t max_surfaces;            /**< capacity, 1 to 2^20; default 4096 */
    uint32_t hip_count;               /**< HIPs, 1 to 8; default 1 */
    uint32_t full_model;              /**< KNURL_FULL_ bits: reductions to switch off; default 0 */
    const knurl_allocator *allocator; /**< copied; null: malloc and free */
} knurl_scene_desc;

/** How a scene has built a surface. An output: set struct_size with knurl_surface_info_init() first. */
typedef struct knurl_surface_info {
    uint32_t struct_size;
    uint32_t triangle_count;    /**< 0 for a plane */
    uint32_t dropped_triangles; /**< left out: without area, or duplicates */
    uint32_t double_sided;      /**< 1: as it was given, or because triangles came in reversed pairs, or
                                     because mixed winding left it without a front (halves of the same area, a Moebius
                                     strip) */
    const char *name;           /**< the scene's, valid while the surface is */
    const char *shape;          /**< "plane" or "mesh": what was given; static */
    const char *model;          /**< the model that ticks use: "plane", "plane+outline" or "mesh+bvh"; static */
    uint64_t bytes;             /**< memory that this surface uses in the scene; of a shared shape
                                     (knurl_surface_desc.shape_of) its part */
    double bounds_min[3];       /**< scene axes, m */
    double bounds_max[3];       /**< scene axes, m */
    double anchor[3];           /**< a point on the surface near the middle of its bounds, scene, m */
    double anchor_x[3];         /**< unit, scene: the grating's x at the anchor */
    double anchor_normal[3];    /**< unit, scene: the outward normal at the anchor */
    double anchor_reach[4];     /**< m from the anchor in a straight line along +x, -x, +y, -y to the edge of the
                                     bounds: an upper limit of how far a flat surface extends. Of no use on curved
                                     surfaces; see knurl_fake_lay_stroke() */
    double stretch[3];          /**< min, mean and max of d(surface coordinate)/d(distance on the surface) along x,
                                     before `orientation`; 1: undistorted. S1 and BANDLIMITED render fs times it */
    const char *why;            /**< why this model, in a sentence; static */
    double model_error;         /**< m: the model's surface lies within this of what was given */
    uint32_t reversed_twins;    /**< triangles left out because another has the same corners, facing the other way */
    uint32_t turned_triangles;  /**< mixed winding: triangles turned over to face as most of their connected
                                     component does, by area. Where other triangles touch too closely to tell, they stay
                                     as they are: knurl_scene_check_surface() warns of them */
    double axis[3];             /**< unit, the surface's frame: the axis that was given; 0 without one */
    double stretch_y[3];        /**< as stretch, along y */
    double seam;                /**< m: edges closer than this count as connected; from the mesh's size and float32's
                                     precision */
    uint64_t touching_pairs; /**< pairs of the mesh's triangles that touch elsewhere than at a shared edge: T-junctions,
                                  seams, parts that intersect. Ticks near them take longer; 0: a clean mesh. A lower
                                bound: counting ends after 96 tests, or 4 pairs, for each triangle */
} knurl_surface_info;

/** The input of one tick. */
typedef struct knurl_tick_input {
    double position[3];    /**< device frame, m */
    double velocity[3];    /**< device frame, m/s; used where has_velocity is 1 */
    uint32_t has_velocity; /**< 0: the HIP's own estimator gives the velocity */
    uint32_t absent;       /**< 1: there is no position: the force is 0, contacts end, and the next tick counts as the
                                first */
    double attenuation;    /**< the share of the force that the caller will not send: 0 (default): none of it is
                                withheld; 1, anything outside 0 to 1, or NaN: all. It applies to the force that the
                                device can play, before the slew limit; outputs, counts and heat are of the rest. While
                                it is 1, the force is 0 whatever came before, and depths restart at 0, as on entry */
    uint32_t paused;       /**< 1: the HIP's position and velocity are reported, but nothing is touched: contacts end,
                                the force is 0, and the next tick counts as the first */
    uint32_t reserved[9];  /**< 0 */
} knurl_tick_input;

/** Bits of knurl_tick_output.flags. */
enum {
    KNURL_TICK_CONTACT = 1,        /**< the HIP is in contact: a surface is nearer than its grating's crests are high */
    KNURL_TICK_FORCE_LIMIT = 2,    /**< the force was shortened to max_force */
    KNURL_TICK_ABOVE_NYQUIST = 4,  /**< f_t is above f_h/2: the grating is too fine at this speed for the update rate */
    KNURL_TICK_NOT_FINITE = 8,     /**< the HIP is beyond KNURL_COORDINATE_MAX or faster than 1e15 m/s, or an input or a
                                        result was NaN or infinite: the force is 0 and all contacts end */
    KNURL_TICK_CONTACTS_FULL = 16, /**< more surfaces were in contact than KNURL_CONTACTS_MAX */
    KNURL_TICK_ENTRY = 32,         /**< the entry ramp limited a depth */
    KNURL_TICK_SLEW = 64,          /**< the slew rate limited the force */
    KNURL_TICK_HEAT = 128,         /**< the force was shortened because the motors are warm */
    KNURL_TICK_PASSIVITY = 256,    /**< the wall was softened because it made the HIP oscillate */
    KNURL_TICK_ABSENT = 512,       /**< the input said `absent` */
    KNURL_TICK_SQUEEZED = 1024,    /**< the proxy was caught between two surfaces, one of which moved over it: the
                                        moving surface no longer holds the HIP, and the force falls at slew_rate. Where
                                        two close at less than 11 degrees the proxy is caught, else pushed out */
    KNURL_TICK_VISIT_LIMIT = 2048  /**< contact met the tick's limit of visits (knurl_hip_desc.max_visits): a surface
                                        that holds the HIP goes on as the plane through its latest contact; a contact
                                        may begin late, or at a point that is not the nearest */
};

/** The output of one tick, in scene axes unless a field says otherwise; every number is finite. Of several contacts the
 * deepest is reported. */
typedef struct knurl_tick_output {
    double device_force[3]; /**< the force for the device: device axes, N, limited */
    double force[3];        /**< the same in scene axes, N */
    double hip[3];          /**< HIP position, m */
    double hip_velocity[3]; /**< m/s */
    double proxy[3];        /**< the proxy: the point on the surface that the HIP is held at, m; the HIP itself without
                                 contact */
    double normal[3];       /**< outward, unit; 0 without contact */
    double surface_velocity[2]; /**< vx, vy of the HIP relative to the surface in the surface's frame, m/s */
    double depth;               /**< -z: penetration depth, m; negative where the HIP is outside and only the grating's
                                     crests reach it; 0 without contact */
    double height;              /**< H: m; 0 without contact */
    double spatial_frequency;   /**< fs: cycles/m in the direction of motion */
    double temporal_frequency;  /**< f_t: Hz, of the motion over the grating, not clamped */
    int64_t event;              /**< number of the event that is being played, from 0 at the contact's begin, or
                                     KNURL_NO_EVENT */
    knurl_surface_id surface;   /**< the surface in contact, or 0 */
    uint64_t tick;              /**< 0, 1, ... since the HIP was configured */
    uint32_t flags;             /**< KNURL_TICK_ bits */
    uint32_t contacts;          /**< surfaces in contact, 0 to KNURL_CONTACTS_MAX */
    double cycles[2];           /**< where on the grating: the surface's coordinates times fsx and fsy, cycles from its
                                     origin; 0 without a grating or without coordinates */
    uint64_t reserved[6];       /**< 0 */
} knurl_tick_output;

/** Sums over a HIP's ticks since it was configured. */
typedef struct knurl_hip_counts {
    uint64_t ticks;
    uint64_t contact_ticks;       /**< with KNURL_TICK_CONTACT */
    uint64_t events;              /**< events started (S2), or ridges begun (BANDLIMITED) */
    uint64_t force_limit_ticks;   /**< ticks with KNURL_TICK_FORCE_LIMIT */
    uint64_t above_nyquist_ticks; /**< ticks with KNURL_TICK_ABOVE_NYQUIST */
    uint64_t non_finite_ticks;    /**< ticks with KNURL_TICK_NOT_FINITE */
    uint64_t entry_ticks;         /**< ticks with KNURL_TICK_ENTRY */
    uint64_t slew_ticks;          /**< ticks with KNURL_TICK_SLEW */
    uint64_t heat_ticks;          /**< ticks with KNURL_TICK_HEAT */
    uint64_t passivity_ticks;     /**< ticks with KNURL_TICK_PASSIVITY */
    double force_max;             /**< N: the greatest force so far */
    double heat;                  /**< heat of the motors: 0 is cold, 1 as warm as continuous_force makes them in the
                                       long run; above 1 only without KNURL_PROTECT_HEAT. A loop's HIP starts with its
                                       device's heat */
    double half_cycles_crossed;  /**< ridges and grooves that the HIP crossed, for every method, not rounded: the sum of
                                      2 f_t / f_h over all ticks and touched surfaces (Eq. 12; a stroke of L metres
                                      along x crosses 2 fsx L). For S1 and BANDLIMITED in the grating's coordinates, for
                                      S2 in metres; 0 without a grating */
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

/** Makes an empty scene. desc: null for all defaults.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_create(const knurl_scene_desc *desc, knurl_scene **scene);

/** Destroys a scene and frees its memory; null is allowed. A loop that uses the scene ends by itself with zero force,
 * and the memory is freed when the last such loop is destroyed. The caller must not use the handle or the surfaces'
 * names any more, and must not tick the scene. [game thread, or any while no other thread uses the scene] */
KNURL_API void knurl_scene_destroy(knurl_scene *scene);

/** Checks, copies and adds a surface; before the commit or after.
 * Errors: KNURL_ERROR_ARGUMENT (which field, expected, found), KNURL_ERROR_FULL, KNURL_ERROR_STALE_ID (shape_of),
 * KNURL_ERROR_MEMORY. surface: gets its id; may be null. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc,
                                               knurl_surface_id *surface);

/** Removes a surface, before or after the commit; contacts with it end at the next tick. Its id becomes stale. Its
 * memory is freed by a later edit, when no tick can use it any more.
 * Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface_id surface);

/** Replaces a surface under the same id, before or after the commit: shape, sides, axis, name, material and pose. A
 * contact goes on, as after a jump (knurl_scene_set_transform() with 0 seconds), where the HIP is at most 10 mm behind
 * the new surface. The old name becomes invalid.
 * Errors: KNURL_ERROR_STALE_ID and those of knurl_scene_add_surface() except KNURL_ERROR_FULL; the old surface is then
 * kept. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_replace_surface(knurl_scene *scene, knurl_surface_id surface,
                                                   const knurl_surface_desc *desc);

/** Changes a surface's material, before or after the commit. An event that is being played is played to its end.
 * Errors: KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY, and those of a material. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface_id surface,
                                                const knurl_material_desc *material);

/** Moves a surface's origin to `position` (m, within KNURL_COORDINATE_MAX) and rotates it to `rotation` (unit
 * quaternion x, y, z, w), both in scene axes, at constant speed over `seconds` (0 to 10; pass the game's frame time).
 * Then it stays until moved again. The motion is felt: velocities are relative to the surface. With 0 seconds it jumps:
 * what lies on the way is not touched, and a HIP that it held is tested again as on a first tick. Time advances with
 * ticks: without ticks the motion waits; before the commit it is done at once. Errors: KNURL_ERROR_ARGUMENT,
 * KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface_id surface, const double position[3],
                                                 const double rotation[4], double seconds);

/** Where a surface's origin is now, and how it is rotated (unit quaternion x, y, z, w), in scene axes: of one that
 * moves, on its way. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_transform(const knurl_scene *scene, knurl_surface_id surface, double position[3],
                                                 double rotation[4]);

/** 1 where the id names a surface of this scene; else 0, without a message. [any thread but the haptic] */
KNURL_API uint32_t knurl_scene_has_surface(const knurl_scene *scene, knurl_surface_id surface);

/** Stores a pointer of the caller's with a surface, for example to the game's object; the scene never uses it.
 * knurl_scene_replace_surface() keeps it. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_user_data(knurl_scene *scene, knurl_surface_id surface, void *user_data);

/** The pointer that knurl_scene_set_user_data() stored; null where none was. Errors: KNURL_ERROR_STALE_ID. [any thread
 * but the haptic] */
KNURL_API knurl_result knurl_scene_get_user_data(const knurl_scene *scene, knurl_surface_id surface, void **user_data);

/** A point of a surface. An output: set struct_size with knurl_surface_point_init() first. */
typedef struct knurl_surface_point {
    uint32_t struct_size;
    uint32_t reserved;        /**< 0 */
    knurl_surface_id surface; /**< 0: none was found; the rest is 0 then */
    double distance;          /**< m */
    double position[3];       /**< scene axes, m */
    double normal[3];         /**< unit, scene axes: outward from the front of the triangle or plane */
} knurl_surface_point;

/** Sets struct_size; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_point_init(knurl_surface_point *point, uint32_t size);

/** Finds the point of all surfaces, as they stand now, that is closest to `position` (scene axes, m, within
 * KNURL_COORDINATE_MAX), up to `radius` (m, > 0) away. Gratings do not count. Takes longer the more surfaces there are;
 * other editing threads wait, ticks do not. Errors: KNURL_ERROR_ARGUMENT. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_find_closest(const knurl_scene *scene, const double position[3], double radius,
                                                knurl_surface_point *point);

/** Finds the point where the straight line from `from` to `to` (scene axes, m, within KNURL_COORDINATE_MAX) first goes
 * through a surface, as surfaces stand now: through its front or, where it is double-sided, through either side.
 * Gratings do not count. point->distance is measured from `from`. A line that ends on a surface does not go through it.
 * Takes longer the more surfaces there are; other editing threads wait, ticks do not. Errors: KNURL_ERROR_ARGUMENT.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_cast_ray(const knurl_scene *scene, const double from[3], const double to[3],
                                            knurl_surface_point *point);

/** Prepares the scene for ticks: builds the broad phase over its surfaces. Call it once, after the first surfaces.
 * Errors: KNURL_ERROR_STATE (committed already), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_commit(knurl_scene *scene);

/** Surfaces in the scene. [any thread] */
KNURL_API uint32_t knurl_scene_get_surface_count(const knurl_scene *scene);

/** The id of surface number `index`, 0 <= index < count, in the order of adding; 0 beyond. [any thread] */
KNURL_API knurl_surface_id knurl_scene_get_surface(const knurl_scene *scene, uint32_t index);

/** Finds a surface by name: the first in the order of adding.
 * Errors: KNURL_ERROR_UNKNOWN, with the names that exist. [any thread] */
KNURL_API knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface_id *surface);

/** A surface's name; the scene's, valid while the surface exists. Errors: KNURL_ERROR_STALE_ID. [any thread] */
KNURL_API knurl_result knurl_scene_get_surface_name(const knurl_scene *scene, knurl_surface_id surface,
                                                    const char **name);

/** A surface's material as rendered: the default method is resolved. material: set its struct_size with
 * knurl_material_desc_init() first. Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_get_material(const knurl_scene *scene, knurl_surface_id surface,
                                                knurl_material_desc *material);

/** Describes how the scene has built a surface. It searches for the anchor: too slow for every frame. Errors:
 * KNURL_ERROR_STALE_ID. [any thread] */
KNURL_API knurl_result knurl_scene_get_surface_info(const knurl_scene *scene, knurl_surface_id surface,
                                                    knurl_surface_info *info);

/** All memory that the scene uses now, in bytes, with what edits replaced and ticks may still use. [any thread but the
 * haptic] */
KNURL_API uint64_t knurl_scene_get_bytes(const knurl_scene *scene);

/** Frees the memory that edits replaced and no tick uses any more. Optional: the next edit does it too. [any thread but
 * the haptic] */
KNURL_API void knurl_scene_collect(knurl_scene *scene);

/** Sets up one HIP and clears its state and counts, but not its motors' heat (in a loop, its device's). hip: 0 to
 * hip_count - 1. desc: null for all defaults, which also hold until the first call.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (a loop has it). [game thread, while the caller's own thread does not
 * tick that HIP] */
KNURL_API knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc);

/** The workspace map of a HIP, also where the scene chose it at the commit; of one that moves, where it will be.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (to be chosen by the scene, which is not committed). [any thread but
 * the haptic] */
KNURL_API knurl_result knurl_scene_get_workspace(const knurl_scene *scene, uint32_t hip, knurl_workspace *workspace);

/** Moves a HIP's workspace and changes its scale, also while it ticks. It moves evenly over `seconds` (0 to 10) and
 * carries the HIP with it, in contact with what it meets. A change of scale moves the HIP too, towards the workspace's
 * origin or away from it. It takes at least 0.2 s for a factor of e, and goes on where a later call gives the same
 * scale again. With 0 s the workspace jumps, at once in its scale: contacts end, and the next tick is a first one. A
 * loop that is created later keeps the workspace; knurl_scene_configure_hip() replaces it. Errors: KNURL_ERROR_ARGUMENT
 * (hip, workspace, seconds), KNURL_ERROR_STATE (not committed). [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_workspace(knurl_scene *scene, uint32_t hip, const knurl_workspace *workspace,
                                                 double seconds);

/** The limits of a device that a surface can exceed. K s is its stiffness in device metres. */
enum {
    KNURL_LIMIT_STABILITY = 1, /**< K s above the closed-form bound for the HIP's rate, delay and damping */
    KNURL_LIMIT_STIFFNESS = 2, /**< K s above the device's max_stiffness */
    KNURL_LIMIT_AMPLITUDE = 4, /**< the texture's highest force swing, K A times the method's peaks, above max_force */
    KNURL_LIMIT_HEAT = 8,      /**< the texture's rms force K A above the device's continuous_force */
    KNURL_LIMIT_PERIOD = 16,   /**< ridges finer than two of the device's position quanta */
    KNURL_LIMIT_FAR = 64, /**< farther than KNURL_FAR from the scene's origin: float32 positions are centimetres apart
                               there */
    KNURL_LIMIT_VISITS = 128,  /**< contact meets knurl_hip_desc.max_visits at one of 65 places of the mesh; or 15 other
                                    meshes come within 1 mm of its anchor (once committed) */
    KNURL_LIMIT_WINDING = 256, /**< mixed winding, turned over (knurl_surface_info.turned_triangles) or not */
    KNURL_LIMIT_STRETCH = 32   /**< uneven uvs: somewhere S1 and BANDLIMITED render more than KNURL_STRETCH_MAX times
                                    the material's ridges per metre, or fewer than 1 / KNURL_STRETCH_MAX */
};

/** m: beyond this distance from the origin, the float32 coordinates of meshes and engines are 6 cm apart or more. */
#define KNURL_FAR 1000000.0

/** The stretch that is warned of: an octave. Hands feel it, and a good unwrapping of uvs stays below it. */
#define KNURL_STRETCH_MAX 2.0

/** How a surface fits a device. An output: set struct_size with knurl_surface_check_init() first. */
typedef struct knurl_surface_check {
    uint32_t struct_size;
    uint32_t exceeded;      /**< KNURL_LIMIT_ bits; 0: none */
    double stiffness;       /**< N/m at the device: K times the workspace's scale */
    double stiffness_limit; /**< N/m: the least of its bounds */
    double amplitude;       /**< m */
    double amplitude_limit; /**< m: at the device's stiffness */
    char message[1024];     /**< a sentence for each limit: which, by how much, what to do; "" where none is exceeded */
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
 * once, of whatever surfaces; each gives a force by how far it holds the proxy back. Surfaces below the first one are
 * not felt. A HIP that slides off one surface goes over to the next if that is at most 1 mm higher, or lower by any
 * amount; cracks are crossed within 5 ms, and those of up to 0.1 um do not exist. With more than 32 surfaces near one
 * point, some may be missed (KNURL_TICK_CONTACTS_FULL).
 *
 * Bounded time: contact looks at no more than knurl_hip_desc.max_visits triangles, planes and nodes (half as many
 * more where a contact begins), the search for nearby surfaces at those that moved lately and few others (all with
 * KNURL_FULL_SEARCH). No heap, lock, system call, clock, log or file, whatever other threads edit. `output` is always
 * filled in, with zero force where the result is not KNURL_OK. Errors: KNURL_ERROR_STATE (not committed, or a loop has
 * the HIP), KNURL_ERROR_ARGUMENT (hip, null or an invalid handle). [haptic thread, one per HIP] */
KNURL_API knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip, const knurl_tick_input *input,
                                        knurl_tick_output *output) KNURL_NONBLOCKING;

/** Runs `count` ticks one after another, each as knurl_scene_tick(), for simulations and for callers to whom each call
 * is costly. inputs, outputs: `count` each, the caller's; all outputs are filled in unless scene, inputs or outputs is
 * invalid. Returns the first error; later ticks run all the same. Errors: those of knurl_scene_tick(). [haptic thread,
 * one per HIP] */
KNURL_API knurl_result knurl_scene_tick_batch(knurl_scene *scene, uint32_t hip, const knurl_tick_input *inputs,
                                              uint64_t count, knurl_tick_output *outputs) KNURL_NONBLOCKING;

/** A consistent snapshot of the latest tick of a HIP, for cursors and plots; all zeros before the first tick. output,
 * counts: either may be null.
 * Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_scene_get_tick(const knurl_scene *scene, uint32_t hip, knurl_tick_output *output,
                                            knurl_hip_counts *counts);

/** One of the contacts of a HIP, scene axes. */
typedef struct knurl_hip_contact {
    knurl_surface_id surface;
    double proxy[3];      /**< the point on the surface that the HIP is held at, m */
    double normal[3];     /**< outward, unit */
    double depth;         /**< m; negative where only the grating's crests reach the HIP */
    uint64_t reserved[6]; /**< 0 */
} knurl_hip_contact;

/** All contacts of a HIP's latest tick; knurl_tick_output has the deepest alone. contacts: room for `capacity`, the
 * caller's; may be null where that is 0. Returns how many contacts there are, at most KNURL_CONTACTS_MAX; 0 for an
 * invalid handle or HIP. [haptic thread: the one that ticks this HIP, for example in a loop's tick_callback] */
KNURL_API uint32_t knurl_scene_get_contacts(const knurl_scene *scene, uint32_t hip, knurl_hip_contact *contacts,
                                            uint32_t capacity) KNURL_NONBLOCKING;

/** Locks all memory of the scene into RAM (mlock), so that no tick waits for a page. A loop calls it by itself.
 * Errors: KNURL_ERROR_SYSTEM (the system's limit; the scene works without). [game thread] */
KNURL_API knurl_result knurl_scene_lock_memory(knurl_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
