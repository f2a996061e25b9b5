/* Surfaces that move into one another round the HIP: the force is bounded, the squeeze is counted, and the HIP is
 * released by a ramp, with the default protections. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

#include <stdio.h>

#define K         400.0 /* N/m, the default */
#define TICK      0.001 /* s */
#define MAX_FORCE 3.3   /* N: the default, a Touch's */
#define SLEW      0.66  /* N a tick: MAX_FORCE within 5 ms */
#define HEIGHT    0.004 /* m: of the HIP over the one surface's place */
#define GAP       0.005 /* m: of the other's, at first */

/* Kinds of surfaces; each has its front at z = 0, towards +z. */
enum { PLANE, FLAT_MESH, UNEVEN_MESH, BOX, KINDS };
static const char *const names[KINDS] = {"plane", "flat mesh", "uneven mesh", "box"};

static double uneven(double x, double y) {
    return 2e-5 * sin(900.0 * x) * cos(1100.0 * y);
}

static knurl_surface_id add_kind(knurl_scene *scene, int kind, const pose *at) {
    const double half[2] = {0.03, 0.03};
    SCOPED_SHAPE s = kind == BOX ? shape_box((const double[3]){0.03, 0.03, 0.01}, 0)
                                 : shape_sheet(12, 12, half, kind == UNEVEN_MESH ? uneven : NULL);
    for (uint32_t v = 0; kind == BOX && v < s.vertex_count; v++) {
        s.positions[3 * (size_t)v + 2] -= 0.01f;
    }
    surface_parts parts = kind == PLANE ? surface_plane() : surface_mesh(&s);
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.03;
    parts.desc.axis[0] = 1.0;
    place(&parts, at);
    const knurl_surface_id id = add_surface(scene, &parts);
    return id;
}

/* A default HIP, but in scene axes and without quantisation. */
static void configure_protected(knurl_scene *scene) {
    knurl_hip_desc desc = hip_in_scene_axes();
    desc.resolution = 0.0;
    assert_int_equal(knurl_scene_configure_hip(scene, 0, &desc), KNURL_OK);
}

/* Result of a squeeze. */
typedef struct squeeze {
    double most;    /* N: the greatest force, */
    double step;    /* N: and its greatest change in a tick */
    double at_last; /* N */
    uint64_t told;  /* ticks counted as squeezed */
    int unbounded;  /* ticks with more force than the proxy's distance gives, K (A + depth) */
    int ramped;     /* ticks from the release until there is no force */
    double lifted;  /* N: after a press into the floor later on, at once when the HIP is lifted */
} squeeze;

/* A floor and a lid over it that comes down at `speed` (m/s) through the HIP and the floor, to `past` m below it, and
 * goes back up. The HIP is at rest, HEIGHT over the floor. */
static squeeze close_over(int floor, int lid, double speed, double past) {
    const pose at_floor = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
    pose at_lid = {{0.0, 0.0, GAP}, {1.0, 0.0, 0.0, 0.0}}; /* turned over */
    const int down = (int)((GAP + past) / (speed * TICK));
    SCOPED_SCENE *scene = empty_scene(1);
    double last[3] = {0.0, 0.0, 0.0};
    squeeze s = {0};
    (void)add_kind(scene, floor, &at_floor);
    const knurl_surface_id moving = add_kind(scene, lid, &at_lid);
    configure_protected(scene);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    (void)tick_at(scene, 0.0013, 0.0017, HEIGHT);
    for (int k = 0; k < 2 * down + 100; k++) {
        at_lid.position[2] += k < down ? -speed * TICK : k >= 2 * down ? 0.0 : speed * TICK;
        move_to(scene, moving, &at_lid, TICK);
        const knurl_tick_output out = tick_at(scene, 0.0013, 0.0017, HEIGHT);
        const double force = length3(out.force);
        s.unbounded += out.contacts > 0 && !(force <= out.contacts * K * (distance3(out.hip, out.proxy) + 2e-6));
        s.ramped += out.contacts == 0 && force > 0.0;
        s.most = fmax(s.most, force);
        s.step = fmax(s.step, distance3(out.force, last));
        s.at_last = force;
        memcpy(last, out.force, sizeof last);
    }
    for (int k = 0; k < 100; k++) {
        (void)tick_at(scene, 0.0013, 0.0017, -0.003);
    }
    s.lifted = length3(tick_at(scene, 0.0013, 0.0017, 0.001).force);
    s.told = counts_of(scene).squeezed_ticks;
    return s;
}

TEST(a_hip_squeezed_between_two_surfaces_is_released_by_a_ramp) {
    static const double speeds[3] = {0.02, 0.1, 0.3};
    for (int floor = 0; floor < KINDS; floor++) {
        for (int lid = 0; lid < KINDS; lid++) {
            for (size_t i = 0; i < COUNT_OF(speeds); i++) {
                const squeeze s = close_over(floor, lid, speeds[i], 0.003);
                if (s.unbounded > 0 || !(s.most <= MAX_FORCE) || s.told == 0 || !(s.step <= SLEW + 1e-9) ||
                    s.ramped == 0 || s.ramped > 5 || s.at_last != 0.0 || s.lifted != 0.0) {
                    fail_msg("%s under %s at %g m/s: %d ticks unbounded, %g N at most, %d squeezes told, a step of %g "
                             "N, a ramp of %d ticks, %g N at last, %g N when lifted",
                             names[floor], names[lid], speeds[i], s.unbounded, s.most, (int)s.told, s.step, s.ramped,
                             s.at_last, s.lifted);
                }
            }
        }
    }
}
