/* All outputs are finite, for every scene and hand: scenes from denormal floats to beyond the accepted range, with HIPs
 * anywhere. A call returns an error and changes nothing, or all of its doubles are finite. SPDX-License-Identifier: MIT
 */
#include "scene/ask.h"
#include "support/poses.h"

#define FAR 1e9 /* m: KNURL_COORDINATE_MAX as it is documented */

enum { SCENES = 6000, TICKS = 120 };

static uint64_t seed;
static int scene_number;
static int64_t all_contacts;

/* Doubles from one field of a struct up to another. */
static void check_doubles(const char *what, const void *from, size_t begin, size_t end) {
    for (size_t at = begin; at < end; at += sizeof(double)) {
        double value;
        memcpy(&value, (const char *)from + at, sizeof value);
        if (!isfinite(value)) {
            fail_msg("scene %d: %s: the double at byte %d is %g", scene_number, what, (int)at, value);
        }
    }
}

#define CHECK_FINITE(object, first, behind)                                                                            \
    check_doubles(#object, &(object), offsetof(__typeof__(object), first), offsetof(__typeof__(object), behind))

static int one_in(int64_t n) {
    return random_integer(&seed, 1, n) == 1;
}

/* A number of any size and sign; now and then NaN, an infinity or a subnormal. */
static double wild(double low, double high) {
    static const double odd[] = {0.0,      -0.0,        5e-324,           1.7e308,
                                 -1.7e308, (double)NAN, (double)INFINITY, -(double)INFINITY};
    if (one_in(60)) {
        return odd[random_integer(&seed, 0, COUNT_OF(odd) - 1)];
    }
    return (one_in(2) ? -1.0 : 1.0) * pow(10.0, random_between(&seed, low, high));
}

/* The same, but mostly one that is taken. */
static double size_of(double low, double high) {
    return one_in(50) ? wild(-320.0, 300.0) : pow(10.0, random_between(&seed, low, high));
}

static void wild_point(double most, double out[3]) {
    for (int i = 0; i < 3; i++) {
        out[i] = one_in(3) ? 0.0 : wild(-20.0, most);
    }
}

static void wild_rotation(double q[4]) {
    const pose p = random_pose(&seed);
    memcpy(q, p.quaternion, sizeof p.quaternion);
    if (one_in(3)) {
        memcpy(q, (const double[4]){0.0, 0.0, 0.0, 1.0}, 4 * sizeof *q);
    }
}

static void wild_material(knurl_material_desc *m) {
    m->method = (int32_t)random_integer(&seed, 0, 4);
    for (int i = 0; i < 2; i++) {
        m->spatial_frequency[i] = one_in(3) ? 0.0 : size_of(-12.0, 9.0);
    }
    m->amplitude = one_in(3) ? 0.0 : size_of(-12.0, 6.0);
    m->stiffness = size_of(-6.0, 12.0);
    m->damping = one_in(2) ? 0.0 : size_of(-6.0, 12.0);
    m->friction = one_in(2) ? 0.0 : size_of(-6.0, 6.0);
    m->orientation = one_in(2) ? 0.0 : wild(-6.0, 6.0);
}

/* A shape of any size, off the origin by anything. */
static shape wild_shape(void) {
    const double size = size_of(-44.0, 9.0);
    double off[3];
    wild_point(8.9, off);
    shape s = one_in(3)   ? shape_box((const double[3]){1.0, 0.5, 0.3}, 0)
              : one_in(2) ? shape_soup(random_bits(&seed), 12, 1.0)
                          : shape_sheet(3, 3, (const double[2]){1.0, 1.0}, NULL);
    const double uv_size = size_of(-44.0, 9.0);
    for (uint32_t i = 0; i < 3 * s.vertex_count; i++) {
        s.positions[i] = (float)((double)s.positions[i] * size + (one_in(200) ? wild(-40.0, 38.0) : 0.0) + off[i % 3]);
    }
    for (uint32_t i = 0; s.uvs && i < 2 * s.vertex_count; i++) {
        s.uvs[i] = (float)((double)s.uvs[i] * uv_size + (one_in(200) ? wild(-40.0, 38.0) : 0.0));
    }
    return s;
}

static void check_info(const knurl_scene *scene, knurl_surface_id id) {
    const knurl_surface_info info = info_of(scene, id);
    CHECK_FINITE(info, bounds_min, why);
    CHECK_FINITE(info, model_error, reversed_twins);
    CHECK_FINITE(info, axis, touching_pairs);
}

static void add_wild_surface(knurl_scene *scene) {
    SCOPED_SHAPE s = wild_shape();
    surface_parts parts = one_in(3) ? surface_plane() : surface_mesh(&s);
    knurl_surface_id id = 0;
    parts.plane.half_extents[0] = size_of(-9.0, 9.0);
    parts.plane.half_extents[1] = size_of(-9.0, 9.0);
    wild_material(&parts.material);
    if (!one_in(3)) {
        wild_point(8.9, parts.desc.position);
    }
    wild_rotation(parts.desc.rotation);
    if (parts.is_mesh && (!s.uvs || one_in(2))) {
        wild_point(6.0, parts.desc.axis);
    }
    parts.desc.double_sided = (uint32_t)one_in(2);
    if (knurl_scene_add_surface(scene, surface_ready(&parts), &id) == KNURL_OK) {
        check_info(scene, id);
    }
}

static knurl_workspace wild_workspace(void) {
    knurl_workspace w;
    knurl_workspace_set_identity(&w);
    wild_point(8.0, w.origin);
    w.scale = one_in(2) ? 1.0 : size_of(-9.0, 9.0);
    if (one_in(3)) {
        const double turned[9] = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
        memcpy(w.rotation, turned, sizeof turned);
    }
    return w;
}

static void configure_wildly(knurl_scene *scene) {
    knurl_hip_desc d;
    const knurl_workspace w = wild_workspace();
    knurl_hip_desc_init(&d, sizeof d);
    d.update_rate_hz = one_in(2) ? 0.0 : size_of(2.0, 4.0);
    d.resolution = one_in(2) ? -1.0 : one_in(2) ? 0.0 : size_of(-9.0, -2.0);
    d.max_force = one_in(2) ? 0.0 : size_of(-2.0, 6.0);
    d.continuous_force = one_in(2) ? 0.0 : one_in(3) ? (double)INFINITY : size_of(-2.0, 3.0);
    d.heat_time = one_in(2) ? 0.0 : size_of(-3.0, 6.0);
    d.viscous = one_in(2) ? -1.0 : size_of(-3.0, 3.0);
    d.delay = one_in(2) ? -1.0 : size_of(-3.0, 1.2);
    d.max_stiffness = one_in(2) ? 0.0 : size_of(0.0, 9.0);
    d.slew_rate = one_in(2) ? 0.0 : size_of(-2.0, 9.0);
    d.protections = (uint32_t)random_integer(&seed, 0, KNURL_PROTECT_ALL);
    d.clamp = (uint32_t)one_in(3);
    d.workspace = one_in(3) ? NULL : &w;
    (void)knurl_scene_configure_hip(scene, 0, &d);
}

/* A point near some surface, in a scene that may have none. */
static void aim(const knurl_scene *scene, double out[3]) {
    const uint32_t count = knurl_scene_get_surface_count(scene);
    wild_point(9.3, out);
    if (count > 0 && !one_in(8)) {
        const uint32_t which = (uint32_t)random_integer(&seed, 0, count - 1);
        const knurl_surface_info info = info_of(scene, knurl_scene_get_surface(scene, which));
        const double reach = 0.3 * fabs(info.bounds_max[0] - info.bounds_min[0]);
        for (int i = 0; i < 3; i++) {
            const double beside = one_in(2) ? wild(-12.0, 0.0) : 0.01 * wild(-3.0, 0.0);
            out[i] = info.anchor[i] + (one_in(2) ? beside : reach * random_between(&seed, -1.0, 1.0)) -
                     0.001 * info.anchor_normal[i];
        }
    }
}

static void query(const knurl_scene *scene, const double from[3], const double to[3]) {
    knurl_surface_point point;
    knurl_surface_point_init(&point, sizeof point);
    const double radius = one_in(2) ? (double)INFINITY : size_of(-9.0, 10.0);
    if (knurl_scene_find_closest(scene, from, radius, &point) == KNURL_OK) {
        check_doubles("closest", &point, offsetof(knurl_surface_point, distance), sizeof point);
    }
    if (knurl_scene_cast_ray(scene, from, to, &point) == KNURL_OK) {
        check_doubles("ray", &point, offsetof(knurl_surface_point, distance), sizeof point);
    }
}

static void tick_wildly(knurl_scene *scene, const double at[3]) {
    knurl_tick_input input;
    knurl_tick_output out;
    knurl_hip_contact contacts[KNURL_CONTACTS_MAX];
    knurl_workspace w;
    memset(&input, 0, sizeof input);
    assert_int_equal(knurl_scene_get_workspace(scene, 0, &w), KNURL_OK);
    knurl_workspace_to_device(&w, at, input.position);
    input.has_velocity = (uint32_t)one_in(3);
    wild_point(16.0, input.velocity);
    assert_int_equal(knurl_scene_tick(scene, 0, &input, &out), KNURL_OK);
    CHECK_FINITE(out, device_force, event);
    CHECK_FINITE(out, cycles, reserved);
    if (!(fabs(out.hip[0]) + fabs(out.hip[1]) + fabs(out.hip[2]) <= FAR)) {
        fail_msg("scene %d: a HIP at %g, %g, %g was taken", scene_number, out.hip[0], out.hip[1], out.hip[2]);
    }
    const knurl_hip_counts counts = counts_of(scene);
    CHECK_FINITE(counts, force_max, half_cycles_played);
    const uint32_t touched = knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX);
    all_contacts += touched;
    for (uint32_t i = 0; i < touched; i++) {
        check_doubles("contact", &contacts[i], offsetof(knurl_hip_contact, proxy),
                      offsetof(knurl_hip_contact, reserved));
    }
}

