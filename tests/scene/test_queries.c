/* A game's queries: a surface's pose and existence, the closest point of all surfaces, all contacts of a HIP.
 * SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

static knurl_surface_point closest_to(const knurl_scene *scene, const double p[3], double radius) {
    knurl_surface_point found;
    knurl_surface_point_init(&found, sizeof found);
    assert_int_equal(knurl_scene_find_closest(scene, p, radius, &found), KNURL_OK);
    return found;
}

static knurl_surface_point cast(const knurl_scene *scene, const double from[3], const double to[3]) {
    knurl_surface_point found;
    knurl_surface_point_init(&found, sizeof found);
    assert_int_equal(knurl_scene_cast_ray(scene, from, to, &found), KNURL_OK);
    return found;
}

static double flat(double x, double y) {
    (void)x;
    (void)y;
    return 0.0;
}

static void check_frame(const knurl_scene *scene, knurl_surface_id plane, const pose *expected) {
    const plane_frame found = frame_of(scene, plane);
    CHECK_VECTOR(found.centre, expected->position[0], expected->position[1], expected->position[2], 1e-12);
    for (int i = 0; i < 3; i++) {
        const double along[3] = {i == 0, i == 1, i == 2};
        double turned[3];
        turn(expected->quaternion, along, turned);
        CHECK_VECTOR(found.axes[i], turned[0], turned[1], turned[2], 1e-12);
    }
}

TEST(a_moving_surface_is_described_on_its_way) {
    static const double z[3] = {0.0, 0.0, 1.0};
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    pose end = {{0.1, -0.2, 0.0}, {0.0}}, middle = {{0.05, -0.1, 0.0}, {0.0}};
    turn_about(z, 1.0, end.quaternion);
    turn_about(z, 0.5, middle.quaternion);
    move_to(scene, id, &end, 0.1);
    for (int tick = 0; tick < 50; tick++) {
        (void)tick_at(scene, 0.0, 0.0, 0.5);
    }
    check_frame(scene, id, &middle);
    for (int tick = 0; tick < 60; tick++) {
        (void)tick_at(scene, 0.0, 0.0, 0.5);
    }
    check_frame(scene, id, &end);
}

TEST(ids_are_valid_while_their_surface_is_in_their_scene) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = scene_of(&parts);
    SCOPED_SCENE *other = scene_of(&parts);
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    assert_int_equal(knurl_scene_has_surface(scene, id), 1);
    assert_int_equal(knurl_scene_has_surface(scene, 0), 0);
    assert_int_equal(knurl_scene_has_surface(other, id), 0);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    assert_int_equal(knurl_scene_has_surface(scene, id), 0);
}

/* --- the closest point --- */

/* A box about the origin, seen from outside: its closest point has the coordinates of p, held within its sides. A plane
 * is a box without height. */
static double clamp_to_box(const double p[3], const double half[3], double closest[3]) {
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        closest[i] = fmax(-half[i], fmin(half[i], p[i]));
        square += (p[i] - closest[i]) * (p[i] - closest[i]);
    }
    return sqrt(square);
}

/* Half edges of a plane, a box and a sheet. */
static const double half_edges[3][3] = {{0.05, 0.05, 0.0}, {0.03, 0.02, 0.04}, {0.02, 0.03, 0.0}};

/* Three surfaces at random poses. */
typedef struct three {
    knurl_scene *scene;
    knurl_surface_id ids[3];
    pose poses[3];
} three;

static three place_three(surface_parts parts[3], uint64_t *seed) {
    three t = {.scene = empty_scene(1)};
    for (int i = 0; i < 3; i++) {
        t.poses[i] = random_pose(seed);
        place(&parts[i], &t.poses[i]);
        parts[i].desc.axis[0] = 1.0;
        t.ids[i] = add_surface(t.scene, &parts[i]);
    }
    return t;
}

typedef struct nearest {
    double distance, point[3];
    int surface, is_in_box; /* 0, 1 or 2; 1 if the point is in the box, which has another rule */
} nearest;

/* The closest point of the three to p, by clamping to each one's box in its own frame. */
static nearest find_nearest(const pose *poses, const double *p) {
    nearest n = {10.0, {0.0}, 0, 0};
    for (int i = 0; i < 3; i++) {
        const double back[4] = {-poses[i].quaternion[0], -poses[i].quaternion[1], -poses[i].quaternion[2],
                                poses[i].quaternion[3]};
        double off[3], own[3], closest[3];
        for (int axis = 0; axis < 3; axis++) {
            off[axis] = p[axis] - poses[i].position[axis];
        }
        turn(back, off, own);
        const double distance = clamp_to_box(own, half_edges[i], closest);
        n.is_in_box |= i == 1 && distance == 0.0;
        if (distance < n.distance) {
            n.distance = distance;
            n.surface = i;
            pose_point(&poses[i], closest, n.point);
        }
    }
    return n;
}

