// Knurl: unique surface names.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_NAMES_HPP
#define KNURL_GLTF_NAMES_HPP

#include "base/finite.h"

#include <knurl/query.h>

#include <map>
#include <string>

namespace knurl::gltf {

/** A surface's name is at most 255 bytes: a node's or a mesh's name, " / ", a material's name, " (2)". */
constexpr size_t name_max = 255;
constexpr size_t name_part_max = 115; ///< plus "..."

class Names {
  public:
    /** Starts with the names of the scene's surfaces. */
    explicit Names(const knurl_scene *scene);

    /** Returns `name`, with " (2)", " (3)", ... appended if it is taken, and marks the result as taken. */
    std::string unique(const std::string &name);

  private:
    /// A tree, not a hash table, which a hostile file could make slow by its choice of names.
    std::map<std::string, uint32_t> taken_; ///< name to the highest number tried
};

} // namespace knurl::gltf
#endif