static void edit_wildly(knurl_scene *scene) {
    const uint32_t count = knurl_scene_get_surface_count(scene);
    const knurl_workspace w = wild_workspace();
    const double seconds = one_in(3) ? 0.0 : size_of(-300.0, 1.0);
    if (count > 0 && one_in(2)) {
        double position[3], rotation[4];
        const knurl_surface_id id = knurl_scene_get_surface(scene, (uint32_t)random_integer(&seed, 0, count - 1));
        wild_point(9.3, position);
        wild_rotation(rotation);
        (void)knurl_scene_set_transform(scene, id, position, rotation, seconds);
        check_info(scene, id);
    } else if (one_in(2)) {
        (void)knurl_scene_set_workspace(scene, 0, &w, seconds);
    }
}

TEST(every_number_that_comes_out_is_finite) {
    for (scene_number = 0; scene_number < SCENES; scene_number++) {
        SCOPED_SCENE *scene = empty_scene(1);
        double from[3], at[3];
        seed = 0x9e3779b97f4a7c15u * (uint64_t)(scene_number + 1);
        configure_wildly(scene);
        for (int64_t surfaces = random_integer(&seed, 1, 5); surfaces > 0; surfaces--) {
            add_wild_surface(scene);
        }
        assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
        aim(scene, at);
        for (int tick = 0; tick < TICKS; tick++) {
            memcpy(from, at, sizeof from);
            if (one_in(4)) {
                aim(scene, at);
            } else {
                at[random_integer(&seed, 0, 2)] += 0.01 * wild(-3.0, 0.0);
            }
            tick_wildly(scene, at);
            if (one_in(10)) {
                query(scene, from, at);
                edit_wildly(scene);
            }
        }
    }
    assert_true(all_contacts > 10 * SCENES); /* otherwise nothing was tested */
}

