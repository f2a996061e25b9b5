// Small glTF files made by the tests that load them, and the loading itself.
// SPDX-License-Identifier: MIT
#ifndef KNURL_TESTS_GLTF_BUILDER_HPP
#define KNURL_TESTS_GLTF_BUILDER_HPP

#include <knurl/gltf.h>
#include <knurl/hip.h>
#include <knurl/query.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "support/suite.h"

namespace builder {

/** A tag that has all that is required; more keys behind it. */
inline std::string tag(const std::string &more = "") {
    return R"("extras":{"knurl":{"version":1,"spatial_frequency":[1000,0],"amplitude":0.0005,"stiffness":400)" +
           (more.empty() ? "" : "," + more) + "}}";
}

enum Type { BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126 };

/** A file in pieces, each the JSON text inside an array's brackets; binary data is collected by the adding functions.
 */
struct File {
    std::string nodes = R"({"mesh":0})";
    std::string meshes;
    std::string materials = "{" + tag() + "}";
    std::string views;
    std::string accessors;
    std::string buffers; ///< made from bin if empty
    std::string more;    ///< further members of the root: ,"scene":0
    std::string asset = R"("asset":{"version":"2.0"})";
    std::string bin;
    int view_count = 0;
    int accessor_count = 0;

    static void append(std::string &list, const std::string &item) {
        list += (list.empty() ? "" : ",") + item;
    }

    /** Bytes as a bufferView of their own, 4-byte aligned; its index. */
    template <typename T>
    int view(const std::vector<T> &values, const std::string &extra = "") {
        bin.resize((bin.size() + 3) / 4 * 4);
        append(views, R"({"buffer":0,"byteOffset":)" + std::to_string(bin.size()) + R"(,"byteLength":)" +
                          std::to_string(values.size() * sizeof(T)) + extra + "}");
        bin.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T));
        return view_count++;
    }

    /** An accessor from its text; its index. */
    int accessor(const std::string &text) {
        append(accessors, "{" + text + "}");
        return accessor_count++;
    }

    template <typename T>
    int add(Type component_type, const char *type, size_t components, const std::vector<T> &values,
            const std::string &extra = "") {
        const int index = view(values);
        return accessor(R"("bufferView":)" + std::to_string(index) + "," +
                        element(component_type, type, values.size() / components) + extra);
    }

    static std::string element(Type component_type, const char *type, size_t count) {
        return R"("componentType":)" + std::to_string(static_cast<int>(component_type)) + R"(,"type":")" + type +
               R"(","count":)" + std::to_string(count);
    }

    int vec3(const std::vector<float> &values) {
        return add(FLOAT, "VEC3", 3, values);
    }
    int vec2(const std::vector<float> &values) {
        return add(FLOAT, "VEC2", 2, values);
    }
    int shorts(const std::vector<uint16_t> &values) {
        return add(USHORT, "SCALAR", 1, values);
    }

    std::string json(const std::string &uri = "") const {
        std::string text = "{" + asset;
        const std::string sole =
            R"({"byteLength":)" + std::to_string(bin.size()) + (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}";
        member(text, "nodes", nodes);
        member(text, "meshes", meshes);
        member(text, "materials", materials);
        member(text, "accessors", accessors);
        member(text, "bufferViews", views);
        member(text, "buffers", !buffers.empty() ? buffers : bin.empty() ? "" : sole);
        return text + more + "}";
    }

    std::string glb() const;

    /** JSON with the binary data inside. */
    std::string gltf() const;

  private:
    static void member(std::string &text, const char *name, const std::string &items) {
        if (!items.empty())
            text += ",\"" + std::string(name) + "\":[" + items + "]";
    }
};

inline std::string base64(const std::string &bytes) {
    const char *digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (unsigned k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
    }
    return text;
}

inline void append_word(std::string &bytes, uint64_t value) {
    for (unsigned i = 0; i < 4; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 255U);
}

/** A .glb from its two parts; no BIN chunk if bin is empty. */
inline std::string glb(std::string json, std::string bin) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    bin.resize((bin.size() + 3) / 4 * 4);
    std::string bytes = "glTF";
    append_word(bytes, 2);
    append_word(bytes, 20 + json.size() + (bin.empty() ? 0 : 8 + bin.size()));
    append_word(bytes, json.size());
    bytes += "JSON" + json;
    if (!bin.empty()) {
        append_word(bytes, bin.size());
        bytes += std::string("BIN\0", 4) + bin;
    }
    return bytes;
}

inline std::string File::glb() const {
    return builder::glb(json(), bin);
}

inline std::string File::gltf() const {
    return json("data:application/octet-stream;base64," + base64(bin));
}

