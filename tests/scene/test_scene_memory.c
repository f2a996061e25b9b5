/* Memory of a scene: bytes are freed, failures leave it unchanged, structs of older and newer callers, and information
 * about its surfaces. SPDX-License-Identifier: MIT */
#include "scene/scene.h"

#include "scene/ask.h"
#include "support/ledger.h"

static double valley(double x, double y) {
    return 0.2 * x + 0.1 * y * y; /* flat, it would be stored as a plane */
}

TEST(a_surface_tells_what_it_added_to_the_scene) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    for (int i = 0; i < 3; i++) { /* with room in the lists */
        (void)add_surface(scene, &parts);
    }
    parts.desc.name = "a name that takes memory of its own";
    const uint64_t before = knurl_scene_get_bytes(scene);
    const knurl_surface_id id = add_surface(scene, &parts);
    assert_int_equal(info_of(scene, id).bytes, knurl_scene_get_bytes(scene) - before);
}

TEST(removing_gives_the_bytes_back) {
    ledger books = {0, 0, 0, 0};
    SCOPED_SHAPE sheet = shape_sheet(30, 30, (const double[2]){0.05, 0.05}, valley);
    surface_parts parts = surface_mesh(&sheet);
    parts.desc.name = "a name of some length";
    knurl_scene *scene = scene_with(&books);
    surface_parts plane = surface_plane();
    (void)add_surface(scene, &plane); /* the places for the first few surfaces stay */
    const uint64_t before = knurl_scene_get_bytes(scene);
    for (int i = 0; i < 3; i++) {
        const knurl_surface_id id = add_surface(scene, &parts);
        assert_true(knurl_scene_get_bytes(scene) == books.bytes);
        assert_true(books.bytes > before + 1800 * 12);
        assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
        assert_true(knurl_scene_get_bytes(scene) == before);
        assert_true(books.bytes == before);
    }
    end_with(scene, &books);
}

TEST(refused_surfaces_leave_no_bytes) {
    ledger books = {0, 0, 0, 0};
    SCOPED_SHAPE sheet = shape_sheet(3, 3, (const double[2]){0.05, 0.05}, valley);
    knurl_scene *scene = scene_with(&books);
    surface_parts plane = surface_plane();
    (void)add_surface(scene, &plane);
    const uint64_t before = books.bytes;
    surface_parts bad = surface_mesh(&sheet);
    bad.desc.name = "refused";
    bad.material.stiffness = -1.0; /* found after the mesh was built */
    knurl_surface_id id = 77;
    CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(&bad), &id), KNURL_ERROR_ARGUMENT, id);
    assert_true(books.bytes == before && knurl_scene_get_bytes(scene) == before);
    end_with(scene, &books);
}

/* Adds with one request refused; the scene is as it was, and the next attempt succeeds. */
static int add_without(int32_t refused, surface_parts *parts, int is_committed) {
    ledger books = {0, 0, 0, 0};
    knurl_scene *scene = scene_with(&books);
    surface_parts plane = surface_plane();
    knurl_surface_id first = 0;
    knurl_surface_id id = 77;
    for (int i = 0; i < 4; i++) { /* one more makes the scene grow */
        first = first ? first : add_surface(scene, &plane);
        (void)(i > 0 ? add_surface(scene, &plane) : 0);
    }
    assert_int_equal(is_committed ? knurl_scene_commit(scene) : KNURL_OK, KNURL_OK);
    books.refused = books.requests + refused;
    const knurl_result result = knurl_scene_add_surface(scene, surface_ready(parts), &id);
    if (result != KNURL_OK) {
        assert_int_equal(result, KNURL_ERROR_MEMORY);
        assert_true(id == 77);
        assert_int_equal(knurl_scene_get_surface_count(scene), 4);
        assert_true(knurl_scene_get_bytes(scene) == books.bytes);
        const knurl_surfaces *s = &scene->surfaces;
        assert_true(s->capacity == 4 || !knurl_surfaces_find(s, knurl_surfaces_make_id(s, 4, s->generations[4])));
        books.refused = 0;
        id = add_surface(scene, parts);
    }
    assert_true(knurl_scene_get_surface(scene, 0) == first);
    assert_true(knurl_scene_get_surface(scene, 4) == id);
    end_with(scene, &books);
    return result != KNURL_OK;
}

TEST(memory_that_runs_out_leaves_the_scene_as_it_was) {
    float tangents[16 * 4] = {0};
    SCOPED_SHAPE sheet = shape_sheet(3, 3, (const double[2]){0.05, 0.05}, valley);
    surface_parts parts = surface_mesh(&sheet);
    parts.mesh.tangents = tangents;
    parts.desc.name = "sheet";
    for (int is_committed = 0; is_committed <= 1; is_committed++) {
        int32_t refused = 1;
        while (add_without(refused, &parts, is_committed)) {
            refused++;
        }
        assert_in_range(refused, 12, 60); /* each part of a mesh, its scratch, the name, the scene's tables */
    }
}

TEST(memory_that_runs_out_makes_no_scene) {
    for (int32_t refused = 1; refused <= 2; refused++) {
        ledger books = {0, 0, 0, refused};
        const knurl_allocator allocator = {take, give_back, &books};
        knurl_scene_desc desc;
        knurl_scene *scene = NULL;
        knurl_scene_desc_init(&desc, sizeof desc);
        desc.allocator = &allocator;
        CHECK_REFUSED(knurl_scene_create(&desc, &scene), KNURL_ERROR_MEMORY, scene);
        assert_int_equal(books.blocks, 0);
    }
}

