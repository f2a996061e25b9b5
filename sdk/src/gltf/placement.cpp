// SPDX-License-Identifier: MIT
#include "placement.hpp"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <utility>

namespace knurl::gltf {
namespace {

// Exporters write float32; what is further from a unit quaternion or from affine than this is a mistake.
constexpr double unit_tolerance = 1e-2;
constexpr double affine_tolerance = 1e-6;

// A volume this small beside its sides' product is lost in float32 positions.
constexpr double flat_tolerance = 1e-9;

std::string node_label(const tinygltf::Model &model, uint32_t node) {
    return label("node", model.nodes.at(node).name, node);
}

glm::dmat4 local_matrix(const tinygltf::Model &model, uint32_t index) {
    const tinygltf::Node &node = model.nodes.at(index);
    if (!node.matrix.empty()) {
        const glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
        for (int column = 0; column < 4; ++column)
            if (std::fabs(matrix[column][3] - (column == 3 ? 1.0 : 0.0)) > affine_tolerance)
                refuse(node_label(model, index), "matrix: expected 0, 0, 0, 1 as its last row");
        return matrix;
    }
    glm::dmat4 matrix(1.0);
    if (!node.rotation.empty()) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(rotation);
        if (!(std::fabs(length - 1.0) <= unit_tolerance))
            refuse(node_label(model, index),
                   "rotation: expected a quaternion of length 1, found length " + std::to_string(length));
        matrix = glm::mat4_cast(glm::normalize(rotation));
    }
    if (!node.scale.empty())
        for (int column = 0; column < 3; ++column)
            matrix[column] *= node.scale[static_cast<size_t>(column)];
    if (!node.translation.empty())
        matrix[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    return matrix;
}

bool is_finite(const glm::dvec3 &v) {
    return knurl_is_finite(v.x) && knurl_is_finite(v.y) && knurl_is_finite(v.z);
}

glm::dvec3 at(const std::vector<float> &values, size_t i) {
    return {values[i], values[i + 1], values[i + 2]};
}

void put(std::vector<float> &values, size_t i, const glm::dvec3 &v) {
    for (int c = 0; c < 3; ++c)
        values[i + static_cast<size_t>(c)] = static_cast<float>(v[c]);
}

} // namespace

const glm::dmat4 &Placement::world(uint32_t node) {
    // Up to an ancestor that is known, then down again.
    std::vector<uint32_t> chain;
    glm::dmat4 matrix(1.0);
    for (int64_t i = node; i >= 0; i = parents_[static_cast<size_t>(i)]) {
        const auto known = worlds_.find(static_cast<uint32_t>(i));
        if (known != worlds_.end()) {
            matrix = known->second;
            break;
        }
        chain.push_back(static_cast<uint32_t>(i));
    }
    for (size_t i = chain.size(); i > 0; --i) {
        matrix = matrix * local_matrix(model_, chain[i - 1]);
        worlds_.emplace(chain[i - 1], matrix);
    }
    return worlds_.at(node);
}

Frame Placement::frame(uint32_t node) {
    const glm::dmat4 &matrix = world(node);
    const glm::dmat3 linear(matrix);
    Frame frame{glm::dvec3(matrix[3]), glm::dquat(1.0, 0.0, 0.0, 0.0), linear, glm::determinant(linear) < 0.0};
    const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const bool finite = is_finite(frame.position) && knurl_is_finite(volume);
    if (!finite || !(std::fabs(glm::determinant(linear)) > flat_tolerance * volume))
        refuse(node_label(model_, node),
               finite ? "its transform flattens the mesh: expected a scale without 0" : "its transform is not finite");
    // Gram-Schmidt. The third axis is the cross product, so that mirroring stays in `bake`.
    glm::dmat3 axes;
    axes[0] = glm::normalize(linear[0]);
    axes[1] = glm::normalize(linear[1] - axes[0] * glm::dot(axes[0], linear[1]));
    axes[2] = glm::cross(axes[0], axes[1]);
    frame.rotation = glm::normalize(glm::quat_cast(axes));
    frame.bake = glm::transpose(axes) * linear;
    return frame;
}

void bake(Geometry &geometry, const Frame &frame, const std::string &where) {
    for (size_t i = 0; i + 2 < geometry.positions.size(); i += 3) {
        put(geometry.positions, i, frame.bake * at(geometry.positions, i));
        if (!is_finite(at(geometry.positions, i)))
            refuse(where, "its transform moves vertex " + std::to_string(i / 3) + " beyond float32's range");
    }
    for (size_t i = 0; i + 3 < geometry.tangents.size(); i += 4) {
        // A direction: its length says nothing, but must not overflow or vanish on the way.
        const glm::dvec3 tangent = frame.bake * at(geometry.tangents, i);
        const double length = glm::length(tangent);
        put(geometry.tangents, i, length > 0.0 ? tangent / length : tangent);
    }
    if (frame.mirrored)
        for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3)
            std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
}

} // namespace knurl::gltf
