#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/simplify/kept_chains.hpp>
#include <libmesh/simplify/seen_along.hpp>
#include <libmesh/weld/equal_points.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace treeform::detail::simplify {
namespace {

[[nodiscard]] bool uses(const face& f, std::uint32_t p) {
    return f[0] == p || f[1] == p || f[2] == p;
}

/// The face that has side `i` of `f` the other way round, if that and no other has it, too.
[[nodiscard]] std::uint32_t mate_of(const connected_faces& mesh, std::uint32_t f, std::size_t i) {
    const std::uint32_t p = mesh.faces[f][i], q = mesh.faces[f][(i + 1) % 3];
    std::uint32_t mate = no_face;
    for (const std::uint32_t g : mesh.star[p]) {
        if (g == f || !uses(mesh.faces[g], q)) continue;
        if (mate != no_face || mesh.faces[g][(corner_of(mesh.faces[g], q) + 1) % 3] != p)
            return no_face;
        mate = g;
    }
    return mate;
}

/// Whether faces at `p` follow one another, around it or from border to border.
[[nodiscard]] bool is_fan(const connected_faces& mesh, std::uint32_t p) {
    const ids& star = mesh.star[p];
    const auto side_to = [&](std::uint32_t f, std::size_t step) {  // 0: from p, 2: to p
        return mesh.mates[f][(corner_of(mesh.faces[f], p) + step) % 3];
    };
    std::uint32_t first = star.front();
    for (const std::uint32_t f : star)
        if (side_to(f, 0) == no_face) first = f;
    std::size_t count = 1;
    for (std::uint32_t f = side_to(first, 2); f != no_face && f != first && count <= star.size();
         f = side_to(f, 2))
        ++count;
    return count == star.size();
}

}  // namespace

connected_faces::connected_faces(mesh_view given, precision of_points)
    : points(given.points.begin(), given.points.end()) {
    if (of_points == precision::float32)
        for (point3& p : points)
            p = {base::nearest_float(p.x), base::nearest_float(p.y), base::nearest_float(p.z)};
    const ids first = weld::equal_firsts(points, {});
    for (std::uint32_t f = 0; f < given.faces.size(); ++f) {
        face corners = given.faces[f];
        for (std::uint32_t& c : corners) c = first[c];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
            continue;
        faces.push_back(corners);
        source.push_back(f);
    }
    star.resize(points.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t c : faces[f]) star[c].push_back(f);
    mates.resize(faces.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) mates[f][i] = mate_of(*this, f, i);
}

kept_chains::kept_chains(const connected_faces& mesh, const simplify_options& options)
    : at_(mesh.points.size()), locked_(mesh.points.size()) {
    const double cosine = std::cos(options.feature_angle * std::numbers::pi / 180.0);
    const auto& groups = options.face_groups;
    const auto group_at = [&](std::uint32_t f, std::uint32_t p) {
        return options.corner_groups[3 * mesh.source[f] + corner_of(mesh.faces[f], p)];
    };
    const auto is_smooth = [&](std::uint32_t f, std::uint32_t g,
                               const std::array<std::uint32_t, 2>& ends) {
        if (!groups.empty() && groups[mesh.source[f]] != groups[mesh.source[g]]) return false;
        if (!options.corner_groups.empty())
            for (const std::uint32_t p : ends)
                if (group_at(f, p) != group_at(g, p)) return false;
        if (options.feature_angle >= 180.0) return true;
        const point3 m = normal_of(base::triangle_of(mesh.points, mesh.faces[f]));
        const point3 n = normal_of(base::triangle_of(mesh.points, mesh.faces[g]));
        return base::dot(m, n) >= cosine * std::sqrt(base::dot(m, m) * base::dot(n, n));
    };
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t p = mesh.faces[f][i], q = mesh.faces[f][(i + 1) % 3];
            const std::uint32_t mate = mesh.mates[f][i];
            if (mate != no_face && (mate < f || is_smooth(f, mate, {p, q}))) continue;
            const bool is_border = std::ranges::count_if(mesh.star[p], [&](std::uint32_t g) {
                                       return uses(mesh.faces[g], q);
                                   }) == 1;
            if (mate == no_face && !is_border) {
                locked_[p] = locked_[q] = 1;
            } else {
                at_[p].push_back({q});
                at_[q].push_back({p});
            }
        }
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p)
        if (!mesh.star[p].empty() && locked_[p] == 0 && !is_fan(mesh, p)) locked_[p] = 1;
}

bool kept_chains::has(std::uint32_t p, std::uint32_t q) const {
    return std::ranges::any_of(at_[p], [&](const link& l) { return l.to == q; });
}

std::optional<double> kept_chains::bound(const std::vector<point3>& points, std::uint32_t gone,
                                         std::uint32_t kept) const {
    const std::vector<link>& links = at_[gone];
    const point3 &p = points[gone], &to = points[kept];
    const point3& from = points[links[0].to == kept ? links[1].to : links[0].to];
    const point3 way = base::minus(to, from), there = base::minus(p, from);
    const double share = base::dot(there, way) / base::dot(way, way);
    if (!(share >= 0.0 && share <= 1.0)) return std::nullopt;
    const point3 off = base::minus(there, base::scaled(way, share));
    // Points at one share of the way, whatever it is, are matched. Each operation is off by no more
    // than 4 u of the largest coordinate.
    const double error =
        0x1p-47 * std::max({base::largest_of(p), base::largest_of(to), base::largest_of(from)});
    return std::max(links[0].at_most, links[1].at_most) + std::sqrt(base::dot(off, off)) + error;
}

void kept_chains::join(std::uint32_t p, std::uint32_t q, std::uint32_t gone, double at_most) {
    std::vector<link> all;
    for (const std::uint32_t from : {p, q})
        for (link l : at_[from]) {
            if (l.to == p || l.to == q) continue;
            if (from == gone) l.at_most = at_most;
            for (link& back : at_[l.to])
                if (back.to == from) back = {p, l.at_most};
            all.push_back(l);
        }
    at_[p] = std::move(all);
    at_[q].clear();
    locked_[p] = locked_[p] | locked_[q];
}

}  // namespace treeform::detail::simplify
