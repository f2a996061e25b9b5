// Knurl: surfaces' names, each once in a scene.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_NAMES_HPP
#define KNURL_GLTF_NAMES_HPP

#include "base/finite.h"

#include <knurl/scene.h>

#include <map>
#include <string>

namespace knurl::gltf {

/** A surface's name is at most 255 bytes: a node's or a mesh's, " / ", a material's, and " (2)" or so. */
constexpr size_t name_max = 255;
constexpr size_t name_part_max = 115; ///< and "..."

class Names {
  public:
    /** Knows the names of the surfaces that are in the scene. */
    explicit Names(const knurl_scene *scene);

    /** `name`, or with " (2)", " (3)", ... behind it where it is taken; taken from now on. */
    std::string unique(const std::string &name);

  private:
    /// A tree, not a hash table: a hostile file cannot choose names that make it slow.
    std::map<std::string, uint32_t> taken_; ///< and the highest number that was tried
};

} // namespace knurl::gltf
#endif
