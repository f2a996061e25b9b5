// Knurl: typed reading of one JSON object's keys: all checks of types and ranges are here.
// SPDX-License-Identifier: MIT
#ifndef KNURL_GLTF_FIELDS_HPP
#define KNURL_GLTF_FIELDS_HPP

#include "file/failure.hpp"
#include "file/json.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace knurl::gltf {

/** The largest whole number: fits an int in tinygltf's structs, and is above any offset in a file of bytes_max. */
constexpr uint32_t whole_max = 0x7FFFFFFF;

/** Index of the file's root, which is not in an array. */
constexpr size_t no_index = SIZE_MAX;

/** A JSON object and its name in messages. */
class Fields {
  public:
    /** kind, index: "material" 3; "" and no_index for the root. object: must outlive this. */
    Fields(const Json &object, const char *kind, size_t index);

    /** The object under `key`, or empty if absent. Its keys appear in messages as "key.name". */
    std::optional<Fields> object(const char *key) const;
    /** Object i of the array under `key`, of its own kind in messages: "node" 3. */
    Fields item(const char *key, const char *kind, size_t i) const;
    /** The same with an index that the caller of the library chose: throws KNURL_ERROR_ARGUMENT beyond the end. */
    Fields chosen(const char *key, const char *kind, uint32_t i) const;
    /** The same as item(), as a part of this object. Its keys appear in messages as "key[i].name". */
    Fields element(const char *key, size_t i) const;

    /** "material 'bars' (0)" */
    std::string where() const;
    /** The object's name, or "". */
    std::string_view name() const;

    /** The value under a key, or null if absent. */
    const Json *find(const char *key) const;
    std::optional<uint32_t> whole(const char *key, uint32_t least = 0, uint32_t most = whole_max) const;
    /** An index into an array of `size` elements; `kind` names the array in messages. */
    std::optional<uint32_t> index(const char *key, size_t size, const char *kind) const;
    /** Exactly `count` numbers; empty if absent. */
    std::vector<double> numbers(const char *key, size_t count) const;
    std::optional<bool> flag(const char *key) const;
    const std::string *text(const char *key) const;
    /** The array under `key`; empty if absent. */
    const Json::Array &array(const char *key) const;
    /** Indices into an array of `size` elements; empty if absent. */
    std::vector<uint32_t> indices(const char *key, size_t size, const char *kind) const;

    /** Throws "OBJECT: KEY: expected EXPECTED, found ...". */
    [[noreturn]] void refuse_value(const std::string &key, const std::string &expected, const Json &found) const;
    /** Throws "OBJECT: KEY: PROBLEM". */
    [[noreturn]] void refuse_key(const std::string &key, const std::string &what,
                                 knurl_result code = KNURL_ERROR_FORMAT) const;
    /** Returns the value; throws "OBJECT: KEY: missing: expected ..." if it is empty. */
    template <typename T>
    T required(std::optional<T> value, const char *key, const char *expected) const {
        if (!value)
            refuse_key(key, std::string("missing: expected ") + expected);
        return *std::move(value);
    }

  private:
    Fields(const Json &object, const Fields &parent, std::string prefix);
    uint32_t index_of(const Json &value, const std::string &key, size_t size, const char *kind) const;
    void check() const;

    const Json *object_;
    const Json *named_; ///< the object whose name appears in messages
    const char *kind_;
    size_t index_;
    std::string prefix_; ///< put before keys in messages
};

} // namespace knurl::gltf
#endif