/* Callers of another version: a material before `damping` was appended, and with a future field. */
TEST(older_material_keeps_the_defaults_of_what_it_lacks) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    parts.material.stiffness = 123.0;
    parts.material.damping = (double)NAN; /* not read */
    parts.material.friction = 7.0;
    parts.material.orientation = (double)NAN;
    parts.material.struct_size = offsetof(knurl_material_desc, damping);
    const knurl_surface_id id = add_surface(scene, &parts);
    const knurl_material_desc material = material_of(scene, id);
    CHECK_SAME(material.stiffness, 123.0);
    CHECK_SAME(material.damping, 0.0);
    CHECK_SAME(material.friction, 0.0);
    CHECK_SAME(material.orientation, 0.0);
}

TEST(older_surface_and_scene_descriptions_work) {
    surface_parts parts = surface_plane();
    knurl_scene_desc desc;
    SCOPED_SCENE *scene = NULL;
    knurl_scene_desc_init(&desc, offsetof(knurl_scene_desc, hip_count));
    assert_int_equal(desc.struct_size, 8);
    desc.max_surfaces = 1;
    desc.hip_count = 1000; /* not read */
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    parts.desc.rotation[0] = parts.desc.axis[0] = (double)NAN; /* not read */
    parts.desc.struct_size = offsetof(knurl_surface_desc, rotation);
    parts.plane.half_extents[0] = (double)NAN;
    parts.plane.struct_size = offsetof(knurl_plane_desc, half_extents);
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_true((tick_at(scene, 0.049, 0.049, -0.001).flags & KNURL_TICK_CONTACT) != 0); /* the default of 0.05 */
}

TEST(newer_structs_are_refused_only_where_their_news_is_used) {
    struct {
        knurl_material_desc known;
        double appended[2];
    } newer;
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    knurl_material_desc_init(&newer.known, sizeof newer);
    assert_int_equal(newer.known.struct_size, sizeof newer);
    CHECK_SAME(newer.appended[1], 0.0);
    assert_int_equal(knurl_scene_set_material(scene, id, &newer.known), KNURL_OK);
    newer.appended[1] = 1e-300;
    CHECK_REFUSED(knurl_scene_set_material(scene, id, &newer.known), KNURL_ERROR_UNSUPPORTED, newer);
    assert_non_null(strstr(knurl_error_message(), "knurl_material_desc"));
}

TEST(shorter_info_is_written_no_further_than_its_size) {
    surface_parts parts = surface_plane();
    knurl_surface_info info;
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    memset(&info, 0x77, sizeof info);
    info.struct_size = offsetof(knurl_surface_info, bytes);
    assert_int_equal(knurl_scene_get_surface_info(scene, id, &info), KNURL_OK);
    assert_string_equal(info.shape, "plane");
    assert_int_equal(info.struct_size, offsetof(knurl_surface_info, bytes));
    assert_true(info.bytes == UINT64_C(0x7777777777777777));
}

TEST(info_tells_what_a_plane_came_to_be) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    parts.desc.name = "wall";
    parts.desc.double_sided = 1;
    parts.desc.position[2] = 0.5;
    parts.desc.normal[1] = -1.0; /* a quarter turn about x: the front faces -y */
    parts.plane.half_extents[0] = 0.02;
    parts.plane.half_extents[1] = 0.03;
    parts.material.orientation = asin(1.0); /* the grating's x along the plane's y, the scene's z */
    const knurl_surface_id id = add_surface(scene, &parts);
    const knurl_surface_info info = info_of(scene, id);
    assert_string_equal(info.name, "wall");
    assert_string_equal(info.model, "plane");
    assert_int_equal(info.triangle_count, 0);
    assert_int_equal(info.double_sided, 1);
    assert_int_equal(material_of(scene, id).method, KNURL_METHOD_BANDLIMITED); /* the default, resolved */
    CHECK_VECTOR(info.bounds_min, -0.02, 0.0, 0.47, 1e-12);
    CHECK_VECTOR(info.bounds_max, 0.02, 0.0, 0.53, 1e-12);
    CHECK_VECTOR(info.anchor, 0.0, 0.0, 0.5, 1e-12);
    CHECK_VECTOR(info.anchor_normal, 0.0, -1.0, 0.0, 1e-12);
    CHECK_VECTOR(info.anchor_x, 0.0, 0.0, 1.0, 1e-12);
    CHECK_VECTOR(info.anchor_reach, 0.03, 0.03, 0.02, 1e-12);
    CHECK_VECTOR(info.stretch, 1.0, 1.0, 1.0, 0.0L);
}

/* A sheet 0.1 m by 0.1 m whose u runs twice as fast in its right half: dP/du is 0.15 and 0.075 m there, 0.1125 in the
 * mean. */
TEST(info_tells_how_uvs_stretch) {
    SCOPED_SHAPE sheet = shape_sheet(2, 1, (const double[2]){0.05, 0.05}, NULL);
    for (uint32_t v = 0; v < 6; v++) {
        sheet.uvs[2 * v] = v % 3 == 0 ? 0.0f : v % 3 == 1 ? 1.0f / 3.0f : 1.0f;
    }
    surface_parts parts = surface_mesh(&sheet);
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_info info = info_of(scene, add_surface(scene, &parts));
    assert_string_equal(info.shape, "mesh");
    assert_string_equal(info.model, "mesh+bvh");
    assert_int_equal(info.triangle_count, 4);
    CHECK_VECTOR(info.stretch, 0.75, 1.125, 1.5, 1e-6); /* 0.1125/0.15; its mean with 0.1125/0.075 by area; that */
    CHECK_VECTOR(info.anchor_normal, 0.0, 0.0, 1.0, 1e-9);
    CHECK_VECTOR(info.anchor_x, 1.0, 0.0, 0.0, 1e-6);
    CHECK_CLOSE(info.anchor[2], 0.0, 1e-9);
}
