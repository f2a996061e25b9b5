// Knurl: lists a file's tags, and sets or removes one. Only the text of one object's `extras` changes: every other byte
// of the file stays. The JSON was checked by parse_json() before its text is walked, so the walk has no errors.
// SPDX-License-Identifier: MIT
#include <knurl/gltf.h>

#include "file/container.hpp"
#include "file/nlohmann.hpp"
#include "guarded.hpp"
#include "tags.hpp"

#include <cstring>

namespace knurl::gltf {
namespace {

struct Kind {
    const char *array; ///< the key in the file's root
    const char *name;  ///< in messages
};

constexpr Kind kinds[] = {{"materials", "material"}, {"meshes", "mesh"}, {"nodes", "node"}};

/// A member of an object, or an element of an array, by offsets into the text.
struct Part {
    std::string key; ///< decoded; "" in an array
    size_t begin = 0;
    size_t value = 0;
    size_t end = 0;
};

size_t skip_blank(std::string_view text, size_t at) {
    return text.find_first_not_of(" \t\r\n", at);
}

size_t skip_string(std::string_view text, size_t at) {
    for (++at; text[at] != '"'; ++at)
        at += text[at] == '\\' ? 1 : 0;
    return at + 1;
}

size_t skip_value(std::string_view text, size_t at) {
    if (std::strchr("\"{[", text[at]) == nullptr)
        return text.find_first_of(",]} \t\r\n", at);
    size_t depth = 0;
    do {
        const char c = text[at];
        depth += c == '{' || c == '[' ? 1 : 0;
        depth -= c == '}' || c == ']' ? 1 : 0;
        at = c == '"' ? skip_string(text, at) : at + 1;
    } while (depth > 0);
    return at;
}

std::string decoded(std::string_view quoted) {
    if (quoted.find('\\') == std::string_view::npos)
        return std::string(quoted.substr(1, quoted.size() - 2));
    Budget budget({});
    return *parse_json(quoted, budget).text();
}

/// The parts of the object or array that opens at an offset.
std::vector<Part> parts_of(std::string_view text, size_t open) {
    std::vector<Part> parts;
    for (size_t at = skip_blank(text, open + 1); text[at] != '}' && text[at] != ']';) {
        Part part;
        part.begin = at;
        if (text[open] == '{') {
            const size_t end = skip_string(text, at);
            part.key = decoded(text.substr(at, end - at));
            at = skip_blank(text, skip_blank(text, end) + 1); // after the colon
        }
        part.value = at;
        part.end = skip_value(text, at);
        at = skip_blank(text, part.end);
        if (text[at] == ',')
            at = skip_blank(text, at + 1);
        parts.push_back(std::move(part));
    }
    return parts;
}

std::optional<Part> find_part(std::string_view text, size_t open, std::string_view key) {
    for (Part &part : parts_of(text, open))
        if (part.key == key)
            return std::move(part);
    return std::nullopt;
}

/// The elements of an array of the root; the caller has checked that it is an array or absent.
std::vector<Part> objects_of(std::string_view text, const char *array) {
    const std::optional<Part> part = find_part(text, text.find('{'), array);
    return part ? parts_of(text, part->value) : std::vector<Part>();
}

bool is_extras(std::string_view key) {
    return key == "extras";
}

bool is_of_tag(std::string_view key) {
    return key == "knurl" || is_flat(key);
}

void erase_parts(std::string &text, size_t open, bool (*is_erased)(std::string_view key)) {
    const std::vector<Part> parts = parts_of(text, open);
    std::string kept;
    for (size_t i = 0; i < parts.size(); ++i)
        if (!is_erased(parts[i].key)) {
            const size_t from = kept.empty() ? parts[i].begin : parts[i - 1].end; // the comma before it, too
            kept.append(text, from, parts[i].end - from);
        }
    if (!parts.empty())
        text.replace(parts.front().begin, parts.back().end - parts.front().begin, kept);
}

void append_part(std::string &text, size_t open, const std::string &member) {
    const std::vector<Part> parts = parts_of(text, open);
    text.insert(parts.empty() ? open + 1 : parts.back().end, (parts.empty() ? "" : ",") + member);
}

/// A tag's keys without prefix, and their values as text, in the file's order.
class TagText {
  public:
    TagText() {
        set("version", "1");
    }

    /// "null" removes the key.
    void set(const std::string &key, std::string_view value) {
        const auto known = places_.find(key);
        if (value == "null") {
            if (known == places_.end())
                return;
            parts_[known->second].clear();
            places_.erase(known);
            return;
        }
        const size_t place = known != places_.end() ? known->second : parts_.size();
        if (known == places_.end()) {
            places_.emplace(key, place);
            parts_.emplace_back();
        }
        parts_[place] = nlohmann::json(key).dump() + ":" + std::string(value);
    }

    void set_all(std::string_view text, size_t open) {
        for (const Part &part : parts_of(text, open))
            set(part.key, text.substr(part.value, part.end - part.value));
    }

    std::string nested() const {
        std::string text;
        for (const std::string &part : parts_)
            if (!part.empty())
                text += (text.empty() ? "{" : ",") + part;
        return text.empty() ? "{}" : text + "}";
    }

