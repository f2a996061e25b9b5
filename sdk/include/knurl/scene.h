/* Knurl: surfaces with gratings, and the tick that renders them.
 * Life of a scene: create, add surfaces, commit [game thread]; then tick [haptic thread], one thread per HIP, while any
 * thread edits: adds and removes surfaces, moves them, changes how they feel. Editing threads wait for one another;
 * ticks wait for nobody. A tick sees each edit whole or not at all, and of several the newest.
 * Frames are right-handed (glTF's), units SI. `in` and `out` below are from the library's point of view.
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

/** Names a surface of one scene: its place there, which surface at that place, and which of the process's scenes. 0
 * names none; an id outlives its surface as a stale one, and is stale in every other scene (KNURL_ERROR_STALE_ID). That
 * holds for 2^23 surfaces at one place and 2^20 scenes one after another; then numbers are used again. */
typedef uint64_t knurl_surface_id;

/** Surfaces that one HIP can touch at once. */
#define KNURL_CONTACTS_MAX 4

/** Update rates that a HIP can tick at, Hz. */
#define KNURL_UPDATE_RATE_MIN 100.0
#define KNURL_UPDATE_RATE_MAX 10000.0

/** How a surface feels. K, A and fs are per scene metre. */
typedef struct knurl_material_desc {
    uint32_t struct_size;        /**< set by knurl_material_desc_init() */
    int32_t method;              /**< KNURL_METHOD_DEFAULT (LOCKED), KNURL_S1, KNURL_S2, KNURL_LOCKED, KNURL_AREA */
    double spatial_frequency[2]; /**< fsx, fsy: cycles/m along the surface's x and y, >= 0; [0, 0] is smooth */
    double amplitude;            /**< A: m, half peak to peak of the square wave, >= 0 */
    double stiffness;            /**< K: N/m, > 0 */
    double damping;              /**< B: N s/m along the normal, >= 0 */
    double friction;             /**< Coulomb coefficient, >= 0: sticks until K times the way dragged exceeds friction
                                      times K max(0, -z), then slips; the height does not load it */
    double orientation;          /**< turns x and y counter-clockwise about the normal, rad */
} knurl_material_desc;

/** One surface: a plane or a mesh, where it stands, and its material. What is pointed to is copied. */
typedef struct knurl_surface_desc {
    uint32_t struct_size;                /**< set by knurl_surface_desc_init() */
    uint32_t double_sided;               /**< 1: can be touched from behind as well */
    const char *name;                    /**< UTF-8, for reports; null for "" */
    const knurl_plane_desc *plane;       /**< exactly one of plane, mesh and shape_of */
    const knurl_mesh_desc *mesh;         /**< exactly one of plane, mesh and shape_of */
    const knurl_material_desc *material; /**< required */
    double position[3];                  /**< the surface's origin in the scene, m */
    double rotation[4];                  /**< surface to scene: unit quaternion x, y, z, w */
    double axis[3];                      /**< the grating's x in the surface's frame (any length); 0, 0, 0: a plane's x,
                                              a mesh's tangents, else its uvs. With an axis, surface coordinates are
                                              metres from the surface's origin along it */
    knurl_surface_id shape_of;           /**< a surface of this scene: this one has the same shape and axis, built once
                                              and held once, for as long as one of them is there; 0: none */
} knurl_surface_desc;

/** The protections of a HIP, all on by default; one may be left out, to study what it does. */
enum {
    KNURL_PROTECT_ENTRY = 1,     /**< the depth that is felt grows at KNURL_ENTRY_SPEED_MAX, and does not jump */
    KNURL_PROTECT_SLEW = 2,      /**< the force jumps by no more than the texture's step and slew_rate */
    KNURL_PROTECT_HEAT = 4,      /**< the force comes down to continuous_force as the motors warm up */
    KNURL_PROTECT_PASSIVITY = 8, /**< a wall that shakes the hand by itself is felt softer */
    KNURL_PROTECT_ALL = 15
};

/** m/s: the felt depth grows no faster, so that a wall that is suddenly there comes in as a ramp. */
#define KNURL_ENTRY_SPEED_MAX 0.5

