// SPDX-License-Identifier: MIT
#include "tags.hpp"

#include <knurl/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace knurl::gltf {
namespace {

/// One key, its value, and its object for messages. Keys: "knurl.stiffness", or flat "knurl_stiffness".
struct Entry {
    const Fields &extras;
    std::string key;
    const Json &value;

    [[noreturn]] void refuse(const char *expected) const {
        refuse(expected, value);
    }

    /// found: a part of the value.
    [[noreturn]] void refuse(const char *expected, const Json &found) const {
        extras.refuse_value(key, expected, found);
    }
};

double number(const Entry &entry, const Json &value, const char *expected) {
    const std::optional<double> x = value.number();
    if (!x || !knurl_is_finite(*x))
        entry.refuse(expected, value);
    return *x;
}

double number_from_0(const Entry &entry, const Json &value, const char *expected) {
    const double x = number(entry, value, expected);
    if (x < 0.0)
        entry.refuse(expected, value);
    return x;
}

void read_version(Tag & /*tag*/, const Entry &entry) {
    if (entry.value.number() != 1.0)
        entry.refuse("1, the version that this library reads");
}

void read_spatial_frequency(Tag &tag, const Entry &entry) {
    const char *expected = "a number >= 0 or an array of 2 of them (cycles/m)";
    if (entry.value.number()) {
        tag.spatial_frequency = {number_from_0(entry, entry.value, expected), 0.0};
        return;
    }
    const Json::Array *two = entry.value.array();
    if (two == nullptr || two->size() != 2)
        entry.refuse(expected);
    tag.spatial_frequency = {number_from_0(entry, two->front(), expected), number_from_0(entry, two->back(), expected)};
}

void read_axis(Tag &tag, const Entry &entry) {
    const char *expected = "an array of 3 numbers that are not all 0 (a direction in object space)";
    std::array<double, 3> axis{};
    const Json::Array *three = entry.value.array();
    if (three == nullptr || three->size() != axis.size())
        entry.refuse(expected);
    for (size_t i = 0; i < axis.size(); ++i)
        axis[i] = number(entry, (*three)[i], expected);
    // Scale the largest component to 1, so that squares neither overflow nor underflow.
    const double largest = std::max({std::fabs(axis[0]), std::fabs(axis[1]), std::fabs(axis[2])});
    if (largest == 0.0)
        entry.refuse(expected, three->front());
    for (double &component : axis)
        component /= largest;
    tag.axis = axis;
}

void read_coordinates(Tag &tag, const Entry &entry) {
    const std::string *name = entry.value.text();
    if (name == nullptr || (*name != "auto" && *name != "box"))
        entry.refuse("'auto' or 'box'");
    tag.coordinates = *name == "box" ? KNURL_COORDINATES_BOX : KNURL_COORDINATES_AUTO;
}

/// The methods' names for a message: "'S1', 'S2' or 'bandlimited'".
std::string method_names() {
    std::string names;
    for (int32_t i = 1; const char *name = knurl_method_name(i); ++i)
        names += (i == 1 ? "'" : knurl_method_name(i + 1) ? ", '" : " or '") + std::string(name) + "'";
    return names;
}

void read_method(Tag &tag, const Entry &entry) {
    const std::string *name = entry.value.text();
    if (name == nullptr)
        entry.refuse(("a string: " + method_names()).c_str());
    int32_t method = KNURL_METHOD_DEFAULT;
    if (knurl_method_from_name(name->c_str(), &method) != KNURL_OK)
        entry.refuse(method_names().c_str());
    tag.method = method;
}

void read_smooth(Tag &tag, const Entry &entry) {
    const std::optional<double> x = entry.value.number(); // Blender's older properties have no booleans
    tag.smooth = entry.value.flag();
    if (x && (*x == 0.0 || *x == 1.0))
        tag.smooth = *x == 1.0;
    if (!tag.smooth)
        entry.refuse("true or false");
}

struct Key {
    const char *name;
    void (*read)(Tag &, const Entry &); ///< null: one number, into `to`
    std::optional<double> Tag::*to = nullptr;
    double least = 0.0;
    const char *expected = nullptr;
};

constexpr double above_0 = std::numeric_limits<double>::denorm_min();
constexpr double any_number = std::numeric_limits<double>::lowest();

constexpr Key keys[] = {{"version", read_version},
                        {"spatial_frequency", read_spatial_frequency},
                        {"amplitude", nullptr, &Tag::amplitude, 0.0, "a number >= 0 (m)"},
                        {"stiffness", nullptr, &Tag::stiffness, above_0, "a number > 0 (N/m)"},
                        {"damping", nullptr, &Tag::damping, 0.0, "a number >= 0 (N s/m)"},
                        {"friction", nullptr, &Tag::friction, 0.0, "a number >= 0 (a Coulomb coefficient)"},
                        {"orientation", nullptr, &Tag::orientation, any_number, "a number (rad)"},
                        {"axis", read_axis},
                        {"coordinates", read_coordinates},
                        {"method", read_method},
                        {"smooth", read_smooth}};

void read_key(Tag &tag, const Key &key, const Entry &entry) {
    if (key.read != nullptr)
        return key.read(tag, entry);
    const double x = number(entry, entry.value, key.expected);
    if (x < key.least)
        entry.refuse(key.expected);
    tag.*key.to = x;
}

/// prefix: of keys in messages, "knurl." or "knurl_".
void read_entry(Tag &tag, const Fields &extras, const std::string &prefix, std::string_view name, const Json &value) {
    for (const Key &key : keys)
        if (name == key.name) {
            return read_key(tag, key, {extras, prefix + key.name, value});
        }
    std::string known;
    for (const Key &key : keys)
        known += (known.empty() ? "" : ", ") + prefix + key.name;
    extras.refuse_key(prefix + shortened(name), "unknown key; known are " + known);
}

} // namespace