TEST(the_closest_point_of_three_surfaces_is_the_closest_of_each_ones) {
    uint64_t seed = 5;
    SCOPED_SHAPE box = shape_box(half_edges[1], 0);
    SCOPED_SHAPE sheet = shape_sheet(1, 1, half_edges[2], flat);
    surface_parts parts[3] = {surface_plane(), surface_mesh(&box), surface_mesh(&sheet)};
    for (int round = 0; round < 40; round++) {
        const three t = place_three(parts, &seed);
        for (int k = 0; k < 50; k++) {
            const double p[3] = {random_between(&seed, -0.6, 0.6), random_between(&seed, -0.6, 0.6),
                                 random_between(&seed, -0.6, 0.6)};
            const nearest n = find_nearest(t.poses, p);
            knurl_surface_point found = closest_to(t.scene, p, 10.0);
            if (n.is_in_box) {
                continue;
            }
            assert_true(found.surface == t.ids[n.surface]);
            CHECK_CLOSE(found.distance, n.distance, 1e-7); /* meshes are of float32 */
            CHECK_VECTOR(found.position, n.point[0], n.point[1], n.point[2], 1e-7);
            found = closest_to(t.scene, p, 0.999 * n.distance);
            assert_true(found.surface == 0 && found.distance == 0.0 && found.position[0] == 0.0);
            assert_true(closest_to(t.scene, p, 1.001 * n.distance).surface == t.ids[n.surface]);
        }
        knurl_scene_destroy(t.scene);
    }
}

TEST(the_normal_at_the_closest_point_is_the_fronts) {
    static const double half[3] = {0.03, 0.02, 0.04};
    static const double above[3] = {0.001, 0.002, 0.5}, below[3] = {0.001, 0.002, -0.5};
    SCOPED_SHAPE box = shape_box(half, 0);
    surface_parts parts[2] = {surface_plane(), surface_mesh(&box)};
    for (int i = 0; i < 2; i++) {
        parts[i].desc.axis[0] = 1.0;
        SCOPED_SCENE *scene = scene_of(&parts[i]);
        knurl_surface_point found = closest_to(scene, above, 1.0);
        CHECK_VECTOR(found.normal, 0.0, 0.0, 1.0, 1e-9);
        found = closest_to(scene, below, 1.0);
        CHECK_VECTOR(found.normal, 0.0, 0.0, i == 0 ? 1.0 : -1.0, 1e-9); /* a plane has one front */
    }
}

TEST(a_closest_point_is_asked_for_with_numbers_in_range) {
    static const double nowhere[3] = {0.0, (double)NAN, 0.0}, here[3] = {0.0, 0.0, 0.0};
    static const double beyond[3] = {0.0, 0.0, 1e300}, far[3] = {0.0, 0.0, 1e9};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_surface_point found;
    knurl_surface_point_init(&found, sizeof found);
    CHECK_REFUSED(knurl_scene_find_closest(scene, nowhere, 1.0, &found), KNURL_ERROR_ARGUMENT, found);
    CHECK_REFUSED(knurl_scene_find_closest(scene, here, 0.0, &found), KNURL_ERROR_ARGUMENT, found);
    CHECK_REFUSED(knurl_scene_find_closest(scene, here, (double)NAN, &found), KNURL_ERROR_ARGUMENT, found);
    assert_string_equal(knurl_error_message(), "radius: expected more than 0 m, found nan");
    CHECK_REFUSED(knurl_scene_find_closest(scene, beyond, (double)INFINITY, &found), KNURL_ERROR_ARGUMENT, found);
    assert_string_equal(knurl_error_message(),
                        "position: expected numbers from -1e+09 to 1e+09 m, found [0, 0, 1e+300]");
    assert_int_equal(knurl_scene_find_closest(scene, here, (double)INFINITY, &found), KNURL_OK);
    found = closest_to(scene, far, (double)INFINITY);
    assert_true(found.surface != 0);
    CHECK_CLOSE(found.distance / 1e9, 1.0, 1e-12);
}

/* --- rays --- */

/* The entry of p + t * way, t from 0 to 1, into a box about the origin, by slabs: t, or 2 if there is none. */
static double enter_box(const double p[3], const double way[3], const double half[3]) {
    double begin = -1.0, end = 2.0;
    for (int i = 0; i < 3; i++) {
        const double a = (-half[i] - p[i]) / way[i], b = (half[i] - p[i]) / way[i];
        begin = fmax(begin, fmin(a, b));
        end = fmin(end, fmax(a, b));
    }
    return begin > end || begin <= 0.0 || begin >= 1.0 ? 2.0 : begin;
}