/** One haptic interaction point: how fast it ticks, where its device's workspace lies, what its device can do. */
typedef struct knurl_hip_desc {
    uint32_t struct_size;    /**< set by knurl_hip_desc_init() */
    int32_t velocity_method; /**< KNURL_VELOCITY_; default AUTO */
    double update_rate_hz;   /**< KNURL_UPDATE_RATE_MIN to _MAX; 0 (default): the loop's, without one 1000 */
    double resolution;       /**< the device's position quantum, m; negative (default): as the loop's device says,
                                  without one 0.055e-3 (Touch) */
    double max_force;        /**< N; longer forces are shortened to it, and to the loop's device's; 0 (default): as the
                                  loop's device says, without one 3.3 (Touch) */
    const knurl_workspace *workspace; /**< device to scene; null (default): not turned, scale 1, the device's origin at
                                           the centre of all surfaces' bounds */
    double continuous_force; /**< N that the motors can hold for ever; 0 (default): as the loop's device says, without
                                  one 0.88 (Touch); INFINITY: no limit but max_force */
    double heat_time;        /**< s: time constant of the motors' warming; 0 (default): as the loop's device says,
                                  without one the Touch's */
    double viscous;          /**< N s/m: the device's viscous friction, for knurl_scene_check_surface() and the
                                  passivity controller; negative (default): as the loop's device says, without one the
                                  Touch's */
    double delay;            /**< ticks from a force written to a force felt, 0 to 16; negative (default): as the
                                  loop's device says, without one 1 */
    double max_stiffness;    /**< N/m: the stiffest wall that the device's maker promises; 0 (default): as the loop's
                                  device says, without one the Touch's */
    double slew_rate;        /**< N/s: the force grows or turns no faster, but for the texture's own steps; 0
                                  (default): max_force within 5 ms */
    uint32_t protections;    /**< KNURL_PROTECT_ bits; default KNURL_PROTECT_ALL */
    uint32_t clamp;          /**< 1: walls and textures beyond what knurl_scene_check_surface() allows are felt at
                                  what it allows; default 0: they are felt as asked for */
} knurl_hip_desc;

/** The reductions a scene makes, so that it models no more than it needs; a bit turns one off, to compare. */
enum {
    KNURL_FULL_MESHES = 1,  /**< flat meshes stay meshes, instead of planes with an outline */
    KNURL_FULL_SEARCH = 2,  /**< every tick looks at every surface, instead of at those near the HIP */
    KNURL_FULL_GRATING = 4, /**< smooth surfaces run the grating stage too */
    KNURL_FULL_ALL = 7
};

typedef struct knurl_scene_desc {
    uint32_t struct_size;             /**< set by knurl_scene_desc_init() */
    uint32_t max_surfaces;            /**< capacity, 1 to 2^20; default 4096 */
    uint32_t hip_count;               /**< HIPs, 1 to 8; default 1 */
    uint32_t full_model;              /**< KNURL_FULL_ bits: reductions that are not to be made; default 0 */
    const knurl_allocator *allocator; /**< copied; null: malloc and free */
} knurl_scene_desc;

