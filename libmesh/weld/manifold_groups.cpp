#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/group_points.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

using numbers = std::vector<std::uint32_t>;

/// The faces with point v called name[v]; of those that repeated a corner before nothing is left.
std::vector<face> renamed(std::span<const face> faces, const numbers& name) {
    std::vector<face> result(faces.size());
    base::for_numbers(faces.size(), [&](std::size_t i) {
        const face& f = faces[i];
        if (base::has_three_corners(f))
            result[i] = {name[f[0]], name[f[1]], name[f[2]]};
        else
            result[i] = {name[f[0]], name[f[0]], name[f[0]]};
    });
    return result;
}

/// Which corner of the face is called so; the first if there are two.
std::size_t corner_called(const face& f, std::uint32_t name) {
    return f[0] == name ? 0 : f[1] == name ? 1 : 2;
}

/// [V] whether the faces of a point fall into several fans.
std::vector<std::uint8_t> several_fans(std::size_t point_count, std::span<const face> faces,
                                       const edge_uses& edges) {
    base::union_find corners(3 * faces.size());
    const auto corner = [&](std::uint32_t f, std::uint32_t point) {
        return static_cast<std::uint32_t>(3 * std::size_t{f} + corner_called(faces[f], point));
    };
    edges.for_each([&](const used_edge& edge, std::size_t) {
        for (std::size_t i = 1; i < edge.uses.size(); ++i)
            for (const std::uint32_t end : {edge.low, edge.high})
                corners.join(corner(edge.face(0), end), corner(edge.face(i), end));
    });
    std::vector<std::uint8_t> fans(point_count, 0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const face& f = faces[i / 3];
        const auto id = static_cast<std::uint32_t>(i);
        if (!base::has_three_corners(f) || corners.root(id) != id) continue;
        std::uint8_t& n = fans[f[i % 3]];
        n = static_cast<std::uint8_t>(std::min(n + 1, 2));
    }
    for (std::uint8_t& n : fans) n = n > 1 ? 1 : 0;
    return fans;
}

/// Splits groups of the points of some faces; where parts would do harm, into single points.
class splitter {
  public:
    splitter(std::span<const face> faces, const point_groups& given)
        : given_faces_(faces),
          given_(given),
          single_(given.first_of_group.size(), 0),
          several_fans_before_(fans_before()) {}

    point_groups run(int rounds) {
        for (;;) {
            const numbers part = join_along_edges();
            const numbers faulty = faults(part);
            if (faulty.empty()) return number(part);
            if (rounds-- > 0)
                for (const std::uint32_t point : faulty) split_up(point);
            else
                split_components(faulty);
        }
    }

  private:
    [[nodiscard]] std::size_t point_count() const { return given_.group_of_point.size(); }
    void split_up(std::uint32_t point) { single_[given_.group_of_point[point]] = 1; }

    [[nodiscard]] std::vector<std::uint8_t> fans_before() const {
        const edge_uses edges(point_count(), given_faces_, repeated_corners::left_out);
        return several_fans(point_count(), given_faces_, edges);
    }

    /// [V] the lowest point that may be merged with each as things stand.
    [[nodiscard]] numbers mergeable() const {
        numbers name(point_count());
        base::for_numbers(name.size(), [&](std::size_t v) {
            const std::uint32_t group = given_.group_of_point[v];
            name[v] =
                single_[group] != 0 ? static_cast<std::uint32_t>(v) : given_.first_of_group[group];
        });
        return name;
    }

    /// [V] the lowest point of the part each point goes to: what hangs together along edges that
    /// merging makes one edge of at most two faces, and along edges that it shrinks to a point.
    [[nodiscard]] numbers join_along_edges() const {
        const numbers name = mergeable();
        const std::vector<face> faces = renamed(given_faces_, name);
        base::union_find parts(point_count());
        join_shrunk(faces, parts);
        edge_uses(point_count(), faces, repeated_corners::counted)
            .for_each([&](const used_edge& edge, std::size_t) {
                std::size_t left = 0;
                for (std::size_t i = 0; i < edge.uses.size(); ++i)
                    left += base::has_three_corners(faces[edge.face(i)]) ? 1 : 0;
                if (left > 2) return;
                for (std::size_t i = 1; i < edge.uses.size(); ++i)
                    for (const std::uint32_t end : {edge.low, edge.high})
                        parts.join(end_of(faces, edge.face(0), end),
                                   end_of(faces, edge.face(i), end));
            });
        numbers part(point_count());
        base::for_numbers(part.size(), [&](std::size_t v) {
            part[v] = parts.root(static_cast<std::uint32_t>(v));
        });
        return part;
    }

