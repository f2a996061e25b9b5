// Knurl: the pictures of a material, as the bytes of their files. They are not decoded.
// SPDX-License-Identifier: MIT
#include <knurl/gltf.h>

#include "file/container.hpp"
#include "filter.hpp"
#include "guarded.hpp"

#include <cmath>

namespace knurl::gltf {
namespace {

/// Reads the pictures of one material.
class Textures {
  public:
    Textures(const Fields &root, const Resources &resources, knurl_gltf_texture_callback each, void *user)
        : root_(root), resources_(resources), each_(each), user_(user) {}

    void read(const Fields &material) {
        tell(material.object("normalTexture"), "normal");
        tell(material.object("occlusionTexture"), "occlusion");
        if (const auto colours = material.object("pbrMetallicRoughness"))
            tell(colours->object("baseColorTexture"), "base colour");
    }

  private:
    void tell(const std::optional<Fields> &info, const char *use) {
        if (!info)
            return;
        knurl_gltf_texture texture{};
        texture.struct_size = sizeof texture;
        texture.use = use;
        texture.texcoord = info->whole("texCoord").value_or(0);
        texture.scale = number(*info, "scale", 1.0);
        place(*info, texture);
        std::string name;
        std::string problem;
        try {
            const Bytes bytes = image_of(*info, name);
            texture.data = bytes.data;
            texture.size = bytes.size;
        } catch (const Failure &failure) {
            if (failure.code() == KNURL_ERROR_FULL)
                throw;
            problem = failure.what();
            texture.problem = problem.c_str();
        }
        texture.name = name.c_str();
        each_(user_, &texture);
    }

    static double number(const Fields &from, const char *key, double otherwise) {
        const Json *value = from.find(key);
        if (value == nullptr)
            return otherwise;
        const std::optional<double> found = value->number(); // finite: JSON has no other numbers
        if (!found)
            from.refuse_value(key, "a number", *value);
        return *found;
    }

    /// KHR_texture_transform. Its text's matrix turns the wrong way; Babylon, three.js and Blender agree on this one:
    /// counter-clockwise as UVs are drawn, with v down.
    static void place(const Fields &info, knurl_gltf_texture &texture) {
        std::vector<double> scale{1.0, 1.0};
        double turn = 0.0;
        const auto extensions = info.object("extensions");
        if (const auto transform = extensions ? extensions->object("KHR_texture_transform") : std::nullopt) {
            if (const std::vector<double> given = transform->numbers("scale", 2); !given.empty())
                scale = given;
            turn = number(*transform, "rotation", 0.0);
            texture.texcoord = transform->whole("texCoord").value_or(texture.texcoord);
        }
        const double cosine = std::cos(turn);
        const double sine = std::sin(turn);
        texture.from_uv[0][0] = cosine * scale[0];
        texture.from_uv[0][1] = sine * scale[1];
        texture.from_uv[1][0] = -sine * scale[0];
        texture.from_uv[1][1] = cosine * scale[1];
    }

    /// A texture's image; its extensions' if there is no plain one, so that a reader of pictures can name the format.
    std::optional<uint32_t> image_index(const Fields &texture) const {
        const size_t count = root_.array("images").size();
        const auto extensions = texture.object("extensions");
        std::optional<uint32_t> image = texture.index("source", count, "images");
        for (const char *key : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"})
            if (const auto other = extensions ? extensions->object(key) : std::nullopt; other && !image)
                image = other->index("source", count, "images");
        return image;
    }

    Bytes image_of(const Fields &info, std::string &name) {
        const uint32_t index = info.required(info.index("index", root_.array("textures").size(), "textures"), "index",
                                             "the index of a texture");
        const Fields texture = root_.item("textures", "texture", index);
        const uint32_t number = texture.required(image_index(texture), "source", "the index of an image");
        const Fields image = root_.item("images", "image", number);
        const std::string *uri = image.text("uri");
        name = !image.name().empty()                           ? shortened(image.name())
               : uri != nullptr && uri->rfind("data:", 0) != 0 ? shortened(*uri)
                                                               : "image " + std::to_string(number);
        if (uri != nullptr)
            return sources_.read_all(*uri, uri->size(), resources_, image.where());
        return view_of(image);
    }

    Bytes view_of(const Fields &image) {
        const Fields view =
            root_.item("bufferViews", "bufferView",
                       image.required(image.index("bufferView", root_.array("bufferViews").size(), "bufferViews"),
                                      "bufferView", "a bufferView or a uri"));
        const uint32_t number = view.required(view.index("buffer", root_.array("buffers").size(), "buffers"), "buffer",
                                              "the index of a buffer");
        const Bytes bytes = read_buffer(static_cast<int>(number), buffer_source(root_, number), resources_, sources_);
        const uint64_t begin = view.whole("byteOffset").value_or(0);
        const uint32_t length = view.required(view.whole("byteLength", 1), "byteLength", "a length in bytes");
        if (begin + length > bytes.size)
            view.refuse_key("byteLength", "ends at byte " + std::to_string(begin + length) + " of a buffer of " +
                                              std::to_string(bytes.size) + " bytes");
        return {bytes.data + begin, length};
    }

    const Fields &root_;
    Resources resources_;
    knurl_gltf_texture_callback each_;
    void *user_;
    Sources sources_;
};

uint32_t material_of_mesh(const Fields &root, const Fields &mesh) {
    std::optional<uint32_t> found;
    for (size_t i = 0; i < mesh.array("primitives").size(); ++i) {
        const auto material =
            mesh.element("primitives", i).index("material", root.array("materials").size(), "materials");
        if (!material || (found && *material != *found))
            mesh.refuse_key("primitives", "expected one material for all of them: name the material instead");
        found = material;
    }
    return mesh.required(found, "primitives", "at least one");
}

Fields material_of(const Fields &root, std::string_view array, uint32_t index) {
    if (array == "materials")
        return root.chosen("materials", "material", index);
    if (array == "nodes") {
        const Fields node = root.chosen("nodes", "node", index);
        index = node.required(node.index("mesh", root.array("meshes").size(), "meshes"), "mesh", "a mesh with UVs");
    } else if (array != "meshes") {
        throw Failure(KNURL_ERROR_ARGUMENT,
                      "array: expected 'materials', 'meshes' or 'nodes', found " + in_quotes(array));
    }
    return root.item("materials", "material", material_of_mesh(root, root.chosen("meshes", "mesh", index)));
}

void read_textures(Bytes file, std::optional<std::filesystem::path> folder, const char *array, uint32_t index,
                   knurl_gltf_texture_callback each, void *user) {
    Budget budget({});
    budget.take_bytes(file.size, "");
    const Container container = split(file);
    const Json json = parse_json(container.json, budget);
    const Fields root(json, "", no_index);
    Textures(root, {container.bin, std::move(folder), &budget}, each, user).read(material_of(root, array, index));
}

} // namespace
} // namespace knurl::gltf

knurl_result knurl_gltf_read_textures(const void *data, uint64_t size, const char *name, const char *folder,
                                      const char *array, uint32_t index, knurl_gltf_texture_callback each, void *user) {
    if ((size != 0 && knurl::gltf::is_null(data, "data")) || knurl::gltf::is_null(array, "array") ||
        knurl::gltf::is_null(each, "each"))
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::guarded(name, [&] {
        std::optional<std::filesystem::path> root;
        if (folder != nullptr)
            root = std::filesystem::u8path(folder);
        knurl::gltf::read_textures({static_cast<const unsigned char *>(data), static_cast<size_t>(size)},
                                   std::move(root), array, index, each, user);
    });
}
