// SPDX-License-Identifier: MIT
#include "failure.hpp"

#include <locale>
#include <sstream>

namespace knurl::gltf {

void refuse(const std::string &where, const std::string &what, knurl_result code) {
    throw Failure(code, where.empty() ? what : where + ": " + what);
}

std::string shortened(std::string_view text, size_t limit) {
    if (text.size() <= limit)
        return std::string(text);
    // Do not cut inside a UTF-8 character: continuation bytes are 10xxxxxx.
    while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xC0U) == 0x80U)
        --limit;
    return std::string(text.substr(0, limit)) + "...";
}

std::string in_quotes(std::string_view text) {
    return "'" + shortened(text) + "'";
}

std::string shown(double number) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(3);
    text << number;
    return text.str();
}

std::string label(const char *kind, std::string_view name, size_t index) {
    const std::string number = std::to_string(index);
    if (name.empty())
        return std::string(kind) + " " + number;
    return std::string(kind) + " " + in_quotes(name) + " (" + number + ")";
}

} // namespace knurl::gltf
