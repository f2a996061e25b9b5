// Knurl: reads buffers from disk and from URIs, and refuses what a glTF file may not read.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FILES_HPP
#define KNURL_GLTF_FILES_HPP

#include "budget.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace knurl::gltf {

/** Bytes that another object owns. */
struct Bytes {
    const unsigned char *data = nullptr;
    size_t size = 0;
};

/** A whole regular file, links to it followed. */
std::vector<unsigned char> read_file(const std::filesystem::path &path, Budget &budget);

/** Receives the names of the files that were read. */
struct Listener {
    void (*file_read)(void *user, const char *path) = nullptr;
    void *user = nullptr;

    void tell(const std::filesystem::path &path) const {
        if (file_read != nullptr)
            file_read(user, path.u8string().c_str());
    }
};

/** Where a glTF file's buffers may come from. */
struct Resources {
    std::optional<Bytes> bin;                    ///< a .glb's BIN chunk
    std::optional<std::filesystem::path> folder; ///< external files lie in it or below; none: they are refused
    Listener listener;                           ///< told of external files
    Budget *budget = nullptr;                    ///< required
};

/** What URIs name, each file read and held once. */
class Sources {
  public:
    /** The first `size` bytes of what a buffer's URI names: data: or a file below the folder. where: for messages. */
    Bytes read(const std::string &uri, uint64_t size, const Resources &resources, const std::string &where);

  private:
    std::map<std::filesystem::path, std::vector<unsigned char>> files_; ///< whole
    std::vector<std::vector<unsigned char>> texts_;                     ///< what data: URIs held
};

} // namespace knurl::gltf
#endif
