// SPDX-License-Identifier: MIT
#include "filter.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace knurl::gltf {
namespace {

using Json = nlohmann::json;

/// Every buffer, as tinygltf is told of it: a file would have it call functions for files, and which of those it wants
/// changes with its versions.
constexpr const char *one_byte = "data:application/octet-stream;base64,AA==";

/// Copies a checked whole number where it is there.
void copy_whole(Json &to, const Fields &from, const char *key, uint32_t least = 0, uint32_t most = whole_max) {
    if (const auto value = from.whole(key, least, most))
        to[key] = *value;
}

void copy_required(Json &to, const Fields &from, const char *key, uint32_t least, const char *expected) {
    to[key] = from.required(from.whole(key, least), key, expected);
}

void copy_numbers(Json &to, const Fields &from, const char *key, size_t count) {
    if (auto values = from.numbers(key, count))
        to[key] = *std::move(values);
}

/// The vertex layouts that tinygltf and the accessors' reader know.
void copy_component_type(Json &to, const Fields &from) {
    constexpr uint32_t known[] = {5120, 5121, 5122, 5123, 5125, 5126};
    const uint32_t type = from.required(from.whole("componentType"), "componentType", "a number such as 5126 (float)");
    if (std::find(std::begin(known), std::end(known), type) == std::end(known))
        from.refuse_value("componentType", "5120, 5121, 5122, 5123, 5125 or 5126", *from.find("componentType"));
    to["componentType"] = type;
}

/// An array of the file, of which some elements are kept, in the order in which they are come across.
class Kept {
  public:
    explicit Kept(size_t size) : size_(size) {}

