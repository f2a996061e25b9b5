// Primitives and accessors, right and wrong. Expected values by hand from glTF 2.0, 3.6.2 and 3.7.2.
// SPDX-License-Identifier: MIT
#include "gltf/builder.hpp"

#include <limits>

using namespace builder;

namespace {

const char *const mode_strip = R"(,"mode":5)";
const char *const mode_fan = R"(,"mode":6)";

/// `plain` with indices of a component type.
template <typename T>
File indexed(Type type, const std::vector<float> &positions, const std::vector<T> &indices,
             const std::string &more = "") {
    File file;
    const int vertices = file.vec3(positions);
    const int order = file.add<T>(type, "SCALAR", 1, indices);
    return plain(std::move(file), vertices, R"(,"indices":)" + std::to_string(order) + more);
}

void assert_bounds(const File &file, std::initializer_list<double> low, std::initializer_list<double> high) {
    const knurl_surface_info info = Loaded(file.glb()).info();
    assert_near(info.bounds_min, low);
    assert_near(info.bounds_max, high);
}

void assert_file_fails(const File &file, std::initializer_list<const char *> parts,
                       knurl_result code = KNURL_ERROR_FORMAT) {
    assert_fails(file.glb(), code, parts);
}

const std::vector<float> &square() {
    static const std::vector<float> corners = {0, 0, 0, 0.1F, 0, 0, 0.1F, 0.1F, 0, 0, 0.1F, 0};
    return corners;
}

TEST(indices_of_each_width_and_none) {
    const auto check = [](const File &file) {
        const knurl_surface_info info = Loaded(file.glb()).info();
        assert_int_equal(info.triangle_count, 2);
        assert_near(info.bounds_max, {0.1, 0.1, 0});
        assert_near(info.anchor_normal, {0, 0, 1});
    };
    check(indexed<uint8_t>(UBYTE, square(), {0, 1, 2, 0, 2, 3}));
    check(indexed<uint16_t>(USHORT, square(), {0, 1, 2, 0, 2, 3}));
    check(indexed<uint32_t>(UINT, square(), {0, 1, 2, 0, 2, 3}));
    check(plain({0, 0, 0, 0.1F, 0, 0, 0.1F, 0.1F, 0, 0, 0, 0, 0.1F, 0.1F, 0, 0, 0.1F, 0}));
}

TEST(strips_turn_each_second_triangle) {
    File file = plain({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0, 0.1F, 0.1F, 0, 0, 0.2F, 0}, mode_strip);
    knurl_surface_info info = Loaded(file.glb()).info();
    assert_int_equal(info.triangle_count, 3);
    assert_near(info.bounds_max, {0.1, 0.2, 0});
    // With the first without area, the second alone is left: vertices 1, 3, 2, which face +z.
    info = Loaded(plain({0, 0, 0, 0, 0, 0, 0, 0.1F, 0, 0.1F, 0, 0}, mode_strip).glb()).info();
    assert_int_equal(info.triangle_count, 1);
    assert_int_equal(info.dropped_triangles, 1);
    assert_near(info.anchor_normal, {0, 0, 1});
    // And the first alone: 0, 1, 2.
    info = Loaded(plain({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0, 0, 0.1F, 0}, mode_strip).glb()).info();
    assert_int_equal(info.triangle_count, 1);
    assert_near(info.anchor_normal, {0, 0, 1});
    file = indexed<uint8_t>(UBYTE, square(), {0, 1, 3, 2}, mode_strip);
    assert_int_equal(Loaded(file.glb()).info().triangle_count, 2);
}

TEST(fans_start_at_their_first_vertex) {
    knurl_surface_info info = Loaded(plain(square(), mode_fan).glb()).info();
    assert_int_equal(info.triangle_count, 2);
    assert_near(info.anchor_normal, {0, 0, 1});
    // The second alone: vertices 2, 3, 0.
    info = Loaded(plain({0, 0, 0, 0.1F, 0.1F, 0, 0.1F, 0.1F, 0, 0, 0.1F, 0}, mode_fan).glb()).info();
    assert_int_equal(info.triangle_count, 1);
    assert_near(info.anchor_normal, {0, 0, 1});
}

TEST(mirrored_strips_face_out_too) {
    File file = plain({0, 0, 0, 0, 0, 0, 0, 0.1F, 0, 0.1F, 0, 0}, mode_strip);
    file.nodes = R"({"mesh":0,"scale":[-1,1,1]})";
    assert_near(Loaded(file.glb()).info().anchor_normal, {0, 0, 1});
}

TEST(other_modes_and_odd_counts_are_refused) {
    assert_file_fails(plain(square(), R"(,"mode":0)"), {"node 0, mesh 0, primitive 0: mode", "found POINTS"});
    assert_file_fails(plain(square(), R"(,"mode":3)"), {"mode: expected triangles", "found LINE_STRIP"});
    assert_file_fails(plain(square(), R"(,"mode":7)"),
                      {"mesh 0: primitives[0].mode: expected a whole number from 0 to 6"});
    assert_file_fails(plain(square()), {"primitive 0: expected a multiple of 3 vertices or indices, found 4"});
    assert_file_fails(plain({0, 0, 0, 1, 0, 0}, mode_strip), {"expected at least 3", "found 2"});
    assert_file_fails(indexed<uint8_t>(UBYTE, square(), {0, 1, 2, 0}), {"expected a multiple of 3", "found 4"});
}

TEST(surfaces_without_area_name_the_object) {
    assert_file_fails(plain({0, 0, 0, 1, 0, 0, 2, 0, 0}), {"node 0, mesh 0, primitive 0: ", "area"},
                      KNURL_ERROR_ARGUMENT);
}

TEST(integer_positions_are_quantised_ones) {
    const auto quantised = [](auto kind, Type type, const std::vector<decltype(kind)> &values, const char *extra) {
        File file;
        file.more = R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
        const int positions = file.add<decltype(kind)>(type, "VEC3", 3, values, extra);
        return plain(std::move(file), positions);
    };
    const char *normalized = R"(,"normalized":true)";
    assert_bounds(quantised(int16_t{}, SHORT, {0, 0, 0, 5, 0, 0, 0, -7, 0}, ""), {0, -7, 0}, {5, 0, 0});
    assert_bounds(quantised(int16_t{}, SHORT, {-32768, 0, 0, 32767, 0, 0, 0, -32767, 0}, normalized), {-1, -1, 0},
                  {1, 0, 0});
    assert_bounds(quantised(uint16_t{}, USHORT, {0, 0, 0, 65535, 0, 0, 0, 13107, 0}, normalized), {0, 0, 0},
                  {1, 0.2, 0});
    assert_bounds(quantised(int8_t{}, BYTE, {-128, 0, 0, 127, 0, 0, 0, -127, 0}, normalized), {-1, -1, 0}, {1, 0, 0});
    assert_bounds(quantised(uint8_t{}, UBYTE, {0, 0, 0, 255, 0, 0, 0, 51, 0}, normalized), {0, 0, 0}, {1, 0.2, 0});
    assert_bounds(quantised(uint8_t{}, UBYTE, {0, 0, 0, 255, 0, 0, 0, 51, 0}, ""), {0, 0, 0}, {255, 51, 0});
}

TEST(normalised_uvs_give_the_direction) {
    const auto with_uvs = [](auto kind, Type type, const std::vector<decltype(kind)> &values) {
        File file;
        file.vec3({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0});
        file.add<decltype(kind)>(type, "VEC2", 2, values, R"(,"normalized":true)");
        file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]})";
        return Loaded(file.glb()).info();
    };
    // u rises along y; were the largest number read as a signed one, it would fall.
    assert_near(with_uvs(uint16_t{}, USHORT, {0, 0, 0, 65535, 65535, 0}).anchor_x, {0, 1, 0});
    assert_near(with_uvs(uint8_t{}, UBYTE, {0, 0, 0, 255, 255, 0}).anchor_x, {0, 1, 0});
    assert_near(with_uvs(int8_t{}, BYTE, {0, 0, 0, 127, -127, 0}).anchor_x, {0, -1, 0});
}

