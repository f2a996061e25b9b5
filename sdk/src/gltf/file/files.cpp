// SPDX-License-Identifier: MIT
#include "files.hpp"

#include "base/regular_file.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>

namespace fs = std::filesystem;

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

/// Replaces %41 by A. A % without two hex digits is kept, because many exporters do not encode at all.
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

/// The scheme in lower case, such as "https", "data", or "c" of a drive (RFC 3986, 3.1); "" if there is no scheme.
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

/// The bytes of data:[type][;...];base64,TEXT. Throws Failure without the URI.
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

/// Bytes read between two checks of the budget.
constexpr size_t block = size_t{1} << 22U;

/// path: relative to `folder`, without symbolic links, unless `folder` is null.
std::vector<unsigned char> read_regular(const fs::path *folder, const fs::path &path, Budget &budget,
                                        const std::string &where) {
    char why[200];
    uint64_t size = 0;
    const std::string root = folder != nullptr ? folder->u8string() : "";
    const std::unique_ptr<FILE, int (*)(FILE *)> file(knurl_regular_open(folder != nullptr ? root.c_str() : nullptr,
                                                                         path.generic_u8string().c_str(), &size, why,
                                                                         sizeof why),
                                                      std::fclose);
    if (!file)
        throw Failure(KNURL_ERROR_IO, why);
    budget.take_bytes(size, where);
    std::vector<unsigned char> bytes(static_cast<size_t>(size));
    for (size_t at = 0; at < bytes.size(); at += block) {
        const size_t wanted = std::min(block, bytes.size() - at);
        if (std::fread(bytes.data() + at, 1, wanted, file.get()) != wanted)
            throw Failure(KNURL_ERROR_IO, "cannot be read to its end");
        budget.step();
    }
    return bytes;
}

struct Place {
    fs::path folder;
    fs::path file; ///< whole
};

/// Resolves a relative URI and its symbolic links; throws Failure if the file is not in the folder or below it.
Place locate(const std::string &uri, const fs::path &folder) {
    const std::string decoded = percent_decoded(uri);
    const fs::path relative = fs::u8path(decoded);
    if (!scheme_of(uri).empty() || relative.has_root_path() || decoded.find('\0') != std::string::npos)
        throw Failure(KNURL_ERROR_FORMAT, "expected a path relative to the glTF file, without a scheme");
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error)
        throw Failure(KNURL_ERROR_IO, "no folder " + in_quotes(folder.u8string()));
    const fs::path file = fs::canonical(root / relative, error);
    if (error)
        throw Failure(KNURL_ERROR_IO, "no such file in " + in_quotes(folder.empty() ? "." : folder.u8string()));
    if (std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first != root.end())
        throw Failure(KNURL_ERROR_FORMAT, "expected a file in the glTF file's folder or below it");
    return {root, file};
}

} // namespace

std::vector<unsigned char> read_file(const fs::path &path, Budget &budget) {
    return read_regular(nullptr, path, budget, "");
}

const std::vector<unsigned char> &Sources::find(const std::string &uri, uint64_t size, const Resources &resources,
                                                const std::string &where) {
    if (scheme_of(uri) == "data") {
        resources.budget->take_bytes(size, where);
        return texts_.emplace_back(data_uri_bytes(uri));
    }
    if (!resources.folder)
        throw Failure(KNURL_ERROR_IO, "an external file cannot be read, because no folder was given: embed it");
    const Place place = locate(uri, *resources.folder);
    auto known = files_.find(place.file);
    if (known == files_.end()) {
        std::vector<unsigned char> bytes =
            read_regular(&place.folder, place.file.lexically_relative(place.folder), *resources.budget, where);
        resources.budget->tell_read(place.file);
        known = files_.emplace(place.file, std::move(bytes)).first;
    }
    return known->second;
}

Bytes Sources::read_all(const std::string &uri, uint64_t size, const Resources &resources, const std::string &where) {
    try {
        const std::vector<unsigned char> &bytes = find(uri, size, resources, where);
        return {bytes.data(), bytes.size()};
    } catch (const Failure &failure) {
        if (failure.code() == KNURL_ERROR_FULL || failure.code() == KNURL_ERROR_CANCELLED)
            throw; // concerns the whole load; its message is complete
        refuse(where + ": uri " + in_quotes(uri), failure.what(), failure.code());
    }
}

Bytes Sources::read(const std::string &uri, uint64_t size, const Resources &resources, const std::string &where) {
    const Bytes bytes = read_all(uri, size, resources, where);
    if (bytes.size < size) // longer is allowed: padding is common
        refuse(where + ": uri " + in_quotes(uri),
               "expected " + std::to_string(size) + " bytes (byteLength), found " + std::to_string(bytes.size));
    return {bytes.data, static_cast<size_t>(size)};
}

} // namespace knurl::gltf