    void join_shrunk(const std::vector<face>& faces, base::union_find& parts) const {
        for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i) {
                if (!base::has_three_corners(given_faces_[i])) continue;
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t next = k == 2 ? 0 : k + 1;
                    if (faces[i][k] == faces[i][next])
                        parts.join(given_faces_[i][k], given_faces_[i][next]);
                }
            }
        });
    }

    /// The point given that is called `name` in a face.
    [[nodiscard]] std::uint32_t end_of(const std::vector<face>& faces, std::uint32_t f,
                                       std::uint32_t name) const {
        return given_faces_[f][corner_called(faces[f], name)];
    }

    /// Points of parts that must be split up further, empty when all is well. Where there is a
    /// fault there is such a part: an edge made of two has an end made of two points, and merging
    /// the others around a point leaves its faces as they hang together.
    [[nodiscard]] numbers faults(const numbers& part) const {
        const std::vector<face> faces = renamed(given_faces_, part);
        const edge_uses edges(point_count(), faces, repeated_corners::left_out);
        std::vector<std::uint8_t> of_several(point_count(), 0);
        std::vector<std::uint8_t> excused(point_count(), 0);
        for (std::size_t v = 0; v < part.size(); ++v) {
            if (part[v] != v) of_several[part[v]] = 1;
            if (several_fans_before_[v] != 0) excused[part[v]] = 1;
        }
        std::vector<numbers> found(edges.chunks());
        edges.for_each([&](const used_edge& edge, std::size_t chunk) {
            if (edge.uses.size() <= 2 || is_one_edge_given(faces, edge)) return;
            for (const std::uint32_t end : {edge.low, edge.high})
                if (of_several[end] != 0) found[chunk].push_back(end);
        });
        numbers faulty;
        for (const numbers& some : found) faulty.insert(faulty.end(), some.begin(), some.end());
        const std::vector<std::uint8_t> fans = several_fans(point_count(), faces, edges);
        for (std::size_t v = 0; v < fans.size(); ++v)
            if (fans[v] != 0 && excused[v] == 0) faulty.push_back(static_cast<std::uint32_t>(v));
        return faulty;
    }

    [[nodiscard]] bool is_one_edge_given(const std::vector<face>& faces,
                                         const used_edge& edge) const {
        const auto given = [&](std::size_t use) {
            return std::pair(end_of(faces, edge.face(use), edge.low),
                             end_of(faces, edge.face(use), edge.high));
        };
        for (std::size_t i = 1; i < edge.uses.size(); ++i)
            if (given(i) != given(0)) return false;
        return true;
    }

    /// Splits all groups that hang together with a faulty one into single points.
    void split_components(const numbers& faulty) {
        base::union_find linked(point_count());
        for (std::size_t v = 0; v < point_count(); ++v)
            linked.join(static_cast<std::uint32_t>(v),
                        given_.first_of_group[given_.group_of_point[v]]);
        for (const face& f : given_faces_)
            for (const std::uint32_t corner : f) linked.join(f[0], corner);
        std::vector<std::uint8_t> hit(point_count(), 0);
        for (const std::uint32_t v : faulty) hit[linked.root(v)] = 1;
        for (const std::uint32_t first : given_.first_of_group)
            if (hit[linked.root(first)] != 0) split_up(first);
    }

    /// Points without faces go with the lowest point of their group that has some.
    [[nodiscard]] point_groups number(const numbers& part) const {
        std::vector<std::uint8_t> has_faces(point_count(), 0);
        for (const face& f : given_faces_)
            if (base::has_three_corners(f))
                for (const std::uint32_t corner : f) has_faces[corner] = 1;
        numbers host(given_.first_of_group.size(), no_number);
        for (std::size_t v = 0; v < part.size(); ++v) {
            std::uint32_t& h = host[given_.group_of_point[v]];
            if (has_faces[v] != 0) h = std::min(h, part[v]);
        }
        for (std::size_t g = 0; g < host.size(); ++g)
            if (host[g] == no_number) host[g] = given_.first_of_group[g];
        point_groups result;
        numbers number_of(point_count(), no_number);
        result.group_of_point.resize(point_count());
        for (std::size_t v = 0; v < part.size(); ++v) {
            const std::uint32_t g = given_.group_of_point[v];
            std::uint32_t& n = number_of[has_faces[v] != 0 ? part[v] : host[g]];
            if (n == no_number) {
                n = static_cast<std::uint32_t>(result.first_of_group.size());
                result.first_of_group.push_back(static_cast<std::uint32_t>(v));
            }
            result.group_of_point[v] = n;
        }
        return result;
    }

    std::span<const face> given_faces_;
    const point_groups& given_;
    std::vector<std::uint8_t> single_;  ///< [G] whether the group is split into single points
    std::vector<std::uint8_t> several_fans_before_;
};

