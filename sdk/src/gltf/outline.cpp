// SPDX-License-Identifier: MIT
#include "outline.hpp"
#include "hierarchy.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

namespace knurl::gltf {
namespace {

using Tags = std::map<size_t, Tag>;

/// Extensions that change neither shapes nor TEXCOORD_0: looks, lights, images (never loaded), metadata, and quantised
/// accessors, which are read like any other.
bool is_harmless(const std::string &extension) {
    static const char *const known[] = {
        "KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual",
        "KHR_xmp_json_ld",       "EXT_texture_webp",      "EXT_texture_avif",   "MSFT_texture_dds",
    };
    if (extension.rfind("KHR_materials_", 0) == 0)
        return true;
    for (const char *name : known)
        if (extension == name)
            return true;
    return false;
}

void check_asset(const Fields &root) {
    const Fields asset =
        root.required(root.object("asset"), "asset", "an object with the glTF version: is this a glTF 2.0 file?");
    const std::string *version = asset.text("version");
    if (version == nullptr)
        asset.refuse_key("version", "missing: expected '2.0'");
    if (version->rfind("2.", 0) != 0)
        asset.refuse_key("version", "expected '2.0', found " + in_quotes(*version), KNURL_ERROR_UNSUPPORTED);
    const std::string *least = asset.text("minVersion");
    if (least != nullptr && *least != "2.0")
        asset.refuse_key("minVersion", "expected '2.0', found " + in_quotes(*least), KNURL_ERROR_UNSUPPORTED);
    for (const Json &value : root.array("extensionsRequired")) {
        const std::string *name = value.text();
        if (name == nullptr)
            root.refuse_value("extensionsRequired", "an array of strings", value);
        if (!is_harmless(*name))
            root.refuse_key("extensionsRequired", "the extension " + in_quotes(*name) + " is not supported",
                            KNURL_ERROR_UNSUPPORTED);
    }
}

/// Runs a step for one tag. Returns whether it is good; a wrong one fails the load, unless the caller has a
/// callback for wrong tags.
template <typename Step>
bool is_good(const Budget &budget, const Step &step) {
    try {
        step();
        return true;
    } catch (const Failure &failure) {
        if (!budget.tell_wrong_tag(failure.what()))
            throw;
        return false;
    }
}

/// Reads every tag of the array under `key`, even of objects that the scene does not show, to report mistakes in them.
Tags read_tags(const Fields &root, const Budget &budget, const char *key, const char *kind) {
    Tags tags;
    for (size_t i = 0; i < root.array(key).size(); ++i) {
        const Fields owner = root.item(key, kind, i);
        std::optional<Tag> tag;
        if (!is_good(budget, [&] { tag = read_tag(owner); })) {
            tag.emplace();
            tag->wrong = true;
        }
        if (tag)
            tags.emplace(i, *std::move(tag));
    }
    return tags;
}

const Tag *find(const Tags &tags, std::optional<size_t> index) {
    const auto found = index ? tags.find(*index) : tags.end();
    return found == tags.end() ? nullptr : &found->second;
}

/// A mesh's primitives, the same for all nodes that show it.
struct MeshPlan {
    std::vector<std::optional<uint32_t>> materials; ///< of each primitive
    std::vector<uint32_t> tagged;                   ///< primitives that carry a tag by material or mesh
};

class Reader {
  public:
    Reader(const Fields &root, Budget &budget) : root_(root), budget_(budget) {}

    Outline read() {
        check_asset(root_);
        Hierarchy hierarchy = read_hierarchy(root_);
        materials_ = read_tags(root_, budget_, "materials", "material");
        meshes_ = read_tags(root_, budget_, "meshes", "mesh");
        nodes_ = read_tags(root_, budget_, "nodes", "node");
        refuse_lost_tags();
        check_count(hierarchy.shown);
        for (const uint32_t node : hierarchy.shown) {
            show(node);
            budget_.step();
        }
        outline_.parents = std::move(hierarchy.parents);
        return std::move(outline_);
    }

  private:
    void refuse_lost_tags() const {
        refuse_lost(root_, "tag a material, mesh or node");
        for (size_t i = 0; i < root_.array("scenes").size(); ++i)
            refuse_lost(root_.item("scenes", "scene", i), "tag a material, mesh or node");
        for (const auto &[index, tag] : nodes_)
            if (root_.item("nodes", "node", index).find("mesh") == nullptr)
                refuse_lost(root_.item("nodes", "node", index),
                            "the node shows no mesh; tag nodes below it that do, their meshes or materials");
    }

    void refuse_lost(const Fields &owner, const char *instead) const {
        (void)is_good(budget_, [&] { refuse_tag(owner, instead); });
    }

