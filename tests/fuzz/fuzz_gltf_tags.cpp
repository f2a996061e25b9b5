// Files whose structure is right and whose values are chosen by the bytes: tags in all three places and both forms,
// nodes that share and nest, accessors of every type over one buffer. Random bytes rarely reach this.
// SPDX-License-Identifier: MIT
#include "fuzz.h"

#include <string>

#include <knurl/gltf.h>

namespace {

template <size_t N>
std::string one_of(supply &s, const char *const (&texts)[N]) {
    return texts[take_byte(&s) % N];
}

std::string number(supply &s) {
    static const char *const numbers[] = {"0",    "1",     "2",   "3",     "0.5",  "-1",   "1e-3",  "1000", "1e38",
                                          "1e99", "1e-30", "0.1", "65536", "1e10", "null", "\"1\"", "true", "[1,0]"};
    return one_of(s, numbers);
}

/// Mostly valid values, otherwise any.
std::string value(supply &s, const char *good) {
    return take_byte(&s) % 8 != 0 ? good : number(s);
}

std::string tag(supply &s) {
    if (take_byte(&s) % 2 == 0)
        return "";
    const bool flat = take_byte(&s) % 4 == 0;
    const std::string prefix = flat ? "\"knurl_" : "\"";
    std::string text = prefix + "spatial_frequency\":" + value(s, "[700,0]") + "," + prefix +
                       "amplitude\":" + value(s, "2e-4") + "," + prefix + "stiffness\":" + value(s, "400");
    if (take_byte(&s) % 2 == 0)
        text += "," + prefix + "axis\":" + value(s, "[1,0,0]");
    static const char *const more[] = {"damping", "friction", "orientation", "method", "version", "depth", "smooth"};
    if (take_byte(&s) % 4 == 0)
        text += "," + prefix + one_of(s, more) + "\":" + number(s);
    return ",\"extras\":{" + (flat ? text : "\"knurl\":{\"version\":" + value(s, "1") + "," + text + "}") + "}";
}

std::string index(supply &s, unsigned count) {
    return std::to_string(take_byte(&s) % (take_byte(&s) % 16 == 0 ? count + 2 : count));
}

std::string accessor(supply &s) {
    static const char *const types[] = {"5120", "5121", "5122", "5123", "5125", "5126", "5126", "5126"};
    static const char *const widths[] = {"SCALAR", "VEC2", "VEC3", "VEC3", "VEC4"};
    std::string text = R"({"componentType":)" + one_of(s, types) + R"(,"type":")" + one_of(s, widths) +
                       R"(","count":)" + std::to_string(take_byte(&s) % 64);
    if (take_byte(&s) % 8 != 0)
        text += R"(,"bufferView":)" + index(s, 2) + R"(,"byteOffset":)" + std::to_string(take_byte(&s) / 4 * 4);
    if (take_byte(&s) % 8 == 0)
        text += R"(,"normalized":true)";
    if (take_byte(&s) % 8 == 0)
        text += R"(,"sparse":{"count":)" + std::to_string(take_byte(&s) % 8) +
                R"(,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":)" + index(s, 2) + "}}";
    return text + "}";
}

std::string primitive(supply &s) {
    std::string text = R"({"attributes":{"POSITION":)" + index(s, 6);
    if (take_byte(&s) % 2 == 0)
        text += R"(,"TEXCOORD_0":)" + index(s, 6);
    if (take_byte(&s) % 4 == 0)
        text += R"(,"TANGENT":)" + index(s, 6);
    if (take_byte(&s) % 2 == 0)
        text += R"(,"NORMAL":)" + index(s, 6);
    text += "}";
    if (take_byte(&s) % 2 == 0)
        text += R"(,"indices":)" + index(s, 6);
    if (take_byte(&s) % 2 == 0)
        text += R"(,"mode":)" + std::to_string(take_byte(&s) % 8);
    return text + R"(,"material":)" + index(s, 2) + "}";
}

std::string node(supply &s, unsigned number_of_it) {
    std::string text = R"({"name":"n")";
    if (take_byte(&s) % 4 != 0)
        text += R"(,"mesh":)" + index(s, 2);
    if (take_byte(&s) % 4 == 0)
        text += R"(,"children":[)" + std::to_string(number_of_it + 1 + take_byte(&s) % 2) + "]";
    if (take_byte(&s) % 4 == 0)
        text += R"(,"scale":[)" + value(s, "1") + "," + value(s, "-2") + "," + value(s, "1") + "]";
    if (take_byte(&s) % 4 == 0)
        text += R"(,"rotation":[0,)" + value(s, "0.6") + ",0," + value(s, "0.8") + "]";
    if (take_byte(&s) % 4 == 0)
        text += R"(,"translation":[)" + number(s) + "," + number(s) + ",0]";
    return text + tag(s) + "}";
}

template <typename Make>
std::string list(unsigned count, const Make &make) {
    std::string text;
    for (unsigned i = 0; i < count; ++i)
        text += (i > 0 ? "," : "") + make(i);
    return "[" + text + "]";
}

void word(std::string &bytes, size_t value) {
    for (unsigned i = 0; i < 4; ++i)
        bytes += static_cast<char>(value >> (8 * i) & 255U);
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    supply s = {data, size};
    std::string json = R"({"asset":{"version":"2.0"},"materials":)" +
                       list(2, [&](unsigned) { return R"({"doubleSided":)" + value(s, "true") + tag(s) + "}"; });
    json += R"(,"meshes":)" + list(2, [&](unsigned) {
                return R"({"primitives":)" + list(1 + take_byte(&s) % 3, [&](unsigned) { return primitive(s); }) +
                       tag(s) + "}";
            });
    json += R"(,"nodes":)" + list(4, [&](unsigned i) { return node(s, i); });
    json += R"(,"accessors":)" + list(6, [&](unsigned) { return accessor(s); });
    json += R"(,"bufferViews":[{"buffer":0,"byteLength":1024},{"buffer":0,"byteLength":1024,"byteStride":)" +
            std::to_string(4 + take_byte(&s) / 4 * 4) + R"(}],"buffers":[{"byteLength":1024}]})";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bin(1024, '\0');
    for (size_t i = 0; i < bin.size() / 4; ++i) {
        const auto coordinate = static_cast<float>(take_number(&s));
        memcpy(&bin[4 * i], &coordinate, sizeof coordinate);
    }
    std::string glb = "glTF";
    word(glb, 2);
    word(glb, 28 + json.size() + bin.size());
    word(glb, json.size());
    glb += "JSON" + json;
    word(glb, bin.size());
    glb += std::string("BIN\0", 4) + bin;
    knurl_scene *scene = nullptr;
    EXPECT(knurl_scene_create(nullptr, &scene) == KNURL_OK);
    const knurl_result result =
        knurl_gltf_load_memory(scene, glb.data(), glb.size(), "fuzz", nullptr, nullptr, nullptr);
    EXPECT(result == KNURL_OK || knurl_scene_get_surface_count(scene) == 0);
    if (knurl_scene_get_surface_count(scene) > 0) {
        EXPECT(knurl_scene_commit(scene) == KNURL_OK);
        expect_good_ticks(scene, &s, 8);
    }
    knurl_scene_destroy(scene);
    return 0;
}