TEST(interleaved_attributes) {
    File file;
    // x, y, z, u, v a vertex: 20 bytes apart.
    const int view = file.view<float>({0, 0, 0, 0, 0, 0.1F, 0, 0, 0, 1, 0, 0.1F, 0, 1, 0}, R"(,"byteStride":20)");
    file.accessor(R"("bufferView":)" + std::to_string(view) + "," + File::element(FLOAT, "VEC3", 3));
    file.accessor(R"("bufferView":)" + std::to_string(view) + R"(,"byteOffset":12,)" + File::element(FLOAT, "VEC2", 3));
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]})";
    const knurl_surface_info info = Loaded(file.glb()).info();
    assert_near(info.bounds_max, {0.1, 0.1, 0});
    assert_near(info.anchor_x, {0, 1, 0});
}

TEST(sparse_elements_replace_dense_ones) {
    File file;
    const int dense = file.view<float>({0, 0, 0, 0.1F, 0, 0, 0, 9, 0});
    const int indices = file.view<uint16_t>({2});
    const int values = file.view<float>({0, 0.3F, 0});
    const std::string sparse = R"(,"sparse":{"count":1,"indices":{"bufferView":)" + std::to_string(indices) +
                               R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}";
    file.accessor(R"("bufferView":)" + std::to_string(dense) + "," + File::element(FLOAT, "VEC3", 3) + sparse);
    assert_bounds(plain(file, 0), {0, 0, 0}, {0.1, 0.3, 0});
}

TEST(sparse_elements_over_zeros) {
    File file;
    const int indices = file.view<uint8_t>({1, 2});
    const int values = file.view<float>({0.1F, 0, 0, 0, 0.2F, 0});
    file.accessor(File::element(FLOAT, "VEC3", 3) + R"(,"sparse":{"count":2,"indices":{"bufferView":)" +
                  std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" +
                  std::to_string(values) + "}}");
    assert_bounds(plain(file, 0), {0, 0, 0}, {0.1, 0.2, 0});
}

