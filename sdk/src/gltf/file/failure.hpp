// Knurl: errors of the glTF loader: exceptions inside, turned into knurl_fail() by the C functions in load.cpp.
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

/** Its text is one line: object, key, expected value, found value. load.cpp puts the file's name in front. */
class Failure : public std::runtime_error {
  public:
    Failure(knurl_result code, const std::string &text) : std::runtime_error(text), code_(code) {}
    knurl_result code() const {
        return code_;
    }

  private:
    knurl_result code_;
};

/** Throws a Failure with the text "PLACE: PROBLEM", or "PROBLEM" if the place is empty. */
[[noreturn]] void refuse(const std::string &where, const std::string &what, knurl_result code = KNURL_ERROR_FORMAT);

/** Cuts text from a file, so that it does not fill the whole message. */
std::string shortened(std::string_view text, size_t limit = 64);

/** The same in single quotes. */
std::string in_quotes(std::string_view text);

/** A number with a decimal point in every locale of the host: "1.5", "1e+09". */
std::string shown(double number);

/** "material 'bars' (0)", or "material 0" if it has no name. */
std::string label(const char *kind, std::string_view name, size_t index);

} // namespace knurl::gltf
#endif
