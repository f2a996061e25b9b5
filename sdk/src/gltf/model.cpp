// SPDX-License-Identifier: MIT
#define TINYGLTF_IMPLEMENTATION
#include "model.hpp"

namespace knurl::gltf {
namespace {

/// What tinygltf's file callbacks work on.
struct Reading {
    const Filtered &filtered;
    const Resources &resources;
    uint64_t total = 0;
};

std::vector<unsigned char> read_buffer(Reading &reading, size_t index) {
    const BufferSource &source = reading.filtered.buffers.at(index);
    if (!source.needed)
        return std::vector<unsigned char>(1); // as long as its stub says; nothing points to it
    const std::string where = label("buffer", "", index);
    reading.total += source.byte_length;
    if (reading.total > bytes_max)
        refuse(where,
               "all buffers together: expected at most 1 GiB, found " + std::to_string(reading.total) + " bytes");
    if (source.uri != nullptr)
        return read_uri(*source.uri, source.byte_length, reading.resources, where);
    const std::optional<Bytes> &bin = reading.resources.bin;
    if (index != 0 || !bin)
        refuse(where, "uri: missing: expected one, for only buffer 0 of a .glb with a BIN chunk does without");
    if (bin->size < source.byte_length)
        refuse(where, "byteLength: expected at most " + std::to_string(bin->size) + " (the BIN chunk), found " +
                          std::to_string(source.byte_length));
    return {bin->data, bin->data + source.byte_length};
}

bool buffer_exists(const std::string & /*name*/, void * /*user*/) {
    return true;
}

std::string same_name(const std::string &name, void * /*user*/) {
    return name;
}

/// name: "3" stands for buffer 3 (filter.hpp). A Failure goes through tinygltf to load_model's caller.
bool read_named_buffer(std::vector<unsigned char> *out, std::string * /*error*/, const std::string &name, void *user) {
    *out = read_buffer(*static_cast<Reading *>(user), std::stoul(name));
    return true;
}

} // namespace

tinygltf::Model load_model(const Filtered &filtered, const Resources &resources) {
    Reading reading{filtered, resources};
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = buffer_exists;
    callbacks.ExpandFilePath = same_name;
    callbacks.ReadWholeFile = read_named_buffer;
    callbacks.user_data = &reading;
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(callbacks);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool loaded = parser.LoadASCIIFromString(&model, &error, &warning, filtered.json.data(),
                                                   static_cast<unsigned int>(filtered.json.size()), "");
    if (!loaded || !error.empty())
        throw Failure(KNURL_ERROR_FORMAT, "tinygltf: " + (error.empty() ? "refused" : shortened(error, 300)));
    return model;
}

} // namespace knurl::gltf