void Tag::override_with(const Tag &other) {
    const auto take = [](auto &mine, const auto &theirs) {
        if (theirs)
            mine = theirs;
    };
    if (other.axis)
        coordinates.reset(); // of an axis and a box the later one wins
    if (other.coordinates)
        axis.reset();
    wrong = wrong || other.wrong;
    take(spatial_frequency, other.spatial_frequency);
    for (const Key &key : keys)
        if (key.to != nullptr)
            take(this->*key.to, other.*key.to);
    take(axis, other.axis);
    take(coordinates, other.coordinates);
    take(method, other.method);
    take(smooth, other.smooth);
}

const char *Tag::missing_key() const {
    return !spatial_frequency ? "spatial_frequency" : !amplitude ? "amplitude" : !stiffness ? "stiffness" : nullptr;
}

std::optional<Tag> read_tag(const Fields &owner) {
    const Json *extras = owner.find("extras");
    const Json::Object *members = extras != nullptr ? extras->object() : nullptr;
    if (members == nullptr)
        return std::nullopt; // extras may be anything (glTF 2.0, 3.2); if not an object, it has no tag
    const Json *nested = extras->find("knurl");
    std::optional<Tag> tag;
    if (nested != nullptr) {
        if (nested->object() == nullptr)
            owner.refuse_value("extras.knurl", "an object", *nested);
        tag.emplace();
        if (nested->find("version") == nullptr)
            owner.refuse_key("knurl.version", "missing: expected 1");
        for (const auto &[name, value] : *nested->object())
            read_entry(*tag, owner, "knurl.", name, value);
    }
    for (auto member = members->lower_bound(flat_prefix); member != members->end() && is_flat(member->first);
         ++member) {
        if (nested != nullptr)
            owner.refuse_key("extras", "holds both an object 'knurl' and flat keys such as " +
                                           in_quotes(member->first) + ": expected one form of the tag");
        if (!tag)
            tag.emplace();
        read_entry(*tag, owner, std::string(flat_prefix), std::string_view(member->first).substr(flat_prefix.size()),
                   member->second);
    }
    return tag;
}

void refuse_tag(const Fields &owner, const std::string &instead) {
    const Json *extras = owner.find("extras");
    const Json::Object *members = extras != nullptr ? extras->object() : nullptr;
    if (members == nullptr)
        return;
    const auto flat = members->lower_bound(flat_prefix);
    if (members->count("knurl") != 0 || (flat != members->end() && is_flat(flat->first)))
        owner.refuse_key("extras", "a knurl tag would be lost here: " + instead);
}

} // namespace knurl::gltf
