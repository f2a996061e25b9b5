// Knurl: the limits of one load. A file's size says little about what it asks for: a few
// bytes name an array again, or count to millions.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_BUDGET_HPP
#define KNURL_GLTF_BUDGET_HPP

#include "failure.hpp"

#include <chrono>
#include <cstdint>
#include <string>

namespace knurl::gltf {

/** Files, and the buffers of one load taken together, may not be larger. */
constexpr uint64_t bytes_max = uint64_t{1} << 30U;

/** What knurl_mesh_desc takes. */
constexpr uint64_t vertices_max = uint64_t{1} << 28U;
constexpr uint64_t triangles_max = uint64_t{1} << 26U;

/** As many as a scene can hold. */
constexpr uint32_t surfaces_max = uint32_t{1} << 20U;

/** knurl_gltf_budget's fields; 0: the default. */
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

    /** progress: as in knurl_gltf_report. Throws Failure for limits out of their ranges. */
    Budget(const Limits &asked, Progress progress, void *user);

    uint32_t surfaces() const {
        return surfaces_;
    }

    /** Takes so many bytes of a file or buffer, before they are read. where: "" or "buffer 0". */
    void take_bytes(uint64_t count, const std::string &where);
    /** Takes what shapes are made of, before it is read; after all bytes. */
    void take_shape(uint64_t vertices, uint64_t triangles, const std::string &where);

    /** Throws Failure once max_seconds are over, or where the caller says that it is enough. done: 0 to 1. */
    void step(double done);
    /** The same within a long step that is as far as the last one. */
    void step() {
        step(done_);
    }

  private:
    using Clock = std::chrono::steady_clock;

    uint32_t surfaces_;
    uint64_t bytes_;
    uint64_t vertices_;  ///< as asked for; 0: by what is read
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
