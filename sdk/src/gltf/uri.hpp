// Knurl: parsing of buffers' URIs.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_URI_HPP
#define KNURL_GLTF_URI_HPP

#include <string>
#include <string_view>
#include <vector>

namespace knurl::gltf {

/** Replaces %41 by A. A % without two hex digits is kept, because many exporters do not encode at all. */
std::string percent_decoded(std::string_view uri);

/** Starts with "name:", such as "https:" and "file:" (RFC 3986, 3.1), or "c:". */
bool has_scheme(std::string_view uri);

bool is_data_uri(std::string_view uri);

/** The bytes of data:[type][;...];base64,TEXT. Throws Failure without the URI. */
std::vector<unsigned char> data_uri_bytes(std::string_view uri);

} // namespace knurl::gltf
#endif
