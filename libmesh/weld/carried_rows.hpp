#pragma once
/// \file
/// Attributes after points were merged and faces dropped.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace treeform::detail::weld {

/// \throws std::invalid_argument for rows of "vertex" that are not one a point, rows of "face" that
///         are not one a face, columns that do not fit their rows, and corners likewise
void check_rows(const attributes& properties, std::size_t point_count, std::size_t face_count);

/// Whether other elements than "vertex" and "face" name points by it.
[[nodiscard]] bool numbers_points(const column& c);

/// Replaces values `begin` to `end` of such a column by `new_of_old` of each; what is no number
/// less than `points` stays.
template <class NewOfOld>
void renumber(column& c, std::size_t begin, std::size_t end, std::uint64_t points,
              const NewOfOld& new_of_old) {
    with_type(c.type, [&]<class T>(T) {
        for (std::size_t i = begin; i < end; ++i) {
            T value;
            std::byte* const at = c.values.data() + i * sizeof value;
            std::memcpy(&value, at, sizeof value);
            if (value < 0 || static_cast<std::uint64_t>(value) >= points) continue;
            // Groups are numbered by their first points, so that no number grows.
            value = static_cast<T>(new_of_old(static_cast<std::uint64_t>(value)));
            std::memcpy(at, &value, sizeof value);
        }
    });
}

/// What `weld` returns of `properties`, given the other parts of its result but means.
[[nodiscard]] attributes carry_rows(const attributes& properties, const weld_result& welded);

}  // namespace treeform::detail::weld