/* --- values beyond the range are refused, and its end is accepted --- */

TEST(coordinates_are_taken_up_to_a_range_and_refused_beyond) {
    static const double beyond[] = {1.001e9, -1.001e9, 1.7e19, 1e30, 1e300, (double)INFINITY, (double)NAN};
    surface_parts plane = surface_plane();
    SCOPED_SCENE *scene = scene_of(&plane);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    SCOPED_SHAPE s = shape_box((const double[3]){0.1, 0.1, 0.1}, 0);
    knurl_surface_point point;
    char nothing = 0;
    knurl_surface_point_init(&point, sizeof point);
    for (size_t i = 0; i <= COUNT_OF(beyond); i++) { /* the last time all is at the end of its range */
        const double far = i < COUNT_OF(beyond) ? beyond[i] : FAR;
        const double there[3] = {0.0, far, 0.0}, here[3] = {0.0, 0.0, 0.1};
        const knurl_result expected = i < COUNT_OF(beyond) ? KNURL_ERROR_ARGUMENT : KNURL_OK;
        knurl_workspace w;
        knurl_workspace_set_identity(&w);
        w.origin[1] = far;
        surface_parts placed = surface_plane(), wide = surface_plane(), axis = surface_plane();
        surface_parts mesh = surface_along_x(&s);
        placed.desc.position[1] = wide.plane.half_extents[1] = axis.desc.axis[1] = far;
        s.positions[4] = (float)far;
        surface_parts *all[] = {&placed, &wide, &axis, &mesh};
        for (size_t k = 0; k < COUNT_OF(all); k++) {
            assert_int_equal(knurl_scene_add_surface(scene, surface_ready(all[k]), NULL), expected);
        }
        assert_int_equal(knurl_scene_set_transform(scene, id, there, (const double[4]){0.0, 0.0, 0.0, 1.0}, 0.01),
                         expected);
        assert_int_equal(knurl_scene_set_workspace(scene, 0, &w, 0.01), expected);
        assert_int_equal(knurl_scene_find_closest(scene, there, (double)INFINITY, &point), expected);
        assert_int_equal(knurl_scene_cast_ray(scene, there, here, &point), expected);
        assert_int_equal(knurl_scene_cast_ray(scene, here, there, &point), expected);
    }
    CHECK_REFUSED(knurl_scene_find_closest(scene, (const double[3]){0.0, 0.0, 2e9}, 1.0, &point), KNURL_ERROR_ARGUMENT,
                  nothing);
    assert_string_equal(knurl_error_message(),
                        "position: expected numbers from -1e+09 to 1e+09 m, found [0, 0, 2e+09]");
}

