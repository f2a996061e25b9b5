// Knurl: a JSON value, and a parser with limits against hostile files. Used instead of nlohmann's, whose destructor
// allocates and ends the process if memory runs out. This one's does not, and a value can be destroyed after any
// exception. SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_JSON_HPP
#define KNURL_GLTF_JSON_HPP

#include "budget.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace knurl::gltf {

/** Moved, never copied. Destroyed by recursion: parse_json() limits the depth. */
class Json {
  public:
    using Array = std::vector<Json>;
    using Object = std::map<std::string, Json, std::less<>>; ///< sorted, so that messages are reproducible

    Json() = default; ///< null
    explicit Json(bool value) : value_(value) {}
    explicit Json(int64_t value) : value_(value) {}
    explicit Json(uint64_t value) : value_(value) {}
    explicit Json(double value) : value_(value) {}
    explicit Json(std::string value) : value_(std::make_unique<std::string>(std::move(value))) {}
    explicit Json(Array value) : value_(std::make_unique<Array>(std::move(value))) {}
    explicit Json(Object value) : value_(std::make_unique<Object>(std::move(value))) {}

    /** Null for a value of another kind. */
    Object *object() {
        return get<Object>();
    }
    const Object *object() const {
        return get<Object>();
    }
    Array *array() {
        return get<Array>();
    }
    const Array *array() const {
        return get<Array>();
    }
    const std::string *text() const {
        return get<std::string>();
    }
    std::optional<bool> flag() const;
    /** Integers above 2^53 are rounded. */
    std::optional<double> number() const;

    /** The member, or null if this is not an object or has no such member. */
    const Json *find(std::string_view key) const;

    /** A description for "found ...". */
    std::string described() const;

  private:
    template <typename T>
    T *get() const {
        const std::unique_ptr<T> *held = std::get_if<std::unique_ptr<T>>(&value_);
        return held != nullptr ? held->get() : nullptr;
    }

    std::variant<std::nullptr_t, bool, int64_t, uint64_t, double, std::unique_ptr<std::string>, std::unique_ptr<Array>,
                 std::unique_ptr<Object>>
        value_ = nullptr; // 16 bytes: a file may hold millions
};

/** The deepest nesting of objects and arrays; a plain glTF file has 7. */
constexpr size_t json_depth_max = 32;

/** The most values in a file: a tree takes some 100 bytes for each, however short its text. */
constexpr size_t json_values_max = size_t{1} << 23U;

/** Parses without recursion. Throws Failure for a syntax error, deeper nesting, more values, or a key that appears
 * twice in one object: parsers differ in which one they keep. */
Json parse_json(std::string_view text, Budget &budget);

} // namespace knurl::gltf
#endif
