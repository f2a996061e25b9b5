/* Crowds of small tiles: a floor laid out of 10,000 of them is one floor to a HIP that is pressed into it and dragged
 * over the seams, however many are near it. SPDX-License-Identifier: MIT */
#include "support/geometry.h"
#include "support/scenes.h"

#define SIDE  100    /* tiles along each side */
#define TICKS 2000   /* of a drag */
#define STEP  250e-6 /* m a tick: 250 mm/s */
#define DEPTH 0.001  /* m, how far the HIP is pressed in */
#define K     400.0

static const double sizes[] = {0.002, 0.003, 0.004, 0.005, 0.008}; /* m, of a tile */

/* A floor at z = 0 of square tiles from (0, 0) on, side by side; the one at (column, row) is `odd` higher; *id is its
 * id. */
static knurl_scene *lay_floor(double size, int column, int row, double odd, knurl_surface_id *odd_id) {
    knurl_scene_desc desc;
    knurl_scene *scene = NULL;
    surface_parts parts = surface_plane();
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = SIDE * SIDE;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    configure_plainly(scene, 0);
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.5 * size;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const int is_odd = i % SIDE == column && i / SIDE == row;
        parts.desc.position[0] = size * (i % SIDE + 0.5);
        parts.desc.position[1] = size * ((double)(i / SIDE) + 0.5);
        parts.desc.position[2] = is_odd ? odd : 0.0;
        const knurl_surface_id id = add_surface(scene, &parts);
        if (is_odd && odd_id) {
            *odd_id = id;
        }
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    return scene;
}

/* Along a line through `from`, turning back 10 mm before the floor's edges. */
typedef struct dragged {
    double at[2];
    double step[2];
} dragged;

static void drag_on(dragged *d, double size) {
    for (int i = 0; i < 2; i++) {
        const double next = d->at[i] + d->step[i];
        if (next < 0.01 || next > size * SIDE - 0.01) {
            d->step[i] = -d->step[i];
        }
        d->at[i] += d->step[i];
    }
}

/* So near a seam (m) that whichever of the tiles beside it, or two of them, may hold the HIP. */
static int is_on_seam(const double at[2], double size) {
    return fabs(remainder(at[0], size)) < 2e-5 || fabs(remainder(at[1], size)) < 2e-5;
}

/* From its first tick on, which finds it pressed in already, the HIP is held by a floor DEPTH above it. */
static void check_drag(double size, double along_x, double along_y) {
    SCOPED_SCENE *scene = lay_floor(size, -1, -1, 0.0, NULL);
    dragged d = {{0.0207, 0.0211}, {STEP * along_x, STEP * along_y}};
    int tiles = 0;
    knurl_surface_id latest = 0;
    for (int k = 0; k < TICKS; k++) {
        const knurl_tick_output out = tick_at(scene, d.at[0], d.at[1], -DEPTH);
        if (out.contacts == 0 || (out.flags & KNURL_TICK_CONTACTS_FULL) != 0) {
            fail_msg("tiles of %g m, towards %g %g, tick %d at %.9g %.9g: %u contacts, flags %#x", size, along_x,
                     along_y, k, d.at[0], d.at[1], (unsigned)out.contacts, (unsigned)out.flags);
        }
        CHECK_CLOSE(out.depth, DEPTH, 1e-12L);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * DEPTH * out.contacts, 1e-9L);
        if (!is_on_seam(d.at, size)) {
            assert_int_equal(out.contacts, 1);
        }
        tiles += out.surface != latest;
        latest = out.surface;
        drag_on(&d, size);
    }
    assert_true(tiles > (int)(0.9 * TICKS * STEP * fmax(along_x, along_y) / size));
}

TEST(a_floor_of_tiles_is_felt_in_every_tick_of_a_straight_drag) {
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        check_drag(sizes[i], 1.0, 0.0);
        check_drag(sizes[i], 0.0, 1.0);
    }
}

TEST(a_floor_of_tiles_is_felt_in_every_tick_of_a_diagonal_drag) {
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        check_drag(sizes[i], sqrt(0.5), sqrt(0.5));
        check_drag(sizes[i], 0.8, 0.6);
    }
}

/* Corners of four tiles, repeatedly: at, before and behind each corner. Sums of decimal fractions are not exact, so
 * that at a corner a HIP is outside of all four by a rounding error. */
