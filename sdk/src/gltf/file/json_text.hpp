// Knurl: parses JSON text into a tree, with limits against hostile files.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_JSON_TEXT_HPP
#define KNURL_GLTF_JSON_TEXT_HPP

#include "budget.hpp"
#include "json.hpp"

namespace knurl::gltf {

/** The deepest nesting of objects and arrays; a plain glTF file has 7. */
constexpr size_t json_depth_max = 32;

/** The most values in a file: a tree takes some 100 bytes for each, however short its text. */
constexpr size_t json_values_max = size_t{1} << 23U;

/** Parses without recursion. Throws Failure for a syntax error, deeper nesting, more values, or a key that appears
 * twice in one object: parsers differ in which one they keep. */
Json parse_json(std::string_view text, Budget &budget);

} // namespace knurl::gltf
#endif
