// SPDX-License-Identifier: MIT
#include "budget.hpp"

#include <algorithm>

namespace knurl::gltf {
namespace {

constexpr uint32_t surfaces_default = uint32_t{1} << 16U;
constexpr uint32_t surfaces_max = uint32_t{1} << 20U; // of knurl_scene_desc
constexpr double seconds_default = 60.0;

// Defaults: a fixed number for every file, plus some per byte read. A vertex takes at least 3 bytes in a file, a
// triangle of a strip 1 or 2. Files of exporters stay far below; 2^20 triangles take about a second, and some 100 MB
// while they are built.
constexpr uint64_t vertices_default = uint64_t{1} << 24U;
constexpr uint64_t vertices_a_byte = 16;
constexpr uint64_t triangles_default = uint64_t{1} << 20U;
constexpr uint64_t bytes_a_triangle = 2;

[[noreturn]] void refuse_excess(const std::string &where, const char *name, uint64_t most, uint64_t found) {
    refuse(where,
           std::string("options.") + name + ": expected at most " + std::to_string(most) + ", found " +
               std::to_string(found) + " (see knurl_gltf_options)",
           KNURL_ERROR_FULL);
}

void check_limit(uint64_t asked, uint64_t greatest, const char *name) {
    if (asked > greatest)
        throw Failure(KNURL_ERROR_ARGUMENT, std::string("options.") + name + ": expected 0 to " +
                                                std::to_string(greatest) + ", found " + std::to_string(asked));
}

} // namespace

Budget::Budget(const knurl_gltf_options &options) : options_(options) {
    check_limit(options.max_surfaces, surfaces_max, "max_surfaces");
    check_limit(options.max_bytes, bytes_max, "max_bytes");
    check_limit(options.max_vertices, UINT64_MAX / 2, "max_vertices");
    check_limit(options.max_triangles, triangles_max, "max_triangles");
    if (!(options.max_seconds >= 0.0))
        throw Failure(KNURL_ERROR_ARGUMENT, "options.max_seconds: expected >= 0, found " + shown(options.max_seconds));
    options_.max_surfaces = options.max_surfaces != 0 ? options.max_surfaces : surfaces_default;
    options_.max_bytes = options.max_bytes != 0 ? options.max_bytes : bytes_max;
    options_.max_seconds = options.max_seconds > 0.0 ? options.max_seconds : seconds_default;
}

void Budget::take_surfaces(uint64_t count) const {
    if (count > options_.max_surfaces)
        refuse_excess("", "max_surfaces", options_.max_surfaces, count);
}

void Budget::take_bytes(uint64_t count, const std::string &where) {
    bytes_taken_ += count;
    if (bytes_taken_ > options_.max_bytes)
        refuse_excess(where, "max_bytes", options_.max_bytes, bytes_taken_);
}

void Budget::take_shape(uint64_t vertices, uint64_t triangles, const std::string &where) {
    const uint64_t most_vertices =
        options_.max_vertices != 0 ? options_.max_vertices : vertices_default + vertices_a_byte * bytes_taken_;
    const uint64_t most_triangles = options_.max_triangles != 0
                                        ? options_.max_triangles
                                        : std::min(triangles_max, triangles_default + bytes_taken_ / bytes_a_triangle);
    vertices_taken_ += vertices;
    triangles_taken_ += triangles;
    if (vertices_taken_ > most_vertices)
        refuse_excess(where, "max_vertices", most_vertices, vertices_taken_);
    if (triangles_taken_ > most_triangles)
        refuse_excess(where, "max_triangles", most_triangles, triangles_taken_);
}

void Budget::step(double done) {
    done_ = std::max(done_, done);
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (seconds > options_.max_seconds)
        throw Failure(KNURL_ERROR_FULL, "options.max_seconds: expected at most " + shown(options_.max_seconds) +
                                            " s, found more (see knurl_gltf_options)");
    if (options_.progress != nullptr && options_.progress(options_.user, done_) != 0)
        throw Failure(KNURL_ERROR_CANCELLED, "the load was cancelled");
}

bool Budget::tell_wrong_tag(const char *message) const {
    if (options_.wrong_tag == nullptr)
        return false;
    options_.wrong_tag(options_.user, message);
    return true;
}

void Budget::tell_read(const std::filesystem::path &path) const {
    if (options_.file_read != nullptr)
        options_.file_read(options_.user, path.u8string().c_str());
}

} // namespace knurl::gltf
