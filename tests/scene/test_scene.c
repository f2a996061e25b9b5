/* A scene's life on the game thread: every documented error, ids, names, memory. SPDX-License-Identifier: MIT */
#include "scene/ask.h"
#include "support/poses.h"

static const double NO_NUMBERS[] = {(double)NAN, (double)INFINITY, (double)-INFINITY};

#define CHECK_ADD_REFUSED(scene, parts, code, word)                                                                    \
    do {                                                                                                               \
        knurl_surface_id id_ = 77;                                                                                     \
        const uint32_t count_ = knurl_scene_get_surface_count(scene);                                                  \
        CHECK_REFUSED(knurl_scene_add_surface(scene, surface_ready(parts), &id_), code, id_);                          \
        check_message(word);                                                                                           \
        assert_int_equal(knurl_scene_get_surface_count(scene), count_);                                                \
    } while (0)

TEST(life_goes_from_create_to_tick) {
    SCOPED_SCENE *scene = NULL;
    assert_int_equal(knurl_scene_create(NULL, &scene), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_count(scene), 0);
    assert_true(knurl_scene_get_surface(scene, 0) == 0);
    surface_parts parts = surface_plane();
    parts.desc.name = "first";
    const knurl_surface_id first = add_surface(scene, &parts);
    parts.desc.name = NULL;
    const knurl_surface_id second = add_surface(scene, &parts);
    assert_true(first != second);
    assert_int_equal(knurl_scene_get_surface_count(scene), 2);
    assert_true(knurl_scene_get_surface(scene, 0) == first);
    assert_true(knurl_scene_get_surface(scene, 1) == second);
    assert_true(knurl_scene_get_surface(scene, 2) == 0);
    char name[KNURL_NAME_SIZE] = "";
    assert_int_equal(knurl_scene_get_surface_name(scene, first, name), KNURL_OK);
    assert_string_equal(name, "first");
    assert_int_equal(knurl_scene_get_surface_name(scene, second, name), KNURL_OK);
    assert_string_equal(name, "");
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_true((tick_at(scene, 0.0, 0.0, -0.001).flags & KNURL_TICK_CONTACT) != 0);
    knurl_scene_destroy(NULL);
}

TEST(scene_descriptions_out_of_range_are_refused) {
    knurl_scene *scene = NULL;
    knurl_scene_desc good;
    knurl_scene_desc_init(&good, sizeof good);
    knurl_scene_desc bad;
    const struct {
        uint32_t *value, wrong;
        const char *name;
    } fields[] = {{&bad.max_surfaces, 0, "max_surfaces"},
                  {&bad.max_surfaces, (1u << 20) + 1, "max_surfaces"},
                  {&bad.hip_count, 0, "hip_count"},
                  {&bad.hip_count, 9, "hip_count"},
                  {&bad.struct_size, 0, "struct_size"}};
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        bad = good;
        *fields[i].value = fields[i].wrong;
        CHECK_REFUSED(knurl_scene_create(&bad, &scene), KNURL_ERROR_ARGUMENT, scene);
        check_message(fields[i].name);
    }
    bad = good;
    const knurl_allocator half = {NULL, NULL, NULL};
    bad.allocator = &half;
    CHECK_REFUSED(knurl_scene_create(&bad, &scene), KNURL_ERROR_ARGUMENT, scene);
    check_message("allocator");
}

TEST(a_scene_is_committed_once) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id id = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    CHECK_REFUSED(knurl_scene_commit(scene), KNURL_ERROR_STATE, id);
    assert_int_equal(knurl_scene_get_surface_count(scene), 1);
}

TEST(a_long_name_is_cut_between_characters) {
    char given[302] = "a", name[KNURL_NAME_SIZE];
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    for (int i = 1; i < 301; i += 3) {
        memcpy(given + i, "\xe2\x82\xac", 3); /* the sign of the euro */
    }
    parts.desc.name = given;
    const knurl_surface_id id = add_surface(scene, &parts);
    knurl_surface_id found = 0;
    assert_int_equal(knurl_scene_get_surface_name(scene, id, name), KNURL_OK);
    assert_int_equal(strlen(name), 253);
    assert_memory_equal(name, given, 253);
    assert_int_equal(knurl_scene_find_surface(scene, given, &found), KNURL_OK); /* by all of it */
    assert_true(found == id);
    CHECK_REFUSED(knurl_scene_find_surface(scene, name, &found), KNURL_ERROR_UNKNOWN, found);
    memset(given, 'b', 255);
    given[255] = 0;
    assert_int_equal(knurl_scene_get_surface_name(scene, add_surface(scene, &parts), name), KNURL_OK);
    assert_string_equal(name, given);
}

