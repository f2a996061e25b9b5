// Knurl: tinygltf's types. Its parser is not compiled in: it builds trees of nlohmann's, which end the process where
// memory runs out, and the filter has read and checked all there is (filter.hpp). SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_TINYGLTF_HPP
#define KNURL_GLTF_TINYGLTF_HPP

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON // model.cpp includes it: as published, the header looks for it beside itself

#include <fstream> // the header needs it and, with NO_FS, forgets it

#include <tiny_gltf.h>

#endif
