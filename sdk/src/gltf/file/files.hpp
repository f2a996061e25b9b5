// Knurl: reads buffers from files and data: URIs; refuses files outside the glTF file's folder.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILES_HPP
#define KNURL_GLTF_FILES_HPP

#include "budget.hpp"

#include <map>
#include <optional>
#include <vector>

namespace knurl::gltf {

/** Bytes that another object owns. */
struct Bytes {
    const unsigned char *data = nullptr;
    size_t size = 0;
};

/** Reads a whole regular file; follows links to it. */
std::vector<unsigned char> read_file(const std::filesystem::path &path, Budget &budget);

/** Sources that a glTF file's buffers and images may use. */
struct Resources {
    std::optional<Bytes> bin;                    ///< a .glb's BIN chunk
    std::optional<std::filesystem::path> folder; ///< external files must be in it or below; empty: refused
    Budget *budget = nullptr;                    ///< required
};

/** The contents of all URIs; each file is read and stored once. */
class Sources {
  public:
    /** The first `size` bytes of a buffer's URI: data: or a file below the folder. `where` starts error messages. */
    Bytes read(const std::string &uri, uint64_t size, const Resources &resources, const std::string &where);
    /** All bytes of a URI. size: the number expected of a data: URI, for the budget. */
    Bytes read_all(const std::string &uri, uint64_t size, const Resources &resources, const std::string &where);

  private:
    const std::vector<unsigned char> &find(const std::string &uri, uint64_t size, const Resources &resources,
                                           const std::string &where);

    std::map<std::filesystem::path, std::vector<unsigned char>> files_; ///< whole
    std::vector<std::vector<unsigned char>> texts_;                     ///< decoded data: URIs
};

} // namespace knurl::gltf
#endif
