#pragma once
/// \file
/// Converts values to bytes and back, for pickle and copy.

#include "made/states.hpp"

namespace binding {

/// Stores the fields of values as bytes one after the other, or restores them from bytes.
/// `made/states.hpp` lists the fields of structs.
class state {
  public:
    state() = default;
    explicit state(std::string_view given) : gives_(true), rest_(given) {}

    [[nodiscard]] py::bytes bytes() const { return {taken_}; }

    template <class T>
    void field(T& value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            copy(&value, sizeof(T));
        else
            each_field(value, [&](const char*, auto& one) { field(one); });
    }
    template <class T>
    void field(std::optional<T>& value) {
        bool there = value.has_value();
        field(there);
        if (gives_ && there) value.emplace();
        if (there) field(*value);
    }
    template <class T>
    void field(std::vector<T>& values) {
        constexpr bool flat = std::is_trivially_copyable_v<T>;
        make_room(values, flat ? sizeof(T) : 1);
        if constexpr (flat)
            copy(values.data(), values.size() * sizeof(T));
        else
            for (T& one : values) field(one);
    }
    void field(std::string& text) {
        make_room(text, 1);
        copy(text.data(), text.size());
    }

  private:
    /// Stores the number of elements, or resizes `values` to it; an element takes `width` bytes.
    template <class Values>
    void make_room(Values& values, std::size_t width) {
        std::size_t size = values.size();
        field(size);
        if (!gives_) return;
        if (size > rest_.size() / width) throw std::invalid_argument("state: too short");
        values.resize(size);
    }
    void copy(void* data, std::size_t size) {
        if (!gives_) {
            taken_.append(static_cast<const char*>(data), size);
        } else {
            if (size > rest_.size()) throw std::invalid_argument("state: too short");
            if (size != 0) std::memcpy(data, rest_.data(), size);
            rest_.remove_prefix(size);
        }
    }

    bool gives_ = false;
    std::string taken_;
    std::string_view rest_;
};

/// For `py::class_<T>::def`: makes T picklable, where `part_of(value)` is its content.
template <class T, class PartOf>
auto pickled(const PartOf& part_of) {
    return py::pickle(
        [=](T& value) {
            state taken;
            taken.field(part_of(value));
            return taken.bytes();
        },
        [=](const py::bytes& bytes) {
            T value;
            state given{std::string_view(bytes)};
            given.field(part_of(value));
            return value;
        });
}

}  // namespace binding
