// Knurl: the part of a glTF file that its tagged surfaces need, with all types and ranges checked. The rest is left out
// and costs nothing.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILTER_HPP
#define KNURL_GLTF_FILTER_HPP

#include "file/files.hpp"
#include "outline.hpp"
#include "tinygltf.hpp"

#include <map>

namespace knurl::gltf {

/** A buffer used by a tagged surface. */
struct BufferSource {
    uint32_t byte_length = 0;
    const std::string *uri = nullptr; ///< in the file's JSON; null: the BIN chunk
    Bytes bytes;                      ///< see load_buffers()
};

/** By their numbers in the file, except primitives. */
struct Model {
    std::map<int, tinygltf::Node> nodes;
    std::map<int, tinygltf::Accessor> accessors;
    std::map<int, tinygltf::BufferView> views;
    std::map<int, BufferSource> buffers;
    std::vector<tinygltf::Primitive> primitives;
    std::vector<uint32_t> instance_primitives; ///< for each instance of the outline, its place in `primitives`
    Sources sources;
};

/** root: must outlive the result. Throws Failure. */
Model filter(const Fields &root, const Outline &outline);

/** Reads the properties of buffer i of a file. Throws Failure. */
BufferSource buffer_source(const Fields &root, uint32_t i);

/** The bytes of one buffer. Throws Failure. */
Bytes read_buffer(int number, const BufferSource &source, const Resources &resources, Sources &sources);

/** Reads the model's buffers. Throws Failure. */
void load_buffers(Model &model, const Resources &resources);

/** The vertex attributes that are read, POSITION first, with their numbers per element. */
struct Attribute {
    const char *name;
    size_t components;
};
constexpr Attribute attributes_read[] = {{"POSITION", 3}, {"NORMAL", 3}, {"TANGENT", 4}, {"TEXCOORD_0", 2}};

} // namespace knurl::gltf
#endif
