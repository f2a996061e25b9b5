// Knurl: the limits of one load. A file's size does not bound its cost: a few bytes can reuse an array, or give a count
// of millions.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_BUDGET_HPP
#define KNURL_GLTF_BUDGET_HPP

#include "failure.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace knurl::gltf {

/** Largest size of a file, and of all buffers of one load together. */
constexpr uint64_t bytes_max = uint64_t{1} << 30U;

/** Limits of knurl_mesh_desc. */
constexpr uint64_t vertices_max = uint64_t{1} << 28U;
constexpr uint64_t triangles_max = uint64_t{1} << 26U;

/** The most surfaces that a scene can hold. */
constexpr uint32_t surfaces_max = uint32_t{1} << 20U;

/** Limits in knurl_gltf_options; 0: the default. */
struct Limits {
    uint32_t surfaces = 0;
    uint64_t bytes = 0;
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    double seconds = 0.0;
};

class Budget {
  public:
    using Progress = int32_t (*)(void *user, double done);

    /** progress: as in knurl_gltf_options. Throws Failure for limits out of their ranges. */
    Budget(const Limits &asked, Progress progress, void *user);

    uint32_t surfaces() const {
        return surfaces_;
    }

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

  private:
    using Clock = std::chrono::steady_clock;

    uint32_t surfaces_;
    uint64_t bytes_;
    uint64_t vertices_;  ///< 0: default plus a share of the bytes read
    uint64_t triangles_; ///< likewise
    double seconds_;
    uint64_t bytes_taken_ = 0;
    uint64_t vertices_taken_ = 0;
    uint64_t triangles_taken_ = 0;
    Progress progress_ = nullptr;
    void *user_ = nullptr;
    double done_ = 0.0;
    Clock::time_point start_ = Clock::now();
};

} // namespace knurl::gltf
#endif
