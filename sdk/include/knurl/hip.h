/* Knurl: haptic interaction points (HIPs): their set-up, their workspace in the scene, and the tick that computes their
 * force. A scene (scene.h) has one to eight, each ticked by one haptic thread; a loop (loop.h) does it for a device.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_HIP_H
#define KNURL_HIP_H

#include <knurl/motion.h>
#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Surfaces that one HIP can touch at once. */
#define KNURL_CONTACTS_MAX 4

/** Range of a HIP's update rate, Hz. */
#define KNURL_UPDATE_RATE_MIN 100.0
#define KNURL_UPDATE_RATE_MAX 10000.0

/** The protections of a HIP, all on by default. */
enum {
    KNURL_PROTECT_ENTRY = 1, /**< entry ramp: the depth in Eq. 9 grows at most at 0.5 m/s, so that a wall that appears
                                around the HIP pushes it out gradually */
    KNURL_PROTECT_SLEW = 2,  /**< the device's force grows and turns at most at slew_rate, except for the texture's own
                                steps; after KNURL_TICK_SQUEEZED it also falls at most at that rate */
    KNURL_PROTECT_HEAT = 4,  /**< the force is reduced towards continuous_force as the motors warm up */
    KNURL_PROTECT_PASSIVITY = 8, /**< a wall is softened if it makes the hand oscillate, effects so that they do not */
    KNURL_PROTECT_ALL = 15
};

/** Visits of a tick, the limit of contact's cost: of triangles, planes and nodes of meshes' hierarchies. The closest
 * point of a triangle is five visits, or ten if the proxy walks to it. The worst scenes known, most of which use them
 * all, were measured at 8 to 11 us a tick (99th percentile) and 9 to 16 us (99.9th) without interruptions. Tuned: with
 * 600, the proxy was inside in 2 of 70,000 presses into moving meshes; with 800, in 0 of 1,050,000 presses in rooms of
 * 15 kinds. */
#define KNURL_VISITS_MAX 800

/** One haptic interaction point (HIP): its workspace in the scene and the limits of its device. A number that is
 * KNURL_DEFAULT, as knurl_hip_desc_init() sets them all, is that of the loop's device or, without a loop, of a Touch
 * (in brackets). */
typedef struct knurl_hip_desc {
    uint32_t struct_size; /**< set by knurl_hip_desc_init() */
    uint32_t protections; /**< KNURL_PROTECT_ bits; default KNURL_PROTECT_ALL */
    uint32_t clamp;       /**< 1: stiffness and amplitude are clamped to the limits of knurl_scene_check_surface();
                             default 0: rendered as given */
    uint32_t reserved;    /**< 0 */
    const knurl_workspace *workspace; /**< device to scene; null (default): no rotation, scale 1, the device's origin at
                                           the centre of all surfaces' bounds */
    double update_rate_hz;            /**< KNURL_UPDATE_RATE_MIN to _MAX; default: the loop's [1000] */
    double resolution;                /**< the device's position quantum, 1e-9 to 0.01 m; 0: not quantised [0.055e-3] */
    double max_force;        /**< 0.01 to 1e6 N; longer forces are shortened to it, and to the loop's device's [3.3] */
    double continuous_force; /**< 0.01 to 1000 N that the motors can hold indefinitely; INFINITY: no limit but max_force
                                [0.88] */
    double heat_time;        /**< time constant of the motors' heating, 0.001 to 1e6 s [60] */
    double viscous;       /**< the device's viscous friction, 0 to 1000 N s/m, for knurl_scene_check_surface() and the
                             passivity controller [0.5] */
    double delay;         /**< ticks from a force written to a force felt, 0 to 16 [1] */
    double max_stiffness; /**< the stiffest wall in the device maker's specification, 1 to 1e9 N/m; INFINITY: not
                             specified [1020] */
    double slew_rate; /**< the fastest change of the force in device axes, 0.01 to 1e9 N/s, except for the texture's own
                         steps and a fall (unless after KNURL_TICK_SQUEEZED): it is measured from the last force,
                         shortened to the new one's length. INFINITY: no limit; default: max_force within 5 ms */
} knurl_hip_desc;

/** Fills in defaults; `size` is the caller's sizeof. [any thread] */
KNURL_API void knurl_hip_desc_init(knurl_hip_desc *desc, uint32_t size);

/** Sets up one HIP and clears its state and counts, but not its motors' heat (in a loop, its device's). hip: 0 to
 * hip_count - 1. desc: null for all defaults, which apply if this is never called.
 * Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_STATE (a loop has it). [game thread, while the caller's own thread does not
 * tick that HIP] */
KNURL_API knurl_result knurl_scene_configure_hip(knurl_scene *scene, uint32_t hip, const knurl_hip_desc *desc);

/** A gain at a frequency. */
typedef struct knurl_gain {
    double hz;   /**< 0.001 to 1e5 */
    double gain; /**< 0 to 1 */
} knurl_gain;

