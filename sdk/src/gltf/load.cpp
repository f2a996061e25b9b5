// Knurl: the C functions of the glTF loader. No exception leaves them. If a load fails, the scene is unchanged.
// SPDX-License-Identifier: MIT
#include <knurl/gltf.h>
#include <knurl/query.h>

#include "file/container.hpp"
#include "filter.hpp"
#include "guarded.hpp"
#include "placement.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

namespace fs = std::filesystem;

namespace knurl::gltf {
namespace {

/// The surfaces added by one load; removed by the destructor unless keep() was called.
class Addition {
  public:
    explicit Addition(knurl_scene *scene) : scene_(scene) {}
    Addition(const Addition &) = delete;
    Addition &operator=(const Addition &) = delete;
    ~Addition() {
        for (; !added_.empty(); added_.pop_back())
            (void)knurl_scene_remove_surface(scene_, added_.back());
    }
    /// The new surface's id.
    knurl_surface_id add(const knurl_surface_desc &desc, const std::string &where) {
        added_.push_back(0); // before the surface is added, because this may throw
        const knurl_result result = knurl_scene_add_surface(scene_, &desc, &added_.back());
        if (result == KNURL_OK)
            return added_.back();
        added_.pop_back();
        refuse(where, knurl_error_message(), result);
    }
    uint32_t keep() {
        const auto count = static_cast<uint32_t>(added_.size());
        added_.clear();
        return count;
    }

  private:
    knurl_scene *scene_;
    std::vector<knurl_surface_id> added_;
};

/// Makes surfaces' names unique.
class Names {
  public:
    /// Starts with the names of the scene's surfaces.
    explicit Names(const knurl_scene *scene) {
        for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene); ++i) {
            char name[KNURL_NAME_SIZE]; // not cut if it can be a file's, which has at most 255 bytes
            if (knurl_scene_get_surface_name(scene, knurl_scene_get_surface(scene, i), name) == KNURL_OK)
                taken_.emplace(name, 1);
        }
    }

    /// Returns `name`, with " (2)", " (3)", ... appended if it is taken, and marks the result as taken.
    std::string unique(const std::string &name) {
        uint32_t &tried = taken_[name];
        std::string candidate = name;
        while (tried != 0 && taken_.count(candidate) != 0)
            candidate = name + " (" + std::to_string(++tried) + ")";
        if (tried == 0)
            tried = 1;
        taken_.emplace(candidate, 1);
        return candidate;
    }

  private:
    /// A tree, not a hash table, which a hostile file could make slow by its choice of names.
    std::map<std::string, uint32_t> taken_; ///< name to the highest number tried
};

knurl_material_desc material_of(const Tag &tag) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = tag.method.value_or(KNURL_METHOD_DEFAULT);
    // The outline has checked that the first three are present.
    const auto frequency = tag.spatial_frequency.value_or(std::array<double, 2>{});
    std::copy(frequency.begin(), frequency.end(), material.spatial_frequency);
    material.amplitude = tag.amplitude.value_or(0.0);
    material.stiffness = tag.stiffness.value_or(0.0);
    material.damping = tag.damping.value_or(0.0);
    material.friction = tag.friction.value_or(0.0);
    material.orientation = tag.orientation.value_or(0.0);
    return material;
}

knurl_mesh_desc mesh_of(const Geometry &geometry) {
    knurl_mesh_desc mesh;
    knurl_mesh_desc_init(&mesh, sizeof mesh);
    mesh.vertex_count = static_cast<uint32_t>(geometry.positions.size() / 3);
    mesh.positions = geometry.positions.data();
    mesh.normals = geometry.normals.empty() ? nullptr : geometry.normals.data();
    mesh.tangents = geometry.tangents.empty() ? nullptr : geometry.tangents.data();
    mesh.uvs = geometry.uvs.empty() ? nullptr : geometry.uvs.data();
    mesh.indices = geometry.indices.data();
    mesh.index_count = geometry.indices.size();
    return mesh;
}

int32_t smooth_of(const Tag &tag) {
    return !tag.smooth ? KNURL_SMOOTH_AUTO : *tag.smooth ? KNURL_SMOOTH_ON : KNURL_SMOOTH_OFF;
}

/// Identifies a shape: the primitive's place, the baked transform, the axis (0, 0, 0: no axis), the coordinates, and
/// whether it is smooth.
using ShapeKey = std::array<double, 15>;

