/* The facet cached while a HIP stays above one triangle: it saves work, and the results are identical to the bit.
 * SPDX-License-Identifier: MIT */
#include "contact/facet.h"
#include "contact/mesh_frame.h"
#include "scene/scene.h"

#include "support/probe.h"
#include "support/scenes.h"

#define TICKS 20000

static double hills(double x, double y) {
    return 0.002 * sin(150.0 * x) * cos(130.0 * y);
}

static shape hilly_sheet(void) {
    static const double half[2] = {0.05, 0.04};
    return shape_sheet(12, 9, half, hills);
}

/* Contact, frame and rates of one tick. */
typedef struct felt {
    double proxy[3], normal[3], z, weights[3];
    double x[3], y[3], coordinates[2], rates[2];
    uint32_t triangle;
    int32_t held, has_rates;
} felt;

static felt feel(probe *p, const double hip[3], const double velocity[3]) {
    felt f;
    memset(&f, 0, sizeof f);
    f.held = probe_at(p, hip);
    if (f.held) {
        vec3_copy(p->contact.proxy, f.proxy);
        vec3_copy(p->contact.normal, f.normal);
        vec3_copy(p->contact.weights, f.weights);
        f.z = p->contact.z;
        f.triangle = p->contact.triangle;
        knurl_mesh_frame(p->mesh, &p->contact, f.x, f.y, f.coordinates);
        f.has_rates = knurl_mesh_rates(p->mesh, &p->contact, velocity, f.rates);
    }
    return f;
}

/* A finger that wanders over the sheet, pressed in by some mm and now and then lifted; along an axis, or by uvs;
 * from the front (+1) or from behind (-1). */
static void compare(int with_axis, int side) {
    shape shapes[2] = {hilly_sheet(), hilly_sheet()};
    probe probes[2] = {probe_shape(&shapes[0]), probe_shape(&shapes[1])};
    knurl_facet facet;
    uint64_t kept = 0;
    memset(&facet, 0, sizeof facet);
    for (int k = 0; k < 2; k++) {
        probes[k].mesh->has_axis = with_axis;
        probes[k].mesh->axis[0] = 1.0;
        probes[k].query.double_sided = 1;
    }
    probes[1].query.facet = &facet;
    for (int i = 0; i < TICKS; i++) {
        const double t = 0.001 * i;
        const double hip[3] = {0.045 * sin(1.3 * t), 0.045 * sin(1.7 * t + 1.0),
                               side * (0.0040 * cos(4.0 * t) - 0.0015)};
        const double velocity[3] = {cos(5.0 * t), sin(7.0 * t), 0.1};
        const int begins = probes[1].state.side == 0;
        if (begins) {
            facet.side = 0;
        }
        const felt without = feel(&probes[0], hip, velocity);
        const felt with = feel(&probes[1], hip, velocity);
        assert_memory_equal(&without, &with, sizeof with);
        kept += with.held && probes[1].contact.facet == &facet;
    }
    assert_true(kept > TICKS / 4);
    probe_free(&probes[0]);
    probe_free(&probes[1]);
}

TEST(with_a_kept_facet_everything_is_the_same_to_the_bit) {
    compare(0, 1);
    compare(0, -1);
    compare(1, 1);
}

/* On a flat mesh along x: y is across it. */
TEST(along_an_axis_the_rates_are_the_velocitys_parts_along_and_across_it) {
    static const double half[2] = {0.05, 0.04}, hip[3] = {0.004, 0.003, -0.001}, velocity[3] = {0.3, -0.2, 0.1};
    SCOPED_PROBE p = probe_of(shape_sheet(12, 9, half, NULL));
    p.mesh->has_axis = 1;
    p.mesh->axis[0] = 1.0;
    (void)probe_to(&p, 0.004, 0.003, 0.001);
    const felt f = feel(&p, hip, velocity);
    assert_true(f.held && f.has_rates);
    CHECK_CLOSE(f.rates[0], 0.3, 1e-15);
    CHECK_CLOSE(f.rates[1], -0.2, 1e-15);
}

TEST(a_surface_in_anothers_place_is_not_felt_by_the_others_facet) {
    SCOPED_SCENE *scene = empty_scene(1);
    SCOPED_SHAPE sheet = hilly_sheet();
    surface_parts parts = surface_mesh(&sheet);
    const knurl_surface_id first = add_surface(scene, &parts);
    configure_plainly(scene, 0);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    const knurl_facet *facet = &knurl_candidates_at(&scene->hips[0].contacts.candidates, 0)->facet;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(tick_at(scene, 0.004, 0.003, -0.001 + hills(0.004, 0.003)).contacts, 1);
    }
    assert_int_equal(facet->side, 1);
    assert_int_equal(knurl_scene_remove_surface(scene, first), KNURL_OK);
    (void)add_surface(scene, &parts);
    assert_int_equal(tick_at(scene, 0.004, 0.003, 0.001 + hills(0.004, 0.003)).contacts, 0);
    assert_int_equal(tick_at(scene, 0.004, 0.003, -0.001 + hills(0.004, 0.003)).contacts, 1);
    assert_int_equal(facet->side, 0);
}
