// SPDX-License-Identifier: MIT
#include "uri.hpp"
#include "failure.hpp"

#include <charconv>
#include <cstdint>

namespace knurl::gltf {
namespace {

/// -1: not a digit.
int base64_value(char c) {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

std::vector<unsigned char> base64_decoded(std::string_view text) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        throw Failure(KNURL_ERROR_FORMAT, "the base64 text is cut short");
    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    unsigned held = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0)
            throw Failure(KNURL_ERROR_FORMAT, "expected base64 digits, found " + in_quotes(std::string(1, c)));
        bits = (bits << 6U) | static_cast<uint32_t>(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(static_cast<unsigned char>((bits >> held) & 0xFFU));
        }
    }
    return bytes;
}

} // namespace

std::string percent_decoded(std::string_view uri) {
    std::string text;
    text.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char *digits = uri.data() + i + 1;
        if (uri[i] == '%' && uri.size() - i > 2 && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            text.push_back(static_cast<char>(byte));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

std::string scheme_of(std::string_view uri) {
    std::string scheme;
    for (const char c : uri) {
        const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        const bool is_letter = lower >= 'a' && lower <= 'z';
        if (c == ':')
            return scheme;
        if (!is_letter && (scheme.empty() || !((c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.')))
            return "";
        scheme.push_back(lower);
    }
    return "";
}

std::vector<unsigned char> data_uri_bytes(std::string_view uri) {
    const size_t comma = uri.find(',');
    const std::string_view mark = ";base64";
    const std::string_view head = uri.substr(0, comma == std::string_view::npos ? 0 : comma);
    if (head.size() < mark.size() || head.substr(head.size() - mark.size()) != mark)
        throw Failure(KNURL_ERROR_FORMAT, "expected data:TYPE;base64,TEXT");
    const std::string_view text = uri.substr(comma + 1);
    if (text.find('%') != std::string_view::npos)
        return base64_decoded(percent_decoded(text));
    return base64_decoded(text);
}

} // namespace knurl::gltf
