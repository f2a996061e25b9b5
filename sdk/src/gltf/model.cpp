// SPDX-License-Identifier: MIT
#include "model.hpp"

namespace knurl::gltf {
namespace {

Bytes read_buffer(int number, const BufferSource &source, const Resources &resources, Sources &sources) {
    const std::string where = "buffer " + std::to_string(number);
    if (source.uri != nullptr)
        return sources.read(*source.uri, source.byte_length, resources, where);
    const std::optional<Bytes> &bin = resources.bin;
    if (number != 0 || !bin)
        refuse(where, "uri: missing: expected one; only buffer 0 of a .glb with a BIN chunk may omit it");
    if (bin->size < source.byte_length)
        refuse(where, "byteLength: expected at most " + std::to_string(bin->size) + " (the BIN chunk), found " +
                          std::to_string(source.byte_length));
    return {bin->data, source.byte_length};
}

} // namespace

void load_model(Filtered filtered, const Resources &resources, Model &model) {
    model.filtered = std::move(filtered);
    for (const auto &[number, source] : model.filtered.buffers) {
        model.buffers.emplace(number, read_buffer(number, source, resources, model.sources));
        resources.budget->step();
    }
}

} // namespace knurl::gltf