/* A HIP beyond the range ends its contacts, like a position that is not finite; back in range it starts anew. */
TEST(hips_beyond_the_range_count_as_no_position) {
    static const double far[] = {1.001e9, -1.7e19, 1e200, 1e308};
    SCOPED_SCENE *scene = scene_of_plane();
    for (size_t i = 0; i < COUNT_OF(far); i++) {
        (void)tick_at(scene, 0.0, 0.0, 0.001);
        assert_true(tick_at(scene, 0.0, 0.0, -0.001).contacts == 1);
        const knurl_tick_output out = tick_at(scene, 0.0, far[i], -0.001);
        assert_int_equal(out.flags, KNURL_TICK_NOT_FINITE);
        CHECK_VECTOR(out.device_force, 0.0, 0.0, 0.0, 0.0);
        CHECK_VECTOR(out.hip, 0.0, 0.0, 0.0, 0.0);
        const double still[3] = {0.0, 0.0, -0.001}, fast[3] = {0.0, far[i] * 1e7, 0.0};
        assert_int_equal(tick_moving(scene, still, fast).flags, KNURL_TICK_NOT_FINITE);
        assert_int_equal(tick_at(scene, 0.0, 0.0, -0.001).contacts, 1);
        assert_int_equal(tick_at(scene, 0.0, 0.999e9, 0.0).flags, 0);
    }
}
