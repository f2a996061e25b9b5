/* Bytes as a .gltf or .glb, as they come. SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <knurl/gltf.h>

/* A tag is set on the first material, and removed again. */
typedef struct edited {
    const void *data;
    uint64_t size;
} edited;

static void remove_tag(void *user, const void *data, uint64_t size) {
    (void)user;
    EXPECT(size >= 2 && data);
}

static void remove_again(void *user, const void *data, uint64_t size) {
    (void)user;
    EXPECT(knurl_gltf_set_tag(data, size, "fuzz", "materials", 0, NULL, remove_tag, NULL) == KNURL_OK);
}

static void check_texture(void *user, const knurl_gltf_texture *texture) {
    (void)user;
    EXPECT(texture->use && texture->name && (!texture->data) == (texture->problem != NULL));
    for (uint64_t i = 0; i < texture->size; i += 97) {
        EXPECT(((const volatile uint8_t *)texture->data)[i] <= 255); /* readable to its end */
    }
}

static void set_tag(void *user, const char *array, uint32_t index, const char *name, const char *tag) {
    const edited *file = user;
    EXPECT(array && name);
    (void)tag;
    (void)knurl_gltf_read_textures(file->data, file->size, "fuzz", NULL, array, index % 4, check_texture, NULL);
    if (strcmp(array, "materials") == 0 && index == 0) {
        (void)knurl_gltf_set_tag(file->data, file->size, "fuzz", array, index, "{\"stiffness\":400}", remove_again,
                                 NULL);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const uint8_t way[] = {20, 128, 20, 128, 20, 140, 20, 130, 20, 128, 20, 126, 20, 132, 20, 128, 20, 125};
    knurl_scene *scene = NULL;
    knurl_gltf_report report;
    knurl_gltf_options budget;
    knurl_gltf_report_init(&report, sizeof report);
    knurl_gltf_options_init(&budget, sizeof budget);
    budget.max_surfaces = 64; /* deep rather than broad */
    budget.max_vertices = 20000;
    budget.max_triangles = 20000;
    edited file = {data, size};
    (void)knurl_gltf_list_tags(data, size, "fuzz", set_tag, &file);
    EXPECT(knurl_scene_create(NULL, &scene) == KNURL_OK);
    const knurl_result result = knurl_gltf_load_memory(scene, data, size, "fuzz", NULL, &budget, &report);
    const uint32_t count = knurl_scene_get_surface_count(scene);
    EXPECT(result == KNURL_OK ? count == report.surfaces : count == 0 && knurl_error_message()[0] != '\0');
    if (count > 0) {
        EXPECT(knurl_scene_commit(scene) == KNURL_OK);
        for (uint32_t i = 0; i < count; i++) {
            knurl_surface_info info;
            knurl_surface_info_init(&info, sizeof info);
            EXPECT(knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, i), &info) == KNURL_OK);
            EXPECT(strlen(info.name) <= 255);
        }
        supply s = {way, sizeof way};
        expect_good_ticks(scene, &s, 3);
    }
    knurl_scene_destroy(scene);
    return 0;
}
