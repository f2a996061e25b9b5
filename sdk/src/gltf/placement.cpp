// SPDX-License-Identifier: MIT
#include "placement.hpp"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cmath>
#include <utility>

namespace knurl::gltf {
namespace {

// Exporters write float32. A quaternion further from unit length, or a matrix further from affine, is a mistake.
constexpr double unit_tolerance = 1e-2;
constexpr double affine_tolerance = 1e-6;

// If the volume is smaller than this times the product of the sides, float32 positions cannot represent it.
constexpr double flat_tolerance = 1e-9;

// The least length of an axis of a node's transform.
constexpr double shortest_axis = 1e-100;

const tinygltf::Node &node_at(const Model &model, uint32_t number) {
    return model.nodes.at(static_cast<int>(number));
}

std::string node_label(const Model &model, uint32_t number) {
    return label("node", node_at(model, number).name, number);
}

glm::dmat4 local_matrix(const Model &model, uint32_t index) {
    const tinygltf::Node &node = node_at(model, index);
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
                   "rotation: expected a quaternion of length 1, found length " + shown(length));
        matrix = glm::mat4_cast(glm::normalize(rotation));
    }
    if (!node.scale.empty())
        for (int column = 0; column < 3; ++column)
            matrix[column] *= node.scale[static_cast<size_t>(column)];
    if (!node.translation.empty())
        matrix[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    return matrix;
}

bool is_in_range(double coordinate) {
    return std::fabs(coordinate) <= KNURL_COORDINATE_MAX;
}

void put(std::vector<float> &values, size_t i, const glm::dvec3 &v) {
    for (int c = 0; c < 3; ++c)
        values[i + static_cast<size_t>(c)] = static_cast<float>(v[c]);
}

} // namespace

const glm::dmat4 &Placement::world(uint32_t node) {
    // Up to the nearest ancestor with a known transform, then down again.
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
    for (int axis = 0; axis < 3; ++axis)
        if (!is_in_range(frame.position[axis]))
            refuse(node_label(model_, node), "its transform puts it at " + shown(frame.position[axis]) +
                                                 " m: expected within " + shown(KNURL_COORDINATE_MAX) + " m");
    const double least = std::fmin(glm::length(linear[0]), std::fmin(glm::length(linear[1]), glm::length(linear[2])));
    const bool finite = knurl_is_finite(volume);
    // Shorter axes underflow below, where they are normalised.
    if (!finite || !(least > shortest_axis && std::fabs(glm::determinant(linear)) > flat_tolerance * volume))
        refuse(node_label(model_, node),
               finite ? "its transform flattens the mesh: expected a scale without 0" : "its transform is not finite");
    // Gram-Schmidt. The third axis is a cross product, so that the rotation is proper and mirroring stays in `bake`.
    glm::dmat3 axes;
    axes[0] = glm::normalize(linear[0]);
    axes[1] = glm::normalize(linear[1] - axes[0] * glm::dot(axes[0], linear[1]));
    axes[2] = glm::cross(axes[0], axes[1]);
    frame.rotation = glm::normalize(glm::quat_cast(axes));
    frame.bake = glm::transpose(axes) * linear;
    return frame;
}

std::array<double, 9> bake_key(const Frame &frame) {
    std::array<double, 9> key{};
    double largest = 0.0;
    for (int i = 0; i < 9; ++i)
        largest = std::fmax(largest, std::fabs(frame.bake[i / 3][i % 3]));
    // Round to 2^-40 of the largest element: rotations are off by some 2^-50, float32 keeps 2^-24.
    const double unit = std::ldexp(1.0, std::ilogb(largest) - 40);
    for (int i = 0; i < 9; ++i)
        key[static_cast<size_t>(i)] = std::nearbyint(frame.bake[i / 3][i % 3] / unit) * unit + 0.0;
    return key;
}

void bake(Geometry &geometry, const Frame &frame, const std::string &where, int accessor) {
    for (size_t i = 0; i + 2 < geometry.positions.size(); i += 3) {
        const glm::dvec3 p = frame.bake * glm::dvec3(glm::make_vec3(&geometry.positions[i]));
        for (int axis = 0; axis < 3; ++axis)
            if (!is_in_range(p[axis]))
                refuse(where, "POSITION (accessor " + std::to_string(accessor) + "): its used vertex " +
                                  std::to_string(i / 3) + ": expected within " + shown(KNURL_COORDINATE_MAX) +
                                  " m with the node's transform, found " + shown(p[axis]) + " m");
        put(geometry.positions, i, p);
    }
    for (size_t i = 0; i + 3 < geometry.tangents.size(); i += 4) {
        // Only the direction matters; normalise it, so that float32 neither overflows nor underflows.
        const glm::dvec3 tangent = frame.bake * glm::dvec3(glm::make_vec3(&geometry.tangents[i]));
        const double length = glm::length(tangent);
        put(geometry.tangents, i, length > 0.0 ? tangent / length : tangent);
    }
    // Planes turn by the inverse's transpose; their sides stay. A length that is off stays off, for the scene to judge.
    const glm::dmat3 turn = glm::inverseTranspose(frame.bake);
    for (size_t i = 0; i + 2 < geometry.normals.size(); i += 3) {
        const glm::dvec3 given(glm::make_vec3(&geometry.normals[i]));
        const glm::dvec3 turned = turn * given;
        const double length = glm::length(turned);
        put(geometry.normals, i, length > 0.0 ? turned * (glm::length(given) / length) : given);
    }
    if (frame.mirrored)
        for (size_t i = 0; i + 2 < geometry.indices.size(); i += 3)
            std::swap(geometry.indices[i + 1], geometry.indices[i + 2]);
}

} // namespace knurl::gltf