/** Even sensation, off by default: multiplies the amplitude of a HIP's ridges by a gain over f_t, so that a device and
 * a hand do not make them stronger at some speeds than at others. gains: `count` pairs, hz rising; straight in log hz
 * between two (to a sixteenth of an octave), constant beyond; copied. Null or count 0: off. It stays if the HIP is
 * configured again. knurl_gains_from_response() and knurl_gains_from_plant() find gains for a device.
 * Errors: KNURL_ERROR_ARGUMENT (hip, which pair), KNURL_ERROR_STATE (a loop has it). [game thread, while the caller's
 * own thread does not tick that HIP] */
KNURL_API knurl_result knurl_scene_set_gains(knurl_scene *scene, uint32_t hip, const knurl_gain *gains, uint32_t count);

/** How many gains the next two functions find: a sixteenth of an octave apart, from 20 to 494 Hz. */
#define KNURL_GAINS 75

/** Finds gains with which ridges are felt equally strongly from 25 to 300 Hz on a device whose response is known: as
 * strongly as the weakest of them. Above, where they are weaker still, gains are 1. The strength is that of a square
 * wave's harmonics, by the response and a fingertip's threshold (Verrillo 1963): a model of what is felt.
 *
 * file: the contents of a response file, `size` bytes, at most 64 KiB, as `knurl sweep` writes it: UTF-8, a first line
 * "# knurl response 1", a header "frequency_hz,gain", then rows (2 to 1024) with rising frequencies from 25 Hz or less
 * to 300 Hz or more. A gain is motion per force, in any unit. Lines that begin with '#' are comments. gains:
 * room for KNURL_GAINS. Errors: KNURL_ERROR_ARGUMENT, KNURL_ERROR_FORMAT (the line, expected, found). [any thread,
 * never from a tick] */
KNURL_API knurl_result knurl_gains_from_response(const char *file, uint64_t size, knurl_gain *gains);

/** The same gains on a model: a device of `mass` (0.001 to 10 kg) and `viscous` friction (0 to 1000 N s/m), as
 * knurl_device_info has them, in a hand of 700 N/m and 5 N s/m, which plays at `update_rate_hz` (100 to 10000 Hz). For
 * a device that was not measured; dry friction and joints that give are not in it. Errors: KNURL_ERROR_ARGUMENT (also
 * if the mass is 0, not known). [any thread, never from a tick] */
KNURL_API knurl_result knurl_gains_from_plant(double mass, double viscous, double update_rate_hz, knurl_gain *gains);

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
    KNURL_TICK_PASSIVITY = 256,    /**< a wall was softened because it made the HIP oscillate, or effects because they
                                        would (knurl_scene_set_effects()) */
    KNURL_TICK_ABSENT = 512,       /**< the input was `absent` */
    KNURL_TICK_SQUEEZED = 1024, /**< the proxy was caught between two surfaces, one of which moved over it: that one no
                                     longer holds the HIP, and the force falls at slew_rate. If the angle between them
                                     is above 11 degrees, the proxy is pushed out instead */
    KNURL_TICK_VISIT_LIMIT = 2048 /**< contact reached KNURL_VISITS_MAX: a surface that holds the HIP is
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
                                    crosses 2 fsx L). For S2 in metres, for other methods in the grating's coordinates;
                                    0 without a grating */
    uint64_t half_cycles_played; /**< half cycles rendered: sign changes of the height */
    uint64_t squeezed_ticks;     /**< ticks with KNURL_TICK_SQUEEZED */
    uint64_t visit_limit_ticks;  /**< ticks with KNURL_TICK_VISIT_LIMIT */
    uint64_t reserved[4];        /**< 0 */
} knurl_hip_counts;

/** Runs one tick of one HIP, of length 1/update_rate_hz: position in, force out. For each surface in contact F = max(0,
 * K (H - z) - B vn) along its normal (Eq. 9), plus friction along the surface.
 *
 * Contact: a HIP inside a surface is held by every face that its proxy has not crossed from the front, at most three at
 * once, of any surfaces; each contributes a force that depends on how far it holds the proxy back. Surfaces below the
 * first one are not felt. A HIP that slides off one surface continues on the next if that is at most 1 mm higher, or
 * lower by any amount; cracks are crossed within 5 ms, and ignored up to 0.1 um. If more than 32 surfaces are near one
 * point, some may be missed (KNURL_TICK_CONTACTS_FULL).
 *
 * Bounded time: contact visits at most KNURL_VISITS_MAX triangles, planes and nodes (half as many more if a
 * contact begins); the search for nearby surfaces visits those that moved lately and few others (all with
 * full_model). No heap, lock, system call, clock, log or file, whatever other threads edit. `output` is always
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

#ifdef __cplusplus
}
#endif
#endif
