// Knurl: accessors to plain arrays; every offset, stride and count checked against the bytes that are there.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_ACCESSOR_HPP
#define KNURL_GLTF_ACCESSOR_HPP

#include "model.hpp"

#include <cstdint>
#include <vector>

namespace knurl::gltf {

/** Elements of an accessor without a bufferView, which costs memory but no bytes in the file. */
constexpr size_t zeros_max = size_t{1} << 22U;

/** How many elements of `components` numbers an accessor has (1: they are indices), all of which are in its
 * buffer. Throws Failure. */
size_t count_elements(const Model &model, int accessor, size_t components, size_t most, const std::string &where);

/** Float elements of `components` numbers each, all finite; normalised integers are mapped as glTF says.
 * where: "mesh 'm' (0), primitive 1: POSITION". Throws Failure. */
std::vector<float> read_floats(const Model &model, int accessor, size_t components, const std::string &where);

/** Indices, each below vertex_count. */
std::vector<uint32_t> read_indices(const Model &model, int accessor, size_t vertex_count, const std::string &where);

} // namespace knurl::gltf
#endif
