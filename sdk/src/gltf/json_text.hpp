// Knurl: JSON text to a tree, with limits that hostile files run into.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_JSON_TEXT_HPP
#define KNURL_GLTF_JSON_TEXT_HPP

#include "budget.hpp"
#include "json.hpp"

namespace knurl::gltf {

/** Objects and arrays inside each other; a plain glTF file has 7. */
constexpr size_t json_depth_max = 32;

/** Values in a file: a tree takes some 100 bytes for each, however short its text. */
constexpr size_t json_values_max = size_t{1} << 23U;

/** Parses without recursion. Refuses syntax errors, deeper nesting, more values, and a key that appears twice in one
 * object: parsers differ in which one they keep. */
Json parse_json(std::string_view text, Budget &budget);

} // namespace knurl::gltf
#endif
