#pragma once
/// \file
/// The part of a file that one of several processes reads.

#include <cstdint>

namespace treeform::detail::io {

/// Part `rank` of `size` parts of nearly equal counts.
struct file_part {
    std::uint64_t rank = 0;
    std::uint64_t size = 1;

    [[nodiscard]] std::uint64_t first(std::uint64_t count) const {
        return count / size * rank + count % size * rank / size;
    }
    [[nodiscard]] std::uint64_t last(std::uint64_t count) const {
        return file_part{rank + 1, size}.first(count);
    }
    [[nodiscard]] bool is_last() const { return rank + 1 == size; }
};

/// A row after the points, counted over all elements there, and the byte of the file at which it
/// begins.
struct row_place {
    std::uint64_t row = 0;
    std::uint64_t byte = 0;
};

}  // namespace treeform::detail::io
