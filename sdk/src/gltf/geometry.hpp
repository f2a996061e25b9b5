// Knurl: one primitive's triangles and vertices as arrays that knurl_mesh_desc takes.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_GEOMETRY_HPP
#define KNURL_GLTF_GEOMETRY_HPP

#include "accessor.hpp"

namespace knurl::gltf {

struct Geometry {
    std::vector<float> positions;  ///< x, y, z
    std::vector<float> tangents;   ///< x, y, z, w; empty: none
    std::vector<float> uvs;        ///< u, v; empty: none
    std::vector<uint32_t> indices; ///< three a triangle; never empty
};

/** What reading a primitive comes to. */
struct GeometryCount {
    uint64_t elements = 0; ///< of its attributes
    uint64_t triangles = 0;
};

/** Counts without reading; checks what can be told without. where: as below. Throws Failure. */
GeometryCount count_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where);

/** Reads a primitive in its mesh's frame: triangles, strips and fans as triangles, counter-clockwise out.
 * where: "mesh 'm' (0), primitive 1". Throws Failure. */
Geometry read_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where);

} // namespace knurl::gltf
#endif
