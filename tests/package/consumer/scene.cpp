// A consumer in C++: loads a glTF file and strokes it with the fake device. SPDX-License-Identifier: MIT
#include <knurl/knurl.h>

#include <cstdio>

int main(int argc, char **argv) {
    knurl_scene *scene = nullptr;
    knurl_device *device = nullptr;
    knurl_loop *loop = nullptr;
    knurl_loop_desc desc;
    knurl_loop_desc_init(&desc, sizeof desc);
    desc.tick_limit = 1000;
    knurl_result result = argc < 2 ? KNURL_ERROR_ARGUMENT : knurl_scene_create(nullptr, &scene);
    result = result ? result : knurl_gltf_load_file(scene, argv[1], nullptr, nullptr);
    result = result ? result : knurl_scene_commit(scene);
    result = result ? result : knurl_device_open("fake", &device);
    result =
        result ? result
               : knurl_fake_lay_stroke(device, scene, 0, knurl_scene_get_surface(scene, 0), KNURL_STROKE_LINE, nullptr);
    desc.scene = scene;
    desc.device = device;
    result = result ? result : knurl_loop_create(&desc, &loop);
    result = result ? result : knurl_loop_step(loop, 1000);
    knurl_hip_counts counts{};
    result = result ? result : knurl_scene_get_tick(scene, 0, nullptr, &counts);
    if (result)
        std::fprintf(stderr, "%s\n", knurl_error_message());
    else
        std::printf("%u surfaces, %llu of %llu ticks in contact\n", knurl_scene_get_surface_count(scene),
                    static_cast<unsigned long long>(counts.contact_ticks),
                    static_cast<unsigned long long>(counts.ticks));
    knurl_loop_destroy(loop);
    knurl_device_close(device);
    knurl_scene_destroy(scene);
    return result || counts.contact_ticks == 0;
}
