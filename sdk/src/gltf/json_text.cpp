// SPDX-License-Identifier: MIT
#include "json_text.hpp"
#include "failure.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace knurl::gltf {
namespace {

using Json = nlohmann::json;

/// Builds the tree from the parser's events, so that limits are met while reading and not after it.
class Builder : public nlohmann::json_sax<Json> {
  public:
    explicit Builder(Budget &budget) : budget_(budget) {}

    Json take() {
        return std::move(root_);
    }

    bool null() override {
        add(nullptr);
        return true;
    }
    bool boolean(bool value) override {
        add(value);
        return true;
    }
    bool number_integer(number_integer_t value) override {
        add(value);
        return true;
    }
    bool number_unsigned(number_unsigned_t value) override {
        add(value);
        return true;
    }
    bool number_float(number_float_t value, const string_t & /*text*/) override {
        add(value);
        return true;
    }
    bool string(string_t &value) override {
        add(std::move(value));
        return true;
    }
    bool binary(binary_t & /*value*/) override {
        return false; // there is none in JSON
    }
    bool start_object(size_t /*size*/) override {
        open(Json::object());
        return true;
    }
    bool end_object() override {
        open_.pop_back();
        return true;
    }
    bool start_array(size_t /*size*/) override {
        open(Json::array());
        return true;
    }
    bool end_array() override {
        open_.pop_back();
        return true;
    }

    bool key(string_t &name) override {
        auto &members = open_.back()->get_ref<Json::object_t &>();
        const auto [member, fresh] = members.try_emplace(name);
        if (!fresh)
            refuse("JSON", "the key " + in_quotes(name) + " appears twice in " + path());
        member_ = &member->second;
        return true;
    }

    bool parse_error(size_t /*position*/, const std::string & /*token*/, const Json::exception &error) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 5: ...": the bracket is left out.
        std::string_view text = error.what();
        const size_t bracket = text.find("] ");
        if (bracket != std::string_view::npos)
            text.remove_prefix(bracket + 2);
        throw Failure(KNURL_ERROR_FORMAT, "JSON: " + shortened(text, 300));
    }

  private:
    Json *add(Json value) {
        if (values_ % values_a_step == 0)
            budget_.step();
        if (++values_ > json_values_max)
            refuse("JSON", "more than " + std::to_string(json_values_max) + " values");
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        Json &parent = *open_.back();
        if (parent.is_array())
            return &parent.get_ref<Json::array_t &>().emplace_back(std::move(value));
        *member_ = std::move(value);
        return member_;
    }

    void open(Json container) {
        if (open_.size() == json_depth_max)
            refuse("JSON", "nested deeper than " + std::to_string(json_depth_max) + " in " + path());
        open_.push_back(add(std::move(container)));
    }

    /// Where the reading is: "materials[0].extras".
    std::string path() const {
        std::string text;
        for (size_t i = 0; i + 1 < open_.size(); ++i) {
            const Json &parent = *open_[i];
            if (parent.is_array()) {
                text += "[" + std::to_string(parent.size() - 1) + "]";
                continue;
            }
            for (const auto &[name, child] : parent.get_ref<const Json::object_t &>())
                if (&child == open_[i + 1])
                    text += (text.empty() ? "" : ".") + shortened(name);
        }
        return text.empty() ? "the file's root" : text;
    }

    static constexpr size_t values_a_step = size_t{1} << 14U;

    Budget &budget_;
    Json root_;
    // Pointers into the tree stay good: a container grows only while none of its children is open.
    std::vector<Json *> open_;
    Json *member_ = nullptr;
    size_t values_ = 0;
};

} // namespace

nlohmann::json parse_json(std::string_view text, Budget &budget) {
    Builder builder(budget);
    Json::sax_parse(text.data(), text.data() + text.size(), &builder);
    return builder.take();
}

std::string described(const nlohmann::json &value) {
    switch (value.type()) {
    case Json::value_t::string:
        return in_quotes(value.get_ref<const std::string &>());
    case Json::value_t::array:
        return "an array of " + std::to_string(value.size());
    case Json::value_t::object:
        return "an object";
    default:
        return value.dump();
    }
}

} // namespace knurl::gltf
