// SPDX-License-Identifier: MIT
#include "filter.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

namespace knurl::gltf {
namespace {

/// Stores a checked whole number in a member of tinygltf, whose integer types differ between versions.
template <typename T>
void put(T &to, std::optional<uint32_t> value) {
    if (value)
        to = static_cast<T>(*value);
}

std::vector<double> numbers_of(const Fields &from, const char *key, size_t count) {
    return from.numbers(key, count).value_or(std::vector<double>());
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
    const std::string *type = accessor.text("type");
    for (const auto &[name, value] : known)
        if (type != nullptr && *type == name)
            return value;
    accessor.refuse_key("type", "expected 'SCALAR', 'VEC2', 'VEC3' or 'VEC4', found " +
                                    (type != nullptr ? in_quotes(*type) : "none"));
}

/// The elements kept of one of the file's arrays, in the order of their first use.
template <typename T>
class Kept {
  public:
    explicit Kept(size_t size) : size_(size) {}

    size_t size() const {
        return size_;
    }
    /// The place of element `number`, and true if it is new: the caller must then fill it in.
    std::pair<uint32_t, bool> place(uint32_t number) {
        const auto [found, fresh] = places_.emplace(number, static_cast<uint32_t>(numbers_.size()));
        if (fresh) {
            numbers_.push_back(number);
            elements_.emplace_back();
        }
        return {found->second, fresh};
    }
    T &operator[](uint32_t place) {
        return elements_[place];
    }
    std::vector<T> take_elements() {
        return std::move(elements_);
    }
    std::vector<uint32_t> take_numbers() {
        return std::move(numbers_);
    }
    std::unordered_map<uint32_t, uint32_t> take_places() {
        return std::move(places_);
    }

  private:
    size_t size_;
    std::unordered_map<uint32_t, uint32_t> places_;
    std::vector<uint32_t> numbers_;
    std::vector<T> elements_;
};

class Filter {
  public:
    explicit Filter(const Json &json)
        : root_(json, "", no_index), nodes_(root_.array_size("nodes")), accessors_(root_.array_size("accessors")),
          views_(root_.array_size("bufferViews")), buffers_(root_.array_size("buffers")) {}

    Filtered run(const Outline &outline) {
        Filtered filtered;
        for (const Instance &instance : outline.instances) {
            for (int32_t node = static_cast<int32_t>(instance.node); node >= 0;
                 node = outline.parents[static_cast<size_t>(node)]) {
                const auto [place, fresh] = nodes_.place(static_cast<uint32_t>(node));
                if (!fresh)
                    break; // its ancestors are kept already
                nodes_[place] = node_of(static_cast<uint32_t>(node));
            }
            filtered.instance_primitives.push_back(primitive_place(instance.mesh, instance.primitive));
        }
        filtered.nodes = nodes_.take_elements();
        filtered.node_places = nodes_.take_places();
        filtered.primitives = std::move(primitives_);
        filtered.accessors = accessors_.take_elements();
        filtered.accessor_numbers = accessors_.take_numbers();
        filtered.views = views_.take_elements();
        filtered.view_numbers = views_.take_numbers();
        filtered.buffers = buffers_.take_elements();
        return filtered;
    }

  private:
    Fields at(const char *key, const char *kind, size_t i) const {
        return {root_.json().at(key).at(i), kind, i};
    }

    tinygltf::Node node_of(size_t i) const {
        const Fields node = at("nodes", "node", i);
        tinygltf::Node kept;
        kept.name = shortened(node.name());
        if (node.find("matrix") != nullptr)
            for (const char *key : {"translation", "rotation", "scale"})
                if (node.find(key) != nullptr)
                    node.refuse_key(key, "expected either a matrix or translation, rotation and scale, found both");
        kept.matrix = numbers_of(node, "matrix", 16);
        kept.translation = numbers_of(node, "translation", 3);
        kept.rotation = numbers_of(node, "rotation", 4);
        kept.scale = numbers_of(node, "scale", 3);
        return kept;
    }

    /// Reads each primitive once, for all nodes; primitives with the same mode and accessors share a place.
    uint32_t primitive_place(uint32_t mesh, uint32_t primitive) {
        const auto [known, fresh] = primitive_places_.emplace(uint64_t{mesh} << 32U | primitive, 0);
        if (fresh) {
            tinygltf::Primitive made = primitive_of(mesh, primitive);
            const auto [same, first] = same_primitives_.emplace(key_of(made), primitives_.size());
            if (first)
                primitives_.push_back(std::move(made));
            known->second = static_cast<uint32_t>(same->second);
        }
        return known->second;
    }

