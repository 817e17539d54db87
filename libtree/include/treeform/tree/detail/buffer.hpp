#pragma once
/// \file
/// An array that does not initialize its elements, so that the loop that fills it also page-faults
/// its memory, on the threads that will use it.

#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

namespace treeform::detail {

/// Memory aligned to a cache line. Large buffers request huge pages, which the kernel clears and
/// maps several times faster.
///
/// \throws std::bad_alloc
[[nodiscard]] TREEFORM_API void* allocate_buffer(std::size_t bytes);
TREEFORM_API void free_buffer(void* memory);

/// An uninitialized array, aligned to cache lines. Copies are deep. `resize` reuses the memory if
/// it suffices, but does not keep the contents.
template <class T>
requires(std::is_trivially_copyable_v<T>&& std::is_trivially_destructible_v<T>) class buffer {
  public:
    buffer() = default;
    explicit buffer(std::size_t size) { resize(size); }
    buffer(const buffer& other) : buffer(other.size_) {
        std::uninitialized_copy_n(other.data(), size_, data());
    }
    buffer(buffer&& other) noexcept { swap(other); }
    buffer& operator=(buffer other) noexcept {
        swap(other);
        return *this;
    }

    void resize(std::size_t size) {
        if (size > capacity_) {
            data_.reset();  // both at once would double the peak
            capacity_ = 0;
            data_.reset(static_cast<T*>(allocate_buffer(size * sizeof(T))));
            capacity_ = size;
        }
        size_ = size;
    }

    [[nodiscard]] T* data() { return data_.get(); }
    [[nodiscard]] const T* data() const { return data_.get(); }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::span<const T> span() const { return {data(), size_}; }
    [[nodiscard]] T& operator[](std::size_t i) { return data_.get()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data_.get()[i]; }

  private:
    struct release {
        void operator()(T* p) const { free_buffer(p); }
    };

    void swap(buffer& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

    std::unique_ptr<T, release> data_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

}  // namespace treeform::detail