/* The first surface that a ray hits, or -1; the share of the ray, and 1 if on its front. The box of a plane
 * has no height: its slabs meet at z = 0. The first surface is single-sided, and passed from behind; the last is not.
 */
static int find_first(const three *t, const double from[3], const double way[3], double *share, int *front) {
    int best = -1;
    *share = 2.0;
    for (int i = 0; i < 3; i++) {
        const double *q = t->poses[i].quaternion;
        const double back[4] = {-q[0], -q[1], -q[2], q[3]};
        double off[3], own[3], own_way[3];
        for (int axis = 0; axis < 3; axis++) {
            off[axis] = from[axis] - t->poses[i].position[axis];
        }
        turn(back, off, own);
        turn(back, way, own_way);
        const double entered = i == 0 && own[2] < 0.0 ? 2.0 : enter_box(own, own_way, half_edges[i]);
        if (entered < *share) {
            *share = entered;
            *front = i != 2 || own[2] > 0.0;
            best = i;
        }
    }
    return best;
}

/* Returns which was hit, or -1. */
static int check_ray(const three *t, const double from[3], const double to[3]) {
    double way[3], share, along = 0.0, length = 0.0;
    int front = 0;
    for (int i = 0; i < 3; i++) {
        way[i] = to[i] - from[i];
        length += way[i] * way[i];
    }
    const int best = find_first(t, from, way, &share, &front);
    const knurl_surface_point found = cast(t->scene, from, to);
    if (best < 0) {
        assert_true(found.surface == 0 && found.distance == 0.0 && found.normal[2] == 0.0);
        return best;
    }
    assert_true(found.surface == t->ids[best]);
    CHECK_CLOSE(found.distance, share * sqrt(length), 1e-6); /* meshes are of float32, and some rays graze */
    for (int i = 0; i < 3; i++) {
        CHECK_CLOSE(found.position[i], from[i] + share * way[i], 1e-6);
        along += found.normal[i] * way[i];
    }
    assert_true(front ? along < 0.0 : along > 0.0);
    return best;
}

TEST(a_ray_hits_the_first_of_three_surfaces) {
    uint64_t seed = 9;
    int hits[4] = {0};
    SCOPED_SHAPE box = shape_box(half_edges[1], 0);
    SCOPED_SHAPE sheet = shape_sheet(1, 1, half_edges[2], flat);
    surface_parts parts[3] = {surface_plane(), surface_mesh(&box), surface_mesh(&sheet)};
    parts[2].desc.double_sided = 1;
    for (int round = 0; round < 40; round++) {
        three t = place_three(parts, &seed);
        for (int k = 0; k < 100; k++) {
            double from[3], to[3];
            for (int i = 0; i < 3; i++) {
                from[i] = random_between(&seed, -1.0, 1.0);
                to[i] = from[i] + 1.5 * (t.poses[k % 3].position[i] + random_between(&seed, -0.04, 0.04) - from[i]);
            }
            hits[1 + check_ray(&t, from, to)]++;
        }
        knurl_scene_destroy(t.scene);
    }
    assert_true(hits[0] > 100 && hits[1] > 100 && hits[2] > 100 && hits[3] > 100);
}

TEST(a_ray_ends_where_it_is_told_to_and_meets_a_surface_where_it_is_now) {
    static const double above[3] = {0.0, 0.0, 0.3}, on[3] = {0.0, 0.0, 0.0}, below[3] = {0.0, 0.0, -0.01};
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_surface_id id = knurl_scene_get_surface(scene, 0);
    assert_true(cast(scene, above, on).surface == 0);
    knurl_surface_point found = cast(scene, above, below);
    assert_true(found.surface == id);
    CHECK_CLOSE(found.distance, 0.3, 1e-15);
    glide_to(scene, 0.0, 0.0, 0.1, 0.1);
    for (int tick = 0; tick < 50; tick++) {
        (void)tick_at(scene, 0.0, 0.0, 0.5);
    }
    CHECK_CLOSE(cast(scene, above, below).distance, 0.25, 1e-12);
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    found = cast(scene, above, below);
    assert_true(found.surface == 0 && found.distance == 0.0);
}

TEST(a_point_exactly_at_the_radius_is_found) {
    static const double above[3] = {0.0, 0.0, 0.25};
    SCOPED_SCENE *scene = scene_of_plane();
    const knurl_surface_point found = closest_to(scene, above, 0.25);
    assert_true(found.surface == knurl_scene_get_surface(scene, 0));
    CHECK_SAME(found.distance, 0.25);
    assert_true(closest_to(scene, above, 0.2499).surface == 0);
}

