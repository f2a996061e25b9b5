// SPDX-License-Identifier: MIT
#include "filter.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace knurl::gltf {

BufferSource buffer_source(const Fields &root, uint32_t i) {
    const Fields buffer = root.item("buffers", "buffer", i);
    BufferSource source;
    source.byte_length = buffer.required(buffer.whole("byteLength", 1), "byteLength", "a length in bytes");
    source.uri = buffer.text("uri");
    return source;
}

namespace {

/// Stores a checked whole number in a member of tinygltf, whose integer types differ between versions.
template <typename T>
void put(T &to, std::optional<uint32_t> value) {
    if (value)
        to = static_cast<T>(*value);
}

/// The component types that accessor.cpp can read.
uint32_t component_type_of(const Fields &from) {
    constexpr uint32_t known[] = {5120, 5121, 5122, 5123, 5125, 5126};
    const uint32_t type = from.required(from.whole("componentType"), "componentType", "a number such as 5126 (float)");
    if (std::find(std::begin(known), std::end(known), type) == std::end(known))
        from.refuse_value("componentType", "5120, 5121, 5122, 5123, 5125 or 5126", *from.find("componentType"));
    return type;
}

int type_of(const Fields &accessor) {
    constexpr std::pair<const char *, int> known[] = {{"SCALAR", TINYGLTF_TYPE_SCALAR},
                                                      {"VEC2", TINYGLTF_TYPE_VEC2},
                                                      {"VEC3", TINYGLTF_TYPE_VEC3},
                                                      {"VEC4", TINYGLTF_TYPE_VEC4}};
    const std::string expected = "expected 'SCALAR', 'VEC2', 'VEC3' or 'VEC4'";
    const std::string *type = accessor.text("type");
    if (type == nullptr)
        accessor.refuse_key("type", "missing: " + expected);
    for (const auto &[name, value] : known)
        if (*type == name)
            return value;
    accessor.refuse_key("type", expected + ", found " + in_quotes(*type));
}

class Filter {
  public:
    explicit Filter(const Fields &root)
        : root_(root), accessors_(root_.array("accessors").size()), views_(root_.array("bufferViews").size()),
          buffers_(root_.array("buffers").size()) {}

    Model run(const Outline &outline) {
        for (const Instance &instance : outline.instances) {
            for (int32_t node = static_cast<int32_t>(instance.node); node >= 0;
                 node = outline.parents[static_cast<size_t>(node)]) {
                const auto [kept, fresh] = filtered_.nodes.try_emplace(node);
                if (!fresh)
                    break; // its ancestors are kept already
                kept->second = node_of(static_cast<size_t>(node));
            }
            filtered_.instance_primitives.push_back(primitive_place(instance));
        }
        return std::move(filtered_);
    }

  private:
    tinygltf::Node node_of(size_t i) const {
        const Fields node = root_.item("nodes", "node", i);
        tinygltf::Node kept;
        kept.name = shortened(node.name());
        if (node.find("matrix") != nullptr)
            for (const char *key : {"translation", "rotation", "scale"})
                if (node.find(key) != nullptr)
                    node.refuse_key(key, "expected either a matrix or translation, rotation and scale, found both");
        kept.matrix = node.numbers("matrix", 16);
        kept.translation = node.numbers("translation", 3);
        kept.rotation = node.numbers("rotation", 4);
        kept.scale = node.numbers("scale", 3);
        return kept;
    }

    /// Reads each primitive once, for all nodes; primitives with the same mode and accessors share a place.
    uint32_t primitive_place(const Instance &instance) {
        const auto [known, fresh] = primitive_places_.try_emplace({instance.mesh, instance.primitive}, 0);
        if (fresh) {
            tinygltf::Primitive made = primitive_of(instance.mesh, instance.primitive);
            const auto [same, first] = same_primitives_.emplace(key_of(made), filtered_.primitives.size());
            if (first)
                filtered_.primitives.push_back(std::move(made));
            known->second = static_cast<uint32_t>(same->second);
        }
        return known->second;
    }

    tinygltf::Primitive primitive_of(uint32_t mesh_index, uint32_t primitive_index) {
        const Fields mesh = root_.item("meshes", "mesh", mesh_index);
        const Fields primitive = mesh.element("primitives", primitive_index);
        tinygltf::Primitive kept;
        put(kept.mode, primitive.whole("mode", 0, 6).value_or(TINYGLTF_MODE_TRIANGLES));
        if (const auto accessor = primitive.index("indices", accessors_, "accessors")) {
            put(kept.indices, keep_accessor(*accessor));
            // By the specification all indices are then zero: triangles without area.
            if (filtered_.accessors.at(kept.indices).bufferView < 0)
                root_.item("accessors", "accessor", *accessor)
                    .refuse_key("bufferView", "missing: expected one for indices");
        }
        const std::optional<Fields> attributes = primitive.object("attributes");
        if (!attributes || attributes->find("POSITION") == nullptr)
            primitive.refuse_key("attributes.POSITION", "missing: expected an accessor in a tagged primitive");
        for (const Attribute &read : attributes_read)
            if (const auto accessor = attributes->index(read.name, accessors_, "accessors"))
                put(kept.attributes[read.name], keep_accessor(*accessor));
        return kept;
    }

