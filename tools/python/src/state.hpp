#pragma once
/// \file
/// Values as bytes and back, for Python's pickle and copy.

#include "base.hpp"

namespace binding {

/// Takes the fields of values one after the other: `all_fields(state, value)` names those of a struct.
class state_writer {
  public:
    template <class... Values>
    void operator()(Values&... values) {
        (put(values), ...);
    }
    [[nodiscard]] py::bytes bytes() const { return {bytes_}; }

  private:
    template <class T>
    void put(T& value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
        else
            all_fields(*this, value);
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

    std::string bytes_;
};

/// Gives the fields what a `state_writer` has taken.
class state_reader {
  public:
    explicit state_reader(std::string_view bytes) : rest_(bytes) {}

    template <class... Values>
    void operator()(Values&... values) {
        (get(values), ...);
    }

  private:
    std::string_view take(std::size_t count, std::size_t width) {
        if (count > rest_.size() / width) throw std::invalid_argument("state: too short");
        const std::string_view taken = rest_.substr(0, count * width);
        rest_.remove_prefix(taken.size());
        return taken;
    }
    template <class T>
    void get(T& value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            std::memcpy(&value, take(1, sizeof(T)).data(), sizeof(T));
        else
            all_fields(*this, value);
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

    std::string_view rest_;
};

/// What `py::class_<T>::def` takes to make T picklable.
template <class T>
auto pickled() {
    return py::pickle(
        [](T& value) {
            state_writer state;
            state(value);
            return state.bytes();
        },
        [](const py::bytes& bytes) {
            T value;
            state_reader state{std::string_view(bytes)};
            state(value);
            return value;
        });
}

}  // namespace binding
