// SPDX-License-Identifier: MIT
#include "fields.hpp"

#include <cmath>

namespace knurl::gltf {
namespace {

/// A whole number, written 3 or 3.0; empty if it is not one or out of range.
std::optional<uint32_t> whole_of(const Json &value, uint32_t least, uint32_t most) {
    const double number = value.number().value_or(-1.0); // exact up to 2^53, and rounded above most
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
    if (object_->object() == nullptr)
        refuse(where(), (prefix_.empty() ? "" : prefix_.substr(0, prefix_.size() - 1) + ": ") +
                            "expected an object, found " + object_->described());
}

std::optional<Fields> Fields::object(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    return Fields(*value, *this, prefix_ + key + ".");
}

Fields Fields::item(const char *key, const char *kind, size_t i) const {
    return {array(key).at(i), kind, i};
}

Fields Fields::chosen(const char *key, const char *kind, uint32_t i) const {
    const size_t count = array(key).size();
    if (i >= count)
        throw Failure(KNURL_ERROR_ARGUMENT, std::string(key) + ": expected an index below " + std::to_string(count) +
                                                ", found " + std::to_string(i));
    return item(key, kind, i);
}

Fields Fields::element(const char *key, size_t i) const {
    return {array(key).at(i), *this, prefix_ + key + "[" + std::to_string(i) + "]."};
}

std::string Fields::where() const {
    return index_ == no_index ? std::string(kind_) : label(kind_, name(), index_);
}

std::string_view Fields::name() const {
    const Json *found = named_->find("name");
    const std::string *text = found != nullptr ? found->text() : nullptr;
    return text != nullptr ? std::string_view(*text) : std::string_view();
}

const Json *Fields::find(const char *key) const {
    return object_->find(key);
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
    std::vector<uint32_t> all;
    for (const Json &value : array(key))
        all.push_back(index_of(value, key + ("[" + std::to_string(all.size()) + "]"), size, kind));
    return all;
}

std::vector<double> Fields::numbers(const char *key, size_t count) const {
    const Json *value = find(key);
    if (value == nullptr)
        return {};
    const std::string expected = "an array of " + std::to_string(count) + " numbers";
    const Json::Array *elements = value->array();
    if (elements == nullptr || elements->size() != count)
        refuse_value(key, expected, *value);
    std::vector<double> all;
    for (const Json &element : *elements) {
        const std::optional<double> number = element.number();
        if (!number)
            refuse_value(key, expected, element);
        all.push_back(*number);
    }
    return all;
}

std::optional<bool> Fields::flag(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return std::nullopt;
    const std::optional<bool> flag = value->flag();
    if (!flag)
        refuse_value(key, "true or false", *value);
    return flag;
}

const std::string *Fields::text(const char *key) const {
    const Json *value = find(key);
    if (value == nullptr)
        return nullptr;
    const std::string *text = value->text();
    if (text == nullptr)
        refuse_value(key, "a string", *value);
    return text;
}

const Json::Array &Fields::array(const char *key) const {
    static const Json::Array empty;
    const Json *value = find(key);
    if (value == nullptr)
        return empty;
    const Json::Array *elements = value->array();
    if (elements == nullptr)
        refuse_value(key, "an array", *value);
    return *elements;
}

void Fields::refuse_value(const std::string &key, const std::string &expected, const Json &found) const {
    refuse_key(key, "expected " + expected + ", found " + found.described());
}

void Fields::refuse_key(const std::string &key, const std::string &what, knurl_result code) const {
    refuse(where(), prefix_ + key + ": " + what, code);
}

} // namespace knurl::gltf
