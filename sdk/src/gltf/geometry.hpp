// Knurl: reads one primitive into the arrays of a knurl_mesh_desc.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_GEOMETRY_HPP
#define KNURL_GLTF_GEOMETRY_HPP

#include "accessor.hpp"

namespace knurl::gltf {

struct Geometry {
    std::vector<float> positions;  ///< x, y, z
    std::vector<float> normals;    ///< x, y, z; may be empty
    std::vector<float> tangents;   ///< x, y, z, w; may be empty
    std::vector<float> uvs;        ///< u, v; may be empty
    std::vector<uint32_t> indices; ///< three a triangle; never empty
};

/** The size of a primitive. */
struct GeometryCount {
    uint64_t elements = 0; ///< of its attributes
    uint64_t triangles = 0;
};

/** Counts without reading the data, and checks mode and counts. Throws Failure. */
GeometryCount count_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where);

/** Reads a primitive that was counted in its mesh's frame, strips and fans as triangles, counter-clockwise seen from
 * outside. `where` starts error messages: "mesh 'm' (0), primitive 1". Throws Failure. */
Geometry read_geometry(const Model &model, const tinygltf::Primitive &primitive, const std::string &where);

} // namespace knurl::gltf
#endif