bool all_equal(points_view points, const point_groups& given) {
    std::vector<std::uint8_t> differ(chunk_count(points.size(), light_grain), 0);
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t v = begin; v < end && differ[c] == 0; ++v) {
            const std::uint32_t first = given.first_of_group[given.group_of_point[v]];
            if (first != v && !(points[v] == points[first])) differ[c] = 1;
        }
    });
    return std::find(differ.begin(), differ.end(), 1) == differ.end();
}

/// The groups with only points of equal coordinates left together.
point_groups with_equal_coordinates(points_view points, const point_groups& given) {
    const numbers place = find_equal_points(points).group_of_point;
    buffer<point3> keys(points.size());
    base::for_numbers(keys.size(), [&](std::size_t v) {
        keys[v] = {static_cast<double>(given.group_of_point[v]), static_cast<double>(place[v]),
                   0.0};
    });
    return find_equal_points(keys.span());
}

/// The same groups, of parts of them instead of points.
point_groups of_parts(const point_groups& given, const point_groups& parts) {
    point_groups result;
    for (const std::uint32_t point : parts.first_of_group)
        result.group_of_point.push_back(given.group_of_point[point]);
    for (const std::uint32_t point : given.first_of_group)
        result.first_of_group.push_back(parts.group_of_point[point]);
    return result;
}

/// `parts`, joined as `of_part` says.
point_groups put_together(point_groups parts, const point_groups& of_part) {
    for (std::uint32_t& n : parts.group_of_point) n = of_part.group_of_point[n];
    numbers first;
    for (const std::uint32_t part : of_part.first_of_group)
        first.push_back(parts.first_of_group[part]);
    parts.first_of_group = std::move(first);
    return parts;
}

std::uint64_t count_split(const point_groups& given, const point_groups& parts) {
    numbers parts_of(given.first_of_group.size(), 0);
    std::uint64_t split = 0;
    for (const std::uint32_t point : parts.first_of_group)
        split += ++parts_of[given.group_of_point[point]] == 2 ? 1 : 0;
    return split;
}

}  // namespace

manifold_groups split_to_manifold(mesh_view mesh, const point_groups& given, int rounds) {
    if (mesh.faces.size() > no_number / 3)
        throw std::invalid_argument("treeform::weld: more than 2^32 / 3 faces with keep_manifold");
    const bool equal = all_equal(mesh.points, given);
    point_groups parts =
        equal ? splitter(mesh.faces, given).run(rounds)
              : splitter(mesh.faces, with_equal_coordinates(mesh.points, given)).run(rounds);
    if (!equal) {
        const std::vector<face> faces = renamed(mesh.faces, parts.group_of_point);
        const point_groups of_part = splitter(faces, of_parts(given, parts)).run(rounds);
        parts = put_together(std::move(parts), of_part);
    }
    const std::uint64_t split = count_split(given, parts);
    return {std::move(parts), split};
}

}  // namespace treeform::detail::weld