    size_t size() const {
        return size_;
    }
    /// The place of element `number`, and whether it is a new one, whose JSON is still to be filled in.
    std::pair<uint32_t, bool> place(uint32_t number) {
        const auto [found, fresh] = places_.emplace(number, static_cast<uint32_t>(numbers_.size()));
        if (fresh) {
            numbers_.push_back(number);
            json_.emplace_back();
        }
        return {found->second, fresh};
    }
    Json &operator[](uint32_t place) {
        return json_[place];
    }
    Json take_json() {
        return std::move(json_);
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
    Json::array_t json_;
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
                    break; // and its ancestors are kept
                nodes_[place] = node_of(static_cast<uint32_t>(node));
            }
            filtered.primitives.push_back(primitive_place(instance.mesh, instance.primitive));
        }
        for (uint32_t i = 0; i < sources_.size(); ++i)
            buffers_[i] = {{"byteLength", 1}, {"uri", one_byte}}; // what the file calls for is in sources_
        Json mesh = {{"primitives", std::move(primitives_)}};
        const Json all = {{"asset", {{"version", "2.0"}}},     {"nodes", nodes_.take_json()},
                          {"meshes", {std::move(mesh)}},       {"accessors", accessors_.take_json()},
                          {"bufferViews", views_.take_json()}, {"buffers", buffers_.take_json()}};
        filtered.json = all.dump();
        filtered.buffers = std::move(sources_);
        filtered.accessors = accessors_.take_numbers();
        filtered.views = views_.take_numbers();
        filtered.nodes = nodes_.take_places();
        return filtered;
    }

  private:
    Fields at(const char *key, const char *kind, size_t i) const {
        return {root_.json().at(key).at(i), kind, i};
    }

    Json node_of(size_t i) const {
        const Fields node = at("nodes", "node", i);
        Json kept;
        kept["name"] = shortened(node.name());
        if (node.find("matrix") != nullptr)
            for (const char *key : {"translation", "rotation", "scale"})
                if (node.find(key) != nullptr)
                    node.refuse_key(key, "expected either a matrix or translation, rotation and scale, found both");
        copy_numbers(kept, node, "matrix", 16);
        copy_numbers(kept, node, "translation", 3);
        copy_numbers(kept, node, "rotation", 4);
        copy_numbers(kept, node, "scale", 3);
        return kept;
    }

    /// Looked at once, whoever shows it; and those of the same accessors are one.
    uint32_t primitive_place(uint32_t mesh, uint32_t primitive) {
        const auto [known, fresh] = primitive_places_.emplace(uint64_t{mesh} << 32U | primitive, 0);
        if (fresh) {
            Json made = primitive_of(mesh, primitive);
            const auto [same, first] = same_primitives_.emplace(made.dump(), primitives_.size());
            if (first)
                primitives_.push_back(std::move(made));
            known->second = static_cast<uint32_t>(same->second);
        }
        return known->second;
    }

    Json primitive_of(uint32_t mesh_index, uint32_t primitive_index) {
        const Fields mesh = at("meshes", "mesh", mesh_index);
        const Fields primitive = mesh.element("primitives", primitive_index);
        Json kept;
        copy_whole(kept, primitive, "mode", 0, 6);
        if (const auto accessor = primitive.index("indices", accessors_.size(), "accessors")) {
            const uint32_t place = accessor_place(*accessor);
            kept["indices"] = place;
            // tinygltf refuses such a file in words that name nothing.
            if (!accessors_[place].contains("bufferView"))
                at("accessors", "accessor", *accessor).refuse_key("bufferView", "missing: expected one for indices");
        }
        const std::optional<Fields> attributes = primitive.object("attributes");
        if (!attributes || attributes->find("POSITION") == nullptr)
            primitive.refuse_key("attributes.POSITION", "missing: expected an accessor in a tagged primitive");
        for (const Attribute &read : attributes_read)
            if (const auto accessor = attributes->index(read.name, accessors_.size(), "accessors"))
                kept["attributes"][read.name] = accessor_place(*accessor);
        return kept;
    }

    uint32_t accessor_place(uint32_t i) {
        const auto [place, fresh] = accessors_.place(i);
        if (fresh)
            accessors_[place] = accessor_of(i);
        return place;
    }

    Json accessor_of(uint32_t i) {
        const Fields accessor = at("accessors", "accessor", i);
        Json kept;
        keep_view_of(kept, accessor);
        copy_whole(kept, accessor, "byteOffset");
        copy_component_type(kept, accessor);
        copy_required(kept, accessor, "count", 1, "how many elements there are");
        if (const auto normalized = accessor.flag("normalized"))
            kept["normalized"] = *normalized;
        const std::string *type = accessor.text("type");
        const bool known =
            type != nullptr && (*type == "SCALAR" || *type == "VEC2" || *type == "VEC3" || *type == "VEC4");
        if (!known)
            accessor.refuse_key("type", "expected 'SCALAR', 'VEC2', 'VEC3' or 'VEC4', found " +
                                            (type != nullptr ? in_quotes(*type) : "none"));
        kept["type"] = *type;
        if (const auto sparse = accessor.object("sparse"))
            kept["sparse"] = keep_sparse(*sparse);
        return kept;
    }

    Json keep_sparse(const Fields &sparse) {
        Json kept;
        copy_required(kept, sparse, "count", 1, "how many elements are replaced");
        for (const std::string part : {"indices", "values"}) {
            const auto from = sparse.object(part.c_str());
            if (!from)
                sparse.refuse_key(part, "missing: expected an object");
            Json &to = kept[part];
            keep_view_of(to, *from);
            if (!to.contains("bufferView"))
                from->refuse_key("bufferView", "missing: expected an index");
            to["byteOffset"] = from->whole("byteOffset").value_or(0); // tinygltf 2.5 asks for one
            if (part == "indices")
                copy_component_type(to, *from);
        }
        return kept;
    }

    void keep_view_of(Json &kept, const Fields &from) {
        const auto view = from.index("bufferView", views_.size(), "bufferViews");
        if (!view)
            return;
        const auto [place, fresh] = views_.place(*view);
        if (fresh)
            views_[place] = view_of(*view);
        kept["bufferView"] = place;
    }

    Json view_of(uint32_t i) {
        const Fields view = at("bufferViews", "bufferView", i);
        Json kept;
        const uint32_t buffer =
            view.required(view.index("buffer", buffers_.size(), "buffers"), "buffer", "the index of a buffer");
        copy_whole(kept, view, "byteOffset");
        copy_required(kept, view, "byteLength", 1, "a length in bytes");
        copy_whole(kept, view, "byteStride", 4, 252);
        if (kept.contains("byteStride") && kept["byteStride"].get<uint32_t>() % 4 != 0)
            view.refuse_value("byteStride", "a multiple of 4", *view.find("byteStride"));
        const auto [place, fresh] = buffers_.place(buffer);
        kept["buffer"] = place;
        if (fresh)
            sources_.push_back(source_of(buffer));
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

    Fields root_;
    Kept nodes_;
    Kept accessors_;
    Kept views_;
    Kept buffers_;
    Json::array_t primitives_;
    std::unordered_map<uint64_t, uint32_t> primitive_places_; ///< by mesh and primitive
    std::map<std::string, size_t> same_primitives_;           ///< by their JSON
    std::vector<BufferSource> sources_;
};

} // namespace

Filtered filter(const Json &root, const Outline &outline) {
    return Filter(root).run(outline);
}

} // namespace knurl::gltf
