// Knurl: tinygltf's types. Its parser is not compiled in: it builds nlohmann's trees, which end the process if memory
// runs out, and filter.hpp has already read and checked everything needed. SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_TINYGLTF_HPP
#define KNURL_GLTF_TINYGLTF_HPP

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_INCLUDE_JSON                // as published, the header looks for it in its own folder
#define tinygltf                 knurl_tinygltf // as in nlohmann.hpp

#include <fstream> // missing in the header with NO_FS

#include <tiny_gltf.h>

#endif
