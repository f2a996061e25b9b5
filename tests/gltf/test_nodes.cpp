// Nodes that are shown, their poses and names. Expected values by hand from glTF 2.0, 3.5.
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

using namespace builder;

namespace {

constexpr double half_sqrt = 0.70710678118654752;

/// A triangle at the origin that faces +z, its grating along x.
File triangle(const char *axis = "[1,0,0]") {
    return plain({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0}, "", axis);
}

knurl_surface_info placed(File file, const std::string &node) {
    file.nodes = R"({"mesh":0,)" + node + "}";
    return Loaded(file.glb()).info();
}

TEST(translation_rotation_scale_chain) {
    File file = triangle();
    // A quarter turn about z: x' = 1 - y, y' = x; the child is at x = 0.5.
    file.nodes = R"({"translation":[1,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],"children":[1]},
                    {"mesh":0,"translation":[0.5,0,0],"scale":[1,1,1]})";
    const knurl_surface_info info = Loaded(file.glb()).info();
    assert_near(info.bounds_min, {0.9, 0.5, 0});
    assert_near(info.bounds_max, {1.0, 0.6, 0});
    assert_near(info.anchor_x, {0, 1, 0});
    assert_near(info.anchor_normal, {0, 0, 1});
}

TEST(matrix_is_column_major) {
    // x -> y, y -> z, z -> x, then (1, 2, 3).
    const knurl_surface_info info = placed(triangle(), R"("matrix":[0,1,0,0, 0,0,1,0, 1,0,0,0, 1,2,3,1])");
    assert_near(info.bounds_min, {1, 2, 3});
    assert_near(info.bounds_max, {1, 2.1, 3.1});
    assert_near(info.anchor_x, {0, 1, 0});
    assert_near(info.anchor_normal, {1, 0, 0});
}

TEST(non_uniform_scale_moves_geometry_and_not_the_grating) {
    // x + y + z = 1 becomes x/2 + y + z = 1, whose normal is (1, 2, 2)/3; (1, -1, 0) becomes (2, -1, 0).
    File file = plain({1, 0, 0, 0, 1, 0, 0, 0, 1}, "", "[1,-1,0]");
    file.nodes = R"({"mesh":0,"scale":[2,1,1]})";
    const Loaded loaded(file.glb());
    const knurl_surface_info info = loaded.info();
    assert_near(info.bounds_max, {2, 1, 1});
    assert_near(info.anchor_normal, {1.0 / 3, 2.0 / 3, 2.0 / 3});
    assert_near(info.anchor_x, {2 / 2.2360679774997896, -1 / 2.2360679774997896, 0});
    assert_near(loaded.material().spatial_frequency, {1000, 0}, 1e-12);
    assert_number(loaded.material().amplitude, 0.0005);
}

TEST(shear_of_turned_and_scaled_nodes) {
    File file = triangle();
    // Turned by 45 degrees, then stretched by 2 along x: (1, 0) becomes (2, 1)/sqrt(2).
    file.nodes = R"({"scale":[2,1,1],"children":[1]},
                    {"mesh":0,"rotation":[0,0,0.38268343236508977,0.92387953251128674]})";
    const knurl_surface_info info = Loaded(file.glb()).info();
    assert_near(info.anchor_x, {2 / 2.2360679774997896, 1 / 2.2360679774997896, 0});
    assert_near(info.anchor_normal, {0, 0, 1});
}

TEST(mirrored_nodes_keep_their_front) {
    knurl_surface_info info = placed(triangle(), R"("scale":[-1,1,1])");
    assert_near(info.anchor_normal, {0, 0, 1});
    assert_near(info.anchor_x, {-1, 0, 0});
    assert_near(info.bounds_min, {-0.1, 0, 0});
    assert_near(info.bounds_max, {0, 0.1, 0});
    info = placed(triangle(), R"("scale":[1,1,-1])"); // its front is turned away with it
    assert_near(info.anchor_normal, {0, 0, -1});
    info = placed(triangle(), R"("scale":[-1,-1,1])"); // two mirrors are a half turn
    assert_near(info.anchor_normal, {0, 0, 1});
    assert_near(info.anchor_x, {-1, 0, 0});
}

