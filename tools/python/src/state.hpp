#pragma once
/// \file
/// Values as bytes and back, for Python's pickle and copy.

#include "made/states.hpp"

namespace binding {

/// Takes the fields of values one after the other; `made/states.hpp` has those of structs.
class state_writer {
  public:
    [[nodiscard]] py::bytes bytes() const { return {bytes_}; }

    template <class T>
    void put(T& value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
        else
            each_field(value, [&](const char*, auto& field) { put(field); });
    }
    template <class T>
    void put(std::optional<T>& value) {
        bool there = value.has_value();
        put(there);
        if (there) put(*value);
    }
    template <class T>
    void put(std::vector<T>& values) {
        std::size_t size = values.size();
        put(size);
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char*>(values.data()), size * sizeof(T));
        else
            for (T& one : values) put(one);
    }
    void put(std::string& text) {
        std::size_t size = text.size();
        put(size);
        bytes_ += text;
    }

  private:
    std::string bytes_;
};

/// Gives the fields what a `state_writer` has taken.
class state_reader {
  public:
    explicit state_reader(std::string_view bytes) : rest_(bytes) {}

    template <class T>
    void get(T& value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            std::memcpy(&value, take(1, sizeof(T)).data(), sizeof(T));
        else
            each_field(value, [&](const char*, auto& field) { get(field); });
    }
    template <class T>
    void get(std::optional<T>& value) {
        bool there = false;
        get(there);
        if (there) get(value.emplace());
    }
    template <class T>
    void get(std::vector<T>& values) {
        std::size_t size = 0;
        get(size);
        if constexpr (std::is_trivially_copyable_v<T>) {
            const std::string_view taken = take(size, sizeof(T));
            values.resize(size);
            if (size != 0) std::memcpy(values.data(), taken.data(), taken.size());
        } else {
            while (values.size() < size) get(values.emplace_back());
        }
    }
    void get(std::string& text) {
        std::size_t size = 0;
        get(size);
        text = take(size, 1);
    }

  private:
    std::string_view take(std::size_t count, std::size_t width) {
        if (count > rest_.size() / width) throw std::invalid_argument("state: too short");
        const std::string_view taken = rest_.substr(0, count * width);
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view rest_;
};

/// What `py::class_<T>::def` takes to make T picklable; `part_of(value)` is all of it.
template <class T, class PartOf>
auto pickled(const PartOf& part_of) {
    return py::pickle(
        [=](T& value) {
            state_writer state;
            state.put(part_of(value));
            return state.bytes();
        },
        [=](const py::bytes& bytes) {
            T value;
            state_reader state{std::string_view(bytes)};
            state.get(part_of(value));
            return value;
        });
}

}  // namespace binding
