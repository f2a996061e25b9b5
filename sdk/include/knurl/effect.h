/* Knurl: effects, forces of a HIP that belong to no surface: springs, detents, dampers, guides, a constant force. Each
 * tick adds them to the surfaces' forces. For vibrations see knurl_loop_vibrate() (loop.h).
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_EFFECT_H
#define KNURL_EFFECT_H

#include <knurl/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Effects that one HIP can have at once. */
#define KNURL_EFFECTS_MAX 8

/** Kinds of effects. x: from the anchor to the HIP, m. v: the HIP's velocity less the anchor's, m/s. u: the axis, of
 * length 1. along: the part of a vector in the direction of u. across: the rest. */
enum {
    KNURL_EFFECT_SPRING = 1, /**< F = -K x - B v: pulls to the anchor */
    KNURL_EFFECT_DETENT = 2, /**< F = -(K spacing / 2 pi) sin(2 pi along(x) / spacing) u - B along(v): notches along the
                                axis, the anchor in one of them. K is the stiffness at the bottom of a notch */
    KNURL_EFFECT_DAMPER = 3, /**< F = -B v: a thick liquid */
    KNURL_EFFECT_LINE = 4,   /**< F = -K across(x) - B across(v): holds the HIP on the line through the anchor along the
                                axis */
    KNURL_EFFECT_PLANE = 5,  /**< F = -K along(x) - B along(v): holds the HIP in the plane through the anchor at right
                                angles to the axis, from both sides */
    KNURL_EFFECT_FORCE = 6   /**< F = max_force u */
};

/** One effect. Numbers that its kind does not use are checked but ignored. */
typedef struct knurl_effect {
    int32_t kind;           /**< KNURL_EFFECT_ */
    uint32_t reserved_bits; /**< 0 */
    double anchor[3];       /**< scene, m, within KNURL_COORDINATE_MAX */
    double axis[3];   /**< scene; any length but 0 for DETENT, LINE, PLANE, FORCE; each within KNURL_COORDINATE_MAX */
    double stiffness; /**< K: N/m in scene metres, 0 or 1 to 1e9 */
    double damping;   /**< B: N s/m, 0 to 1000 */
    double spacing;   /**< m between two notches of a DETENT, 1e-6 to 1e9 */
    double max_force; /**< N: this effect's force is shortened to it, 0.01 to 1000 */
    uint64_t reserved[4]; /**< 0 */
} knurl_effect;

/** Fills in an effect to change: at the scene's origin, axis +y, 200 N/m, 1 N s/m, 10 mm, 2 N. kind: KNURL_EFFECT_.
 * Errors: KNURL_ERROR_ARGUMENT. [any thread] */
KNURL_API knurl_result knurl_effect_prepare(int32_t kind, knurl_effect *effect);

/** Replaces a HIP's effects, before or after the commit, also while it ticks. effects: `count`, 0 to KNURL_EFFECTS_MAX;
 * copied; null if count is 0. seconds: 0 to 10. An effect whose kind was at the same index before moves its anchor to
 * the new one evenly over `seconds` of ticks (pass the game's frame time); with 0, or if the kind is new, it is there
 * at once. All other numbers count from the next tick on. The effects stay if the HIP is configured again.
 *
 * The sum passes the HIP's protections: a new effect's force grows at slew_rate, and the sum with the surfaces' force
 * stays within max_force and heat. With KNURL_PROTECT_PASSIVITY, stiffness and damping are limited so that a loosely
 * held device does not shake: all stiffness is reduced by one factor if its sum in a direction is above 0.8 (viscous +
 * 0.5 N s/m)/(T/2 + delay) or max_stiffness (a Touch: 533 N/m), all damping if its sum is above 20 N s/m (less with
 * long delays), both at the device; ticks then have KNURL_TICK_PASSIVITY. Errors: KNURL_ERROR_ARGUMENT (which effect
 * and field, expected, found), KNURL_ERROR_MEMORY; the old effects stay then. [any thread but the haptic] */
KNURL_API knurl_result knurl_scene_set_effects(knurl_scene *scene, uint32_t hip, const knurl_effect *effects,
                                               uint32_t count, double seconds);

#ifdef __cplusplus
}
#endif
#endif
