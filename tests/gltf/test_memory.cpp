// Memory that cannot be had: an error, no exception, and a scene as it was.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <new>

#include "gltf/builder.hpp"

using namespace builder;

namespace {

/// Counts down at each request; the one at 0 fails.
long requests_left = -1;

bool fails_now() {
    if (requests_left < 0)
        return false;
    --requests_left;
    return requests_left < 0;
}

} // namespace

// Not inlined: seeing free() in one place and not malloc() in the other, GCC would take them for a mismatch.
__attribute__((noinline)) void *operator new(size_t size) {
    void *memory = fails_now() ? nullptr : std::malloc(size);
    if (memory == nullptr)
        throw std::bad_alloc();
    return memory;
}
__attribute__((noinline)) void operator delete(void *memory) noexcept {
    std::free(memory);
}
__attribute__((noinline)) void operator delete(void *memory, size_t /*size*/) noexcept {
    std::free(memory);
}

namespace {

/// Two surfaces of 400 triangles.
std::string two_surfaces() {
    std::vector<float> positions;
    std::vector<float> uvs;
    for (unsigned i = 0; i < 400; ++i) {
        const auto x = static_cast<float>(i);
        positions.insert(positions.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0});
        uvs.insert(uvs.end(), {x, 0, x + 1, 0, x, 1});
    }
    File file;
    file.vec3(positions);
    file.vec2(uvs);
    file.meshes = R"({"primitives":[{"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}]})";
    file.nodes = R"({"mesh":0},{"mesh":0})";
    return file.gltf();
}

TEST(the_loader_without_memory) {
    const std::string bytes = two_surfaces();
    Loaded loaded(quad().glb());
    knurl_result result = KNURL_ERROR_MEMORY;
    long failures = 0;
    for (; result != KNURL_OK; ++failures) {
        requests_left = failures;
        result =
            knurl_gltf_load_memory(loaded.scene, bytes.data(), bytes.size(), "test.glb", nullptr, nullptr, nullptr);
        requests_left = -1;
        if (result == KNURL_OK)
            break;
        assert_int_equal(result, KNURL_ERROR_MEMORY);
        assert_message("test.glb", {"memory"});
        assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 1);
    }
    assert_true(failures > 100);
    assert_int_equal(knurl_scene_get_surface_count(loaded.scene), 3);
}

/// Three tagged meshes of a wavy strip, behind `untagged` others of their own geometry.
std::string three_among(unsigned untagged) {
    File file;
    const unsigned columns = 100;
    for (unsigned m = 0; m < untagged + 3; ++m) {
        std::vector<float> positions;
        std::vector<float> uvs;
        for (unsigned i = 0; i < columns; ++i) {
            const float x = 0.001F * static_cast<float>(i);
            const float z = 0.0001F * static_cast<float>((i + m) % 7);
            positions.insert(positions.end(), {x, 0, z, x + 0.001F, 0, z, x, 0.01F, z});
            uvs.insert(uvs.end(), {x, 0, x + 0.001F, 0, x, 0.01F});
        }
        const std::string at = std::to_string(file.vec3(positions));
        const std::string uv = std::to_string(file.vec2(uvs));
        std::string mesh = R"({"primitives":[{"material":)";
        mesh.append(m < untagged ? "0" : "1").append(R"(,"attributes":{"POSITION":)").append(at);
        mesh.append(R"(,"TEXCOORD_0":)").append(uv).append("}}]}");
        File::append(file.meshes, mesh);
        if (m > 0)
            File::append(file.nodes, R"({"mesh":)" + std::to_string(m) + "}");
    }
    file.materials = "{},{" + tag() + "}";
    return file.glb();
}

TEST(a_scene_costs_what_it_tags) {
    const Loaded alone(three_among(0));
    const Loaded among(three_among(1000));
    assert_int_equal(alone.report.surfaces, 3);
    assert_int_equal(among.report.surfaces, 3);
    assert_int_equal(among.report.skipped, 1000);
    uint64_t bytes[2] = {0, 0};
    for (uint32_t i = 0; i < 3; ++i) {
        bytes[0] += alone.info(i).bytes - std::strlen(alone.info(i).name);
        bytes[1] += among.info(i).bytes - std::strlen(among.info(i).name);
    }
    assert_int_equal(bytes[1], bytes[0]);
    assert_in_range(knurl_scene_get_bytes(among.scene), bytes[0], knurl_scene_get_bytes(alone.scene) + 64);
}

struct Pool {
    long requests_left = 1L << 30;
};

void *pool_allocate(size_t size, size_t /*alignment*/, void *user) {
    return static_cast<Pool *>(user)->requests_left-- > 0 ? std::malloc(size) : nullptr;
}

void pool_release(void *memory, size_t /*size*/, void * /*user*/) {
    std::free(memory);
}

TEST(the_scene_without_memory) {
    Pool pool;
    const knurl_allocator allocator = {pool_allocate, pool_release, &pool};
    const std::string bytes = two_surfaces();
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    desc.max_surfaces = 16;
    desc.allocator = &allocator;
    knurl_scene *scene = nullptr;
    assert_int_equal(knurl_scene_create(&desc, &scene), KNURL_OK);
    knurl_result result = KNURL_ERROR_MEMORY;
    long failures = 0;
    for (; result != KNURL_OK; ++failures) {
        pool.requests_left = failures;
        result = knurl_gltf_load_memory(scene, bytes.data(), bytes.size(), "test.glb", nullptr, nullptr, nullptr);
        if (result == KNURL_OK)
            break;
        assert_int_equal(result, KNURL_ERROR_MEMORY);
        assert_message("test.glb", {"node "});
        assert_int_equal(knurl_scene_get_surface_count(scene), 0);
    }
    assert_true(failures > 4);
    assert_int_equal(knurl_scene_get_surface_count(scene), 2);
    knurl_scene_destroy(scene);
}

} // namespace