TEST(ids_of_removed_surfaces_stay_stale) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    char name[KNURL_NAME_SIZE] = "untouched";
    knurl_surface_info info;
    knurl_surface_info_init(&info, sizeof info);
    const knurl_surface_id kept = add_surface(scene, &parts);
    const knurl_surface_id removed = add_surface(scene, &parts);
    assert_int_equal(knurl_scene_remove_surface(scene, removed), KNURL_OK);
    const knurl_surface_id next = add_surface(scene, &parts); /* takes the place, not the id */
    assert_true(next != removed);
    const knurl_surface_id stale[] = {removed, 0, UINT64_MAX, next + 1, kept + ((uint64_t)1 << 32)};
    for (size_t i = 0; i < COUNT_OF(stale); i++) {
        CHECK_REFUSED(knurl_scene_remove_surface(scene, stale[i]), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_set_material(scene, stale[i], &parts.material), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_get_surface_name(scene, stale[i], name), KNURL_ERROR_STALE_ID, name);
        CHECK_REFUSED(knurl_scene_get_surface_info(scene, stale[i], &info), KNURL_ERROR_STALE_ID, info);
    }
    assert_int_equal(knurl_scene_get_surface_name(scene, kept, name), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_name(scene, next, name), KNURL_OK);
}

TEST(an_id_of_another_scene_is_stale_and_says_so) {
    surface_parts parts = surface_plane();
    knurl_scene *scenes[2] = {empty_scene(1), empty_scene(1)};
    knurl_surface_id ids[2];
    char name[KNURL_NAME_SIZE] = "";
    for (int i = 0; i < 2; i++) {
        ids[i] = add_surface(scenes[i], &parts); /* both of them at their scene's first place */
    }
    for (int i = 0; i < 2; i++) {
        CHECK_REFUSED(knurl_scene_remove_surface(scenes[i], ids[1 - i]), KNURL_ERROR_STALE_ID, parts);
        check_message("another scene's");
        CHECK_REFUSED(knurl_scene_get_surface_name(scenes[i], ids[1 - i], name), KNURL_ERROR_STALE_ID, name);
        assert_int_equal(knurl_scene_get_surface_count(scenes[i]), 1);
        CHECK_REFUSED(knurl_scene_remove_surface(scenes[i], 1), KNURL_ERROR_STALE_ID, parts);
        check_message("names no surface");
    }
    assert_int_equal(knurl_scene_remove_surface(scenes[0], ids[0]), KNURL_OK);
    knurl_scene_destroy(scenes[0]);
    SCOPED_SCENE *after = empty_scene(1); /* may have its memory, but not its ids */
    (void)add_surface(after, &parts);
    CHECK_REFUSED(knurl_scene_remove_surface(after, ids[0]), KNURL_ERROR_STALE_ID, parts);
    knurl_scene_destroy(scenes[1]);
}

TEST(order_of_adding_survives_removal) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id ids[9];
    for (int i = 0; i < 9; i++) {
        ids[i] = add_surface(scene, &parts);
    }
    assert_int_equal(knurl_scene_remove_surface(scene, ids[0]), KNURL_OK);
    assert_int_equal(knurl_scene_remove_surface(scene, ids[4]), KNURL_OK);
    const knurl_surface_id last = add_surface(scene, &parts);
    const knurl_surface_id expected[8] = {ids[1], ids[2], ids[3], ids[5], ids[6], ids[7], ids[8], last};
    assert_int_equal(knurl_scene_get_surface_count(scene), 8);
    for (uint32_t i = 0; i < 8; i++) {
        assert_true(knurl_scene_get_surface(scene, i) == expected[i]);
    }
}

TEST(full_scene_has_room_after_a_removal) {
    surface_parts parts = surface_plane();
    knurl_scene_desc desc;
    SCOPED_SCENE *scene = NULL;
    knurl_surface_id id = 0;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 6;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    for (int i = 0; i < 6; i++) {
        id = add_surface(scene, &parts);
    }
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_FULL, "max_surfaces");
    assert_int_equal(knurl_scene_remove_surface(scene, id), KNURL_OK);
    (void)add_surface(scene, &parts);
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_FULL, "6");
}