TEST(a_ray_is_cast_with_numbers_in_range) {
    static const double nowhere[3] = {0.0, (double)NAN, 0.0}, beyond[3] = {0.0, 0.0, -1e31}, here[3] = {0.0, 0.0, 0.1};
    SCOPED_SCENE *scene = scene_of_plane();
    knurl_surface_point found;
    knurl_surface_point_init(&found, sizeof found);
    CHECK_REFUSED(knurl_scene_cast_ray(scene, nowhere, here, &found), KNURL_ERROR_ARGUMENT, found);
    CHECK_REFUSED(knurl_scene_cast_ray(scene, here, beyond, &found), KNURL_ERROR_ARGUMENT, found);
    assert_string_equal(knurl_error_message(), "to: expected numbers from -1e+09 to 1e+09 m, found [0, 0, -1e+31]");
    assert_true(cast(scene, here, here).surface == 0);
}

/* --- contacts --- */

/* The floor faces +z, the wall at x = 0 faces +x. */
static knurl_scene *floor_and_wall(knurl_surface_id ids[2]) {
    surface_parts parts = surface_plane();
    knurl_scene *scene = empty_scene(1);
    ids[0] = add_surface(scene, &parts);
    turn_about((const double[3]){0.0, 1.0, 0.0}, 2.0 * atan(1.0), parts.desc.rotation);
    ids[1] = add_surface(scene, &parts);
    return commit_plainly(scene);
}

TEST(every_contact_of_a_tick_is_reported) {
    knurl_surface_id ids[2];
    knurl_hip_contact contacts[KNURL_CONTACTS_MAX];
    SCOPED_SCENE *scene = floor_and_wall(ids);
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX), 0);
    (void)tick_at(scene, 0.01, 0.0, 0.01);
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX), 0);
    (void)tick_at(scene, 0.01, 0.0, -0.001); /* the floor alone */
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX), 1);
    assert_true(contacts[0].surface == ids[0]);
    CHECK_CLOSE(contacts[0].depth, 0.001, 1e-12);
    const knurl_tick_output out = tick_at(scene, -0.002, 0.003, -0.001);
    assert_int_equal(out.contacts, 2);
    memset(contacts, 0x55, sizeof contacts);
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, KNURL_CONTACTS_MAX), 2);
    for (int i = 0; i < 2; i++) {
        const int is_wall = contacts[i].surface == ids[1];
        assert_true(is_wall || contacts[i].surface == ids[0]);
        assert_true(contacts[0].surface != contacts[1].surface);
        CHECK_VECTOR(contacts[i].normal, is_wall, 0.0, !is_wall, 1e-9);
        CHECK_VECTOR(contacts[i].proxy, 0.0, 0.003, 0.0, 1e-8);
        CHECK_CLOSE(contacts[i].depth, is_wall ? 0.002 : 0.001, 1e-8);
        assert_true(contacts[i].reserved[0] == 0 && contacts[i].reserved[5] == 0);
    }
}

TEST(contacts_are_counted_beyond_the_room_that_is_given) {
    knurl_surface_id ids[2];
    knurl_hip_contact contacts[2];
    SCOPED_SCENE *scene = floor_and_wall(ids);
    (void)tick_at(scene, 0.01, 0.0, 0.01);
    (void)tick_at(scene, -0.002, 0.0, -0.001);
    memset(contacts, 0x55, sizeof contacts);
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, 1), 2);
    assert_int_equal(contacts[1].surface, UINT64_C(0x5555555555555555));
    assert_int_equal(knurl_scene_get_contacts(scene, 0, NULL, 0), 2);
    assert_int_equal(knurl_scene_get_contacts(scene, 1, contacts, 2), 0);
}

TEST(contacts_name_a_removed_surface_by_its_stale_id) {
    knurl_surface_id ids[2];
    knurl_hip_contact contacts[2];
    SCOPED_SCENE *scene = floor_and_wall(ids);
    (void)tick_at(scene, 0.01, 0.0, 0.01);
    (void)tick_at(scene, 0.01, 0.0, -0.001);
    assert_int_equal(knurl_scene_remove_surface(scene, ids[0]), KNURL_OK);
    knurl_scene_collect(scene);
    assert_int_equal(knurl_scene_get_contacts(scene, 0, contacts, 2), 1);
    assert_true(contacts[0].surface == ids[0]);
    assert_int_equal(knurl_scene_has_surface(scene, contacts[0].surface), 0);
}
