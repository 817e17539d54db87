#pragma once
/// \file
/// Values as bytes and back, for Python's pickle and copy.

#include "made/states.hpp"

namespace binding {

/// Takes the fields of values one after the other as bytes, or gives them what it was made of;
/// `made/states.hpp` has those of structs.
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
    /// As many elements, of so many bytes at least, as are told.
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

/// What `py::class_<T>::def` takes to make T picklable; `part_of(value)` is all of it.
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
