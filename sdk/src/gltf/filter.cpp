// SPDX-License-Identifier: MIT
#include "filter.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace knurl::gltf {
namespace {

using Json = nlohmann::json;

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

class Filter {
  public:
    explicit Filter(const Json &json)
        : root_(json, "", no_index), nodes_(stubs("nodes", Json::object())),
          meshes_(stubs("meshes", {{"primitives", Json::array()}})),
          accessors_(stubs("accessors", {{"componentType", 5126}, {"count", 0}, {"type", "SCALAR"}})),
          views_(stubs("bufferViews", {{"buffer", 0}, {"byteLength", 1}})),
          buffers_(stubs("buffers", {{"byteLength", 1}})), done_accessors_(accessors_.size()),
          done_views_(views_.size()), sources_(buffers_.size()) {}

    Filtered run(const Outline &outline) {
        std::vector<bool> done_nodes(nodes_.size());
        for (const Instance &instance : outline.instances) {
            for (int32_t node = static_cast<int32_t>(instance.node); node >= 0 && !done_nodes[index(node)];
                 node = outline.parents[index(node)]) {
                done_nodes[index(node)] = true;
                keep_node(index(node));
            }
            keep_primitive(instance.mesh, instance.primitive);
        }
        for (size_t i = 0; i < buffers_.size(); ++i)
            buffers_[i]["uri"] = std::to_string(i); // what the file calls for is in sources_
        const Json all = {{"asset", {{"version", "2.0"}}},    {"nodes", std::move(nodes_)},
                          {"meshes", std::move(meshes_)},     {"accessors", std::move(accessors_)},
                          {"bufferViews", std::move(views_)}, {"buffers", std::move(buffers_)}};
        return {all.dump(), std::move(sources_)};
    }

  private:
    static size_t index(int32_t node) {
        return static_cast<size_t>(node);
    }

    Json stubs(const char *key, const Json &stub) const {
        return Json::array_t(root_.array_size(key), stub);
    }

    Fields at(const char *key, const char *kind, size_t i) const {
        return {root_.json().at(key).at(i), kind, i};
    }

    void keep_node(size_t i) {
        const Fields node = at("nodes", "node", i);
        Json &kept = nodes_[i];
        kept["name"] = node.name();
        if (node.find("matrix") != nullptr)
            for (const char *key : {"translation", "rotation", "scale"})
                if (node.find(key) != nullptr)
                    node.refuse_key(key, "expected either a matrix or translation, rotation and scale, found both");
        copy_numbers(kept, node, "matrix", 16);
        copy_numbers(kept, node, "translation", 3);
        copy_numbers(kept, node, "rotation", 4);
        copy_numbers(kept, node, "scale", 3);
    }

    void keep_primitive(uint32_t mesh_index, uint32_t primitive_index) {
        const Fields mesh = at("meshes", "mesh", mesh_index);
        Json &kept_mesh = meshes_[mesh_index];
        if (kept_mesh["primitives"].empty()) {
            kept_mesh["name"] = mesh.name();
            const Json stub = {{"attributes", Json::object()}};
            kept_mesh["primitives"] = Json::array_t(mesh.array_size("primitives"), stub);
        }
        Json &kept = kept_mesh["primitives"][primitive_index];
        if (!kept["attributes"].empty())
            return; // another node shows it as well
        const Fields primitive = mesh.element("primitives", primitive_index);
        copy_whole(kept, primitive, "mode", 0, 6);
        if (const auto accessor = primitive.index("indices", accessors_.size(), "accessors")) {
            kept["indices"] = *accessor;
            keep_accessor(*accessor);
            // tinygltf refuses such a file in words that name nothing.
            if (!accessors_[*accessor].contains("bufferView"))
                at("accessors", "accessor", *accessor).refuse_key("bufferView", "missing: expected one for indices");
        }
        const std::optional<Fields> attributes = primitive.object("attributes");
        if (!attributes || attributes->find("POSITION") == nullptr)
            primitive.refuse_key("attributes.POSITION", "missing: expected an accessor in a tagged primitive");
        for (const char *name : attribute_names)
            if (const auto accessor = attributes->index(name, accessors_.size(), "accessors")) {
                kept["attributes"][name] = *accessor;
                keep_accessor(*accessor);
            }
    }

    void keep_accessor(uint32_t i) {
        if (done_accessors_[i])
            return;
        done_accessors_[i] = true;
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
        accessors_[i] = std::move(kept);
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
            copy_whole(to, *from, "byteOffset");
            if (part == "indices")
                copy_component_type(to, *from);
        }
        return kept;
    }

    void keep_view_of(Json &kept, const Fields &from) {
        const auto view = from.index("bufferView", views_.size(), "bufferViews");
        if (!view)
            return;
        kept["bufferView"] = *view;
        if (!done_views_[*view])
            keep_view(*view);
        done_views_[*view] = true;
    }

    void keep_view(uint32_t i) {
        const Fields view = at("bufferViews", "bufferView", i);
        Json kept;
        const uint32_t buffer =
            view.required(view.index("buffer", buffers_.size(), "buffers"), "buffer", "the index of a buffer");
        kept["buffer"] = buffer;
        copy_whole(kept, view, "byteOffset");
        copy_required(kept, view, "byteLength", 1, "a length in bytes");
        copy_whole(kept, view, "byteStride", 4, 252);
        if (kept.contains("byteStride") && kept["byteStride"].get<uint32_t>() % 4 != 0)
            view.refuse_value("byteStride", "a multiple of 4", *view.find("byteStride"));
        views_[i] = std::move(kept);
        if (!sources_[buffer].needed)
            keep_buffer(buffer);
    }

    void keep_buffer(uint32_t i) {
        const Fields buffer = at("buffers", "buffer", i);
        BufferSource &source = sources_[i];
        source.needed = true;
        source.byte_length = buffer.required(buffer.whole("byteLength", 1), "byteLength", "a length in bytes");
        source.uri = buffer.text("uri");
        buffers_[i]["byteLength"] = source.byte_length;
    }

    Fields root_;
    Json nodes_;
    Json meshes_;
    Json accessors_;
    Json views_;
    Json buffers_;
    std::vector<bool> done_accessors_;
    std::vector<bool> done_views_;
    std::vector<BufferSource> sources_;
};

} // namespace

Filtered filter(const Json &root, const Outline &outline) {
    return Filter(root).run(outline);
}

} // namespace knurl::gltf