TEST(every_method_is_taken_and_an_unknown_one_refused_with_a_sentence) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &parts);
    for (parts.material.method = KNURL_METHOD_DEFAULT; parts.material.method <= KNURL_METHOD_BANDLIMITED;
         parts.material.method++) {
        (void)add_surface(scene, &parts);
        assert_int_equal(knurl_scene_set_material(scene, id, &parts.material), KNURL_OK);
    }
    parts.material.method = 99;
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_UNKNOWN, "99");
    CHECK_REFUSED(knurl_scene_set_material(scene, id, &parts.material), KNURL_ERROR_UNKNOWN, id);
}

TEST(materials_out_of_range_are_refused_by_name) {
    surface_parts good = surface_plane();
    surface_parts bad;
    set_grating(&good, KNURL_METHOD_S2, 500.0, 300.0, 0.0005);
    struct {
        double *value;
        const char *name;
        double wrong;
    } fields[] = {
        {&bad.material.spatial_frequency[0], "spatial_frequency", -1.0},
        {&bad.material.spatial_frequency[1], "spatial_frequency", -1e-300},
        {&bad.material.amplitude, "amplitude", -1e-9},
        {&bad.material.stiffness, "stiffness", 0.0},
        {&bad.material.stiffness, "stiffness", -400.0},
        {&bad.material.damping, "damping", -0.1},
        {&bad.material.friction, "friction", -0.1},
        {&bad.material.orientation, "orientation", (double)NAN},
    };
    SCOPED_SCENE *scene = empty_scene(1);
    const knurl_surface_id id = add_surface(scene, &good);
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        for (size_t k = 0; k <= COUNT_OF(NO_NUMBERS); k++) {
            bad = good;
            *fields[i].value = k < COUNT_OF(NO_NUMBERS) ? NO_NUMBERS[k] : fields[i].wrong;
            CHECK_ADD_REFUSED(scene, &bad, KNURL_ERROR_ARGUMENT, fields[i].name);
            CHECK_REFUSED(knurl_scene_set_material(scene, id, &bad.material), KNURL_ERROR_ARGUMENT, bad);
        }
    }
    const knurl_material_desc material = material_of(scene, id); /* the first value is kept */
    assert_memory_equal(&material, &good.material, sizeof material);
}

TEST(places_out_of_range_are_refused_by_name) {
    surface_parts good = surface_plane();
    surface_parts bad;
    const struct {
        double *values;
        int count;
        const char *name;
    } fields[] = {{bad.desc.position, 3, "position"},
                  {bad.desc.rotation, 3, "rotation"},
                  {bad.desc.axis, 3, "axis"},
                  {bad.desc.normal, 3, "normal"},
                  {bad.plane.half_extents, 2, "half_extents"}};
    SCOPED_SCENE *scene = empty_scene(1);
    for (size_t i = 0; i < COUNT_OF(fields); i++) {
        for (int axis = 0; axis < fields[i].count; axis++) {
            for (size_t k = 0; k < COUNT_OF(NO_NUMBERS); k++) {
                bad = good;
                fields[i].values[axis] = NO_NUMBERS[k];
                CHECK_ADD_REFUSED(scene, &bad, KNURL_ERROR_ARGUMENT, fields[i].name);
            }
        }
    }
    bad = good;
    bad.desc.rotation[3] = 0.0;
    CHECK_ADD_REFUSED(scene, &bad, KNURL_ERROR_ARGUMENT, "unit quaternion");
    bad.desc.rotation[3] = 2.0;
    CHECK_ADD_REFUSED(scene, &bad, KNURL_ERROR_ARGUMENT, "unit quaternion");
    bad = good;
    bad.plane.half_extents[1] = 0.0;
    CHECK_ADD_REFUSED(scene, &bad, KNURL_ERROR_ARGUMENT, "half_extents[1]");
}

