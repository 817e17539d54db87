#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace treeform {
namespace {

constexpr std::size_t ahead = 4;  ///< stars whose memory is under way

/// One use of an edge at a point: the point at its other end, then the position in the star of the
/// face that uses it. No two of a star are equal.
using edge_use = std::uint64_t;
edge_use use_of(std::uint32_t other, std::uint32_t position) {
    return std::uint64_t{other} << 32 | position;
}
std::uint32_t other_end(edge_use use) { return static_cast<std::uint32_t>(use >> 32); }
std::uint32_t position_of(edge_use use) { return static_cast<std::uint32_t>(use); }

/// Sorts different numbers. Few are sent to their ranks, counted without a branch: in a mesh whose
/// points have random numbers each comparison is a coin toss.
void sort_uses(std::vector<edge_use>& uses, std::vector<edge_use>& scratch) {
    constexpr std::size_t few = 40;
    if (uses.size() > few) {
        std::sort(uses.begin(), uses.end());
        return;
    }
    scratch.resize(uses.size());
    for (const edge_use use : uses) {
        std::size_t rank = 0;
        for (const edge_use other : uses) rank += other < use ? 1 : 0;
        scratch[rank] = use;
    }
    uses.swap(scratch);
}

/// What one chunk of points finds.
struct chunk_counts {
    topology_counts counts;
    /// Faces of different fans of one point, to be linked once the edges have been.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> fan_links;
};

/// Looks at one star after the other; every edge is counted at its lower end.
class star_reader {
  public:
    star_reader(std::span<const face> faces, detail::base::union_find& by_edge, chunk_counts& found)
        : faces_(faces), by_edge_(by_edge), found_(found) {}

    void prefetch(std::span<const std::uint32_t> star) const {
        for (const std::uint32_t face : star.first(std::min<std::size_t>(star.size(), 16))) {
            __builtin_prefetch(&faces_[face]);
            by_edge_.prefetch(face);
        }
    }

    void read(std::uint32_t point, std::span<const std::uint32_t> star) {
        if (star.empty()) return;
        ++found_.counts.points_used;
        collect_uses(point, star);
        fan_.resize(star.size());
        for (std::uint32_t i = 0; i < star.size(); ++i) fan_[i] = i;
        for (std::size_t begin = 0, end = 0; begin < uses_.size(); begin = end) {
            const std::uint32_t other = other_end(uses_[begin]);
            while (end < uses_.size() && other_end(uses_[end]) == other) ++end;
            const std::span<const edge_use> edge(uses_.data() + begin, end - begin);
            for (const edge_use use : edge.subspan(1))
                join_fans(position_of(edge.front()), position_of(use));
            if (point < other) count_edge(point, edge, star);
        }
        count_fans(star);
    }

  private:
    void collect_uses(std::uint32_t point, std::span<const std::uint32_t> star) {
        uses_.clear();
        for (std::uint32_t i = 0; i < star.size(); ++i) {
            const face& f = faces_[star[i]];
            const std::size_t k = (f[1] == point ? 1U : 0U) | (f[2] == point ? 2U : 0U);
            uses_.push_back(use_of(f[k == 0 ? 1 : 0], i));
            uses_.push_back(use_of(f[k == 2 ? 1 : 2], i));
        }
        sort_uses(uses_, scratch_);
    }

    /// Whether the face runs from the star's point to the other end, not back.
    bool outgoing(std::uint32_t point, edge_use use, std::span<const std::uint32_t> star) const {
        const face& f = faces_[star[position_of(use)]];
        return other_end(use) == (f[0] == point ? f[1] : f[1] == point ? f[2] : f[0]);
    }

    void count_edge(std::uint32_t point, std::span<const edge_use> edge,
                    std::span<const std::uint32_t> star) {
        topology_counts& counts = found_.counts;
        ++counts.edges;
        if (edge.size() == 1) ++counts.boundary_edges;
        if (edge.size() >= 3) ++counts.nonmanifold_edges;
        if (edge.size() == 2 && outgoing(point, edge[0], star) == outgoing(point, edge[1], star))
            ++counts.misoriented_edges;
        for (std::size_t i = 1; i < edge.size(); ++i)
            by_edge_.join(star[position_of(edge[0])], star[position_of(edge[i])]);
        if (edge.size() >= 2) count_duplicates(point, edge, star);
    }

