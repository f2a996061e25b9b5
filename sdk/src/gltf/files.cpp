// SPDX-License-Identifier: MIT
#include "files.hpp"
#include "uri.hpp"

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;

namespace knurl::gltf {
namespace {

/// A regular file's size. A directory, FIFO or device is refused before it is opened: opening one may never return.
uint64_t regular_size(const fs::path &path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
        throw Failure(KNURL_ERROR_IO, "no such file");
    if (error)
        throw Failure(KNURL_ERROR_IO, "cannot be read: " + error.message());
    if (status.type() != fs::file_type::regular)
        throw Failure(KNURL_ERROR_IO, std::string("expected a regular file, found a ") +
                                          (status.type() == fs::file_type::directory ? "directory" : "special file"));
    const uint64_t size = fs::file_size(path, error);
    if (error)
        throw Failure(KNURL_ERROR_IO, "cannot be read: " + error.message());
    return size;
}

std::vector<unsigned char> read_start(const fs::path &path, uint64_t size) {
    std::vector<unsigned char> bytes(static_cast<size_t>(size));
    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw Failure(KNURL_ERROR_IO, "cannot be opened for reading");
    stream.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<uint64_t>(stream.gcount()) != size)
        throw Failure(KNURL_ERROR_IO, "cannot be read to its end");
    return bytes;
}

std::vector<unsigned char> read_regular_start(const fs::path &path, uint64_t size) {
    const uint64_t there = regular_size(path);
    if (there < size)
        throw Failure(KNURL_ERROR_FORMAT,
                      "expected " + std::to_string(size) + " bytes (byteLength), found " + std::to_string(there));
    return read_start(path, size);
}

/// The file that a relative URI names, symbolic links resolved; nothing outside the folder.
fs::path locate(const std::string &uri, const fs::path &folder) {
    const std::string decoded = percent_decoded(uri);
    const fs::path relative = fs::u8path(decoded);
    if (has_scheme(uri) || relative.has_root_path() || decoded.find('\0') != std::string::npos)
        throw Failure(KNURL_ERROR_FORMAT, "expected a path relative to the glTF file, without a scheme");
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error)
        throw Failure(KNURL_ERROR_IO, "no folder " + in_quotes(folder.u8string()));
    const fs::path file = fs::canonical(root / relative, error);
    if (error)
        throw Failure(KNURL_ERROR_IO, "no such file in " + in_quotes(folder.empty() ? "." : folder.u8string()));
    if (std::mismatch(root.begin(), root.end(), file.begin(), file.end()).first != root.end())
        throw Failure(KNURL_ERROR_FORMAT, "expected a file in the glTF file's folder or below it");
    return file;
}

std::vector<unsigned char> read_data_uri(const std::string &uri, uint64_t size) {
    std::vector<unsigned char> bytes = data_uri_bytes(uri);
    if (bytes.size() < size)
        throw Failure(KNURL_ERROR_FORMAT, "expected " + std::to_string(size) + " bytes (byteLength), found " +
                                              std::to_string(bytes.size()));
    bytes.resize(static_cast<size_t>(size)); // a longer one is allowed, and padded to 3 bytes is common
    return bytes;
}

} // namespace

std::vector<unsigned char> read_file(const fs::path &path) {
    const uint64_t size = regular_size(path);
    if (size > bytes_max)
        throw Failure(KNURL_ERROR_IO, "expected at most 1 GiB, found " + std::to_string(size) + " bytes");
    return read_start(path, size);
}

std::vector<unsigned char> read_uri(const std::string &uri, uint64_t size, const Resources &resources,
                                    const std::string &where) {
    try {
        if (is_data_uri(uri))
            return read_data_uri(uri, size);
        if (!resources.folder)
            throw Failure(KNURL_ERROR_IO, "an external file cannot be read, for no folder was given: embed the buffer");
        const fs::path file = locate(uri, *resources.folder);
        std::vector<unsigned char> bytes = read_regular_start(file, size);
        resources.listener.tell(file);
        return bytes;
    } catch (const Failure &failure) {
        refuse(where + ": uri " + in_quotes(uri), failure.what(), failure.code());
    }
}

} // namespace knurl::gltf
