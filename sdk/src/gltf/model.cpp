// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp> // for tinygltf's own code

#define TINYGLTF_IMPLEMENTATION
#include "model.hpp"

namespace knurl::gltf {
namespace {

Bytes read_buffer(const BufferSource &source, const Resources &resources, Sources &sources) {
    const std::string where = label("buffer", "", source.number);
    if (source.uri != nullptr)
        return sources.read(*source.uri, source.byte_length, resources, where);
    const std::optional<Bytes> &bin = resources.bin;
    if (source.number != 0 || !bin)
        refuse(where, "uri: missing: expected one, for only buffer 0 of a .glb with a BIN chunk does without");
    if (bin->size < source.byte_length)
        refuse(where, "byteLength: expected at most " + std::to_string(bin->size) + " (the BIN chunk), found " +
                          std::to_string(source.byte_length));
    return {bin->data, source.byte_length};
}

} // namespace

void load_model(Filtered filtered, const Resources &resources, Model &model) {
    model.filtered = std::move(filtered);
    for (const BufferSource &source : model.filtered.buffers) {
        model.buffers.push_back(read_buffer(source, resources, model.sources));
        resources.budget->step();
    }
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    const bool loaded = parser.LoadASCIIFromString(&model.parsed, &error, &warning, model.filtered.json.data(),
                                                   static_cast<unsigned int>(model.filtered.json.size()), "");
    if (!loaded || !error.empty())
        throw Failure(KNURL_ERROR_FORMAT, "tinygltf: " + (error.empty() ? "refused" : shortened(error, 300)));
    model.filtered.json.clear();
    model.filtered.json.shrink_to_fit();
}

} // namespace knurl::gltf
