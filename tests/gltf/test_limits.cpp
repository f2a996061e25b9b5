// Deep, long and large files: small stacks, chains, many surfaces, and the time for a real size.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>
#include <ctime>

#include <pthread.h>

#include "gltf/builder.hpp"

using namespace builder;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
constexpr bool is_measured = false;
constexpr size_t small_stack = size_t{256} * 1024; // the sanitizers' frames are several times as large
#else
constexpr bool is_measured = true;
constexpr size_t small_stack = size_t{128} * 1024; // the promise in gltf.h
#endif

std::string repeated(const std::string &text, size_t count) {
    std::string all;
    for (size_t i = 0; i < count; ++i)
        all += text;
    return all;
}

/// Extras with the innermost `depth` objects deep: root, materials, material, extras, ...
std::string nested(size_t depth) {
    const size_t inner = depth - 3;
    return R"({"x":)" + repeated(R"({"x":)", inner - 2) + "{}" + repeated("}", inner - 1);
}

/// A quad's .glb whose material has such extras beside a tag.
std::string nested_quad(size_t depth) {
    File file = quad();
    std::string extras = tag().substr(9); // without "extras":
    file.materials = R"({"extras":)" + extras.substr(0, extras.size() - 1) + "," + nested(depth).substr(1) + "}";
    return file.glb();
}

/// A chain of nodes, the last of which shows the quad.
std::string chain(size_t length) {
    File file = quad();
    file.nodes.clear();
    for (size_t i = 1; i < length; ++i)
        file.nodes += R"({"children":[)" + std::to_string(i) + "]},";
    file.nodes += R"({"mesh":0})";
    return file.glb();
}

TEST(nesting_is_limited) {
    assert_int_equal(Loaded(nested_quad(32)).report.surfaces, 1);
    assert_fails(nested_quad(33), KNURL_ERROR_FORMAT, {"JSON: nested deeper than 32 in materials[0].extras.x.x"});
    assert_fails(nested_quad(16000), KNURL_ERROR_FORMAT, {"JSON: nested deeper than 32"});
    assert_fails("{\"a\":" + std::string(5000000, '['), KNURL_ERROR_FORMAT, {"JSON: nested deeper than 32 in a[0][0]"});
}

TEST(node_depth_is_limited) {
    assert_int_equal(Loaded(chain(1024)).report.surfaces, 1);
    assert_fails(chain(1025), KNURL_ERROR_FORMAT, {"node 1024: lies more than 1024 nodes deep"});
    assert_fails(chain(200000), KNURL_ERROR_FORMAT, {"node 1024: lies more than 1024 nodes deep"});
}

TEST(surfaces_are_counted_before_they_are_made) {
    File file = quad();
    std::string primitive = file.meshes.substr(std::strlen(R"({"primitives":[)"));
    primitive.resize(primitive.size() - 2);
    file.meshes = R"({"primitives":[)" + repeated(primitive + ",", 1999) + primitive + "]}";
    file.nodes = repeated(R"({"mesh":0},)", 1999) + R"({"mesh":0})";
    assert_fails(file.glb(), KNURL_ERROR_FULL, {"options.max_surfaces: expected at most 65536, found 4000000"});
    file.nodes = R"({"mesh":0},{"mesh":0},{"mesh":0})"; // beyond this scene's own capacity of 4096
    assert_fails(file.glb(), KNURL_ERROR_FULL, {"node 2, mesh 0, primitive 96: "});
    file.materials = "{}";
    assert_int_equal(Loaded(file.glb()).report.skipped, 6000);
}

/// Everything that might be deep, on a small stack.
void *load_on_small_stack(void *failures) {
    struct Case {
        std::string bytes;
        knurl_result result;
    };
    const Case cases[] = {{quad().glb(), KNURL_OK},
                          {quad().gltf(), KNURL_OK},
                          {nested_quad(32), KNURL_OK},
                          {chain(1024), KNURL_OK},
                          {nested_quad(472), KNURL_ERROR_FORMAT},
                          {nested_quad(16000), KNURL_ERROR_FORMAT},
                          {chain(200000), KNURL_ERROR_FORMAT},
                          {quad_with(R"({"knurl_stiffness":-1})").glb(), KNURL_ERROR_FORMAT},
                          {quad().json("none.bin"), KNURL_ERROR_IO}};
    for (const Case &one : cases) {
        knurl_scene_desc desc;
        knurl_scene_desc_init(&desc, sizeof desc);
        knurl_scene *scene = nullptr;
        if (knurl_scene_create(&desc, &scene) != KNURL_OK ||
            knurl_gltf_load_memory(scene, one.bytes.data(), one.bytes.size(), "small", ".", nullptr, nullptr) !=
                one.result)
            ++*static_cast<int *>(failures);
        knurl_scene_destroy(scene);
    }
    return nullptr;
}

TEST(a_small_stack_is_enough) {
    int failures = 0;
    pthread_t thread;
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    assert_int_equal(pthread_attr_setstacksize(&attributes, small_stack), 0);
    assert_int_equal(pthread_create(&thread, &attributes, load_on_small_stack, &failures), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    assert_int_equal(failures, 0);
}

/// A waved sheet of 2 n^2 triangles with UVs.
std::string sheet(uint32_t n) {
    std::vector<float> positions;
    std::vector<float> uvs;
    std::vector<uint32_t> indices;
    const auto step = 1.0F / static_cast<float>(n);
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float u = static_cast<float>(i) * step;
            const float v = static_cast<float>(j) * step;
            positions.insert(positions.end(), {u, v, 0.05F * std::sin(9.0F * u) * std::cos(7.0F * v)});
            uvs.insert(uvs.end(), {u, v});
            const uint32_t corner = j * (n + 1) + i;
            if (i < n && j < n)
                indices.insert(indices.end(),
                               {corner, corner + 1, corner + n + 2, corner, corner + n + 2, corner + n + 1});
        }
    File file;
    file.vec3(positions);
    file.vec2(uvs);
    file.add<uint32_t>(UINT, "SCALAR", 1, indices);
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2}]})";
    return file.glb();
}

TEST(a_hundred_thousand_triangles_load_within_half_a_second) {
    const std::string bytes = sheet(224);
    double best = 1e9;
    for (int i = 0; i < 3; ++i) {
        Loaded loaded;
        const std::clock_t start = std::clock(); // of the processor: others may use it, too
        loaded.assert_loads(bytes);
        best = std::fmin(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        assert_int_equal(loaded.info().triangle_count, 100352);
    }
    std::printf("100,352 triangles (%.1f MB) load in %.0f ms\n", static_cast<double>(bytes.size()) * 1e-6, best * 1e3);
    if (is_measured)
        assert_true(best < 0.5);
}

} // namespace
