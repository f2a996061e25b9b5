/* The loader when memory runs out. SPDX-License-Identifier: MIT */
#include "memory/failing.h"

#include <knurl/gltf.h>

#include <stdlib.h>
#include <string.h>

/* A quad of two triangles in all encodings: flat and nested tags, a strip and a list, sparse positions,
 * a matrix and its parts, names, one node below another. */
static const char many_ways[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
    "\"nodes\":[{\"name\":\"a\",\"mesh\":0,\"children\":[2],\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0.5,1]},"
    "{\"mesh\":1,\"translation\":[0.1,0,0],\"rotation\":[0,0,0,1],\"scale\":[2,1,1]},"
    "{\"name\":\"a\",\"mesh\":0,\"scale\":[-1,1,1]}],"
    "\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"material\":0,\"mode\":5,\"attributes\":{\"POSITION\":0}}]},"
    "{\"primitives\":[{\"material\":1,\"indices\":2,\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}},"
    "{\"attributes\":{\"POSITION\":0}}]}],"
    "\"materials\":[{\"name\":\"flat\",\"doubleSided\":true,\"extras\":{\"knurl_version\":1,\"knurl_amplitude\":2e-4,"
    "\"knurl_spatial_frequency\":800,\"knurl_stiffness\":400,\"knurl_axis\":[1,0,0],\"knurl_method\":\"S2\"}},"
    "{\"extras\":{\"knurl\":{\"version\":1,\"amplitude\":2e-4,\"spatial_frequency\":[800,100],\"stiffness\":400}}}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":1,"
    "\"indices\":{\"bufferView\":2,\"componentType\":5121},\"values\":{\"bufferView\":3}}},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"byteOffset\":1,\"componentType\":5121,\"count\":6,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},"
    "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":7},{\"buffer\":0,\"byteOffset\":88,\"byteLength\":12}],"
    "\"buffers\":[{\"byteLength\":100,\"uri\":\"data:application/octet-stream;base64,"
    /* positions (0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), none; UVs at the corners; 3, 0 1 2 2 1 3; (0.1, 0.1, 0) */
    "AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MzD0AAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AACAPwAAgD8DAAECAgEDAM3MzD3NzMw9AAAAAA==\"}]}";

static knurl_scene *scene;
static char *large; /* 1 MB of JSON without a tag */

static void make_scene(void) {
    knurl_scene_desc desc;
    knurl_scene_desc_init(&desc, sizeof desc);
    failing_need(knurl_scene_create(&desc, &scene));
    failing_need(knurl_gltf_load_memory(scene, many_ways, strlen(many_ways), "before", NULL, NULL, NULL));
}

static void free_scene(void) {
    knurl_scene_destroy(scene);
    scene = NULL;
}

static void scene_state(char *text, size_t size) {
    const uint32_t count = knurl_scene_get_surface_count(scene);
    size_t used = 0;
    for (uint32_t i = 0; i < count && used < size; i++) {
        const knurl_surface_id id = knurl_scene_get_surface(scene, i);
        char name[KNURL_NAME_SIZE] = "";
        (void)knurl_scene_get_surface_name(scene, id, name);
        used += (size_t)snprintf(text + used, size - used, "%s %llx, ", name, (unsigned long long)id);
    }
}

static knurl_result load_file(const char *path) {
    knurl_gltf_report report;
    knurl_gltf_report_init(&report, sizeof report);
    return knurl_gltf_load_file(scene, path, NULL, &report);
}

static knurl_result load_memory(const char *text) {
    knurl_gltf_report report;
    knurl_gltf_report_init(&report, sizeof report);
    return knurl_gltf_load_memory(scene, text, strlen(text), "memory.gltf", NULL, NULL, &report);
}

static knurl_result load_grid(void) {
    return load_file(KNURL_TEST_ASSETS "/grid_2d.glb");
}

static knurl_result load_handle(void) {
    return load_file(KNURL_TEST_ASSETS "/knurled_handle.glb");
}

static knurl_result load_many_ways(void) {
    return load_memory(many_ways);
}

static knurl_result load_missing(void) {
    return load_file(KNURL_TEST_ASSETS "/missing.glb");
}

static knurl_result load_half_a_file(void) {
    return load_memory("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"name\":\"a\",\"children\":[1,2,");
}

static knurl_result load_wrong_tag(void) {
    return load_memory("{\"asset\":{\"version\":\"2.0\"},\"materials\":[{\"name\":\"m\",\"extras\":{\"knurl\":"
                       "{\"version\":1,\"axis\":[1,2,\"z\"],\"amplitude\":{\"a\":[]}}}}]}");
}

static uint64_t written; /* bytes of the last file */

static void reset_written(void) {
    written = 0;
}

static void keep_size(void *user, const void *data, uint64_t size) {
    (void)user, (void)data;
    written = size;
}

static void ignore_tag(void *user, const char *array, uint32_t index, const char *object, const char *tag) {
    (void)user, (void)array, (void)index, (void)object, (void)tag;
}

static void written_state(char *text, size_t size) {
    (void)snprintf(text, size, "%llu bytes", (unsigned long long)written);
}

static knurl_result set_tag(void) {
    return knurl_gltf_set_tag(many_ways, strlen(many_ways), "memory.gltf", "materials", 0, "{\"friction\":1}",
                              keep_size, NULL);
}

static knurl_result list_tags(void) {
    return knurl_gltf_list_tags(many_ways, strlen(many_ways), "memory.gltf", ignore_tag, NULL);
}

static void ignore_texture(void *user, const knurl_gltf_texture *texture) {
    (void)user;
    (void)texture;
}

static knurl_result read_textures(void) {
    static const char textured[] =
        "{\"materials\":[{\"name\":\"m\",\"normalTexture\":{\"index\":0,\"extensions\":{\"KHR_texture_transform\":"
        "{\"scale\":[2,3]}}},\"occlusionTexture\":{\"index\":1}}],\"textures\":[{\"source\":0},{\"source\":1}],"
        "\"images\":[{\"uri\":\"data:image/png;base64,AAAA\"},{\"bufferView\":0}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":2}],"
        "\"buffers\":[{\"byteLength\":3,\"uri\":\"data:;base64,AAAA\"}]}";
    return knurl_gltf_read_textures(textured, strlen(textured), "memory.gltf", NULL, "materials", 0, ignore_texture,
                                    NULL);
}

