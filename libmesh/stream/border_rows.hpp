#pragma once
/// \file
/// What tiles leave to borders, as rows of numbers, which the values of points follow.

#include <libmesh/stream/row_file.hpp>
#include <libmesh/weld/tile_weld.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::stream {

using weld::asked_point;
using weld::border_point;

[[nodiscard]] inline point3 point_of(numbers row) {
    const auto at = [&](std::size_t k) { return std::bit_cast<double>(row[k]); };
    return {at(0), at(1), at(2)};
}

[[nodiscard]] inline std::array<std::uint64_t, 8> row_of(const border_point& b) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    const point3& p = b.at;
    const point3& q = b.leader_at;
    return {b.tag, bits(p.x), bits(p.y), bits(p.z), b.leader, bits(q.x), bits(q.y), bits(q.z)};
}
[[nodiscard]] inline border_point border_of(numbers row) {
    return {row[0], point_of(row.subspan(1)), row[4], point_of(row.subspan(5))};
}

[[nodiscard]] inline std::array<std::uint64_t, 5> row_of(const asked_point& a) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    return {a.id, bits(a.at.x), bits(a.at.y), bits(a.at.z), a.slices};
}
[[nodiscard]] inline asked_point asked_of(numbers row) {
    return {row[0], point_of(row.subspan(1)), row[4]};
}

}  // namespace treeform::detail::stream
