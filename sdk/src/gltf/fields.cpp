// SPDX-License-Identifier: MIT
#include "fields.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace knurl::gltf {
namespace {

using Json = nlohmann::json;

/// A whole number of any spelling (3, 3.0), or none.
std::optional<uint32_t> whole_of(const Json &value, uint32_t least, uint32_t most) {
    double number = -1.0;
    if (value.is_number())
        number = value.get<double>(); // exact up to 2^53, and rounded above most
    if (!knurl_is_within(number, least, most) || number != std::floor(number))
        return std::nullopt;
    return static_cast<uint32_t>(number);
}

} // namespace

Fields::Fields(const Json &object, const char *kind, size_t index)
    : object_(&object), named_(&object), kind_(kind), index_(index) {
    check();
}

Fields::Fields(const Json &object, const Fields &parent, std::string prefix)
    : object_(&object), named_(parent.named_), kind_(parent.kind_), index_(parent.index_), prefix_(std::move(prefix)) {
    check();
}

void Fields::check() const {
    if (!object_->is_object())
        refuse(where(), (prefix_.empty() ? "" : prefix_.substr(0, prefix_.size() - 1) + ": ") +
                            "expected an object, found " + described(*object_));
}

std::optional<Fields> Fields::object(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    return Fields(*value, *this, prefix_ + key + ".");
}

Fields Fields::element(const char *key, size_t i) const {
    return {object_->at(key).at(i), *this, prefix_ + key + "[" + std::to_string(i) + "]."};
}

std::string Fields::where() const {
    return index_ == no_index ? std::string(kind_) : label(kind_, name(), index_);
}

std::string_view Fields::name() const {
    if (!named_->is_object())
        return {};
    const auto found = named_->find("name");
    return found != named_->end() && found->is_string() ? found->get_ref<const std::string &>() : std::string_view();
}

const Json *Fields::find(const char *key) const {
    const auto found = object_->find(key);
    return found == object_->end() ? nullptr : &*found;
}

std::optional<uint32_t> Fields::whole(const char *key, uint32_t least, uint32_t most) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    const std::optional<uint32_t> number = whole_of(*value, least, most);
    if (!number)
        refuse_value(key, "a whole number from " + std::to_string(least) + " to " + std::to_string(most), *value);
    return number;
}

uint32_t Fields::index_of(const Json &value, const std::string &key, size_t size, const char *kind) const {
    const std::optional<uint32_t> number = whole_of(value, 0, whole_max);
    if (!number || *number >= size)
        refuse_value(key, "an index below " + std::to_string(size) + " (" + kind + ")", value);
    return *number;
}

std::optional<uint32_t> Fields::index(const char *key, size_t size, const char *kind) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    return index_of(*value, key, size, kind);
}

std::vector<uint32_t> Fields::indices(const char *key, size_t size, const char *kind) const {
    std::vector<uint32_t> all(array_size(key));
    for (size_t i = 0; i < all.size(); ++i)
        all[i] = index_of(object_->at(key).at(i), key + ("[" + std::to_string(i) + "]"), size, kind);
    return all;
}

std::optional<std::vector<double>> Fields::numbers(const char *key, size_t count) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    const std::string expected = "an array of " + std::to_string(count) + " numbers";
    if (!value->is_array() || value->size() != count)
        refuse_value(key, expected, *value);
    std::vector<double> all;
    for (const Json &number : *value) {
        if (!number.is_number())
            refuse_value(key, expected, number);
        all.push_back(number.get<double>());
    }
    return all;
}

std::optional<bool> Fields::flag(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    if (!value->is_boolean())
        refuse_value(key, "true or false", *value);
    return value->get<bool>();
}

const std::string *Fields::text(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return nullptr;
    if (!value->is_string())
        refuse_value(key, "a string", *value);
    return &value->get_ref<const std::string &>();
}

size_t Fields::array_size(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return 0;
    if (!value->is_array())
        refuse_value(key, "an array", *value);
    return value->size();
}

void Fields::refuse_value(const std::string &key, const std::string &expected, const Json &found) const {
    refuse_key(key, "expected " + expected + ", found " + described(found));
}

void Fields::refuse_key(const std::string &key, const std::string &what, knurl_result code) const {
    refuse(where(), prefix_ + key + ": " + what, code);
}

} // namespace knurl::gltf
