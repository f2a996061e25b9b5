// A game with its own tinygltf, nlohmann-json, and functions whose names a driver might have chosen.
// SPDX-License-Identifier: MIT
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <knurl/knurl.h>

#include <cstdio>

extern "C" {
int touch_read, touch_write, hd_acquire, rawhid_exchange, falcon_exchange, usb_close;
}

int main(int, char **argv) {
    tinygltf::Model model;
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader([](tinygltf::Image *, int, std::string *, std::string *, int, int, const unsigned char *, int,
                             void *) { return true; },
                          nullptr);
    std::string error, warning;
    knurl_scene *scene = nullptr;
    const bool mine = loader.LoadBinaryFromFile(&model, &error, &warning, argv[1]);
    const bool ours = !knurl_scene_create(nullptr, &scene) && !knurl_gltf_load_file(scene, argv[1], nullptr, nullptr);
    std::printf("%zu meshes, %u surfaces, %d\n", mine ? model.meshes.size() : 0,
                ours ? knurl_scene_get_surface_count(scene) : 0, nlohmann::json::parse("[1, 2]")[1].get<int>());
    knurl_scene_destroy(scene);
}
