// Knurl: where nodes stand, and geometry moved from a mesh's frame into its surface's: metres, not sheared.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_PLACEMENT_HPP
#define KNURL_GLTF_PLACEMENT_HPP

#include "geometry.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <unordered_map>

namespace knurl::gltf {

/** A node's world transform M as a rigid frame and what is left: M = translate(position) * rotation * bake. */
struct Frame {
    glm::dvec3 position;
    glm::dquat rotation;   ///< proper: right-handed
    glm::dmat3 bake;       ///< mesh to surface: scale, shear and mirroring
    bool mirrored = false; ///< the triangles' winding is to be flipped
};

/** World transforms of a model's nodes. */
class Placement {
  public:
    /** Both must outlive this. */
    Placement(const Model &model, const std::vector<int32_t> &parents) : model_(model), parents_(parents) {}

    /** Throws Failure where the node's transform is not finite or flattens what it shows. */
    Frame frame(uint32_t node);

  private:
    const glm::dmat4 &world(uint32_t node);

    const Model &model_;
    const std::vector<int32_t> &parents_;
    std::unordered_map<uint32_t, glm::dmat4> worlds_;
};

/** What a bake comes to but for its rounding: as good as the same for all that is stored in float32, and the same for
 * nodes that only stand and face differently. */
std::array<double, 9> bake_key(const Frame &frame);

/** Moves a geometry from its mesh's frame into its surface's. where: "node 'n' (1)"; positions: what its POSITION is
 * called, "accessor 0". Throws Failure. */
void bake(Geometry &geometry, const Frame &frame, const std::string &where, const std::string &positions);

} // namespace knurl::gltf
#endif