/** What a surface came to be. An output: set struct_size with knurl_surface_info_init() first. */
typedef struct knurl_surface_info {
    uint32_t struct_size;
    uint32_t triangle_count;      /**< 0 for a plane */
    uint32_t dropped_triangles;   /**< left out for want of area, or as duplicates */
    uint32_t double_sided;        /**< 1: as it was given, or because triangles came in reversed pairs */
    const char *name;             /**< the scene's, valid while the surface is */
    const char *shape;            /**< "plane" or "mesh": what was given; static */
    const char *model;            /**< what a tick works on: "plane", "plane+outline" or "mesh+bvh"; static */
    uint64_t bytes;               /**< memory this surface holds in the scene; of a shape that several have
                                       (knurl_surface_desc.shape_of), its part */
    double bounds_min[3];         /**< scene axes, m */
    double bounds_max[3];         /**< scene axes, m */
    double anchor[3];             /**< a point on the surface near the middle of its bounds, scene, m */
    double anchor_x[3];           /**< unit, scene: the grating's x at the anchor */
    double anchor_normal[3];      /**< unit, scene: the outward normal at the anchor */
    double anchor_reach[4];       /**< m from the anchor straight on along +x, -x, +y, -y to the edge of the bounds: how
                                       far a flat surface goes at most. Of a curved one it says nothing: the straight
                                       line leaves it, and the bounds may end where it begins. See
                                       knurl_fake_lay_stroke() */
    double stretch[3];            /**< min, mean, max of d(surface coordinate)/d(metres travelled) along x, before
                                       `orientation` turns it; 1: true. S1 and LOCKED feel fs times it */
    knurl_material_desc material; /**< as felt: method resolved */
    const char *why;              /**< why this model, in a sentence; static */
    double model_error;           /**< m: the model's surface lies within this of what was given */
    uint32_t reversed_twins;      /**< triangles left out because another has the same corners, facing the other way */
    uint32_t reserved;            /**< 0 */
    double axis[3];               /**< unit, the surface's frame: the axis that was given; 0 without one */
    double stretch_y[3];          /**< as stretch, along y */
    double seam;                  /**< m: edges that run side by side within this touch: by the size and float32 */
    uint64_t touching_pairs; /**< of a mesh's triangles, other than along an edge that they share: T-junctions, seams,
                                  parts that go through each other. There a tick takes longer; 0: a clean mesh */
} knurl_surface_info;

/** What a device says at one tick. */
typedef struct knurl_tick_input {
    double position[3];    /**< device frame, m */
    double velocity[3];    /**< device frame, m/s; used where has_velocity is 1 */
    uint32_t has_velocity; /**< 0: the HIP's own estimator gives the velocity */
    uint32_t absent;       /**< 1: there is no position: nothing is felt, contacts end, the next tick is a first one */
    double attenuation;    /**< how much of the force is not sent: 0 (as in a zeroed struct): none, 1: all of it; beyond
                                that or NaN: all of it. It is taken off what the device can play, before the slew limit,
                              and the output, the counts and the heat are of what is left. While it is 1 the felt depth is
                              0, so that walls come back as after an entry */
    uint32_t paused;       /**< 1: the HIP is told, but nothing is touched: contacts end, no force, the next tick is a
                                first one */
    uint32_t reserved;     /**< 0 */
} knurl_tick_input;

/** Bits of knurl_tick_output.flags. */
enum {
    KNURL_TICK_CONTACT = 1,        /**< some surface is in reach of its grating's crests */
    KNURL_TICK_FORCE_LIMIT = 2,    /**< the force was shortened to max_force */
    KNURL_TICK_FREQUENCY = 4,      /**< f_t above f_h/2: the grating is finer than the update rate can render */
    KNURL_TICK_NOT_FINITE = 8,     /**< a NaN or infinity came in or arose: the force is 0 and all contacts end */
    KNURL_TICK_CONTACTS_FULL = 16, /**< a further surface was in reach, beyond KNURL_CONTACTS_MAX */
    KNURL_TICK_ENTRY = 32,         /**< a wall came in as a ramp */
    KNURL_TICK_SLEW = 64,          /**< the force was kept from jumping */
    KNURL_TICK_HEAT = 128,         /**< the force was shortened to what warm motors can hold */
    KNURL_TICK_PASSIVITY = 256,    /**< the wall was softened because the HIP kept bouncing in it, unasked */
    KNURL_TICK_ABSENT = 512,       /**< there was no position, as the input said */
    KNURL_TICK_SQUEEZED = 1024     /**< a surface moved over the HIP's proxy, which another kept from giving way: the
                                        one that moved does not hold the HIP any more */
};

