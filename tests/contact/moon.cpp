// Reads the first mesh of a glTF file: two accessors of one buffer, and no more than that needs.
// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

using nlohmann::json;

namespace {

struct file {
    json root;
    std::string bytes;

    /// The start of an accessor's elements; its offsets come from the file, and are checked.
    const char *data(const json &accessor, size_t size) const {
        const json &view = root.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
        const size_t at = view.value("byteOffset", size_t{0}) + accessor.value("byteOffset", size_t{0});
        if (view.value("byteStride", size) != size || at + size * accessor.at("count").get<size_t>() > bytes.size())
            throw std::out_of_range("accessor");
        return bytes.data() + at;
    }
};

std::string read(const std::string &path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

template <class T>
T *copy(const void *from, size_t count) {
    if (count == 0)
        throw std::length_error("an accessor without elements");
    T *to = static_cast<T *>(std::malloc(count * sizeof(T)));
    std::memcpy(to, from, count * sizeof(T));
    return to;
}

} // namespace

extern "C" int moon_load(const char *path, float **positions, uint32_t *vertex_count, uint32_t **indices,
                         uint32_t *index_count);

extern "C" int moon_load(const char *path, float **positions, uint32_t *vertex_count, uint32_t **indices,
                         uint32_t *index_count) {
    const std::string folder = std::string(path).substr(0, std::string(path).rfind('/') + 1);
    try {
        file f{json::parse(read(path)), ""};
        f.bytes = read(folder + f.root.at("buffers").at(0).at("uri").get<std::string>());
        const json &accessors = f.root.at("accessors");
        const json &terrain = f.root.at("meshes").at(0).at("primitives").at(0);
        const json &at = accessors.at(terrain.at("attributes").at("POSITION").get<size_t>());
        const json &corners = accessors.at(terrain.at("indices").get<size_t>());
        const size_t count = corners.at("count").get<size_t>();
        const bool wide = corners.at("componentType") == 5125;
        const char *from = f.data(corners, wide ? 4 : 2);
        std::vector<uint32_t> list(count);
        for (size_t i = 0; i < count; ++i) {
            uint16_t narrow = 0;
            if (wide)
                std::memcpy(&list[i], from + 4 * i, 4);
            else {
                std::memcpy(&narrow, from + 2 * i, 2);
                list[i] = narrow;
            }
        }
        *vertex_count = at.at("count").get<uint32_t>();
        *positions = copy<float>(f.data(at, 12), size_t{3} * *vertex_count);
        *index_count = static_cast<uint32_t>(count);
        *indices = copy<uint32_t>(list.data(), count);
        return 1;
    } catch (const std::exception &) {
        return 0;
    }
}
