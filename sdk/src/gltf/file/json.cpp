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

namespace {

/// Builds the tree from the parser's events, so that limits apply while parsing, not afterwards.
class Builder : public nlohmann::json_sax<nlohmann::json> {
  public:
    explicit Builder(Budget &budget) : budget_(budget) {}

    Json take() {
        return std::move(root_);
    }

    bool null() override {
        return add(Json());
    }
    bool boolean(bool value) override {
        return add(Json(value));
    }
    bool number_integer(number_integer_t value) override {
        return add(Json(value));
    }
    bool number_unsigned(number_unsigned_t value) override {
        return add(Json(value));
    }
    bool number_float(number_float_t value, const string_t & /*text*/) override {
        return add(Json(value));
    }
    bool string(string_t &value) override {
        return add(Json(std::move(value)));
    }
    bool binary(binary_t & /*value*/) override {
        return false; // not in JSON text
    }
    bool start_object(size_t /*size*/) override {
        return open(Json(Json::Object()));
    }
    bool end_object() override {
        open_.pop_back();
        return true;
    }
    bool start_array(size_t /*size*/) override {
        return open(Json(Json::Array()));
    }
    bool end_array() override {
        open_.pop_back();
        return true;
    }

    bool key(string_t &name) override {
        const auto [member, fresh] = open_.back()->object()->try_emplace(name);
        if (!fresh)
            refuse("JSON", "the key " + in_quotes(name) + " appears twice in " + path());
        added_ = &member->second;
        return true;
    }

    bool parse_error(size_t /*position*/, const std::string & /*token*/,
                     const nlohmann::json::exception &error) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: ...": drop the bracket.
        std::string_view text = error.what();
        const size_t bracket = text.find("] ");
        if (bracket != std::string_view::npos)
            text.remove_prefix(bracket + 2);
        throw Failure(KNURL_ERROR_FORMAT, "JSON: " + shortened(text, 300));
    }

  private:
    bool add(Json value) {
        if (values_ % values_a_step == 0)
            budget_.step();
        if (++values_ > json_values_max)
            refuse("JSON", "more than " + std::to_string(json_values_max) + " values");
        if (open_.empty()) {
            root_ = std::move(value);
            added_ = &root_;
        } else if (Json::Array *elements = open_.back()->array()) {
            added_ = &elements->emplace_back(std::move(value));
        } else {
            *added_ = std::move(value);
        }
        return true;
    }

    bool open(Json container) {
        if (open_.size() == json_depth_max)
            refuse("JSON", "nested deeper than " + std::to_string(json_depth_max) + " in " + path());
        add(std::move(container));
        open_.push_back(added_);
        return true;
    }

    /// The current position: "materials[0].extras".
    std::string path() const {
        std::string text;
        for (size_t i = 0; i + 1 < open_.size(); ++i) {
            if (const Json::Array *elements = open_[i]->array()) {
                text += "[" + std::to_string(elements->size() - 1) + "]";
                continue;
            }
            for (const auto &[name, child] : *open_[i]->object())
                if (&child == open_[i + 1])
                    text += (text.empty() ? "" : ".") + shortened(name);
        }
        return text.empty() ? "the file's root" : text;
    }

    static constexpr size_t values_a_step = size_t{1} << 14U;

    Budget &budget_;
    Json root_;
    // Pointers into the tree stay valid: a container does not grow while a child of it is open.
    std::vector<Json *> open_;
    Json *added_ = nullptr; ///< the last value, or the member whose key was read last
    size_t values_ = 0;
};

} // namespace

Json parse_json(std::string_view text, Budget &budget) {
    Builder builder(budget);
    nlohmann::json::sax_parse(text.data(), text.data() + text.size(), &builder);
    return builder.take();
}

} // namespace knurl::gltf