ShapeKey key_of(const Instance &instance, uint32_t primitive, const Frame &frame) {
    ShapeKey key{static_cast<double>(primitive)};
    const std::array<double, 9> baked = bake_key(frame);
    std::copy(baked.begin(), baked.end(), key.begin() + 1);
    if (const auto &axis = instance.tag.axis)
        std::copy(axis->begin(), axis->end(), key.begin() + 10);
    key[13] = instance.tag.coordinates.value_or(KNURL_COORDINATES_AUTO);
    key[14] = smooth_of(instance.tag);
    return key;
}

/// A shape shown by one or more nodes.
struct Shape {
    uint64_t triangles = 0;
    knurl_surface_id first = 0; ///< the first surface with this shape; 0: not made yet
};

/// One instance's frame and shape.
struct Plan {
    Frame frame;
    Shape *shape = nullptr;
};

/// Makes surfaces from an outline. Counts everything before reading any of it.
class Maker {
  public:
    Maker(const Fields &root, const Outline &outline, const Model &model, Budget &budget, knurl_scene *scene)
        : root_(root), outline_(outline), model_(model), budget_(budget), scene_(scene) {}

    uint32_t run() {
        plan();
        Names names(scene_);
        Addition addition(scene_);
        uint64_t made = 0;
        for (size_t i = 0; i < plans_.size(); ++i) {
            Shape &shape = *plans_[i].shape;
            made += shape.first == 0 ? shape.triangles : 0;
            add(addition, i, names.unique(outline_.instances[i].name));
            budget_.step(read_done + (1.0 - read_done) * static_cast<double>(made) / static_cast<double>(triangles_));
        }
        return addition.keep();
    }

  private:
    static constexpr double read_done = 0.25; ///< progress when JSON and buffers are read

    void plan() {
        Placement placement(model_, outline_.parents);
        budget_.step(read_done);
        for (size_t i = 0; i < outline_.instances.size(); ++i) {
            const Instance &instance = outline_.instances[i];
            const uint32_t place = model_.instance_primitives[i];
            const Frame frame = placement.frame(instance.node);
            const auto [known, fresh] = shapes_.try_emplace(key_of(instance, place, frame));
            if (fresh) {
                const std::string where = where_of(root_, instance);
                const GeometryCount count = count_geometry(model_, model_.primitives[place], where);
                budget_.take_shape(count.elements, count.triangles, where);
                known->second.triangles = count.triangles;
                triangles_ += count.triangles;
            }
            plans_.push_back({frame, &known->second});
            budget_.step();
        }
    }

    void add(Addition &addition, size_t i, const std::string &name) {
        const Instance &instance = outline_.instances[i];
        const Plan &plan = plans_[i];
        const std::string where = where_of(root_, instance);
        const knurl_material_desc material = material_of(instance.tag);
        knurl_surface_desc surface;
        knurl_surface_desc_init(&surface, sizeof surface);
        surface.double_sided = instance.double_sided ? 1 : 0;
        surface.name = name.c_str();
        surface.material = &material;
        for (int axis = 0; axis < 3; ++axis)
            surface.position[axis] = plan.frame.position[axis];
        surface.rotation[0] = plan.frame.rotation.x;
        surface.rotation[1] = plan.frame.rotation.y;
        surface.rotation[2] = plan.frame.rotation.z;
        surface.rotation[3] = plan.frame.rotation.w;
        surface.shape_of = plan.shape->first;
        if (surface.shape_of != 0)
            (void)addition.add(surface, where);
        else
            plan.shape->first = add_shape(addition, i, surface, where);
    }

    /// Makes a shape for the first instance that needs it.
    knurl_surface_id add_shape(Addition &addition, size_t i, knurl_surface_desc surface, const std::string &where) {
        const Frame &frame = plans_[i].frame;
        const tinygltf::Primitive &from = model_.primitives[model_.instance_primitives[i]];
        Geometry geometry = read_geometry(model_, from, where);
        bake(geometry, frame, where, from.attributes.at("POSITION"));
        const knurl_mesh_desc mesh = mesh_of(geometry);
        surface.mesh = &mesh;
        if (const auto &axis = outline_.instances[i].tag.axis) {
            const glm::dvec3 turned = glm::normalize(frame.bake * glm::dvec3((*axis)[0], (*axis)[1], (*axis)[2]));
            for (int k = 0; k < 3; ++k)
                surface.axis[k] = turned[k];
        }
        surface.coordinates = outline_.instances[i].tag.coordinates.value_or(KNURL_COORDINATES_AUTO);
        surface.smooth = smooth_of(outline_.instances[i].tag);
        return addition.add(surface, where);
    }

    const Fields &root_;
    const Outline &outline_;
    const Model &model_;
    Budget &budget_;
    knurl_scene *scene_;
    std::map<ShapeKey, Shape> shapes_;
    std::vector<Plan> plans_; ///< one per instance
    uint64_t triangles_ = 0;
};

