/// \file
/// judge FILE...: what CGAL's exact predicates say of surfaces as other programs read them, with
/// points of equal coordinates as one. A line of CSV for each file:
///
///   file,faces,volume,area,bad_edges,bad_vertices,meeting
///
/// `bad_edges` have not exactly two faces that run along them in opposite directions,
/// `bad_vertices` more than one fan of faces. `meeting` counts pairs of faces that have more in
/// common than corners and edges, and degenerate faces; with many, the search stops at 10,000. A
/// file that cannot be read has "unreadable" in the place of numbers.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using corners = std::array<std::uint32_t, 3>;

struct surface {
    std::vector<kernel::Point_3> points;
    std::vector<corners> faces;
};

surface read(const char* path) {
    const tf::mesh mesh = tf::read(path).mesh;
    surface result;
    std::map<std::array<double, 3>, std::uint32_t> known;
    std::vector<std::uint32_t> number;
    for (const tf::point3& p : mesh.points) {
        const auto next = static_cast<std::uint32_t>(result.points.size());
        const auto [at, is_new] = known.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, next);
        if (is_new) result.points.emplace_back(p.x, p.y, p.z);
        number.push_back(at->second);
    }
    for (const tf::face& f : mesh.faces)
        result.faces.push_back({number[f[0]], number[f[1]], number[f[2]]});
    return result;
}

bool is_degenerate(const surface& s, const corners& f) {
    return CGAL::collinear(s.points[f[0]], s.points[f[1]], s.points[f[2]]);
}

std::size_t bad_edges(const surface& s) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> uses;
    for (const corners& f : s.faces)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = f[i], to = f[(i + 1) % 3];
            ++uses[std::minmax(from, to)][from < to ? 0 : 1];
        }
    return static_cast<std::size_t>(std::ranges::count_if(uses, [](const auto& use) {
        return use.second != std::array<int, 2>{1, 1};
    }));
}

/// Faces at a vertex are of one fan when they are linked by edges at it.
std::size_t bad_vertices(const surface& s) {
    std::vector<std::vector<std::size_t>> faces_at(s.points.size());
    for (std::size_t f = 0; f < s.faces.size(); ++f)
        for (const std::uint32_t v : s.faces[f]) faces_at[v].push_back(f);
    std::size_t bad = 0;
    for (std::uint32_t v = 0; v < faces_at.size(); ++v) {
        const std::vector<std::size_t>& around = faces_at[v];
        std::vector<std::size_t> fan(around.size());
        std::iota(fan.begin(), fan.end(), std::size_t{0});
        const auto root = [&](std::size_t i) {
            while (fan[i] != i) i = fan[i];
            return i;
        };
        std::map<std::uint32_t, std::size_t> first_along;
        for (std::size_t i = 0; i < around.size(); ++i)
            for (const std::uint32_t w : s.faces[around[i]]) {
                if (w == v) continue;
                const auto [at, is_new] = first_along.try_emplace(w, i);
                if (!is_new) fan[root(i)] = root(at->second);
            }
        std::size_t fans = 0;
        for (std::size_t i = 0; i < around.size(); ++i) fans += root(i) == i ? 1 : 0;
        bad += fans > 1 ? 1 : 0;
    }
    return bad;
}

/// `f`, turned so that the corners that `g` has, too, come first. Returns how many these are.
std::size_t shared_first(corners& f, const corners& g) {
    return static_cast<std::size_t>(
        std::stable_partition(f.begin(), f.end(),
                              [&](std::uint32_t v) { return std::ranges::count(g, v) > 0; }) -
        f.begin());
}

/// Whether two faces that are not degenerate have more in common than corners and an edge.
bool meet(const surface& s, corners f, corners g) {
    const std::size_t shared = shared_first(f, g);
    shared_first(g, f);
    const auto at = [&](const corners& face, std::size_t i) { return s.points[face[i]]; };
    const auto triangle = [&](const corners& face) {
        return kernel::Triangle_3(at(face, 0), at(face, 1), at(face, 2));
    };
    if (shared == 0) return CGAL::do_intersect(triangle(f), triangle(g));
    // From the common corner, what is common is left through the side opposite of it in one of
    // them.
    if (shared == 1)
        return CGAL::do_intersect(kernel::Segment_3(at(f, 1), at(f, 2)), triangle(g)) ||
               CGAL::do_intersect(kernel::Segment_3(at(g, 1), at(g, 2)), triangle(f));
    if (shared == 2)
        return CGAL::coplanar(at(f, 0), at(f, 1), at(f, 2), at(g, 2)) &&
               CGAL::coplanar_orientation(at(f, 0), at(f, 1), at(f, 2), at(g, 2)) == CGAL::POSITIVE;
    return true;
}

std::size_t meeting(const surface& s) {
    using box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
    constexpr std::size_t enough = 10'000;
    struct stop {};
    std::size_t found = 0;
    std::vector<box> boxes;
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
        const auto& [a, b, c] = s.faces[f];
        if (is_degenerate(s, s.faces[f]))
            ++found;
        else
            boxes.emplace_back(s.points[a].bbox() + s.points[b].bbox() + s.points[c].bbox(), f);
    }
    try {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const box& x, const box& y) {
            found += meet(s, s.faces[x.info()], s.faces[y.info()]);
            if (found >= enough) throw stop{};
        });
    } catch (const stop&) {
    }
    return found;
}

void judge(const char* path) {
    const surface s = read(path);
    double volume = 0.0, area = 0.0;
    const kernel::Vector_3 base = s.points.empty() ? CGAL::NULL_VECTOR : s.points[0] - CGAL::ORIGIN;
    for (const corners& f : s.faces) {
        const auto from_base = [&](std::size_t i) { return s.points[f[i]] - base - CGAL::ORIGIN; };
        const kernel::Vector_3 a = from_base(0), b = from_base(1), c = from_base(2);
        volume += CGAL::to_double(CGAL::determinant(a, b, c)) / 6;
        area += std::sqrt(CGAL::to_double(CGAL::cross_product(b - a, c - a).squared_length())) / 2;
    }
    std::printf("%s,%zu,%.17g,%.17g,%zu,%zu,%zu\n", path, s.faces.size(), volume, area,
                bad_edges(s), bad_vertices(s), meeting(s));
}

}  // namespace

int main(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        try {
            judge(argv[i]);
        } catch (const std::exception& failure) {
            std::printf("%s,unreadable,,,,,\n", argv[i]);
            std::fprintf(stderr, "%s: %s\n", argv[i], failure.what());
        }
        std::fflush(stdout);
    }
    return 0;
}
