// Knurl: a grating's tag in `extras` (schema: assets/knurl_extras.schema.json).
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_TAGS_HPP
#define KNURL_GLTF_TAGS_HPP

#include "fields.hpp"

#include <array>

namespace knurl::gltf {

/** The tag of one object, or several merged. Units as in knurl_material_desc. */
struct Tag {
    std::optional<std::array<double, 2>> spatial_frequency;
    std::optional<double> amplitude;
    std::optional<double> stiffness;
    std::optional<double> damping;
    std::optional<double> friction;
    std::optional<double> orientation;
    std::optional<std::array<double, 3>> axis; ///< object space, not 0
    std::optional<int32_t> coordinates;        ///< KNURL_COORDINATES_
    std::optional<int32_t> method;
    std::optional<bool> smooth; ///< KNURL_SMOOTH_ON or _OFF; empty: _AUTO
    bool wrong = false;         ///< the caller was told of a mistake in it: not loaded

    /** Replaces each key that `other` has. */
    void override_with(const Tag &other);

    /** The first required key that is missing, or null. */
    const char *missing_key() const;
};

/** A key of the flat form begins with this. */
constexpr std::string_view flat_prefix = "knurl_";

inline bool is_flat(std::string_view key) {
    return key.substr(0, flat_prefix.size()) == flat_prefix;
}

/** The tag of a material, mesh or node, nested or flat; empty if its extras have no tag. Throws Failure. */
std::optional<Tag> read_tag(const Fields &owner);

/** Throws Failure if `owner`, which cannot carry a tag, has one: it would be ignored silently. instead: advice. */
void refuse_tag(const Fields &owner, const std::string &instead);

} // namespace knurl::gltf
#endif