knurl_gltf_report add_surfaces(knurl_scene *scene, Bytes bytes, std::optional<fs::path> folder, Budget &budget) {
    const Container container = split(bytes);
    const Json json = parse_json(container.json, budget);
    const Fields root(json, "", no_index);
    const Outline outline = read_outline(root, budget);
    knurl_gltf_report report{};
    report.skipped = outline.skipped;
    if (outline.instances.empty())
        return report; // do not read buffers for nothing
    Model model = filter(root, outline);
    load_buffers(model, {container.bin, std::move(folder), &budget});
    report.surfaces = Maker(root, outline, model, budget, scene).run();
    return report;
}

/// least: the struct's size in version 0.1.
void check_size(uint32_t size, uint32_t least, const char *type) {
    if (size < least || size > 65536)
        throw Failure(KNURL_ERROR_ARGUMENT, std::string(type) + ".struct_size: expected the value set by " + type +
                                                "_init(), found " + std::to_string(size));
}

/// The caller's options, which may be shorter or longer: 0 in fields that the caller's version does not have.
knurl_gltf_options complete(const knurl_gltf_options *options) {
    knurl_gltf_options all{};
    if (options == nullptr)
        return all;
    const uint32_t size = options->struct_size;
    check_size(size, 8, "knurl_gltf_options");
    const auto *bytes = reinterpret_cast<const unsigned char *>(options);
    for (size_t i = sizeof all; i < size; ++i)
        if (bytes[i] != 0)
            throw Failure(KNURL_ERROR_UNSUPPORTED, "knurl_gltf_options: byte " + std::to_string(i) +
                                                       " is set, but this version supports only " +
                                                       std::to_string(sizeof all) + " bytes of it");
    std::memcpy(&all, options, std::min<size_t>(size, sizeof all));
    return all;
}

/// Runs `load` with the caller's options, and fills the report.
template <typename Load>
knurl_result load_guarded(const char *name, const knurl_gltf_options *options, knurl_gltf_report *report,
                          const Load &load) {
    return guarded(name, [&] {
        Budget budget(complete(options));
        if (report != nullptr)
            check_size(report->struct_size, 16, "knurl_gltf_report");
        const knurl_gltf_report counts = load(budget);
        if (report != nullptr) {
            report->surfaces = counts.surfaces;
            report->skipped = counts.skipped;
        }
    });
}

template <typename T>
void init(T *made, uint32_t size, const char *name) {
    if (is_null(made, name) || size < sizeof made->struct_size)
        return;
    std::memset(made, 0, size);
    made->struct_size = size;
}

bool has_gltf_name(const fs::path &path) {
    std::string extension = path.extension().u8string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return extension == ".gltf" || extension == ".glb";
}

} // namespace
} // namespace knurl::gltf

using knurl::gltf::Failure;
using knurl::gltf::is_null;

void knurl_gltf_options_init(knurl_gltf_options *options, uint32_t size) {
    knurl::gltf::init(options, size, "options");
}

void knurl_gltf_report_init(knurl_gltf_report *report, uint32_t size) {
    knurl::gltf::init(report, size, "report");
}

knurl_result knurl_gltf_load_file(knurl_scene *scene, const char *path, const knurl_gltf_options *options,
                                  knurl_gltf_report *report) {
    if (is_null(path, "path") || knurl_scene_get_bytes(scene) == 0) // 0 for an invalid scene, with a message
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::load_guarded(path, options, report, [&](knurl::gltf::Budget &budget) {
        const fs::path file = fs::u8path(path);
        if (!knurl::gltf::has_gltf_name(file))
            throw Failure(KNURL_ERROR_FORMAT, "expected a name that ends in .gltf or .glb");
        const std::vector<unsigned char> bytes = knurl::gltf::read_file(file, budget);
        budget.tell_read(file);
        return knurl::gltf::add_surfaces(scene, {bytes.data(), bytes.size()}, file.parent_path(), budget);
    });
}

knurl_result knurl_gltf_load_memory(knurl_scene *scene, const void *data, uint64_t size, const char *name,
                                    const char *folder, const knurl_gltf_options *options, knurl_gltf_report *report) {
    if ((size != 0 && is_null(data, "data")) || knurl_scene_get_bytes(scene) == 0)
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::load_guarded(name, options, report, [&](knurl::gltf::Budget &budget) {
        budget.take_bytes(size, "");
        std::optional<fs::path> root;
        if (folder != nullptr)
            root = fs::u8path(folder);
        return knurl::gltf::add_surfaces(scene, {static_cast<const unsigned char *>(data), static_cast<size_t>(size)},
                                         std::move(root), budget);
    });
}