/** What a tick came to. Scene axes but for device_force and where said. Of several contacts the deepest is told. */
typedef struct knurl_tick_output {
    double device_force[3]; /**< what the device is to play: device axes, N, limited, always finite */
    double force[3];        /**< the same in scene axes, N */
    double hip[3];          /**< HIP position, m */
    double hip_velocity[3]; /**< m/s */
    double proxy[3];        /**< the point of the surface that holds the HIP, m; the HIP where there is no contact */
    double normal[3];       /**< outward, unit; 0 without contact */
    double surface_velocity[2]; /**< vx, vy of the HIP relative to the surface in the surface's frame, m/s */
    double depth;               /**< -z: penetration depth, m, negative while the HIP is still outside; 0 w/o contact */
    double height;              /**< H: m; 0 without contact */
    double spatial_frequency;   /**< fs: cycles/m in the direction of motion */
    double temporal_frequency;  /**< f_t: Hz, as the motion asks for it */
    int64_t event;              /**< the event that plays, counted since contact, or KNURL_NO_EVENT */
    knurl_surface_id surface;   /**< the surface felt, or 0 */
    uint64_t tick;              /**< 0, 1, ... since the HIP was configured */
    uint32_t flags;             /**< KNURL_TICK_ bits */
    uint32_t contacts;          /**< surfaces in contact, 0 to KNURL_CONTACTS_MAX */
} knurl_tick_output;