TEST(a_drag_through_the_corners_of_tiles_is_felt_in_every_tick) {
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        SCOPED_SCENE *scene = lay_floor(sizes[i], -1, -1, 0.0, NULL);
        const double start = 10.0 * sizes[i];
        for (int k = 0; k < (int)(80.0 * sizes[i] / STEP); k++) {
            const double at = start + STEP * k; /* 2 to 8 mm: a whole number of ticks a tile */
            const knurl_tick_output out = tick_at(scene, at, at, -DEPTH);
            if (out.flags != KNURL_TICK_CONTACT) {
                fail_msg("tiles of %g m, at %.17g: %u contacts, flags %#x", sizes[i], at, (unsigned)out.contacts,
                         (unsigned)out.flags);
            }
            CHECK_CLOSE(out.depth, DEPTH, 1e-12L);
        }
    }
}

/* Along the middle of the odd tile's row, from 8 tiles before it to its far rim, in whole ticks a tile; the HIP's
 * height is DEPTH below the others. Checks the contacts over the odd one, and their depth. */
static void drag_onto(double size, double odd, double wanted, int held) {
    knurl_surface_id id = 0;
    SCOPED_SCENE *scene = lay_floor(size, 50, 50, odd, &id);
    int over_it = 0;
    for (double x = 42.0 * size + 1e-4; x < 51.0 * size - 1e-4; x += STEP) {
        const knurl_tick_output out = tick_at(scene, x, 50.5 * size, -DEPTH);
        const int on_it = x > 50.0 * size + 1e-5;
        assert_int_equal(out.flags & KNURL_TICK_CONTACTS_FULL, 0);
        assert_int_equal(out.contacts, on_it ? held : 1);
        assert_true((out.surface == id) == (on_it && held));
        CHECK_CLOSE(out.depth, on_it ? wanted : DEPTH, 1e-12L);
        CHECK_VECTOR(out.force, 0.0, 0.0, K * (on_it ? wanted : DEPTH), 1e-9L);
        over_it += on_it;
    }
    assert_true(over_it >= (int)(size / STEP) - 2);
}

TEST(a_tile_half_a_millimetre_lower_than_its_neighbour_takes_the_hip_over) {
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        drag_onto(sizes[i], -0.0005, DEPTH - 0.0005, 1);
    }
}

TEST(below_a_tile_2_mm_higher_than_its_neighbour_the_hip_passes_and_contact_ends) {
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        drag_onto(sizes[i], 0.002, 0.0, 0);
    }
}

/* Two planes with a crack between them; the HIP is dragged from one to the other and spends `ticks` ticks above the
 * crack. Returns the surface that holds it there, if the second one holds it then. */
static uint32_t cross_crack(double crack, int ticks, uint32_t held) {
    SCOPED_SCENE *scene = empty_scene(1);
    surface_parts parts = surface_plane();
    configure_plainly(scene, 0);
    parts.plane.half_extents[0] = parts.plane.half_extents[1] = 0.01;
    for (int i = 0; i < 2; i++) {
        parts.desc.position[0] = i == 0 ? -0.01 : 0.01 + crack;
        (void)add_surface(scene, &parts);
    }
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_int_equal(tick_at(scene, -STEP, 0.0, -DEPTH).contacts, 1);
    for (int k = 0; k < ticks; k++) {
        const knurl_tick_output between = tick_at(scene, 0.5 * crack, 0.0, -DEPTH);
        assert_int_equal(between.contacts, held);
        CHECK_VECTOR(between.force, 0.0, 0.0, held ? K * DEPTH : 0.0, 1e-12L);
    }
    const uint32_t contacts = tick_at(scene, STEP, 0.0, -DEPTH).contacts;
    return contacts;
}

/* Each reaches 0.1 um beyond its edges. */
TEST(a_crack_from_rounding_between_two_surfaces_is_closed) {
    for (int ticks = 0; ticks <= 10; ticks++) {
        assert_int_equal(cross_crack(1e-7, ticks, 1), 1);
    }
}

TEST(a_tick_that_falls_into_a_crack_between_two_surfaces_loses_neither) {
    for (int ticks = 0; ticks <= 4; ticks++) { /* at 1 kHz: less than 5 ms */
        assert_int_equal(cross_crack(1e-6, ticks, 0), 1);
    }
}

TEST(a_hip_that_stays_between_two_surfaces_has_slid_off_both) {
    assert_int_equal(cross_crack(1e-6, 6, 0), 0);
}
