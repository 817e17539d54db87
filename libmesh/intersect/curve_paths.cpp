#include <libmesh/base/union_find.hpp>
#include <libmesh/intersect/check_pairs.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <libmesh/intersect/same_points.hpp>
#include <treeform/mesh/curves.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform {
namespace {

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
        for (const detail::intersect::meeting& m : met.meetings)
            for (std::size_t k = 0; k < m.count; ++k) ids_.push_back(m.ends[k].point);
        std::sort(ids_.begin(), ids_.end());
        ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
        std::vector<implicit_point> exact;
        for (const std::uint32_t id : ids_)
            exact.push_back(id < given_ ? implicit_point(mesh.points[id])
                                        : met.points[id - given_]);
        detail::base::union_find sets(ids_.size());
        for (const auto& [a, b] : detail::intersect::equal_pairs(exact)) sets.join(a, b);
        number_.resize(ids_.size());
        for (std::uint32_t i = 0; i < ids_.size(); ++i) {
            const std::uint32_t root = sets.root(i);
            if (root == i) {
                number_[i] = static_cast<std::uint32_t>(points.size());
                points.push_back(named(ids_[i], met, rounded(exact[i])));
            } else {
                number_[i] = number_[root];
            }
        }
    }

    [[nodiscard]] std::uint32_t operator[](std::uint32_t id) const {
        return number_[static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), id) -
                                                ids_.begin())];
    }

    std::vector<curve_point> points;

  private:
    [[nodiscard]] curve_point named(std::uint32_t id, const detail::intersect::mesh_meetings& met,
                                    const point3& position) const {
        if (id < given_) return {curve_point::origin::corner, {id, id}, {id, id}, position};
        const detail::intersect::point_name& name = met.names[id - given_];
        const bool by_edges = name.kind == detail::intersect::point_name::origin::edges;
        return {by_edges ? curve_point::origin::edges : curve_point::origin::edge_face, name.edge,
                name.by, position};
    }

    std::size_t given_;
    std::vector<std::uint32_t> ids_;     ///< of the input or named, ascending
    std::vector<std::uint32_t> number_;  ///< of each
};

/// Segments as a graph, walked from point to point.
class path_walker {
  public:
    path_walker(std::size_t point_count, std::vector<segment> segments)
        : segments_(std::move(segments)), walked_(segments_.size()), begin_(point_count + 1) {
        for (const segment& s : segments_)
            for (const std::uint32_t end : s.ends) ++begin_[end + 1];
        for (std::size_t p = 0; p < point_count; ++p) begin_[p + 1] += begin_[p];
        at_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t i = 0; i < segments_.size(); ++i)
            for (const std::uint32_t end : segments_[i].ends) at_[next[end]++] = i;
    }

    [[nodiscard]] std::vector<curve_path> paths() {
        std::vector<curve_path> found;
        const auto point_count = static_cast<std::uint32_t>(begin_.size() - 1);
        for (const bool at_nodes : {true, false})
            for (std::uint32_t p = 0; p < point_count; ++p) {
                if (at_nodes && degree(p) == 2) continue;
                for (std::size_t i = begin_[p]; i < begin_[p + 1]; ++i)
                    if (!walked_[at_[i]]) found.push_back(walk(p, at_[i]));
            }
        return found;
    }
    [[nodiscard]] std::size_t degree(std::uint32_t p) const { return begin_[p + 1] - begin_[p]; }

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
            const std::uint32_t first = at_[begin_[p]];
            along = first == along ? at_[begin_[p] + 1] : first;
        }
    }

    std::vector<segment> segments_;
    std::vector<char> walked_;
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> at_;
};

}  // namespace

curve_network intersection_paths(mesh_view mesh, std::span<const face_pair> pairs) {
    detail::intersect::check_pairs("intersection_paths", mesh, pairs, true);
    const detail::intersect::mesh_meetings met = detail::intersect::meetings_of(mesh, pairs);
    point_table table(mesh, met);
    std::vector<segment> segments;
    std::vector<std::array<std::uint32_t, 2>> touched;  // point, pair
    for (std::uint32_t i = 0; i < met.meetings.size(); ++i) {
        const detail::intersect::meeting& m = met.meetings[i];
        const std::size_t sides = m.count < 3 ? m.count - (m.count != 0) : m.count;
        for (std::size_t k = 0; k < sides; ++k) {
            const std::uint32_t u = table[m.ends[k].point];
            const std::uint32_t v = table[m.ends[(k + 1) % m.count].point];
            segments.push_back({{std::min(u, v), std::max(u, v)}, i});
        }
        if (m.count == 1) touched.push_back({table[m.ends[0].point], i});
    }
    const auto before = [](const segment& s, const segment& t) {
        return s.ends != t.ends ? s.ends < t.ends : s.pair < t.pair;
    };
    std::sort(segments.begin(), segments.end(), before);
    segments.erase(std::unique(segments.begin(), segments.end(),
                               [](const segment& s, const segment& t) { return s.ends == t.ends; }),
                   segments.end());

    curve_network result;
    path_walker walker(table.points.size(), std::move(segments));
    result.paths = walker.paths();
    std::sort(touched.begin(), touched.end());
    for (std::size_t i = 0; i < touched.size(); ++i)
        if ((i == 0 || touched[i - 1][0] != touched[i][0]) && walker.degree(touched[i][0]) == 0)
            result.paths.push_back({{touched[i][0]}, {touched[i][1]}, false});
    result.points = std::move(table.points);
    return result;
}

}  // namespace treeform
