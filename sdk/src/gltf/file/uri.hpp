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

/** The scheme in lower case, such as "https", "data", or "c" of a drive (RFC 3986, 3.1); "" if there is no scheme. */
std::string scheme_of(std::string_view uri);

/** The bytes of data:[type][;...];base64,TEXT. Throws Failure without the URI. */
std::vector<unsigned char> data_uri_bytes(std::string_view uri);

} // namespace knurl::gltf
#endif