    const MeshPlan &plan(uint32_t index) {
        const auto known = plans_.find(index);
        if (known != plans_.end())
            return known->second;
        MeshPlan made;
        const Fields mesh = root_.item("meshes", "mesh", index);
        const bool mesh_tagged = find(meshes_, index) != nullptr;
        for (size_t i = 0; i < mesh.array("primitives").size(); ++i) {
            const Fields primitive = mesh.element("primitives", i);
            refuse_lost(primitive, "tag the mesh, its node or a material");
            const auto material = primitive.index("material", root_.array("materials").size(), "materials");
            made.materials.push_back(material);
            if (mesh_tagged || find(materials_, material) != nullptr)
                made.tagged.push_back(static_cast<uint32_t>(i));
        }
        if (made.materials.empty() && mesh_tagged)
            mesh.refuse_key("primitives", "missing: expected at least one in a tagged mesh");
        return plans_.emplace(index, std::move(made)).first->second;
    }

    std::optional<uint32_t> mesh_of(uint32_t node) const {
        return root_.item("nodes", "node", node).index("mesh", root_.array("meshes").size(), "meshes");
    }

    /// Counts before making instances: nodes times primitives may not fit into memory.
    void check_count(const std::vector<uint32_t> &shown) {
        uint64_t total = 0;
        for (const uint32_t node : shown)
            if (const auto mesh = mesh_of(node)) {
                const MeshPlan &shape = plan(*mesh);
                total += find(nodes_, node) != nullptr ? shape.materials.size() : shape.tagged.size();
            }
        budget_.take_surfaces(total);
    }

    void show(uint32_t index) {
        const Fields node = root_.item("nodes", "node", index);
        const std::optional<uint32_t> mesh = mesh_of(index);
        if (!mesh)
            return;
        const MeshPlan &shape = plan(*mesh);
        const bool all = find(nodes_, index) != nullptr;
        const size_t count = all ? shape.materials.size() : shape.tagged.size();
        for (size_t i = 0; i < count; ++i)
            add(node, index, *mesh, all ? static_cast<uint32_t>(i) : shape.tagged[i], shape);
        const size_t room = std::numeric_limits<uint32_t>::max() - outline_.skipped;
        outline_.skipped += static_cast<uint32_t>(std::min(room, shape.materials.size() - count));
    }

    void add(const Fields &node, uint32_t index, uint32_t mesh_index, uint32_t primitive, const MeshPlan &shape) {
        const Fields mesh = root_.item("meshes", "mesh", mesh_index);
        const std::optional<uint32_t> material_index = shape.materials[primitive];
        Instance instance;
        instance.node = index;
        instance.mesh = mesh_index;
        instance.primitive = primitive;
        for (const Tag *tag : {find(materials_, material_index), find(meshes_, mesh_index), find(nodes_, index)})
            if (tag != nullptr)
                instance.tag.override_with(*tag);
        if (instance.tag.wrong || !is_good(budget_, [&] { check(instance, node, mesh, material_index); })) {
            outline_.skipped += outline_.skipped < std::numeric_limits<uint32_t>::max() ? 1 : 0;
            return;
        }
        if (material_index)
            instance.double_sided =
                root_.item("materials", "material", *material_index).flag("doubleSided").value_or(false);
        instance.name = surface_name(node, index, mesh, primitive, material_index, shape.materials.size());
        outline_.instances.push_back(std::move(instance));
    }

    /// Whether a tagged primitive has all that a surface needs.
    void check(const Instance &instance, const Fields &node, const Fields &mesh,
               std::optional<uint32_t> material_index) const {
        if (const char *key = instance.tag.missing_key())
            refuse(where_of(root_, instance),
                   std::string("knurl.") + key + ": missing: expected in extras of " +
                       (material_index ? root_.item("materials", "material", *material_index).where() + ", " : "") +
                       mesh.where() + " or " + node.where());
        if (node.find("skin") != nullptr)
            refuse(where_of(root_, instance), "skin: a tagged mesh cannot be skinned", KNURL_ERROR_UNSUPPORTED);
        if (mesh.element("primitives", instance.primitive).array("targets").size() > 0)
            refuse(where_of(root_, instance), "targets: a tagged mesh cannot have morph targets",
                   KNURL_ERROR_UNSUPPORTED);
    }

    /// Does not depend on other tags, so that scripts can rely on the name.
    std::string surface_name(const Fields &node, uint32_t index, const Fields &mesh, uint32_t primitive,
                             std::optional<uint32_t> material, size_t primitives) const {
        std::string name = shortened(!node.name().empty() ? node.name() : mesh.name(), name_part_max);
        if (name.empty())
            name = "node " + std::to_string(index);
        if (primitives < 2)
            return name;
        const std::string_view part =
            material ? root_.item("materials", "material", *material).name() : std::string_view();
        return name + " / " +
               (part.empty() ? "primitive " + std::to_string(primitive) : shortened(part, name_part_max));
    }

    const Fields &root_;
    Budget &budget_;
    Tags materials_;
    Tags meshes_;
    Tags nodes_;
    std::unordered_map<uint32_t, MeshPlan> plans_;
    Outline outline_;
};

} // namespace

Outline read_outline(const Fields &root, Budget &budget) {
    return Reader(root, budget).read();
}

std::string where_of(const Fields &root, const Instance &instance) {
    return root.item("nodes", "node", instance.node).where() + ", " +
           root.item("meshes", "mesh", instance.mesh).where() + ", primitive " + std::to_string(instance.primitive);
}

} // namespace knurl::gltf