    /// Each face at the edge between its lowest corner and the next.
    void count_duplicates(std::uint32_t point, std::span<const edge_use> edge,
                          std::span<const std::uint32_t> star) {
        const std::uint32_t other = other_end(edge.front());
        thirds_.clear();
        for (const edge_use use : edge) {
            const face& f = faces_[star[position_of(use)]];
            const std::uint32_t third = f[0] ^ f[1] ^ f[2] ^ point ^ other;
            if (third > other) thirds_.push_back(third);
        }
        std::sort(thirds_.begin(), thirds_.end());
        for (std::size_t i = 1; i < thirds_.size(); ++i)
            found_.counts.duplicate_faces += thirds_[i] == thirds_[i - 1] ? 1 : 0;
    }

    std::uint32_t fan_of(std::uint32_t position) {
        while (fan_[position] != position) position = fan_[position] = fan_[fan_[position]];
        return position;
    }

    void join_fans(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t a = fan_of(i);
        const std::uint32_t b = fan_of(j);
        fan_[std::max(a, b)] = std::min(a, b);
    }

    void count_fans(std::span<const std::uint32_t> star) {
        bool several = false;
        for (std::uint32_t i = 1; i < star.size(); ++i) {
            if (fan_[i] != i) continue;
            several = true;
            found_.fan_links.emplace_back(star[0], star[i]);
        }
        if (several) ++found_.counts.nonmanifold_points;
    }

    std::span<const face> faces_;
    detail::base::union_find& by_edge_;
    chunk_counts& found_;
    std::vector<edge_use> uses_;  ///< ascending: those of an edge side by side
    std::vector<edge_use> scratch_;
    std::vector<std::uint32_t> fan_;     ///< [star] a face of the same fan, never a later one
    std::vector<std::uint32_t> thirds_;  ///< corners off an edge
};

void add(topology_counts& sum, const topology_counts& part) {
    sum.edges += part.edges;
    sum.boundary_edges += part.boundary_edges;
    sum.nonmanifold_edges += part.nonmanifold_edges;
    sum.misoriented_edges += part.misoriented_edges;
    sum.nonmanifold_points += part.nonmanifold_points;
    sum.points_used += part.points_used;
    sum.duplicate_faces += part.duplicate_faces;
}

/// Sets of `linked` that hold a face with three different corners.
std::uint64_t count_components(std::span<const face> faces, detail::base::union_find& linked) {
    constexpr std::size_t large = std::size_t{1} << 16;
    std::vector<std::uint64_t> roots(chunk_count(faces.size(), large), 0);
    for_chunks(faces.size(), large, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto id = static_cast<std::uint32_t>(i);
            roots[c] += linked.root(id) == id && detail::base::has_three_corners(faces[i]) ? 1 : 0;
        }
    });
    std::uint64_t total = 0;
    for (const std::uint64_t n : roots) total += n;
    return total;
}

}  // namespace

topology_counts count_topology(std::size_t point_count, std::span<const face> faces) {
    detail::base::check_faces("count_topology", point_count, faces);
    const detail::base::stars stars(point_count, faces);
    detail::base::union_find linked(faces.size());
    std::vector<chunk_counts> found(chunk_count(stars.size(), light_grain));
    for_chunks(stars.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        chunk_counts part;
        star_reader reader(faces, linked, part);
        for (std::size_t v = begin; v < end; ++v) {
            if (v + ahead < end) reader.prefetch(stars[v + ahead]);
            reader.read(static_cast<std::uint32_t>(v), stars[v]);
        }
        found[c] = std::move(part);
    });

    topology_counts result;
    for (const chunk_counts& part : found) add(result, part.counts);
    result.faces = stars.face_count();
    result.repeated_corner_faces = faces.size() - result.faces;
    result.closed_manifold =
        result.faces > 0 && result.boundary_edges == 0 && result.nonmanifold_edges == 0;
    result.components_by_edge = count_components(faces, linked);
    for (const chunk_counts& part : found)
        for (const auto& [a, b] : part.fan_links) linked.join(a, b);
    result.components_by_point = count_components(faces, linked);
    return result;
}

std::vector<std::uint32_t> face_components(std::size_t point_count, std::span<const face> faces) {
    constexpr std::size_t large = std::size_t{1} << 16;
    detail::base::check_faces("face_components", point_count, faces);
    detail::base::union_find linked(detail::base::nameable_points(point_count));
    for_chunks(faces.size(), large, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            linked.join(faces[i][0], faces[i][1]);
            linked.join(faces[i][0], faces[i][2]);
        }
    });
    constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number_of(linked.size(), unnumbered);
    std::vector<std::uint32_t> component(faces.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        std::uint32_t& number = number_of[linked.root(faces[i][0])];
        if (number == unnumbered) number = next++;
        component[i] = number;
    }
    return component;
}

}  // namespace treeform
