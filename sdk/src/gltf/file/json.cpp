// SPDX-License-Identifier: MIT
#include "json.hpp"
#include "failure.hpp"

#include "nlohmann.hpp"

namespace knurl::gltf {

std::optional<bool> Json::flag() const {
    const bool *value = std::get_if<bool>(&value_);
    return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::optional<double> Json::number() const {
    if (const int64_t *value = std::get_if<int64_t>(&value_))
        return static_cast<double>(*value);
    if (const uint64_t *value = std::get_if<uint64_t>(&value_))
        return static_cast<double>(*value);
    if (const double *value = std::get_if<double>(&value_))
        return *value;
    return std::nullopt;
}

const Json *Json::find(std::string_view key) const {
    const Object *members = object();
    if (members == nullptr)
        return nullptr;
    const auto found = members->find(key);
    return found == members->end() ? nullptr : &found->second;
}

std::string Json::described() const {
    if (const std::string *value = text())
        return in_quotes(*value);
    if (const Array *elements = array())
        return "an array of " + std::to_string(elements->size());
    if (object() != nullptr)
        return "an object";
    if (const int64_t *value = std::get_if<int64_t>(&value_))
        return std::to_string(*value);
    if (const uint64_t *value = std::get_if<uint64_t>(&value_))
        return std::to_string(*value);
    if (const double *value = std::get_if<double>(&value_))
        return nlohmann::json(*value).dump(); // the shortest text that reads back as the same number
    const std::optional<bool> value = flag();
    return value ? *value ? "true" : "false" : "null";
}

} // namespace knurl::gltf
