#include <libmesh/base/compact.hpp>
#include <libmesh/base/fill_stars.hpp>
#include <libmesh/base/parallel_sort.hpp>
#include <libmesh/base/running_sums.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/intersect/check_pairs.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <libmesh/intersect/same_points.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t path_grain = std::size_t{1} << 6;

/// Segments that two faces have in common.
std::size_t sides_of(const detail::intersect::meeting& m) {
    return m.count < 3 ? m.count - (m.count != 0) : m.count;
}

/// A segment of two points, the lower first.
struct segment {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t pair;
};

/// The points that meetings end in, equal ones as one.
class point_table {
  public:
    point_table(mesh_view mesh, const detail::intersect::mesh_meetings& met)
        : given_(mesh.points.size()) {
        find_ids(met);
        detail::buffer<implicit_point> exact(ids_.size());
        for_chunks(exact.size(), path_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                exact[i] = ids_[i] < given_ ? implicit_point(mesh.points[ids_[i]])
                                            : met.points[ids_[i] - given_];
        });
        detail::base::union_find sets(ids_.size());
        for (const auto& [a, b] : detail::intersect::equal_pairs(exact.span())) sets.join(a, b);
        const auto root = sets.take_roots();
        std::vector<std::uint32_t> kept;
        number_.resize(ids_.size());
        detail::base::compact(
            ids_.size(), [&](std::size_t i) { return root[i] == i; },
            [&](std::size_t count) { kept.resize(count); },
            [&](std::size_t i, std::size_t place) {
                kept[place] = static_cast<std::uint32_t>(i);
                number_[i] = static_cast<std::uint32_t>(place);
            });
        points.resize(kept.size());
        for_chunks(points.size(), path_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                points[i] = named(ids_[kept[i]], met, rounded(exact[kept[i]]));
        });
        for (std::size_t i = 0; i < number_.size(); ++i)
            if (root[i] != i) number_[i] = number_[root[i]];
    }

    [[nodiscard]] std::uint32_t operator[](std::uint32_t id) const {
        return number_[static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) -
                                                ids_.begin())];
    }

    std::vector<curve_point> points;

  private:
    void find_ids(const detail::intersect::mesh_meetings& met) {
        const std::vector<std::size_t> first = detail::base::running_sums(
            met.meetings.size(), [&](std::size_t i) { return met.meetings[i].count; });
        std::vector<std::uint32_t> all(first.back());
        for_chunks(met.meetings.size(), path_grain,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           for (std::size_t k = 0; k < met.meetings[i].count; ++k)
                               all[first[i] + k] = met.meetings[i].ends[k].point;
                   });
        detail::base::parallel_sort(all);
        detail::base::compact(
            all.size(), [&](std::size_t i) { return i == 0 || all[i] != all[i - 1]; },
            [&](std::size_t count) { ids_.resize(count); },
            [&](std::size_t i, std::size_t place) { ids_[place] = all[i]; });
    }

    [[nodiscard]] curve_point named(std::uint32_t id, const detail::intersect::mesh_meetings& met,
                                    const point3& position) const {
        if (id < given_) return {{id, id}, {id, id}, position};
        const detail::intersect::point_name& name = met.names[id - given_];
        const bool by_edges = name.kind == detail::intersect::point_name::origin::edges;
        if (by_edges) return {name.edge, name.by, position};
        return {name.edge, {name.by[0], curve_point::none}, position};
    }

    std::size_t given_;
    std::vector<std::uint32_t> ids_;     ///< of the input or named, ascending
    std::vector<std::uint32_t> number_;  ///< of each
};

/// Segments as a graph, walked from point to point.
class path_walker {
  public:
    path_walker(std::size_t point_count, std::vector<segment> segments)
        : segments_(std::move(segments)),
          walked_(segments_.size()),
          at_(detail::base::fill_stars<std::uint64_t>(
              point_count, segments_.size(), [&](std::size_t i, const auto& visit) {
                  for (const std::uint32_t end : segments_[i].ends) visit(end);
              })) {}

    [[nodiscard]] std::vector<curve_path> paths() {
        std::vector<curve_path> found;
        const auto point_count = static_cast<std::uint32_t>(at_.end.size());
        for (const bool at_nodes : {true, false})
            for (std::uint32_t p = 0; p < point_count; ++p) {
                if (at_nodes && degree(p) == 2) continue;
                for (const std::uint32_t i : at_[p])
                    if (!walked_[i]) found.push_back(walk(p, i));
            }
        return found;
    }
    [[nodiscard]] std::size_t degree(std::uint32_t p) const { return at_[p].size(); }

  private:
    [[nodiscard]] curve_path walk(std::uint32_t from, std::uint32_t along) {
        curve_path path{{from}, {}, false};
        for (std::uint32_t p = from;;) {
            walked_[along] = 1;
            path.pairs.push_back(segments_[along].pair);
            p = segments_[along].ends[0] == p ? segments_[along].ends[1] : segments_[along].ends[0];
            path.closed = p == from;
            if (!path.closed) path.points.push_back(p);
            if (path.closed || degree(p) != 2) return path;
            along = at_[p][at_[p][0] == along ? 1 : 0];
        }
    }

    std::vector<segment> segments_;
    std::vector<char> walked_;
    detail::base::faces_by_point<std::uint64_t> at_;  ///< segments at each point
};

}  // namespace

curve_network intersection_paths(mesh_view mesh, std::span<const face_pair> pairs) {
    detail::intersect::check_pairs("intersection_paths", mesh, pairs, true);
    const detail::intersect::mesh_meetings met = detail::intersect::meetings_of(mesh, pairs);
    point_table table(mesh, met);
    const std::vector<std::size_t> first = detail::base::running_sums(
        met.meetings.size(), [&](std::size_t i) { return sides_of(met.meetings[i]); });
    std::vector<segment> all(first.back());
    for_chunks(met.meetings.size(), path_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i) {
                       const detail::intersect::meeting& m = met.meetings[i];
                       for (std::size_t k = 0; k < sides_of(m); ++k) {
                           const std::uint32_t u = table[m.ends[k].point];
                           const std::uint32_t v = table[m.ends[(k + 1) % m.count].point];
                           all[first[i] + k] = {{std::min(u, v), std::max(u, v)},
                                                static_cast<std::uint32_t>(i)};
                       }
                   }
               });
    detail::base::parallel_sort(all, [](const segment& s, const segment& t) {
        return s.ends != t.ends ? s.ends < t.ends : s.pair < t.pair;
    });
    std::vector<segment> segments;
    detail::base::compact(
        all.size(), [&](std::size_t i) { return i == 0 || all[i].ends != all[i - 1].ends; },
        [&](std::size_t count) { segments.resize(count); },
        [&](std::size_t i, std::size_t place) { segments[place] = all[i]; });

    curve_network result;
    path_walker walker(table.points.size(), std::move(segments));
    result.paths = walker.paths();
    std::vector<std::array<std::uint32_t, 2>> touched;  // point, pair
    for (std::uint32_t i = 0; i < met.meetings.size(); ++i)
        if (met.meetings[i].count == 1)
            touched.push_back({table[met.meetings[i].ends[0].point], i});
    std::sort(touched.begin(), touched.end());
    for (std::size_t i = 0; i < touched.size(); ++i)
        if ((i == 0 || touched[i - 1][0] != touched[i][0]) && walker.degree(touched[i][0]) == 0)
            result.paths.push_back({{touched[i][0]}, {touched[i][1]}, false});
    result.points = std::move(table.points);
    return result;
}

}  // namespace treeform