  private:
    std::vector<std::string> parts_;       ///< "key":value; empty: removed
    std::map<std::string, size_t> places_; ///< a tree, not a hash table, which a hostile file could make slow
};

/// The tag in the extras that open at an offset; empty if there is none, as for extras that are not an object.
std::optional<TagText> read_tag_text(std::string_view text, size_t extras) {
    std::optional<TagText> tag;
    for (const Part &part : text[extras] == '{' ? parts_of(text, extras) : std::vector<Part>()) {
        if (!is_of_tag(part.key))
            continue;
        if (!tag)
            tag.emplace();
        if (is_flat(part.key))
            tag->set(part.key.substr(flat_prefix.size()), text.substr(part.value, part.end - part.value));
        else if (text[part.value] == '{')
            tag->set_all(text, part.value);
    }
    return tag;
}

/// patch: null removes the tag. owner: the object in messages.
void edit_object(std::string &text, size_t object, const char *patch, const Fields &owner) {
    if (const Json *extras = owner.find("extras"); extras != nullptr && extras->object() == nullptr)
        owner.refuse_value("extras", "an object, which can hold a tag", *extras);
    const std::optional<Part> extras = find_part(text, object, "extras");
    const std::optional<TagText> old = extras && patch != nullptr ? read_tag_text(text, extras->value) : std::nullopt;
    if (extras)
        erase_parts(text, extras->value, is_of_tag);
    if (patch != nullptr) {
        TagText tag = old.value_or(TagText());
        tag.set_all(patch, skip_blank(patch, 0));
        const std::string member = "\"knurl\":" + tag.nested();
        if (extras)
            append_part(text, extras->value, member);
        else
            append_part(text, object, "\"extras\":{" + member + "}");
    } else if (extras && parts_of(text, extras->value).empty()) {
        erase_parts(text, object, is_extras);
    }
}

void check_patch(const char *patch) {
    Budget budget({});
    const Json json = parse_json(patch, budget);
    if (json.object() == nullptr)
        refuse("tag", "expected a JSON object, found " + json.described());
}

const Kind &kind_of(const char *array) {
    for (const Kind &kind : kinds)
        if (std::strcmp(array, kind.array) == 0)
            return kind;
    throw Failure(KNURL_ERROR_ARGUMENT, "array: expected 'materials', 'meshes' or 'nodes', found " + in_quotes(array));
}

std::string edit_file(Bytes file, const Kind &kind, uint32_t index, const char *patch) {
    Budget budget({});
    budget.take_bytes(file.size, "");
    const Container container = split(file);
    const Json json = parse_json(container.json, budget);
    const Fields root(json, "", no_index);
    const Fields object = root.chosen(kind.array, kind.name, index);
    std::string text(container.json);
    edit_object(text, objects_of(text, kind.array).at(index).value, patch, object);
    const Json edited = parse_json(text, budget);
    (void)read_tag(Fields(edited, "", no_index).item(kind.array, kind.name, index));
    return with_json(file, container, std::move(text));
}

void list_file(Bytes file, knurl_gltf_list_callback each, void *user) {
    Budget budget({});
    budget.take_bytes(file.size, "");
    const std::string_view text = split(file).json;
    const Json json = parse_json(text, budget);
    const Fields root(json, "", no_index);
    for (const Kind &kind : kinds) {
        const size_t count = root.array(kind.array).size();
        const std::vector<Part> objects = objects_of(text, kind.array);
        for (uint32_t i = 0; i < count; ++i) {
            const std::string name(root.item(kind.array, kind.name, i).name());
            const std::optional<Part> extras = find_part(text, objects[i].value, "extras");
            const std::optional<TagText> tag = extras ? read_tag_text(text, extras->value) : std::nullopt;
            each(user, kind.array, i, name.c_str(), tag ? tag->nested().c_str() : nullptr);
        }
    }
}

} // namespace
} // namespace knurl::gltf

knurl_result knurl_gltf_list_tags(const void *data, uint64_t size, const char *name, knurl_gltf_list_callback each,
                                  void *user) {
    if ((size != 0 && knurl::gltf::is_null(data, "data")) || knurl::gltf::is_null(each, "each"))
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::guarded(name, [&] {
        knurl::gltf::list_file({static_cast<const unsigned char *>(data), static_cast<size_t>(size)}, each, user);
    });
}

knurl_result knurl_gltf_set_tag(const void *data, uint64_t size, const char *name, const char *array, uint32_t index,
                                const char *tag, knurl_gltf_write_callback write, void *user) {
    if ((size != 0 && knurl::gltf::is_null(data, "data")) || knurl::gltf::is_null(array, "array") ||
        knurl::gltf::is_null(write, "write"))
        return KNURL_ERROR_ARGUMENT;
    return knurl::gltf::guarded(name, [&] {
        const knurl::gltf::Kind &kind = knurl::gltf::kind_of(array);
        if (tag != nullptr)
            knurl::gltf::check_patch(tag);
        const std::string file = knurl::gltf::edit_file(
            {static_cast<const unsigned char *>(data), static_cast<size_t>(size)}, kind, index, tag);
        write(user, file.data(), file.size());
    });
}
