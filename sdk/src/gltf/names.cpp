// SPDX-License-Identifier: MIT
#include "names.hpp"

namespace knurl::gltf {

Names::Names(const knurl_scene *scene) {
    for (uint32_t i = 0; i < knurl_scene_get_surface_count(scene); ++i) {
        knurl_surface_info info;
        knurl_surface_info_init(&info, sizeof info);
        if (knurl_scene_get_surface_info(scene, knurl_scene_get_surface(scene, i), &info) == KNURL_OK)
            taken_.emplace(info.name, 1);
    }
}

std::string Names::unique(const std::string &name) {
    uint32_t &tried = taken_[name];
    std::string candidate = name;
    while (tried != 0 && taken_.count(candidate) != 0)
        candidate = name + " (" + std::to_string(++tried) + ")";
    if (tried == 0)
        tried = 1;
    taken_.emplace(candidate, 1);
    return candidate;
}

} // namespace knurl::gltf
