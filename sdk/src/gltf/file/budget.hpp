// Knurl: the options of one load, mostly limits. A file's size does not bound its cost: a few bytes can reuse an array,
// or give a count of millions. SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_BUDGET_HPP
#define KNURL_GLTF_BUDGET_HPP

#include "failure.hpp"

#include <knurl/gltf.h>

#include <chrono>
#include <filesystem>

namespace knurl::gltf {

/** Largest size of a file, and of all buffers of one load together. */
constexpr uint64_t bytes_max = uint64_t{1} << 30U;

/** Limits of knurl_mesh_desc. */
constexpr uint64_t vertices_max = uint64_t{1} << 28U;
constexpr uint64_t triangles_max = uint64_t{1} << 26U;

class Budget {
  public:
    /** Throws Failure for limits out of their ranges. */
    explicit Budget(const knurl_gltf_options &options);

    /** Checks the number of surfaces of the whole file. */
    void take_surfaces(uint64_t count) const;
    /** Charges bytes of a file or buffer; call before reading. `where` starts error messages: "" or "buffer 0". */
    void take_bytes(uint64_t count, const std::string &where);
    /** Charges a shape's vertices and triangles; call before reading them and after take_bytes() for all buffers. */
    void take_shape(uint64_t vertices, uint64_t triangles, const std::string &where);

    /** Reports progress. Throws Failure if max_seconds have passed or the callback cancels. done: 0 to 1. */
    void step(double done);
    /** The same without progress, inside a long step. */
    void step() {
        step(done_);
    }

    /** Reports a wrong tag to the caller's callback; false if there is none. A reported tag is skipped. */
    bool tell_wrong_tag(const char *message) const;

    /** Reports a file that was read to the caller's callback. */
    void tell_read(const std::filesystem::path &path) const;

  private:
    using Clock = std::chrono::steady_clock;

    knurl_gltf_options options_; ///< 0 in max_vertices and max_triangles: default plus a share of the bytes read
    uint64_t bytes_taken_ = 0;
    uint64_t vertices_taken_ = 0;
    uint64_t triangles_taken_ = 0;
    double done_ = 0.0;
    Clock::time_point start_ = Clock::now();
};

} // namespace knurl::gltf
#endif
