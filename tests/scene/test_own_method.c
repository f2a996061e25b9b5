/* Own methods through a whole tick: forces, limits, protections, contacts. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/own.h"

#define A  0.001 /* m */
#define K  400.0 /* N/m, the default */
#define FS 1000.0

/* A plane, and a HIP of a Touch with all its protections. */
static knurl_scene *touched(int32_t method, double fsy) {
    surface_parts parts = surface_plane();
    const knurl_hip_desc hip = hip_in_scene_axes();
    set_grating(&parts, method, FS, fsy, A);
    return scene_with_hip(&parts, &hip);
}

/* 0.5 s strokes at random speeds, from `least` to 4 mm deep; below 0, they are lifted off again and again. */
static void check_copy(int32_t copied, int32_t copy, double fsy, double least, double tolerance) {
    SCOPED_SCENE *a = touched(copied, fsy);
    SCOPED_SCENE *b = touched(copy, fsy);
    uint64_t seed = 3;
    double x = 0.0, speed = 0.1;
    for (int i = 0; i < 40000; i++) {
        speed = i % 500 == 0 ? random_between(&seed, 0.01, 0.3) * (x > 0.0 ? -1.0 : 1.0) : speed;
        x += 0.001 * speed;
        const double p[3] = {x, 0.3 * x, -0.5 * (0.004 + least) + 0.5 * (0.004 - least) * sin(0.01 * i)},
                     v[3] = {speed, 0.3 * speed, 0.0};
        const knurl_tick_output one = tick_moving(a, p, v), two = tick_moving(b, p, v);
        CHECK_VECTOR(one.device_force, two.device_force[0], two.device_force[1], two.device_force[2], tolerance);
        assert_int_equal(one.flags, two.flags);
    }
}

TEST(a_copy_of_a_method_gives_its_forces_tick_by_tick) {
    const int32_t s1 = own_add("copy-of-S1", 1.0, own_s1, NULL), s2 = own_add("copy-of-S2", 1.4143, own_s2, NULL);
    check_copy(KNURL_METHOD_S1, s1, 0.0, -0.002, 0.0);
    check_copy(KNURL_METHOD_S1, s1, 700.0, -0.002, 0.0);
    check_copy(KNURL_METHOD_S2, s2, 0.0, 0.001, 1e-12); /* contact begins at another crest */
}

static const double bad[] = {NAN, INFINITY, -INFINITY, 1e30, -1e30, 1e308, -1.5};

static double random_height(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)in, (void)memory;
    return bad[random_bits(user) % COUNT_OF(bad)];
}

static uint64_t random_seed = 11;

TEST(with_any_result_the_force_is_finite_and_within_crest_and_device) {
    const int32_t method = own_add("random", 1.5, random_height, &random_seed);
    surface_parts parts = surface_plane();
    set_grating(&parts, method, FS, 0.0, A);
    SCOPED_SCENE *plain = scene_of(&parts);
    SCOPED_SCENE *safe = touched(method, 0.0);
    for (int i = 0; i < 20000; i++) {
        const double depth = 0.003 * sin(0.02 * i), p[3] = {1e-6 * i, 0.0, -depth}, v[3] = {0.001, 0.0, 0.0};
        const knurl_tick_output raw = tick_moving(plain, p, v), sent = tick_moving(safe, p, v);
        const double bound = fmax(0.0, K * (depth + 1.5 * A));
        assert_true(raw.force[2] >= 0.0 && raw.force[2] <= bound * (1.0 + 1e-12) && fabs(raw.height) <= 1.5 * A);
        assert_true(sent.device_force[2] >= 0.0 && sent.device_force[2] <= 3.3);
        assert_int_equal((raw.flags | sent.flags) & KNURL_TICK_NOT_FINITE, 0);
    }
    assert_true(knurl_method_get_faults(method) > 1000);
}

TEST(contact_begins_at_its_crest_and_a_check_knows_its_swing) {
    const int32_t method = own_add("random", 1.5, random_height, &random_seed);
    SCOPED_SCENE *scene = touched(method, 0.0);
    const knurl_surface_check check = first_check(scene);
    CHECK_CLOSE(check.amplitude_limit, fmin(3.3 / (K * 3.0), 0.88 / K), 1e-15L);
    assert_int_equal(check.exceeded & KNURL_LIMIT_AMPLITUDE, 0); /* 1.2 N from trough to crest, of 3.3 */
    (void)tick_at(scene, 0.0, 0.0, 1.51 * A);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 1.501 * A).contacts, 0);
    assert_int_equal(tick_at(scene, 0.0, 0.0, 1.499 * A).contacts, 1);
}

TEST(a_check_tells_if_its_swing_from_trough_to_crest_exceeds_the_device) {
    const int32_t method = own_add("high", 5.0, random_height, &random_seed);
    SCOPED_SCENE *scene = touched(method, 0.0);
    assert_int_equal(first_check(scene).exceeded & KNURL_LIMIT_AMPLITUDE, KNURL_LIMIT_AMPLITUDE); /* 4 N, of 3.3 */
}

static double count(const knurl_method_input *in, double *memory, void *user) KNURL_NONBLOCKING {
    (void)in, (void)user;
    return 0.01 * ++memory[0];
}

static double press(knurl_scene *scene, int ticks) {
    knurl_tick_output out = {0};
    for (int i = 0; i < ticks; i++) {
        out = tick_moving(scene, (const double[3]){0.0, 0.0, -0.003}, (const double[3]){0.25, 0.0, 0.0});
    }
    return out.height / A;
}

TEST(its_memory_is_cleared_at_lift_off_and_if_another_grating_takes_over) {
    const int32_t first = own_add("first", 10.0, count, NULL), second = own_add("second", 10.0, count, NULL);
    surface_parts parts = surface_plane();
    set_grating(&parts, first, FS, 0.0, A);
    SCOPED_SCENE *scene = scene_of(&parts);
    const knurl_surface_id surface = knurl_scene_get_surface(scene, 0);
    CHECK_CLOSE(press(scene, 20), 0.20, 1e-12L);
    (void)tick_at(scene, 0.0, 0.0, 0.05);
    CHECK_CLOSE(press(scene, 3), 0.03, 1e-12L);
    parts.material.method = second;
    assert_int_equal(knurl_scene_set_material(scene, surface, &parts.material), KNURL_OK);
    CHECK_CLOSE(press(scene, 5), 0.05, 1e-12L);
    parts.material.method = KNURL_METHOD_S2;
    assert_int_equal(knurl_scene_set_material(scene, surface, &parts.material), KNURL_OK);
    CHECK_SAME(press(scene, 4), -1.0);
    parts.material.method = second;
    assert_int_equal(knurl_scene_set_material(scene, surface, &parts.material), KNURL_OK);
    CHECK_CLOSE(press(scene, 2), 0.02, 1e-12L);
}

TEST(a_material_names_it_and_a_number_without_a_method_is_refused) {
    surface_parts parts = surface_plane();
    knurl_surface_id id = 0;
    const int32_t method = own_add("copy-of-S1", 1.0, own_s1, NULL);
    set_grating(&parts, method + 40, FS, 0.0, A);
    SCOPED_SCENE *scene = empty_scene(1);
    CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_ERROR_UNKNOWN, id);
    check_message("knurl_method_add(), found ");
    parts.material.method = method;
    assert_int_equal(knurl_scene_add_surface(scene, surface_ready(&parts), &id), KNURL_OK);
    assert_int_equal(material_of(scene, id).method, method);
}