TEST(tangents_turn_as_vectors) {
    File file;
    const int positions = file.vec3({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0});
    const int tangents = file.add<float>(FLOAT, "VEC4", 4, {1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1});
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":)" + std::to_string(positions) +
                  R"(,"TANGENT":)" + std::to_string(tangents) + "}}]}";
    assert_near(Loaded(file.glb()).info().anchor_x, {half_sqrt, half_sqrt, 0});
    assert_near(placed(file, R"("scale":[3,1,1])").anchor_x, {3 / 3.1622776601683795, 1 / 3.1622776601683795, 0});
}

TEST(bad_transforms_name_the_node) {
    const auto fails = [](const std::string &node, std::initializer_list<const char *> parts) {
        File file = triangle();
        file.nodes = R"({"mesh":0,"name":"N",)" + node + "}";
        assert_fails(file.glb(), KNURL_ERROR_FORMAT, parts);
    };
    fails(R"("scale":[1,0,1])", {"node 'N' (0): its transform flattens the mesh"});
    fails(R"("scale":[1e-170,1e30,1e30])", {"node 'N' (0): its transform flattens the mesh"});
    fails(R"("matrix":[1,0,0,0, 1e-155,1e-163,0,0, 0,0,1,0, 0,0,0,1])",
          {"node 'N' (0): its transform flattens the mesh"});
    fails(R"("scale":[1e300,1e300,1])", {"node 'N' (0): its transform is not finite"});
    fails(R"("scale":[1e40,1e40,1e40])",
          {"node 'N' (0)", "POSITION (accessor 0): its used vertex 1: expected within 1e+09 m"});
    fails(R"("translation":[0,1.7e19,0])",
          {"node 'N' (0): its transform puts it at 1.7e+19 m: expected within 1e+09 m"});
    fails(R"("translation":[0,-1e300,0])", {"node 'N' (0): its transform puts it at -1e+300 m"});
    fails(R"("translation":[2e9,0,0])", {"node 'N' (0): its transform puts it at 2e+09 m"});
    fails(R"("matrix":[1,0,0])", {"node 'N' (0): matrix: expected an array of 16 numbers, found an array of 3"});
    fails(R"("matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0.5, 0,0,0,1])", {"node 'N' (0): matrix: expected 0, 0, 0, 1"});
    fails(R"("matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],"scale":[1,1,1])", {"node 'N' (0): scale", "found both"});
    fails(R"("rotation":[0,0,0,0])", {"node 'N' (0): rotation: expected a quaternion of length 1, found length 0"});
    fails(R"("rotation":[0,0,1])", {"node 'N' (0): rotation: expected an array of 4 numbers"});
    fails(R"("translation":[0,"x",0])", {"node 'N' (0): translation: expected an array of 3 numbers, found 'x'"});
}

TEST(a_bad_transform_of_an_untagged_node_is_ignored) {
    File file = triangle();
    file.nodes += R"(,{"scale":[0,0,0]},{"matrix":[1]})";
    assert_int_equal(Loaded(file.glb()).report.surfaces, 1);
}

TEST(the_scene_to_load) {
    File file = triangle();
    file.nodes = R"({"mesh":0,"name":"a"},{"mesh":0,"name":"b"},{"mesh":0,"name":"c"})";
    assert_int_equal(Loaded(file.glb()).report.surfaces, 3); // no scenes: all roots
    file.more = R"(,"scenes":[{"nodes":[0]},{"nodes":[2,1]}])";
    assert_string_equal(Loaded(file.glb()).info().name, "a");
    file.more += R"(,"scene":1)";
    const Loaded loaded(file.glb());
    assert_int_equal(loaded.report.surfaces, 2);
    assert_string_equal(loaded.info(0).name, "c");
    assert_string_equal(loaded.info(1).name, "b");
    file.more = R"(,"scenes":[{"nodes":[0]}],"scene":1)";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"scene: expected an index below 1 (scenes), found 1"});
    file.more = R"(,"scenes":[{"nodes":[0,0]}])";
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"scene 0: nodes: node 'a' (0) is listed twice"});
}

