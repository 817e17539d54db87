#pragma once
/// \file
/// Temporary bytes: in memory, or in an unnamed file.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

enum class scratch_place : std::uint8_t { memory, file };

/// `size` bytes, initially zero. In a file, they use memory only while they are accessed.
class scratch {
  public:
    /// `name` is the file for which they are needed, in errors. `folder` as for
    /// `open_nameless_file`.
    ///
    /// \throws io_error, std::bad_alloc
    scratch(std::size_t size, scratch_place place, std::string_view name,
            const std::filesystem::path& folder = {});
    scratch(const scratch&) = delete;
    scratch& operator=(const scratch&) = delete;
    ~scratch();

    [[nodiscard]] char* data() const { return data_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Releases the memory of bytes in a file; they can still be read.
    void release_memory() const;

  private:
    char* data_ = nullptr;
    std::size_t size_ = 0;
    scratch_place place_;
};

/// Opens an unnamed file, which is removed when its descriptor is closed: in `folder`, or if empty,
/// in a folder for large temporary files. \throws io_error
[[nodiscard]] int open_nameless_file(std::string_view name,
                                     const std::filesystem::path& folder = {});

/// Advises the system to back `bytes` bytes at `memory`, which will be filled soon, by large pages.
/// A hint that only affects time: page-faulting small pages takes several times as long as reading
/// a cached binary file.
void prefer_large_pages(void* memory, std::size_t bytes);

/// v.reserve(count), in large pages if that pays off.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t count) {
    v.reserve(count);
    if (v.capacity() * sizeof(T) >= std::size_t{8} << 20)
        prefer_large_pages(v.data(), v.capacity() * sizeof(T));
}

}  // namespace treeform::detail::io
