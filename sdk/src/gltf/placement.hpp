// Knurl: world transforms of nodes, and geometry moved from a mesh's frame into its surface's: metres, not sheared.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_PLACEMENT_HPP
#define KNURL_GLTF_PLACEMENT_HPP

#include "geometry.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <unordered_map>

namespace knurl::gltf {

/** A node's world transform M, split into a rigid frame and the rest: M = translate(position) * rotation * bake. */
struct Frame {
    glm::dvec3 position;
    glm::dquat rotation;   ///< proper: right-handed
    glm::dmat3 bake;       ///< mesh to surface: scale, shear and mirroring
    bool mirrored = false; ///< bake() must reverse the triangles' winding
};

/** World transforms of a model's nodes. */
class Placement {
  public:
    /** Both must outlive this. */
    Placement(const Model &model, const std::vector<int32_t> &parents) : model_(model), parents_(parents) {}

    /** Throws Failure if the node's transform is not finite or flattens its mesh. */
    Frame frame(uint32_t node);

  private:
    const glm::dmat4 &world(uint32_t node);

    const Model &model_;
    const std::vector<int32_t> &parents_;
    std::unordered_map<uint32_t, glm::dmat4> worlds_;
};

/** Key of a frame's bake matrix, rounded: equal for nodes that differ only in position and rotation. The rounding does
 * not show in float32 positions. */
std::array<double, 9> bake_key(const Frame &frame);

/** Moves a geometry from its mesh's frame into its surface's. For messages: `where` is "node 'n' (1)", `accessor`
 * POSITION's number. Throws Failure. */
void bake(Geometry &geometry, const Frame &frame, const std::string &where, int accessor);

} // namespace knurl::gltf
#endif