/* The rotation is about z x normal: x, y, z, w = (-ny, nx, 0, 1 + nz) / sqrt(2 + 2 nz). */
TEST(a_surface_with_a_normal_is_turned_to_it_the_shortest_way) {
    static const double normals[][3] = {{0.0, 1.0, 0.0},  {0.0, -3.0, 0.0}, {1e-9, 0.0, 0.0},  {-1e8, 0.0, 0.0},
                                        {0.0, 0.0, 1.0},  {1.0, 2.0, 3.0},  {-1.0, 2.0, -3.0}, {1e-9, -1e-9, -1.0},
                                        {0.3, -0.4, 0.0}, {0.0, 1e-3, -1.0}};
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    for (size_t i = 0; i < COUNT_OF(normals); i++) {
        const double *n = normals[i];
        const double side = hypot(n[0], n[1]), angle = atan2(side, n[2]);
        const double part = side > 0.0 ? sin(0.5 * angle) / side : 0.0;
        memcpy(parts.desc.normal, n, sizeof parts.desc.normal);
        const double q[4] = {-n[1] * part, n[0] * part, 0.0, cos(0.5 * angle)};
        const plane_frame found = frame_of(scene, add_surface(scene, &parts));
        for (int axis = 0; axis < 3; axis++) {
            const double along[3] = {axis == 0, axis == 1, axis == 2};
            double turned[3];
            turn(q, along, turned);
            CHECK_VECTOR(found.axes[axis], turned[0], turned[1], turned[2], 1e-15);
        }
    }
    parts.desc.normal[0] = parts.desc.normal[1] = 0.0;
    const plane_frame about_x = frame_of(scene, add_surface(scene, &parts)); /* to -z */
    CHECK_VECTOR(about_x.axes[0], 1.0, 0.0, 0.0, 1e-15);
    CHECK_VECTOR(about_x.axes[2], 0.0, 0.0, -1.0, 1e-15);
    for (int i = 0; i < 3; i++) { /* however little it turns */
        parts.desc.rotation[i] = 1e-4;
        CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_ARGUMENT, "rotation: expected 0, 0, 0, 1 with a normal, found [");
        parts.desc.rotation[i] = 0.0;
    }
    memcpy(parts.desc.rotation, (const double[4]){0.1, 0.7, -0.1, 0.7}, sizeof parts.desc.rotation);
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_ARGUMENT, "found [0.1, 0.7, -0.1, 0.7]");
}

TEST(surface_is_exactly_one_shape_with_a_material) {
    SCOPED_SHAPE sheet = shape_sheet(2, 2, (const double[2]){0.05, 0.05}, NULL);
    surface_parts parts = surface_mesh(&sheet);
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id id = 77;
    knurl_surface_desc desc = *surface_ready(&parts);
    desc.plane = &parts.plane;
    CHECK_REFUSED(knurl_scene_add_surface(scene, &desc, &id), KNURL_ERROR_ARGUMENT, id);
    check_message("both");
    desc.plane = NULL;
    desc.mesh = NULL;
    CHECK_REFUSED(knurl_scene_add_surface(scene, &desc, &id), KNURL_ERROR_ARGUMENT, id);
    check_message("none");
    desc = *surface_ready(&parts);
    desc.material = NULL;
    CHECK_REFUSED(knurl_scene_add_surface(scene, &desc, &id), KNURL_ERROR_ARGUMENT, id);
    check_message("material");
    CHECK_REFUSED(knurl_scene_add_surface(scene, NULL, &id), KNURL_ERROR_ARGUMENT, id);
    parts.mesh.index_count = 4;
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_ARGUMENT, "multiple of 3");
    assert_int_equal(knurl_scene_get_surface_count(scene), 0);
}

TEST(tangents_alone_give_a_direction_but_s1_needs_coordinates) {
    float tangents[9 * 4] = {0};
    SCOPED_SHAPE sheet = shape_sheet(2, 2, (const double[2]){0.05, 0.05}, NULL);
    surface_parts parts = surface_mesh(&sheet);
    SCOPED_SCENE *scene = empty_scene(1);
    parts.mesh.uvs = NULL;
    parts.mesh.tangents = tangents;
    set_grating(&parts, KNURL_METHOD_S2, 500.0, 0.0, 0.0005);
    const knurl_surface_id id = add_surface(scene, &parts); /* S2 needs a direction only */
    set_grating(&parts, KNURL_METHOD_S1, 500.0, 0.0, 0.0005);
    CHECK_ADD_REFUSED(scene, &parts, KNURL_ERROR_ARGUMENT, "S1");
    CHECK_REFUSED(knurl_scene_set_material(scene, id, &parts.material), KNURL_ERROR_ARGUMENT, id);
    check_message("uvs or an axis");
    parts.desc.axis[0] = 3.0;
    (void)add_surface(scene, &parts);
    parts.desc.axis[0] = 0.0;
    parts.mesh.uvs = sheet.uvs;
    (void)add_surface(scene, &parts);
}