TEST(bad_sparse_elements_are_refused) {
    const auto with = [](uint8_t index, const std::string &count, const char *type) {
        File file;
        file.view<uint8_t>({1, index});
        file.view<float>({0.1F, 0, 0, 0, 0.2F, 0});
        file.accessor(File::element(FLOAT, "VEC3", 3) + R"(,"sparse":{"count":)" + count +
                      R"(,"indices":{"bufferView":0,"componentType":)" + type + R"(},"values":{"bufferView":1}})");
        return plain(std::move(file), 0);
    };
    assert_int_equal(Loaded(with(2, "2", "5121").glb()).report.surfaces, 1);
    assert_file_fails(with(3, "2", "5121"), {"POSITION (accessor 0): sparse: index 1: expected below 3, found 3"});
    assert_file_fails(with(2, "4", "5121"), {"POSITION (accessor 0): sparse: count: expected at most 3, found 4"});
    assert_file_fails(with(2, "3", "5121"), {"sparse.indices: expected 3 elements", "of 2 bytes"});
    assert_file_fails(with(2, "2", "5126"), {"sparse.indices: componentType", "found 5126"});
    assert_file_fails(with(2, "-1", "5121"), {"accessor 0: sparse.count: expected a whole number", "found -1"});
    File file;
    file.accessor(File::element(FLOAT, "VEC3", 3) + R"(,"sparse":{"count":1,"indices":{"componentType":5121}})");
    assert_file_fails(plain(file, 0), {"accessor 0: sparse.indices.bufferView: missing"});
    file = File();
    file.view<uint8_t>({1});
    file.accessor(File::element(FLOAT, "VEC3", 3) +
                  R"(,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5121}})");
    assert_file_fails(plain(file, 0), {"accessor 0: sparse.values: missing"});
}

TEST(positions_that_are_not_finite_name_mesh_and_attribute) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    assert_file_fails(plain({0, 0, 0, 0.1F, 0, 0, 0, nan, 0}),
                      {"mesh 0, primitive 0: POSITION (accessor 0): element 2: expected finite numbers, found NaN"});
    assert_file_fails(plain({0, 0, 0, 0.1F, 0, -infinity, 0, 1, 0}),
                      {"POSITION (accessor 0): element 1", "found infinity"});
    File file = quad();
    file.bin.replace(48, 4, reinterpret_cast<const char *>(&nan), 4); // the first u
    assert_file_fails(file, {"mesh 0, primitive 0: TEXCOORD_0 (accessor 1): element 0", "found NaN"});
}

TEST(attributes_of_wrong_shape_are_refused) {
    File file;
    file.vec3({0, 0, 0, 0.1F, 0, 0, 0, 0.1F, 0});
    file.vec2({0, 0, 1, 0});
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]})";
    assert_file_fails(file, {"TEXCOORD_0: expected one element for each of 3 positions, found 2"});
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":1}}]})";
    assert_file_fails(file, {"POSITION (accessor 1): type: expected VEC3"});
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0},"indices":0}]})";
    assert_file_fails(file,
                      {"indices (accessor 0): componentType: expected 5121, 5123 or 5125 (unsigned), found 5126"});
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"TEXCOORD_0":1}}]})";
    assert_file_fails(file, {"mesh 0: primitives[0].attributes.POSITION: missing"});
    file.meshes = R"({"primitives":[{"material":0}]})";
    assert_file_fails(file, {"mesh 0: primitives[0].attributes.POSITION: missing"});
    file.meshes = R"({)" + tag() + R"(,"name":"empty"})";
    assert_file_fails(file, {"mesh 'empty' (0): primitives: missing"});
    file = File();
    file.add<uint32_t>(UINT, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    assert_file_fails(plain(file, 0), {"POSITION (accessor 0): componentType", "found 5125"});
}

TEST(indices_beyond_the_vertices_are_refused) {
    assert_file_fails(indexed<uint16_t>(USHORT, square(), {0, 1, 4}),
                      {"primitive 0: indices (accessor 1): index 2: expected below 4 (the vertices), found 4"});
    assert_file_fails(indexed<uint32_t>(UINT, square(), {0, 1, 0xFFFFFFFFU}), {"index 2", "found 4294967295"});
    File file;
    file.vec3(square());
    file.accessor(File::element(USHORT, "SCALAR", 3));
    file = plain(std::move(file), 0, R"(,"indices":1)");
    assert_file_fails(file, {"accessor 1: bufferView: missing: expected one for indices"});
}

TEST(shared_vertices_cost_each_surface_its_own) {
    File file;
    std::vector<float> many(3000, 0.5F);
    std::copy(square().begin(), square().end(), many.begin() + 1500);
    file.vec3(many);
    file.add<uint16_t>(USHORT, "SCALAR", 1, {500, 501, 502, 500, 502, 503});
    const Loaded shared(plain(std::move(file), 0, R"(,"indices":1)").glb());
    const Loaded alone(indexed<uint16_t>(USHORT, square(), {0, 1, 2, 0, 2, 3}).glb());
    assert_near(shared.info().bounds_max, {0.1, 0.1, 0});
    assert_int_equal(shared.info().bytes, alone.info().bytes);
}

} // namespace
