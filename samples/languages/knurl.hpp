/* Knurl in C++17: owners that release, and errors as exceptions. Everything else is the C interface. Copy and extend
 * it. SPDX-License-Identifier: MIT */
#ifndef KNURL_HPP
#define KNURL_HPP

#include <knurl/knurl.h>

#include <memory>
#include <stdexcept>

namespace knurl {

struct error : std::runtime_error {
    explicit error(knurl_result result) : std::runtime_error(knurl_error_message()), code(result) {}
    knurl_result code;
};

inline void check(knurl_result result) {
    if (result != KNURL_OK) {
        throw error(result);
    }
}

template <auto release>
struct releases {
    template <typename T>
    void operator()(T *owned) const {
        (void)release(owned);
    }
};
using scene = std::unique_ptr<knurl_scene, releases<knurl_scene_destroy>>;
using device = std::unique_ptr<knurl_device, releases<knurl_device_close>>;
using loop = std::unique_ptr<knurl_loop, releases<knurl_loop_destroy>>;

/** An owner from a function that creates: make<knurl::scene>(knurl_scene_create, nullptr). */
template <typename Owner, typename Create, typename... Arguments>
Owner make(Create create, Arguments... arguments) {
    typename Owner::pointer made = nullptr;
    check(create(arguments..., &made));
    return Owner(made);
}

/** A struct with its defaults: auto plane = described(knurl_plane_desc_init). */
template <typename T>
T described(void (*init)(T *, uint32_t)) {
    T desc;
    init(&desc, sizeof desc);
    return desc;
}

} // namespace knurl

#endif
