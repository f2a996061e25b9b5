// Knurl: reads accessors into plain arrays; checks every offset, stride and count against the buffer's size.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_ACCESSOR_HPP
#define KNURL_GLTF_ACCESSOR_HPP

#include "filter.hpp"

#include <cstdint>
#include <vector>

namespace knurl::gltf {

/** Most elements of an accessor without a bufferView: it takes memory but no bytes in the file. */
constexpr size_t zeros_max = size_t{1} << 22U;

/** The number of an accessor's elements, after checking that each has `components` numbers (1: indices) and lies inside
 * the buffer. Throws Failure. */
size_t count_elements(const Model &model, int accessor, size_t components, size_t most, const std::string &where);

/** Reads a counted accessor's floats, of which each must be finite if `only_finite`; normalised integers are mapped as
 * in glTF 2.0, 3.6.2.2. `where` starts error messages: "mesh 'm' (0), primitive 1: POSITION". Throws Failure. */
std::vector<float> read_floats(const Model &model, int accessor, const std::string &where, bool only_finite);

/** Reads a counted accessor's indices; throws Failure if one is not below vertex_count. */
std::vector<uint32_t> read_indices(const Model &model, int accessor, size_t vertex_count, const std::string &where);

} // namespace knurl::gltf
#endif
