// Knurl: surfaces' names, each once in a scene.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_NAMES_HPP
#define KNURL_GLTF_NAMES_HPP

#include "base/finite.h"

#include <knurl/scene.h>

#include <string>
#include <unordered_map>

namespace knurl::gltf {

class Names {
  public:
    /** Knows the names of the surfaces that are in the scene. */
    explicit Names(const knurl_scene *scene);

    /** `name`, or with " (2)", " (3)", ... behind it where it is taken; taken from now on. */
    std::string unique(const std::string &name);

  private:
    std::unordered_map<std::string, uint32_t> taken_; ///< and the highest number that was tried
};

} // namespace knurl::gltf
#endif
