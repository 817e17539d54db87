#pragma once
/// \file
/// The rows that tiles leave to the border pass. A row has five numbers, namely the tag of a point,
/// its coordinates and one more number, then the values of the point. A point with a leader has a
/// second row, with the coordinates of the leader.

#include <libmesh/stream/row_file.hpp>
#include <libmesh/weld/tile_weld.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::stream {

using weld::asked_point;
using weld::border_kind;
using weld::border_point;

inline constexpr std::size_t border_numbers = 5;
using border_row = std::array<std::uint64_t, border_numbers>;

[[nodiscard]] inline border_row row_of(std::uint64_t tag, const point3& p, std::uint64_t more) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return {tag, bits(p.x), bits(p.y), bits(p.z), more};
}
[[nodiscard]] inline border_row row_of(const asked_point& a) {
    return row_of(a.bundle, a.at, a.asked_by);
}

[[nodiscard]] inline point3 point_of(numbers row) {
    const auto at = [&](std::size_t k) { return std::bit_cast<double>(row[k]); };
    return {at(1), at(2), at(3)};
}
[[nodiscard]] inline asked_point asked_of(numbers row) { return {row[0], point_of(row), row[4]}; }

[[nodiscard]] inline bool has_leader(const border_point& b) {
    return b.kind() == border_kind::provisional || b.kind() == border_kind::link;
}

/// Writes the rows of a point, and returns their number.
inline std::uint64_t put_rows(const border_point& b, numbers values, row_writer& to) {
    to.put(row_of(b.tag, b.at, b.leader));
    to.put(values);
    if (!has_leader(b)) return 1;
    to.put(row_of(b.tag, b.leader_at, 0));
    to.put(values);
    return 2;
}

/// Reads the point at the front, and advances to its last row. \pre not empty
template <class Rows>  // row_reader or row_merge
[[nodiscard]] border_point take_rows(Rows& rows) {
    const numbers row = rows.front();
    border_point b{row[0], point_of(row), row[4], {}};
    if (!has_leader(b)) return b;
    rows.pop();
    b.leader_at = point_of(rows.front());
    return b;
}

}  // namespace treeform::detail::stream