    tinygltf::Primitive primitive_of(uint32_t mesh_index, uint32_t primitive_index) {
        const Fields mesh = at("meshes", "mesh", mesh_index);
        const Fields primitive = mesh.element("primitives", primitive_index);
        tinygltf::Primitive kept;
        put(kept.mode, primitive.whole("mode", 0, 6).value_or(TINYGLTF_MODE_TRIANGLES));
        if (const auto accessor = primitive.index("indices", accessors_.size(), "accessors")) {
            put(kept.indices, accessor_place(*accessor));
            // By the specification all indices are then zero: triangles without area.
            if (accessors_[static_cast<uint32_t>(kept.indices)].bufferView < 0)
                at("accessors", "accessor", *accessor).refuse_key("bufferView", "missing: expected one for indices");
        }
        const std::optional<Fields> attributes = primitive.object("attributes");
        if (!attributes || attributes->find("POSITION") == nullptr)
            primitive.refuse_key("attributes.POSITION", "missing: expected an accessor in a tagged primitive");
        for (const Attribute &read : attributes_read)
            if (const auto accessor = attributes->index(read.name, accessors_.size(), "accessors"))
                put(kept.attributes[read.name], accessor_place(*accessor));
        return kept;
    }

    uint32_t accessor_place(uint32_t i) {
        const auto [place, fresh] = accessors_.place(i);
        if (fresh)
            accessors_[place] = accessor_of(i);
        return place;
    }

    tinygltf::Accessor accessor_of(uint32_t i) {
        const Fields accessor = at("accessors", "accessor", i);
        tinygltf::Accessor kept;
        put(kept.bufferView, view_place(accessor));
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
        const Fields indices = sparse_part(sparse, "indices");
        put(to.indices.bufferView, required_view_place(indices));
        put(to.indices.byteOffset, indices.whole("byteOffset").value_or(0));
        put(to.indices.componentType, component_type_of(indices));
        const Fields values = sparse_part(sparse, "values");
        put(to.values.bufferView, required_view_place(values));
        put(to.values.byteOffset, values.whole("byteOffset").value_or(0));
    }

    static Fields sparse_part(const Fields &sparse, const char *key) {
        return sparse.required(sparse.object(key), key, "an object");
    }

    std::optional<uint32_t> view_place(const Fields &from) {
        const auto view = from.index("bufferView", views_.size(), "bufferViews");
        if (!view)
            return std::nullopt;
        const auto [place, fresh] = views_.place(*view);
        if (fresh)
            views_[place] = view_of(*view);
        return place;
    }

    uint32_t required_view_place(const Fields &from) {
        return from.required(view_place(from), "bufferView", "an index");
    }

    tinygltf::BufferView view_of(uint32_t i) {
        const Fields view = at("bufferViews", "bufferView", i);
        tinygltf::BufferView kept;
        const uint32_t buffer =
            view.required(view.index("buffer", buffers_.size(), "buffers"), "buffer", "the index of a buffer");
        put(kept.byteOffset, view.whole("byteOffset"));
        put(kept.byteLength, view.required(view.whole("byteLength", 1), "byteLength", "a length in bytes"));
        put(kept.byteStride, view.whole("byteStride", 4, 252));
        if (kept.byteStride % 4 != 0)
            view.refuse_value("byteStride", "a multiple of 4", *view.find("byteStride"));
        const auto [place, fresh] = buffers_.place(buffer);
        put(kept.buffer, place);
        if (fresh)
            buffers_[place] = source_of(buffer);
        return kept;
    }

    BufferSource source_of(uint32_t i) const {
        const Fields buffer = at("buffers", "buffer", i);
        BufferSource source;
        source.number = i;
        source.byte_length = buffer.required(buffer.whole("byteLength", 1), "byteLength", "a length in bytes");
        source.uri = buffer.text("uri");
        return source;
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

    Fields root_;
    Kept<tinygltf::Node> nodes_;
    Kept<tinygltf::Accessor> accessors_;
    Kept<tinygltf::BufferView> views_;
    Kept<BufferSource> buffers_;
    std::vector<tinygltf::Primitive> primitives_;
    std::unordered_map<uint64_t, uint32_t> primitive_places_; ///< by mesh and primitive
    std::map<PrimitiveKey, size_t> same_primitives_;
};

} // namespace

Filtered filter(const Json &root, const Outline &outline) {
    return Filter(root).run(outline);
}

} // namespace knurl::gltf