/** Sums over a HIP's ticks since it was configured. */
typedef struct knurl_hip_counts {
    uint64_t ticks;
    uint64_t contact_ticks;      /**< with KNURL_TICK_CONTACT */
    uint64_t events;             /**< events started (S2, LOCKED) */
    uint64_t force_limit_ticks;  /**< ticks with KNURL_TICK_FORCE_LIMIT */
    uint64_t saturation_ticks;   /**< ticks with KNURL_TICK_FREQUENCY */
    uint64_t non_finite_ticks;   /**< ticks with KNURL_TICK_NOT_FINITE */
    uint64_t entry_ticks;        /**< ticks with KNURL_TICK_ENTRY */
    uint64_t slew_ticks;         /**< ticks with KNURL_TICK_SLEW */
    uint64_t heat_ticks;         /**< ticks with KNURL_TICK_HEAT */
    uint64_t passivity_ticks;    /**< ticks with KNURL_TICK_PASSIVITY */
    double force_max;            /**< N, longest force played */
    double heat;                 /**< 0 cold to 1: as warm as continuous_force makes the motors in the long run; above
                                      1 only without KNURL_PROTECT_HEAT. A loop's HIP begins with its device's */
    double half_cycles_crossed;  /**< ridges and grooves that the HIP passed, with every method and not rounded: the
                                      sum of 2 f_t / f_h over all touched surfaces' ticks (Eq. 12: a stroke of L
                                      metres along x crosses 2 fsx L). Of LOCKED in the grating's own coordinates,
                                      of S1 and S2 in metres; without a grating none */
    uint64_t half_cycles_played; /**< half cycles that began after others: sign changes of the rendered heights */
    uint64_t squeezed_ticks;     /**< ticks with KNURL_TICK_SQUEEZED */
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

/** Gives everything back; null is allowed. While a loop has a HIP of the scene, the scene is kept for that loop, which
 * ends by itself, its force zero at once; the last such loop's knurl_loop_destroy() then frees it. To the caller it is
 * gone: its handle and its surfaces' names are not to be used. No tick of the caller's own may run or follow. [game
 * thread, or any that destroys what nobody else uses] */
KNURL_API void knurl_scene_destroy(knurl_scene *scene);

/** Checks, copies and adds a surface; before the commit or after.
 * Errors: KNURL_ERROR_ARGUMENT (which field, expected, found), KNURL_ERROR_FULL, KNURL_ERROR_STALE_ID (shape_of),
 * KNURL_ERROR_MEMORY. surface: gets its id; may be null. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_add_surface(knurl_scene *scene, const knurl_surface_desc *desc,
                                               knurl_surface_id *surface);

/** Takes a surface out, before the commit or after: contacts with it end at the next tick. Its id is stale from
 * then on; its memory is given back by a later edit, when no tick can see it any more.
 * Errors: KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_remove_surface(knurl_scene *scene, knurl_surface_id surface);

/** Puts another surface in a surface's place, before the commit or after: another shape, side, axis, name, material and
 * place under the same id. What is touched goes on being touched, as after a move in no time: a HIP that was in contact
 * is in contact with the new surface where it is at most 10 mm behind it. The old name is gone with the old surface.
 * Errors: KNURL_ERROR_STALE_ID and those of knurl_scene_add_surface() but KNURL_ERROR_FULL; the old surface then stays.
 * [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_replace_surface(knurl_scene *scene, knurl_surface_id surface,
                                                   const knurl_surface_desc *desc);

/** Gives a surface another material, before the commit or after; an event that plays is played to its end.
 * Errors: KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY, and those of a material. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_material(knurl_scene *scene, knurl_surface_id surface,
                                                const knurl_material_desc *material);

/** Moves a surface's origin to `position` (m) and turns it to `rotation` (unit quaternion x, y, z, w), both scene axes,
 * evenly over `seconds` (0 to 10: the game's frame time) from where it is now; there it stays until moved again. What
 * slides under a HIP is felt: velocities are taken relative to the surface. 0 seconds: it stands there at once, and
 * what it passed on the way is not touched (a HIP that it held is looked at anew, as at a first tick). Time is counted
 * by ticks: while none runs, the way waits to be made; before the commit it is made at once.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STALE_ID, KNURL_ERROR_MEMORY. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_transform(knurl_scene *scene, knurl_surface_id surface, const double position[3],
                                                 const double rotation[4], double seconds);

/** Opens the scene to ticks, having sorted its surfaces by where they are.
 * Errors: KNURL_ERROR_STATE (committed already), KNURL_ERROR_MEMORY. [game thread] */
KNURL_API knurl_result knurl_scene_commit(knurl_scene *scene);

/** Surfaces in the scene. [any thread] */
KNURL_API uint32_t knurl_scene_get_surface_count(const knurl_scene *scene);

/** The id of the surface at place `index`, 0 <= index < count, in the order of adding; 0 beyond. [any thread] */
KNURL_API knurl_surface_id knurl_scene_get_surface(const knurl_scene *scene, uint32_t index);

/** The first surface of that name, in the order of adding.
 * Errors: KNURL_ERROR_UNKNOWN, with the names that are there. [any thread] */
KNURL_API knurl_result knurl_scene_find_surface(const knurl_scene *scene, const char *name, knurl_surface_id *surface);

/** A surface's name, the scene's, valid while the surface is. Errors: KNURL_ERROR_STALE_ID. [any thread] */
KNURL_API knurl_result knurl_scene_get_surface_name(const knurl_scene *scene, knurl_surface_id surface,
                                                    const char **name);

/** Tells what a surface came to be; looks for its anchor, so not for every frame. Errors: KNURL_ERROR_STALE_ID. [any
 * thread] */
KNURL_API knurl_result knurl_scene_get_surface_info(const knurl_scene *scene, knurl_surface_id surface,
                                                    knurl_surface_info *info);

/** Memory that the scene holds now, in bytes, all of it: with what edits have replaced and ticks may still see. [any
 * thread but the haptic] */
KNURL_API uint64_t knurl_scene_get_bytes(const knurl_scene *scene);

/** Memory given back early: frees what edits have replaced and no tick can see any more, which else the next edit does.
 * [any thread but the haptic] */
KNURL_API void knurl_scene_collect(knurl_scene *scene);

/** Sets up one HIP and forgets what it did, but not how warm its motors are (with a loop: its device's). hip: 0 to
 * hip_count - 1. desc: null for all defaults. Until it is called a HIP has the defaults. Errors: KNURL_ERROR_ARGUMENT,
 * KNURL_ERROR_STATE (a loop has it). [game thread, while the caller's own thread does not tick that HIP] */
KNURL_API knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc);

/** The workspace that a HIP's ticks use; after the commit also where it was left to the scene.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (left to the scene, not committed yet). [any thread but the haptic]
 */
KNURL_API knurl_result knurl_scene_get_workspace(const knurl_scene *scene, uint32_t hip, knurl_workspace *workspace);

