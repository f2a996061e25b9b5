// Knurl: errors of the glTF loader: exceptions inside, knurl_fail() at its C functions (load.cpp).
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FAILURE_HPP
#define KNURL_GLTF_FAILURE_HPP

#include "base/finite.h"

#include <knurl/base.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace knurl::gltf {

/** One line that names object, key, what was expected and what was found; the file's name is put before it. */
class Failure : public std::runtime_error {
  public:
    Failure(knurl_result code, const std::string &text) : std::runtime_error(text), code_(code) {}
    knurl_result code() const {
        return code_;
    }

  private:
    knurl_result code_;
};

/** Throws "where: what". */
[[noreturn]] void refuse(const std::string &where, const std::string &what, knurl_result code = KNURL_ERROR_FORMAT);

/** Text from a file, short enough to leave room for the rest of a message. */
std::string shortened(std::string_view text, size_t limit = 64);

/** The same in single quotes. */
std::string in_quotes(std::string_view text);

/** "material 'bars' (0)", or "material 0" where it has no name. */
std::string label(const char *kind, std::string_view name, size_t index);

} // namespace knurl::gltf
#endif
