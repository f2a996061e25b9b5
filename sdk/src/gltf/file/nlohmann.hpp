// Knurl: JSON for Modern C++ under a name of its own. The linker keeps one copy of an inline function: a game's own
// version of the library, or its own options, may have another one of the same name. SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_NLOHMANN_HPP
#define KNURL_GLTF_NLOHMANN_HPP

#define nlohmann knurl_nlohmann

#include <nlohmann/json.hpp>

#endif
