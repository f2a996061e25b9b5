// SPDX-License-Identifier: MIT
#include "geometry.hpp"

#include <numeric>

namespace knurl::gltf {
namespace {

std::vector<float> read_attribute(const Model &model, const tinygltf::Primitive &primitive, const char *name,
                                  size_t components, size_t vertices, const std::string &where) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end())
        return {};
    const std::string place = where + ": " + name;
    // Exporters write NaN as the normal of a triangle without area: the scene counts bad normals.
    std::vector<float> values = read_floats(model, found->second, place, std::string_view(name) != "NORMAL");
    if (vertices != 0 && values.size() / components != vertices)
        refuse(place, "expected one element for each of " + std::to_string(vertices) + " positions, found " +
                          std::to_string(values.size() / components));
    return values;
}

/// Returns the number of triangles made by `count` vertices or indices.
size_t check_count(size_t count, int mode, const std::string &where) {
    constexpr const char *others[] = {"POINTS", "LINES", "LINE_LOOP", "LINE_STRIP"};
    if (mode < TINYGLTF_MODE_TRIANGLES)
        refuse(where, std::string("mode: expected triangles in a tagged primitive, found ") + others[mode]);
    if (count < 3 || (mode == TINYGLTF_MODE_TRIANGLES && count % 3 != 0))
        refuse(where, std::string("expected ") + (mode == TINYGLTF_MODE_TRIANGLES ? "a multiple of 3" : "at least 3") +
                          " vertices or indices, found " + std::to_string(count));
    const size_t triangles = mode == TINYGLTF_MODE_TRIANGLES ? count / 3 : count - 2;
    if (triangles > triangles_max)
        refuse(where,
               "expected at most " + std::to_string(triangles_max) + " triangles, found " + std::to_string(triangles));
    return triangles;
}

/// glTF 2.0, 3.7.2.1: every second triangle of a strip is reversed, so that all face the same side; a fan's triangles
/// start at its rim.
std::vector<uint32_t> triangles_of(const std::vector<uint32_t> &order, int mode) {
    std::vector<uint32_t> triangles;
    triangles.reserve((order.size() - 2) * 3);
    for (size_t i = 0; i + 2 < order.size(); ++i) {
        const size_t odd = i % 2;
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            triangles.insert(triangles.end(), {order[i], order[i + 1 + odd], order[i + 2 - odd]});
        else
            triangles.insert(triangles.end(), {order[i + 1], order[i + 2], order[0]});
    }
    return triangles;
}

void keep_used(std::vector<float> &values, size_t components, const std::vector<bool> &used) {
    size_t kept = 0;
    for (size_t i = 0; i * components < values.size(); ++i)
        for (size_t c = 0; used[i] && c < components; ++c)
            values[kept++] = values[i * components + c];
    values.resize(kept);
    values.shrink_to_fit();
}

/// Primitives often share one vertex array: keep only the vertices that this one uses.
void drop_unused_vertices(Geometry &geometry) {
    std::vector<bool> used(geometry.positions.size() / 3);
    for (const uint32_t i : geometry.indices)
        used[i] = true;
    std::vector<uint32_t> place(used.size());
    uint32_t count = 0;
    for (size_t i = 0; i < used.size(); ++i) {
        place[i] = count;
        count += used[i] ? 1 : 0;
    }
    if (count == used.size())
        return;
    for (uint32_t &i : geometry.indices)
        i = place[i];
    keep_used(geometry.positions, 3, used);
    keep_used(geometry.normals, 3, used);
    keep_used(geometry.tangents, 4, used);
    keep_used(geometry.uvs, 2, used);
}

} // namespace

GeometryCount count_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where) {
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES)
        check_count(0, primitive.mode, where);
    GeometryCount count;
    size_t corners = 0;
    for (const Attribute &read : attributes_read) {
        const auto found = primitive.attributes.find(read.name);
        if (found == primitive.attributes.end())
            continue;
        const size_t elements =
            count_elements(model, found->second, read.components, vertices_max, where + ": " + read.name);
        corners = corners == 0 ? elements : corners; // POSITION is first
        count.elements += elements;
    }
    if (primitive.indices >= 0)
        corners = count_elements(model, primitive.indices, 1, 3 * triangles_max, where + ": indices");
    count.triangles = check_count(corners, primitive.mode, where);
    return count;
}

Geometry read_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where) {
    Geometry geometry;
    geometry.positions = read_attribute(model, primitive, "POSITION", 3, 0, where);
    const size_t vertices = geometry.positions.size() / 3;
    geometry.normals = read_attribute(model, primitive, "NORMAL", 3, vertices, where);
    geometry.tangents = read_attribute(model, primitive, "TANGENT", 4, vertices, where);
    geometry.uvs = read_attribute(model, primitive, "TEXCOORD_0", 2, vertices, where);
    if (primitive.indices >= 0) {
        geometry.indices = read_indices(model, primitive.indices, vertices, where + ": indices");
    } else {
        geometry.indices.resize(vertices);
        std::iota(geometry.indices.begin(), geometry.indices.end(), 0U);
    }
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES)
        geometry.indices = triangles_of(geometry.indices, primitive.mode);
    drop_unused_vertices(geometry);
    return geometry;
}

} // namespace knurl::gltf
