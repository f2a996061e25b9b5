// SPDX-License-Identifier: MIT
#include "container.hpp"

#include <cstring>

namespace knurl::gltf {
namespace {

// glTF 2.0, 4.4: three words of header, then chunks of two words of header each; all words little-endian.
constexpr size_t header_size = 12;
constexpr size_t chunk_header_size = 8;
constexpr uint32_t chunk_json = 0x4E4F534A;
constexpr uint32_t chunk_bin = 0x004E4942;

uint32_t word(const unsigned char *at) {
    return uint32_t{at[0]} | uint32_t{at[1]} << 8U | uint32_t{at[2]} << 16U | uint32_t{at[3]} << 24U;
}

void put_word(std::string &bytes, size_t at, size_t value) {
    for (size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<char>(value >> 8U * i & 0xFFU);
}

struct Chunk {
    uint32_t type = 0;
    Bytes bytes;
};

/// Removes the first chunk from `rest` and returns it.
Chunk take_chunk(Bytes &rest, size_t number) {
    const std::string where = ".glb chunk " + std::to_string(number);
    if (rest.size < chunk_header_size)
        refuse(where, "expected a header of 8 bytes, found " + std::to_string(rest.size));
    const uint32_t length = word(rest.data);
    Chunk chunk;
    chunk.type = word(rest.data + 4);
    rest.data += chunk_header_size;
    rest.size -= chunk_header_size;
    if (length > rest.size)
        refuse(where, "expected " + std::to_string(length) + " bytes (its length), found " + std::to_string(rest.size));
    chunk.bytes = {rest.data, length};
    rest.data += length;
    rest.size -= length;
    return chunk;
}

Container split_binary(Bytes bytes) {
    const std::string where = ".glb header";
    if (bytes.size < header_size)
        refuse(where, "expected 12 bytes, found " + std::to_string(bytes.size));
    const uint32_t version = word(bytes.data + 4);
    const uint32_t length = word(bytes.data + 8);
    if (version != 2)
        refuse(where, "expected version 2, found " + std::to_string(version), KNURL_ERROR_UNSUPPORTED);
    if (length < header_size || length > bytes.size)
        refuse(where, "expected the file's length in bytes (" + std::to_string(bytes.size) + "), found " +
                          std::to_string(length));
    Bytes rest{bytes.data + header_size, length - header_size};
    const Chunk json = take_chunk(rest, 0);
    if (json.type != chunk_json)
        refuse(".glb chunk 0", "expected the type JSON");
    Container parts;
    parts.json = {reinterpret_cast<const char *>(json.bytes.data), json.bytes.size};
    // Other chunk types are skipped, as 4.4.3.1 requires.
    for (size_t number = 1; rest.size > 0 && !parts.bin; ++number) {
        const Chunk chunk = take_chunk(rest, number);
        if (chunk.type == chunk_bin)
            parts.bin = chunk.bytes;
    }
    return parts;
}

} // namespace

Container split(Bytes bytes) {
    if (bytes.size >= 4 && std::memcmp(bytes.data, "glTF", 4) == 0)
        return split_binary(bytes);
    const std::string_view text(reinterpret_cast<const char *>(bytes.data), bytes.size);
    // Accept a byte order mark, although glTF forbids it.
    const size_t start = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (start == std::string_view::npos || text[start] != '{')
        throw Failure(KNURL_ERROR_FORMAT, "expected a JSON object or a .glb, found " +
                                              std::string(bytes.size == 0 ? "nothing" : "neither"));
    return {text, std::nullopt};
}

std::string with_json(Bytes file, const Container &container, std::string json) {
    const auto *bytes = reinterpret_cast<const char *>(file.data);
    if (container.json.data() == bytes)
        return json;
    constexpr size_t json_at = header_size + chunk_header_size;
    json.erase(json.find_last_of('}') + 1);
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string whole(bytes, json_at);
    const size_t length = word(file.data + 8) - container.json.size() + json.size();
    if (length > UINT32_MAX)
        refuse(".glb header", "the file would be longer than 4 GiB", KNURL_ERROR_FULL);
    put_word(whole, 8, length);
    put_word(whole, header_size, json.size());
    const size_t rest = json_at + container.json.size();
    return whole.append(json).append(bytes + rest, file.size - rest);
}

} // namespace knurl::gltf