/** 0.1 m x 0.1 m in the xy plane, facing +z, with u along x; its one primitive's attributes may be followed by more. */
inline File quad(const std::string &primitive_more = R"(,"material":0)") {
    File file;
    const int positions = file.vec3({0, 0, 0, 0.1F, 0, 0, 0.1F, 0.1F, 0, 0, 0.1F, 0});
    const int uvs = file.vec2({0, 0, 1, 0, 1, 1, 0, 1});
    const int indices = file.shorts({0, 1, 2, 0, 2, 3});
    file.meshes = R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(positions) + R"(,"TEXCOORD_0":)" +
                  std::to_string(uvs) + R"(},"indices":)" + std::to_string(indices) + primitive_more + "}]}";
    return file;
}

/** A quad whose material's extras are as given. */
inline File quad_with(const std::string &extras) {
    File file = quad();
    file.materials = R"({"name":"bars","extras":)" + extras + "}";
    return file;
}

/** A mesh of positions alone, its x axis by the tag; other members of its primitive behind. */
inline File plain(File file, int positions, const std::string &primitive_more = "", const char *axis = "[1,0,0]") {
    file.materials = "{" + tag(R"("axis":)" + std::string(axis)) + "}";
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":)" + std::to_string(positions) + "}" +
                  primitive_more + "}]}";
    return file;
}

inline File plain(const std::vector<float> &positions, const std::string &primitive_more = "",
                  const char *axis = "[1,0,0]") {
    File file;
    const int index = file.vec3(positions);
    return plain(std::move(file), index, primitive_more, axis);
}

/** A scene with its loaded surfaces. */
class Loaded {
  public:
    Loaded() {
        knurl_scene_desc desc;
        knurl_scene_desc_init(&desc, sizeof desc);
        assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
        knurl_gltf_options_init(&options, sizeof options);
        knurl_gltf_report_init(&report, sizeof report);
    }
    explicit Loaded(const std::string &bytes) : Loaded() {
        assert_loads(bytes);
    }
    Loaded(const Loaded &) = delete;
    Loaded &operator=(const Loaded &) = delete;
    ~Loaded() {
        knurl_scene_destroy(scene);
    }
    knurl_result load(const std::string &bytes, const char *folder = nullptr) {
        // A copy of the exact size, so that a sanitizer sees each byte that is read too far.
        const std::vector<char> exact(bytes.begin(), bytes.end());
        return knurl_gltf_load_memory(scene, exact.data(), exact.size(), "test.glb", folder, &options, &report);
    }
    void assert_loads(const std::string &bytes, const char *folder = nullptr) {
        if (load(bytes, folder) != KNURL_OK)
            fail_msg("expected a load, found: %s", knurl_error_message());
    }
    knurl_surface_info info(uint32_t index = 0) const {
        knurl_surface_info made;
        knurl_surface_info_init(&made, sizeof made);
        assert_int_equal(knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, index), &made), KNURL_OK);
        return made;
    }
    knurl_material_desc material(uint32_t index = 0) const {
        knurl_material_desc made;
        knurl_material_desc_init(&made, sizeof made);
        assert_int_equal(knurl_scene_get_material(scene, knurl_scene_get_surface(scene, index), &made), KNURL_OK);
        return made;
    }

    knurl_scene *scene = nullptr;
    knurl_gltf_options options{};
    knurl_gltf_report report{};
};

/** The last message: one line that starts with `file` and contains each part. */
inline void assert_message(const char *file, std::initializer_list<const char *> parts) {
    const std::string message = knurl_error_message();
    if (message.rfind(std::string(file) + ": ", 0) != 0)
        fail_msg("expected the file's name '%s' first, found: %s", file, message.c_str());
    assert_true(message.find('\n') == std::string::npos);
    for (const char *part : parts)
        if (message.find(part) == std::string::npos)
            fail_msg("expected '%s' in: %s", part, message.c_str());
}

/** A load fails with `code` and a message of these parts, and leaves scene and report as they were. */
inline void assert_fails(const std::string &bytes, knurl_result code, std::initializer_list<const char *> parts,
                         const char *folder = nullptr) {
    Loaded loaded;
    loaded.report.surfaces = 77;
    const knurl_result result = loaded.load(bytes, folder);
    if (result != code)
        fail_msg("expected result %d, found %d: %s", code, result, result ? knurl_error_message() : "it loads");
    assert_message("test.glb", parts);
    assert_int_equal(loaded.report.surfaces, 77);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 0);
}

inline void assert_near(const double *found, std::initializer_list<double> expected, double tolerance = 1e-6) {
    size_t i = 0;
    for (const double value : expected) {
        if (!(found[i] - value < tolerance && value - found[i] < tolerance))
            fail_msg("component %zu: expected %.9g, found %.9g", i, value, found[i]);
        ++i;
    }
}

inline void assert_number(double found, double expected, double tolerance = 1e-12) {
    assert_near(&found, {expected}, tolerance);
}

} // namespace builder
#endif
