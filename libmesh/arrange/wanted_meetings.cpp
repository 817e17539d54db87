#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/arrange/wanted_meetings.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::arrange {
namespace {

using intersect::meeting;
using intersect::meeting_end;
using intersect::mesh_meetings;

constexpr std::size_t meeting_grain = std::size_t{1} << 10;

/// What two faces have in common is the convex hull of its ends.
aabb<double, 3> box_of(const mesh_meetings& met, points_view given, const meeting& m) {
    aabb<double, 3> box;
    for (std::size_t k = 0; k < m.count; ++k) {
        const std::uint32_t p = m.ends[k].point;
        if (p < given.size())
            box.include(given[p]);
        else
            box.include(box_around(met.points[p - given.size()]));
    }
    return box;
}

/// Leaves out the names that no meeting has.
void keep_used_names(mesh_meetings& met, std::size_t given) {
    std::vector<std::uint32_t> number(met.names.size(), 0);
    const auto visit_named = [&](const auto& visit) {
        for (meeting& m : met.meetings)
            for (meeting_end& end : std::span(m.ends).first(m.count))
                if (end.point >= given) visit(end.point);
    };
    visit_named([&](std::uint32_t p) { number[p - given] = 1; });
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (std::exchange(number[i], kept) == 0) continue;
        met.names[kept] = met.names[i];
        met.points[kept] = met.points[i];
        ++kept;
    }
    met.names.resize(kept);
    met.points.resize(kept);
    visit_named(
        [&](std::uint32_t& p) { p = static_cast<std::uint32_t>(given) + number[p - given]; });
}

}  // namespace

void keep_wanted(mesh_meetings& met, points_view given, const is_box_wanted& is_wanted) {
    std::vector<std::uint8_t> keeps(met.meetings.size());
    for_chunks(keeps.size(), meeting_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            keeps[i] = is_wanted(box_of(met, given, met.meetings[i])) ? 1 : 0;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keeps.size(); ++i)
        if (keeps[i] != 0) met.meetings[kept++] = met.meetings[i];
    if (kept == met.meetings.size()) return;
    met.meetings.resize(kept);
    met.meetings.shrink_to_fit();
    keep_used_names(met, given.size());
    met.names.shrink_to_fit();
    met.points.shrink_to_fit();
}

}  // namespace treeform::detail::arrange
