#pragma once
/// \file
/// Transfers attributes to a mesh with merged points and removed faces.

#include <libmesh/exact/plane_predicates.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace treeform::detail::weld {

/// \throws std::invalid_argument when "vertex" has not one row for each point, "face" has not one
///         row for each face, or the size of a column or of corner values does not match
void check_rows(const attributes& properties, std::size_t point_count, std::size_t face_count);

/// Whether the column has point numbers, in elements other than "vertex" and "face".
[[nodiscard]] bool numbers_points(const column& c);

/// Replaces each value in [begin, end) of such a column by its `new_of_old`. Values that are not
/// integers in [0, points) are kept.
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

/// The attributes that `weld` returns, except for means, from `properties` and the rest of its
/// result.
[[nodiscard]] attributes carry_rows(const attributes& properties, const weld_result& welded);

/// The least double that is not below the distance of any point from the position of its group;
/// infinity on overflow. Points that bitwise equal that position need not be finite.
[[nodiscard]] double max_displacement(points_view points,
                                      std::span<const std::uint32_t> group_of_point,
                                      points_view places);

/// Whether the normals of a triangle before and after point in opposite directions (negative dot
/// product), decided exactly. False if either triangle has no area or a corner that is not finite.
[[nodiscard]] bool is_flipped(const plane_points& before, const plane_points& after);

/// Number of flipped faces of `after`; face i was `before.faces[face_source[i]]`.
[[nodiscard]] std::uint64_t count_flipped(mesh_view before, mesh_view after,
                                          std::span<const std::uint32_t> face_source);

}  // namespace treeform::detail::weld