TEST(names_are_stable_and_each_once) {
    File file = plain({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0});
    const std::string primitive = R"({"material":M,"attributes":{"POSITION":0}})";
    const auto with_material = [&](const char *index) {
        std::string text = primitive;
        return text.replace(text.find('M'), 1, index);
    };
    file.materials = R"({"name":"bars",)" + tag(R"("axis":[1,0,0])") + "},{" + tag(R"("axis":[1,0,0])") + "}";
    file.meshes = R"({"name":"one","primitives":[)" + with_material("0") + R"(]},{"primitives":[)" +
                  with_material("0") + "," + with_material("1") + "," + R"({"attributes":{"POSITION":0}})" + "]}";
    file.nodes = R"json({"mesh":0,"name":"plate"},{"mesh":0,"name":"plate"},{"mesh":0},{"mesh":1},
                        {"mesh":0,"name":"plate (2)"},{"mesh":0,"name":"plate"})json";
    const Loaded loaded(file.glb());
    const char *const expected[] = {"plate",         "plate (2)", "one", "node 3 / bars", "node 3 / primitive 1",
                                    "plate (2) (2)", "plate (3)"};
    assert_int_equal(loaded.report.surfaces, 7);
    assert_int_equal(loaded.report.skipped, 1);
    for (uint32_t i = 0; i < 7; ++i)
        assert_string_equal(loaded.info(i).name, expected[i]);
}

TEST(names_differ_from_those_in_the_scene) {
    Loaded loaded;
    File file = triangle();
    file.nodes = R"({"mesh":0,"name":"plate"})";
    loaded.assert_loads(file.glb());
    loaded.assert_loads(file.glb());
    assert_string_equal(loaded.info(0).name, "plate");
    assert_string_equal(loaded.info(1).name, "plate (2)");
}

TEST(double_sided_materials) {
    File file = triangle();
    assert_int_equal(Loaded(file.glb()).info().double_sided, 0);
    file.materials.insert(1, R"("doubleSided":true,)");
    assert_int_equal(Loaded(file.glb()).info().double_sided, 1);
    file.materials.replace(file.materials.find("true"), 4, "1");
    assert_fails(file.glb(), KNURL_ERROR_FORMAT, {"material 0: doubleSided: expected true or false, found 1"});
}

TEST(skins_and_morph_targets_are_refused_where_tagged) {
    File file = triangle();
    file.nodes = R"({"mesh":0,"name":"arm","skin":0})";
    assert_fails(file.glb(), KNURL_ERROR_UNSUPPORTED, {"node 'arm' (0), mesh 0, primitive 0: skin"});
    file.materials = "{}";
    assert_int_equal(Loaded(file.glb()).report.skipped, 1);
    file = plain({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0}, R"(,"targets":[{"POSITION":0}])");
    assert_fails(file.glb(), KNURL_ERROR_UNSUPPORTED, {"node 0, mesh 0, primitive 0: targets"});
    file.materials = "{}";
    assert_int_equal(Loaded(file.glb()).report.skipped, 1);
}

TEST(all_surfaces_or_none) {
    Loaded loaded(triangle().glb());
    const uint64_t bytes = knurl_scene_get_bytes(loaded.scene);
    File file = triangle();
    file.nodes = R"({"mesh":0},{"mesh":0},{"mesh":0,"scale":[0,1,1]})";
    assert_int_equal(loaded.load(file.glb()), KNURL_ERROR_FORMAT);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 1);
    assert_int_equal(knurl_scene_get_bytes(loaded.scene), bytes);
    assert_int_equal(loaded.report.surfaces, 1);
}

TEST(a_file_can_be_loaded_after_the_commit) {
    Loaded loaded(triangle().glb());
    assert_int_equal(knurl_scene_commit(loaded.scene), KNURL_OK);
    assert_int_equal(loaded.load(triangle().glb()), KNURL_OK);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 2);
}

} // namespace