TEST(a_tag_is_written_whole_or_not_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_gltf_set_tag()", reset_written, set_tag, reset_written, written_state, 0, 0},
        {"knurl_gltf_list_tags()", reset_written, list_tags, reset_written, written_state, 0, 0},
        {"knurl_gltf_read_textures()", reset_written, read_textures, reset_written, written_state, 0, 0},
    };
    failing_run(calls, COUNT_OF(calls));
}

TEST(a_load_gives_an_error_wherever_memory_runs_out) {
    const failing_call calls[] = {
        {"knurl_gltf_load_file(grid_2d.glb)", make_scene, load_grid, free_scene, scene_state, 0, 0},
        {"knurl_gltf_load_memory()", make_scene, load_many_ways, free_scene, scene_state, 0, 0},
        {"... of a file that is not there", make_scene, load_missing, free_scene, scene_state, 1, 0},
        {"... of half a file", make_scene, load_half_a_file, free_scene, scene_state, 1, 0},
        {"... of a wrong tag", make_scene, load_wrong_tag, free_scene, scene_state, 1, 0},
        {"knurl_gltf_load_file(knurled_handle.glb)", make_scene, load_handle, free_scene, scene_state, 0, 0},
    };
    failing_run(calls, COUNT_OF(calls) - !failing_is_long()); /* the last one has many triangles */
}

static knurl_result load_large(void) {
    return load_memory(large);
}

/* As `ulimit -v` does it: here the C library's own memory and the stack are short, too. */
TEST(a_load_ends_in_order_with_any_address_space_left) {
    static const char begin[] = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}";
    static const char node[] = ",{\"name\":\"n\",\"children\":[]}";
    const size_t nodes = 32000;
    large = malloc(sizeof begin + nodes * sizeof node + 8);
    assert_non_null(large);
    size_t size = (size_t)sprintf(large, "%s", begin);
    for (size_t i = 0; i < nodes; i++) {
        memcpy(large + size, node, sizeof node);
        size += sizeof node - 1;
    }
    memcpy(large + size, "]}", 3);
    make_scene();
    const size_t step = (size_t)(failing_is_long() ? 128 : 1024) << 10U;
    for (size_t bytes = 0; bytes < (size_t)24 << 20U; bytes += step) {
        if (!failing_survives(load_large, bytes)) {
            fail_msg("a load with %zu kB left ended the process", bytes >> 10U);
        }
    }
    free_scene();
    free(large);
}