/** The limits that a surface can exceed on a device. */
enum {
    KNURL_LIMIT_STABILITY = 1, /**< K s above the closed-form bound for the HIP's rate, delay and damping */
    KNURL_LIMIT_STIFFNESS = 2, /**< K s above the device's max_stiffness */
    KNURL_LIMIT_AMPLITUDE = 4, /**< the texture's highest force swing, K A times the method's peaks, above max_force */
    KNURL_LIMIT_HEAT = 8,      /**< the texture's rms force K A above the device's continuous_force */
    KNURL_LIMIT_PERIOD = 16,   /**< ridges finer than two of the device's position quanta */
    KNURL_LIMIT_FAR = 64, /**< more than KNURL_FAR from the scene's origin: float32 positions lie centimetres apart */
    KNURL_LIMIT_STRETCH = 32 /**< somewhere S1 or LOCKED feel more than KNURL_STRETCH_MAX times the ridges a metre that
                                  the material says, or fewer than one in so many: uneven uvs */
};

/** m: farther from the origin, coordinates in float32, which meshes and engines have, lie 6 cm apart and more. */
#define KNURL_FAR 1000000.0

/** A factor that hands can tell, and unwrapped uvs can keep: an octave. */
#define KNURL_STRETCH_MAX 2.0

/** What a device makes of a surface. An output: set struct_size with knurl_surface_check_init() first. */
typedef struct knurl_surface_check {
    uint32_t struct_size;
    uint32_t exceeded;      /**< KNURL_LIMIT_ bits; 0: nothing to warn of */
    double stiffness;       /**< N/m that the device feels: K times the workspace's scale */
    double stiffness_limit; /**< N/m: the least of its bounds */
    double amplitude;       /**< m */
    double amplitude_limit; /**< m: at the stiffness that is felt */
    char message[1024];     /**< a sentence for each limit: which, by how much, what to do; "" where none is exceeded */
} knurl_surface_check;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_surface_check_init(knurl_surface_check *check, uint32_t size);

/** Holds a surface's stiffness and amplitude against what the HIP's device can do: to be asked at load, before anybody
 * feels it. A game shows the message; knurl_hip_desc.clamp has the limits kept. Errors: KNURL_ERROR_ARGUMENT (hip),
 * KNURL_ERROR_STALE_ID. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_check_surface(const knurl_scene *scene, uint32_t hip, knurl_surface_id surface,
                                                 knurl_surface_check *check);

/** One tick of one HIP, of the nominal length 1/update_rate: position in, force out (Eq. 9: F = max(0, K (H - z) - B
 * vn) along n for each surface in contact, and friction across it). A HIP that is pressed in is held by every face that
 * its proxy has not gone through from the front, at most three at once, whichever surface each belongs to; each is felt
 * as deep as it holds the proxy back. What lies below the first surface met is not felt. Slid off one surface, a HIP is
 * held by the next, where that lies at most 1 mm higher or anywhere below, and a crack between them is crossed within
 * 5 ms; one of 0.1 um is none. Of more than 32 surfaces about one place some may be overlooked
 * (KNURL_TICK_CONTACTS_FULL says so). Bounded time; no heap, lock, system call, clock, log or file, whatever other
 * threads edit meanwhile. `output` is always filled in, with a zero force where the result is not KNURL_OK. Errors:
 * KNURL_ERROR_STATE (not committed, or a loop has the HIP), KNURL_ERROR_ARGUMENT (hip, null or a handle that is none).
 * [haptic thread, one a HIP] */
KNURL_API knurl_result knurl_scene_tick(knurl_scene *scene, uint32_t hip, const knurl_tick_input *input,
                                        knurl_tick_output *output) KNURL_NONBLOCKING;

/** The latest complete tick of a HIP, as one consistent snapshot, for cursors and plots. All zeros before the first.
 * output, counts: either may be null.
 * Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_scene_get_tick(const knurl_scene *scene, uint32_t hip, knurl_tick_output *output,
                                            knurl_hip_counts *counts);

/** Locks all memory of the scene into RAM (mlock), so that no tick waits for a page. knurl_loop calls it.
 * Errors: KNURL_ERROR_SYSTEM (a limit of the system; the scene works all the same). [game thread] */
KNURL_API knurl_result knurl_scene_lock_memory(knurl_scene *scene);

#ifdef __cplusplus
}
#endif
#endif