TEST(info_tells_the_axis_that_was_given) {
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_info info = info_of(scene, add_surface(scene, &parts));
    for (int i = 0; i < 3; i++) {
        CHECK_SAME(info.axis[i], 0.0);
    }
    parts.desc.axis[0] = -3.0;
    parts.desc.axis[1] = 4.0;
    info = info_of(scene, add_surface(scene, &parts));
    CHECK_CLOSE(info.axis[0], -0.6, 1e-15);
    CHECK_CLOSE(info.axis[1], 0.8, 1e-15);
    CHECK_SAME(info.axis[2], 0.0);
}

TEST(unknown_names_are_answered_with_the_known) {
    static const char *const names[] = {"bark", "silk", "bark"};
    surface_parts parts = surface_plane();
    SCOPED_SCENE *scene = empty_scene(1);
    knurl_surface_id ids[3];
    knurl_surface_id found = 77;
    CHECK_REFUSED(knurl_scene_find_surface(scene, "bark", &found), KNURL_ERROR_UNKNOWN, found);
    for (int i = 0; i < 3; i++) {
        parts.desc.name = names[i];
        ids[i] = add_surface(scene, &parts);
    }
    CHECK_REFUSED(knurl_scene_find_surface(scene, "velvet", &found), KNURL_ERROR_UNKNOWN, found);
    check_message("'bark', 'silk', 'bark'");
    check_message("found 'velvet'");
    assert_int_equal(knurl_scene_find_surface(scene, "silk", &found), KNURL_OK);
    assert_true(found == ids[1]);
    assert_int_equal(knurl_scene_find_surface(scene, "bark", &found), KNURL_OK);
    assert_true(found == ids[0]); /* the first of that name */
    assert_int_equal(knurl_scene_remove_surface(scene, ids[0]), KNURL_OK);
    assert_int_equal(knurl_scene_find_surface(scene, "bark", &found), KNURL_OK);
    assert_true(found == ids[2]);
}

TEST(a_hip_that_is_not_there_and_a_workspace_without_size_are_refused) {
    SCOPED_SCENE *scene = empty_scene(2);
    knurl_hip_desc good;
    knurl_workspace workspace;
    knurl_hip_desc_init(&good, sizeof good);
    knurl_workspace_set_identity(&workspace);
    CHECK_REFUSED(knurl_scene_configure_hip(scene, 2, &good), KNURL_ERROR_ARGUMENT, good);
    CHECK_REFUSED(knurl_scene_get_workspace(scene, 0, &workspace), KNURL_ERROR_STATE, workspace);
    knurl_hip_desc bad = good;
    workspace.scale = 0.0;
    bad.workspace = &workspace;
    CHECK_REFUSED(knurl_scene_configure_hip(scene, 0, &bad), KNURL_ERROR_ARGUMENT, bad);
    assert_int_equal(knurl_scene_configure_hip(scene, 1, NULL), KNURL_OK);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    CHECK_REFUSED(knurl_scene_get_workspace(scene, 2, &workspace), KNURL_ERROR_ARGUMENT, workspace);
    assert_int_equal(knurl_scene_get_workspace(scene, 1, &workspace), KNURL_OK);
}

TEST(workspace_left_open_is_centred_on_all_bounds) {
    surface_parts parts = surface_plane();
    knurl_workspace workspace;
    SCOPED_SCENE *scene = empty_scene(1);
    parts.desc.position[0] = 1.0;
    (void)add_surface(scene, &parts);
    parts.desc.position[0] = 3.0;
    parts.desc.position[1] = -0.5;
    parts.desc.position[2] = 0.25;
    parts.desc.normal[0] = 1.0; /* a quarter turn about y: upright in yz */
    (void)add_surface(scene, &parts);
    assert_int_equal(knurl_scene_commit(scene), KNURL_OK);
    assert_int_equal(knurl_scene_get_workspace(scene, 0, &workspace), KNURL_OK);
    /* bounds: x 0.95 to 3, y -0.55 to 0.05, z 0 to 0.3 */
    CHECK_VECTOR(workspace.origin, 0.5 * (0.95 + 3.0), 0.5 * (-0.55 + 0.05), 0.5 * (0.0 + 0.3), 1e-12);
    CHECK_SAME(workspace.scale, 1.0);
}
