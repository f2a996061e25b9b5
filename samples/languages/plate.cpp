/* Presses a smooth plate 1 mm deep, which answers with K times the depth: 0.4 N. SPDX-License-Identifier: MIT */
#include "knurl.hpp"

#include <algorithm>
#include <cstdio>

int main() try {
    auto plane = knurl::described(knurl_plane_desc_init);
    auto material = knurl::described(knurl_material_desc_init);
    auto surface = knurl::described(knurl_surface_desc_init);
    material.stiffness = 400.0; // N/m
    surface.plane = &plane;
    surface.material = &material;

    const auto scene = knurl::make<knurl::scene>(knurl_scene_create, nullptr);
    knurl::check(knurl_scene_add_surface(scene.get(), &surface, nullptr));
    knurl::check(knurl_scene_commit(scene.get()));

    knurl_tick_input input{};
    knurl_tick_output output{};
    for (int tick = 0; tick < 1000; tick++) {
        input.position[2] = std::max(-0.001, 0.001 - 0.00001 * tick); // m
        knurl::check(knurl_scene_tick(scene.get(), 0, &input, &output));
    }
    std::printf("%.6f N, knurl %s\n", output.force[2], knurl_version_string());
} catch (const knurl::error &problem) {
    std::fprintf(stderr, "plate: %s\n", problem.what());
    return 1;
}
