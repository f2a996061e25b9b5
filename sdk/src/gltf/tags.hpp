// Knurl: a grating's tag in `extras` (schema: assets/knurl_extras.schema.json).
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_TAGS_HPP
#define KNURL_GLTF_TAGS_HPP

#include "fields.hpp"

#include <array>

namespace knurl::gltf {

/** What one object's tag says, or what several come to. Units as in knurl_material_desc. */
struct Tag {
    std::optional<std::array<double, 2>> spatial_frequency;
    std::optional<double> amplitude;
    std::optional<double> stiffness;
    std::optional<double> damping;
    std::optional<double> friction;
    std::optional<double> orientation;
    std::optional<std::array<double, 3>> axis; ///< object space, not 0
    std::optional<int32_t> method;

    /** Takes each key that `other` has from it. */
    void override_with(const Tag &other);

    /** The first required key that is not there, or null. */
    const char *missing_key() const;
};

/** The tag of a material, mesh or node, in either form; none where its extras hold none. */
std::optional<Tag> read_tag(const Fields &owner);

/** Refuses a tag on what cannot carry one, where it would be lost in silence. */
void refuse_tag(const Fields &owner, const std::string &instead);

} // namespace knurl::gltf
#endif