    /// Returns the accessor's number.
    uint32_t keep_accessor(uint32_t i) {
        const auto [kept, fresh] = filtered_.accessors.try_emplace(static_cast<int>(i));
        if (fresh)
            kept->second = accessor_of(i);
        return i;
    }

    tinygltf::Accessor accessor_of(uint32_t i) {
        const Fields accessor = root_.item("accessors", "accessor", i);
        tinygltf::Accessor kept;
        put(kept.bufferView, keep_view(accessor));
        put(kept.byteOffset, accessor.whole("byteOffset"));
        put(kept.componentType, component_type_of(accessor));
        put(kept.count, accessor.required(accessor.whole("count", 1), "count", "the number of elements"));
        kept.normalized = accessor.flag("normalized").value_or(false);
        kept.type = type_of(accessor);
        kept.sparse.isSparse = false;
        if (const auto sparse = accessor.object("sparse"))
            keep_sparse(kept, *sparse);
        return kept;
    }

    void keep_sparse(tinygltf::Accessor &kept, const Fields &sparse) {
        auto &to = kept.sparse;
        to.isSparse = true;
        put(to.count, sparse.required(sparse.whole("count", 1), "count", "the number of replaced elements"));
        const Fields indices = sparse.required(sparse.object("indices"), "indices", "an object");
        put(to.indices.bufferView, keep_required_view(indices));
        put(to.indices.byteOffset, indices.whole("byteOffset").value_or(0));
        put(to.indices.componentType, component_type_of(indices));
        const Fields values = sparse.required(sparse.object("values"), "values", "an object");
        put(to.values.bufferView, keep_required_view(values));
        put(to.values.byteOffset, values.whole("byteOffset").value_or(0));
    }

    std::optional<uint32_t> keep_view(const Fields &from) {
        const auto view = from.index("bufferView", views_, "bufferViews");
        if (view)
            if (const auto [kept, fresh] = filtered_.views.try_emplace(static_cast<int>(*view)); fresh)
                kept->second = view_of(*view);
        return view;
    }

    uint32_t keep_required_view(const Fields &from) {
        return from.required(keep_view(from), "bufferView", "an index");
    }

    tinygltf::BufferView view_of(uint32_t i) {
        const Fields view = root_.item("bufferViews", "bufferView", i);
        tinygltf::BufferView kept;
        const uint32_t buffer =
            view.required(view.index("buffer", buffers_, "buffers"), "buffer", "the index of a buffer");
        put(kept.byteOffset, view.whole("byteOffset"));
        put(kept.byteLength, view.required(view.whole("byteLength", 1), "byteLength", "a length in bytes"));
        put(kept.byteStride, view.whole("byteStride", 4, 252));
        if (kept.byteStride % 4 != 0)
            view.refuse_value("byteStride", "a multiple of 4", *view.find("byteStride"));
        put(kept.buffer, buffer);
        filtered_.buffers.try_emplace(kept.buffer, buffer_source(root_, buffer));
        return kept;
    }

    using PrimitiveKey = std::array<int, 2 + std::size(attributes_read)>; ///< mode, and accessors' places or -1

    static PrimitiveKey key_of(const tinygltf::Primitive &primitive) {
        PrimitiveKey key{primitive.mode, primitive.indices};
        for (size_t i = 0; i < std::size(attributes_read); ++i) {
            const auto found = primitive.attributes.find(attributes_read[i].name);
            key[2 + i] = found != primitive.attributes.end() ? found->second : -1;
        }
        return key;
    }

    const Fields &root_;
    size_t accessors_, views_, buffers_; ///< of the whole file
    Model filtered_;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> primitive_places_; ///< by mesh and primitive
    std::map<PrimitiveKey, size_t> same_primitives_;
};

} // namespace

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

Model filter(const Fields &root, const Outline &outline) {
    return Filter(root).run(outline);
}

void load_buffers(Model &model, const Resources &resources) {
    for (auto &[number, source] : model.buffers) {
        source.bytes = read_buffer(number, source, resources, model.sources);
        resources.budget->step();
    }
}

} // namespace knurl::gltf
