#pragma once
/// \file
/// A JSON value with its path for messages: "a.gltf: nodes[3].mesh is not an integer of 0 or more".
/// Values are not converted between types.

#include <libmesh/io/source.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace treeform::detail::io {

inline constexpr std::size_t deepest_json = 500;

/// The quote that ends the string which starts before `at`, or `end`.
[[nodiscard]] inline const char* end_of_string(const char* at, const char* end) {
    while (at != end && *at != '"') at += *at == '\\' && end - at > 1 ? 2 : 1;
    return at;
}

/// Refuses JSON, a part of `in`, that nests deeper than any legitimate file. Other errors are left
/// to the parser.
///
/// \throws io_error naming the byte
inline void refuse_deep_json(const source& in, std::string_view json) {
    const char* const end = json.data() + json.size();
    std::size_t depth = 0;
    for (const char* at = json.data(); at != end; ++at) {
        if (*at == '"') {
            at = end_of_string(at + 1, end);
            if (at == end) return;
        } else if (*at == '[' || *at == '{') {
            if (++depth > deepest_json)
                in.fail_byte(
                    at, "JSON nested more than " + std::to_string(deepest_json) + " levels deep");
        } else if (*at == ']' || *at == '}') {
            if (depth == 0) return;
            --depth;
        }
    }
}

class json_entry {
  public:
    using json = nlohmann::json;

    /// `in` and `value` must outlive the entry.
    json_entry(const source& in, const json& value, std::string place = {})
        : in_(&in), value_(&value), place_(std::move(place)) {}

    /// The member of an object; none if it is missing.
    [[nodiscard]] std::optional<json_entry> find(const char* key) const {
        if (!value_->is_object()) fail("is not a JSON object");
        const auto at = value_->find(key);
        if (at == value_->end()) return std::nullopt;
        return json_entry(*in_, *at, place_.empty() ? key : place_ + '.' + key);
    }
    [[nodiscard]] json_entry get(const char* key) const {
        auto found = find(key);
        if (!found) fail(std::string("has no '") + key + "'");
        return *std::move(found);
    }
    /// The member `inner` of the object that is the member `key`.
    [[nodiscard]] std::optional<json_entry> find(const char* key, const char* inner) const {
        const auto found = find(key);
        return found ? found->find(inner) : std::nullopt;
    }

    /// Calls f(entry) for each item of an array.
    template <class F>
    void for_each(F&& f) const {
        if (!value_->is_array()) fail("is not a JSON array");
        for (std::size_t i = 0; i < value_->size(); ++i)
            f(json_entry(*in_, (*value_)[i], place_ + '[' + std::to_string(i) + ']'));
    }
    /// The same for the array that is the member `key`; a missing array has no items.
    template <class F>
    void for_each(const char* key, F&& f) const {
        if (const auto list = find(key)) list->for_each(f);
    }
    /// Number of items of the array that is the member `key`.
    [[nodiscard]] std::size_t count(const char* key) const {
        const auto list = find(key);
        return list ? list->value_->size() : 0;
    }
    /// Calls f(key, entry) for each member.
    template <class F>
    void for_each_member(F&& f) const {
        if (!value_->is_object()) fail("is not a JSON object");
        for (const auto& [key, value] : value_->items())
            f(key, json_entry(*in_, value, place_ + '.' + key));
    }

    /// A nonnegative integer, also if it is written as 2.0.
    [[nodiscard]] std::uint64_t whole() const {
        if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
        const double number = value_->is_number_float() ? value_->get<double>() : -1.0;
        if (!(number >= 0.0 && number < 0x1p53) || number != std::floor(number))
            fail("is not a non-negative integer");
        return static_cast<std::uint64_t>(number);
    }
    /// An index below `count`.
    [[nodiscard]] std::size_t number_of(std::size_t count, const char* things) const {
        const std::uint64_t number = whole();
        if (number >= count)
            fail("is " + std::to_string(number) + ", but there are " + std::to_string(count) + " " +
                 things);
        return static_cast<std::size_t>(number);
    }
    [[nodiscard]] bool is_number() const { return value_->is_number(); }
    [[nodiscard]] bool is_object() const { return value_->is_object(); }
    [[nodiscard]] double number() const {
        if (!value_->is_number()) fail("is not a number");
        return value_->get<double>();
    }
    template <std::size_t N>
    [[nodiscard]] std::array<double, N> numbers() const {
        std::array<double, N> all{};
        if (!value_->is_array() || value_->size() != N)
            fail("is not an array of " + std::to_string(N) + " numbers");
        for (std::size_t i = 0; i < N; ++i) {
            if (!(*value_)[i].is_number()) fail("has an entry that is not a number");
            all[i] = (*value_)[i].get<double>();
        }
        return all;
    }
    [[nodiscard]] const std::string& text() const {
        if (!value_->is_string()) fail("is not a string");
        return value_->get_ref<const std::string&>();
    }
    [[nodiscard]] bool flag() const {
        if (!value_->is_boolean()) fail("is not a boolean");
        return value_->get<bool>();
    }

    /// Throws io_error "file: place reason".
    [[noreturn]] void fail(std::string_view reason) const {
        in_->fail((place_.empty() ? "glTF" : place_) + ' ' + std::string(reason));
    }

  private:
    const source* in_;
    const json* value_;
    std::string place_;
};

}  // namespace treeform::detail::io
