// SPDX-License-Identifier: MIT
#include "uri.hpp"
#include "failure.hpp"

#include <array>
#include <cstdint>

namespace knurl::gltf {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    if (c >= 'A' && c <= 'F')
        return c - 'A' + 10;
    return -1;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

constexpr uint8_t not_base64 = 255;

std::array<uint8_t, 256> base64_values() {
    std::array<uint8_t, 256> values{};
    values.fill(not_base64);
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < digits.size(); ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<uint8_t>(i);
    return values;
}

std::vector<unsigned char> base64_decoded(std::string_view text) {
    static const std::array<uint8_t, 256> values = base64_values();
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1)
        throw Failure(KNURL_ERROR_FORMAT, "the base64 text is cut short");
    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    unsigned held = 0;
    for (const char c : text) {
        const uint8_t value = values[static_cast<unsigned char>(c)];
        if (value == not_base64)
            throw Failure(KNURL_ERROR_FORMAT, "expected base64 digits, found " + in_quotes(std::string(1, c)));
        bits = (bits << 6U) | value;
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
        const bool triple = uri[i] == '%' && uri.size() - i > 2;
        const int high = triple ? hex_digit(uri[i + 1]) : -1;
        const int low = triple ? hex_digit(uri[i + 2]) : -1;
        if (high >= 0 && low >= 0) {
            text.push_back(static_cast<char>(high * 16 + low));
            i += 2;
        } else {
            text.push_back(uri[i]);
        }
    }
    return text;
}

bool has_scheme(std::string_view uri) {
    if (uri.empty() || !is_letter(uri[0]))
        return false;
    for (const char c : uri) {
        if (c == ':')
            return true;
        if (!is_letter(c) && !(c >= '0' && c <= '9') && c != '+' && c != '-' && c != '.')
            return false;
    }
    return false;
}

bool is_data_uri(std::string_view uri) {
    const std::string_view scheme = "data:";
    if (uri.size() < scheme.size())
        return false;
    for (size_t i = 0; i < scheme.size(); ++i)
        if (uri[i] != scheme[i] && uri[i] != scheme[i] - 'a' + 'A')
            return false;
    return true;
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
