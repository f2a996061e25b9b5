// Knurl: accessors to plain arrays; every offset, stride and count checked against the bytes that are there.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_ACCESSOR_HPP
#define KNURL_GLTF_ACCESSOR_HPP

#include "failure.hpp"
#include "tinygltf.hpp"

#include <cstdint>
#include <vector>

namespace knurl::gltf {

/** What knurl_mesh_desc takes. */
constexpr size_t vertices_max = size_t{1} << 28U;
constexpr size_t triangles_max = size_t{1} << 26U;

/** Elements of an accessor without a bufferView, which costs memory but no bytes in the file. */
constexpr size_t zeros_max = size_t{1} << 22U;

/** Float elements of `components` numbers each, all finite; normalised integers are mapped as glTF says.
 * where: "mesh 'm' (0), primitive 1: POSITION". Throws Failure. */
std::vector<float> read_floats(const tinygltf::Model &model, int accessor, size_t components, const std::string &where);

/** Indices, each below vertex_count. */
std::vector<uint32_t> read_indices(const tinygltf::Model &model, int accessor, size_t vertex_count,
                                   const std::string &where);

} // namespace knurl::gltf
#endif
