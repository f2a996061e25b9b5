// SPDX-License-Identifier: MIT
#include "budget.hpp"

#include <algorithm>

namespace knurl::gltf {
namespace {

constexpr uint32_t surfaces_default = uint32_t{1} << 16U;
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
           std::string("budget.") + name + ": expected at most " + std::to_string(most) + ", found " +
               std::to_string(found) + " (see knurl_gltf_options)",
           KNURL_ERROR_FULL);
}

/// Returns the limit asked for (0: default); throws Failure if it is above `greatest`.
uint64_t limit_of(uint64_t asked, uint64_t greatest, const char *name) {
    if (asked > greatest)
        throw Failure(KNURL_ERROR_ARGUMENT, std::string("budget.") + name + ": expected 0 to " +
                                                std::to_string(greatest) + ", found " + std::to_string(asked));
    return asked;
}

} // namespace

Budget::Budget(const Limits &asked, Progress progress, void *user)
    : surfaces_(static_cast<uint32_t>(limit_of(asked.surfaces, surfaces_max, "max_surfaces"))),
      bytes_(limit_of(asked.bytes, bytes_max, "max_bytes")),
      vertices_(limit_of(asked.vertices, UINT64_MAX / 2, "max_vertices")),
      triangles_(limit_of(asked.triangles, triangles_max, "max_triangles")), seconds_(asked.seconds),
      progress_(progress), user_(user) {
    if (!(seconds_ >= 0.0))
        throw Failure(KNURL_ERROR_ARGUMENT, "budget.max_seconds: expected >= 0, found " + std::to_string(seconds_));
    surfaces_ = surfaces_ != 0 ? surfaces_ : surfaces_default;
    bytes_ = bytes_ != 0 ? bytes_ : bytes_max;
    seconds_ = seconds_ > 0.0 ? seconds_ : seconds_default;
}

void Budget::take_bytes(uint64_t count, const std::string &where) {
    bytes_taken_ += count;
    if (bytes_taken_ > bytes_)
        refuse_excess(where, "max_bytes", bytes_, bytes_taken_);
}

void Budget::take_shape(uint64_t vertices, uint64_t triangles, const std::string &where) {
    const uint64_t most_vertices = vertices_ != 0 ? vertices_ : vertices_default + vertices_a_byte * bytes_taken_;
    const uint64_t most_triangles =
        triangles_ != 0 ? triangles_ : std::min(triangles_max, triangles_default + bytes_taken_ / bytes_a_triangle);
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
    if (seconds > seconds_)
        throw Failure(KNURL_ERROR_FULL, "budget.max_seconds: expected at most " + std::to_string(seconds_) +
                                            " s, found more (see knurl_gltf_options)");
    if (progress_ != nullptr && progress_(user_, done_) != 0)
        throw Failure(KNURL_ERROR_CANCELLED, "the load was cancelled");
}

} // namespace knurl::gltf
