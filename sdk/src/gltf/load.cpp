// Knurl: the C edge of the glTF room. No exception leaves it, and a scene gets all surfaces or none.
// SPDX-License-Identifier: MIT
#include <knurl/gltf.h>

#include "container.hpp"
#include "model.hpp"
#include "names.hpp"
#include "placement.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <new>

namespace fs = std::filesystem;

namespace knurl::gltf {
namespace {

/// The surfaces that one load added; takes them out again unless it is kept.
class Addition {
  public:
    explicit Addition(knurl_scene *scene) : scene_(scene) {}
    Addition(const Addition &) = delete;
    Addition &operator=(const Addition &) = delete;
    ~Addition() {
        for (; !added_.empty(); added_.pop_back())
            (void)knurl_scene_remove_surface(scene_, added_.back());
    }
    void add(const knurl_surface_desc &desc, const std::string &where) {
        added_.push_back(0); // before the surface is there: this may throw
        const knurl_result result = knurl_scene_add_surface(scene_, &desc, &added_.back());
        if (result == KNURL_OK)
            return;
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

knurl_material_desc material_of(const Tag &tag) {
    knurl_material_desc material;
    knurl_material_desc_init(&material, sizeof material);
    material.method = tag.method.value_or(KNURL_METHOD_DEFAULT);
    // The outline saw to it that the first three are there.
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
    mesh.tangents = geometry.tangents.empty() ? nullptr : geometry.tangents.data();
    mesh.uvs = geometry.uvs.empty() ? nullptr : geometry.uvs.data();
    mesh.indices = geometry.indices.data();
    mesh.index_count = geometry.indices.size();
    return mesh;
}

void add_instance(Addition &addition, const Instance &instance, const std::string &name, const Geometry &geometry,
                  const Frame &frame, const std::string &where) {
    const knurl_mesh_desc mesh = mesh_of(geometry);
    const knurl_material_desc material = material_of(instance.tag);
    knurl_surface_desc surface;
    knurl_surface_desc_init(&surface, sizeof surface);
    surface.double_sided = instance.double_sided ? 1 : 0;
    surface.name = name.c_str();
    surface.mesh = &mesh;
    surface.material = &material;
    for (int i = 0; i < 3; ++i)
        surface.position[i] = frame.position[i];
    surface.rotation[0] = frame.rotation.x;
    surface.rotation[1] = frame.rotation.y;
    surface.rotation[2] = frame.rotation.z;
    surface.rotation[3] = frame.rotation.w;
    if (const auto &axis = instance.tag.axis) {
        const glm::dvec3 turned = glm::normalize(frame.bake * glm::dvec3((*axis)[0], (*axis)[1], (*axis)[2]));
        for (int i = 0; i < 3; ++i)
            surface.axis[i] = turned[i];
    } else if (geometry.tangents.empty() && geometry.uvs.empty()) {
        refuse(where, "knurl.axis: missing: expected one (3 numbers, the grating's x in object space), for the "
                      "primitive has neither TANGENT nor TEXCOORD_0: add an axis to the tag, or UVs to the mesh");
    }
    addition.add(surface, where);
}

knurl_gltf_report add_surfaces(knurl_scene *scene, Bytes bytes, std::optional<fs::path> folder,
                               const Listener &listener) {
    const Container container = split(bytes);
    const nlohmann::json root = parse_json(container.json);
    const Outline outline = read_outline(root);
    knurl_gltf_report report{};
    report.skipped = outline.skipped;
    if (outline.instances.empty())
        return report; // no buffer is read for nothing
    const tinygltf::Model model = load_model(filter(root, outline), {container.bin, std::move(folder), listener});
    Placement placement(model, outline.parents);
    Names names(scene);
    Addition addition(scene);
    uint64_t triangles = 0;
    for (const Instance &instance : outline.instances) {
        const std::string where = where_of(root, instance);
        const Frame frame = placement.frame(instance.node);
        const tinygltf::Primitive &primitive = model.meshes.at(instance.mesh).primitives.at(instance.primitive);
        Geometry geometry = read_geometry(model, primitive, where);
        triangles += geometry.indices.size() / 3;
        if (triangles > triangles_max)
            refuse(where, "all surfaces together: expected at most " + std::to_string(triangles_max) + " triangles");
        bake(geometry, frame, where);
        add_instance(addition, instance, names.unique(instance.name), geometry, frame, where);
    }
    report.surfaces = addition.keep();
    return report;
}

/// What a report held in version 0.1; callers of that version know no more.
constexpr uint32_t report_size_first = 16;

Listener listener_of(const knurl_gltf_report *report) {
    return report != nullptr && report->struct_size >= sizeof *report ? Listener{report->file_read, report->user}
                                                                      : Listener{};
}

/// Runs `load` and turns what it throws into a result and a message that starts with the file's name.
template <typename Load>
knurl_result guarded(const char *name, knurl_gltf_report *report, const Load &load) {
    const char *file = name != nullptr && *name != '\0' ? name : "glTF data";
    try {
        if (report != nullptr && (report->struct_size < report_size_first || report->struct_size > 65536))
            return knurl_fail(KNURL_ERROR_ARGUMENT,
                              "knurl_gltf_report.struct_size: expected what knurl_gltf_report_init() sets, found %u",
                              report->struct_size);
        const Listener listener = listener_of(report);
        knurl_gltf_report made = load(listener);
        if (report != nullptr) {
            made.struct_size = report->struct_size;
            made.file_read = listener.file_read;
            made.user = listener.user;
            std::memcpy(report, &made, std::min<size_t>(made.struct_size, sizeof made));
        }
        return KNURL_OK;
    } catch (const Failure &failure) {
        return knurl_fail(failure.code(), "%.400s: %s", file, failure.what());
    } catch (const std::bad_alloc &) {
        return knurl_fail(KNURL_ERROR_MEMORY, "%.400s: memory could not be had", file);
    } catch (const std::exception &error) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%.400s: %s", file, error.what());
    } catch (...) {
        return knurl_fail(KNURL_ERROR_FORMAT, "%.400s: an unknown failure", file);
    }
}

bool is_null(const void *pointer, const char *name) {
    if (pointer == nullptr)
        (void)knurl_fail(KNURL_ERROR_ARGUMENT, "%s: expected a pointer, found null", name);
    return pointer == nullptr;
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

void knurl_gltf_report_init(knurl_gltf_report *report, uint32_t size) {
    if (is_null(report, "report") || size < sizeof report->struct_size)
        return;
    std::memset(report, 0, size);
    report->struct_size = size;
}

knurl_result knurl_gltf_load_file(knurl_scene *scene, const char *path, knurl_gltf_report *report) {
    if (is_null(path, "path") ||
        knurl_scene_get_bytes(scene) == 0) // which says what is wrong with a scene that has none
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::guarded(path, report, [&](const knurl::gltf::Listener &listener) {
        const fs::path file = fs::u8path(path);
        if (!knurl::gltf::has_gltf_name(file))
            throw Failure(KNURL_ERROR_FORMAT, "expected a name that ends in .gltf or .glb");
        const std::vector<unsigned char> bytes = knurl::gltf::read_file(file);
        listener.tell(file);
        return knurl::gltf::add_surfaces(scene, {bytes.data(), bytes.size()}, file.parent_path(), listener);
    });
}

knurl_result knurl_gltf_load_memory(knurl_scene *scene, const void *data, uint64_t size, const char *name,
                                    const char *folder, knurl_gltf_report *report) {
    if ((size != 0 && is_null(data, "data")) || knurl_scene_get_bytes(scene) == 0)
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::guarded(name, report, [&](const knurl::gltf::Listener &listener) {
        if (size > knurl::gltf::bytes_max)
            throw Failure(KNURL_ERROR_IO, "expected at most 1 GiB, found " + std::to_string(size) + " bytes");
        std::optional<fs::path> root;
        if (folder != nullptr)
            root = fs::u8path(folder);
        return knurl::gltf::add_surfaces(scene, {static_cast<const unsigned char *>(data), static_cast<size_t>(size)},
                                         std::move(root), listener);
    });
}
