// NORMAL: felt as the smooth surface with any node transform, unless a tag disables it.
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

#include <cmath>
#include <limits>

using namespace builder;

namespace {

/// A quarter of a cylinder of 40 mm round z, seen from outside, of 16 triangles; with other normals at its first
/// vertex.
File arch(const std::string &more = "", std::initializer_list<float> first = {}) {
    std::vector<float> positions, normals;
    std::vector<uint16_t> indices;
    for (int i = 0; i <= 8; ++i)
        for (int k = 0; k < 2; ++k) {
            const double a = 0.2 * (i - 4);
            for (const double x : {0.04 * std::cos(a), 0.04 * std::sin(a), 0.04 * k - 0.02})
                positions.push_back(static_cast<float>(x));
            for (const double x : {std::cos(a), std::sin(a), 0.0})
                normals.push_back(static_cast<float>(x));
        }
    std::copy(first.begin(), first.end(), normals.begin());
    for (uint16_t i = 0; i < 16; i = static_cast<uint16_t>(i + 2))
        for (const int corner : {0, 2, 3, 0, 3, 1})
            indices.push_back(static_cast<uint16_t>(i + corner));
    File file;
    const int position = file.vec3(positions), normal = file.vec3(normals), order = file.shorts(indices);
    file.materials = "{" + tag("\"axis\":[0,0,1]" + more) + "}";
    file.meshes = R"({"primitives":[{"material":0,"indices":)" + std::to_string(order) +
                  R"(,"attributes":{"POSITION":)" + std::to_string(position) + R"(,"NORMAL":)" +
                  std::to_string(normal) + "}}]}";
    return file;
}

uint32_t curved(const File &file, uint32_t surface = 0) {
    return Loaded(file.glb()).info(surface).curved_triangles;
}

TEST(normals_are_felt_unless_a_tag_says_not_to) {
    assert_int_equal(curved(arch()), 16);
    assert_int_equal(curved(arch(R"(,"smooth":true)")), 16);
    assert_int_equal(curved(arch(R"(,"smooth":false)")), 0);
    assert_int_equal(curved(arch(R"(,"smooth":1)")), 16);
    assert_int_equal(curved(arch(R"(,"smooth":0)")), 0);
    for (const char *bad : {"2", "\"no\"", "null", "[]", "0.5"})
        assert_fails(arch(std::string(R"(,"smooth":)") + bad).glb(), KNURL_ERROR_FORMAT,
                     {"knurl.smooth", "expected true or false"});
}

/// glTF 2.0, 3.7.2.1: "When normals are not specified, client implementations MUST calculate flat normals".
TEST(without_normals_it_is_flat_as_it_looks_unless_a_tag_says_smooth) {
    const auto plain = [](const char *more) {
        File file = arch(more);
        file.meshes.replace(file.meshes.find("NORMAL"), 6, "_PLAIN");
        return curved(file);
    };
    assert_int_equal(plain(""), 0);
    assert_int_equal(plain(R"(,"smooth":false)"), 0);
    assert_int_equal(plain(R"(,"smooth":true)"), 16);
}

TEST(a_node_overrides_smoothness_of_a_shared_mesh) {
    File file = arch();
    file.nodes = R"({"mesh":0},{"mesh":0,"extras":{"knurl_smooth":false}},{"mesh":0,"translation":[1,0,0]})";
    assert_int_equal(curved(file, 0), 16);
    assert_int_equal(curved(file, 1), 0);
    assert_int_equal(curved(file, 2), 16);
}

TEST(bad_normals_are_reported_not_refused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto &first : {std::initializer_list<float>{nan, nan, nan}, {0.0F, 0.0F, 0.0F}, {5.0F, 0.0F, 0.0F}}) {
        const knurl_surface_info info = Loaded(arch("", first).glb()).info();
        assert_int_equal(info.bad_normals, 2); // the vertex is in two triangles
        assert_int_equal(info.curved_triangles, 14);
    }
}

/// Pressed by `depth` at an angle round z, on the ellipse that the transform makes of the cylinder.
void check_pressed(const std::string &transform, double x_scale, double y_scale, double side) {
    File file = arch();
    file.nodes = R"({"mesh":0,)" + transform + "}";
    const Loaded loaded(file.glb());
    assert_int_equal(loaded.info().bad_normals, 0);
    assert_int_equal(loaded.info().curved_triangles, 16);
    knurl_hip_desc desc;
    knurl_workspace workspace;
    knurl_workspace_set_identity(&workspace);
    knurl_hip_desc_init(&desc, sizeof desc);
    desc.workspace = &workspace;
    desc.protections = 0;
    assert_int_equal(knurl_scene_configure_hip(loaded.scene, 0, &desc), KNURL_OK);
    assert_int_equal(knurl_scene_commit(loaded.scene), KNURL_OK);
    for (double a = -0.6; a < 0.6; a += 0.07) {
        const double x = side * x_scale * 0.04 * std::cos(a), y = y_scale * 0.04 * std::sin(a);
        double nx = side * std::cos(a) / x_scale, ny = std::sin(a) / y_scale;
        const double length = std::hypot(nx, ny);
        nx /= length;
        ny /= length;
        knurl_tick_output out = {};
        for (const double depth : {-0.005, 0.0005}) {
            const knurl_tick_input input = {{x - depth * nx, y - depth * ny, 0.003}, {0, 0, 0}, 1, 0, 0, 0, {}};
            assert_int_equal(knurl_scene_tick(loaded.scene, 0, &input, &out), KNURL_OK);
        }
        assert_true(std::fabs(out.depth - 0.0005) < 2e-5);
        assert_true(out.normal[0] * nx + out.normal[1] * ny > std::cos(0.02)); // a degree
    }
}

TEST(normals_turn_as_planes) {
    check_pressed(R"("scale":[1,1,1])", 1.0, 1.0, 1.0);
    check_pressed(R"("scale":[2,2,2])", 2.0, 2.0, 1.0);
    check_pressed(R"("scale":[1.5,1,0.7])", 1.5, 1.0, 1.0);
    check_pressed(R"("scale":[-1,1,1])", 1.0, 1.0, -1.0);
    check_pressed(R"("scale":[-1.5,1,1])", 1.5, 1.0, -1.0);
    check_pressed(R"("rotation":[0,0,1,0])", 1.0, 1.0, -1.0);
}

} // namespace
