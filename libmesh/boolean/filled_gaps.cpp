#include <libmesh/base/double_double.hpp>
#include <libmesh/base/operand_name.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/boolean/filled_gaps.hpp>
#include <libmesh/geometry/flat_triangle.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail::boolean {
namespace {

using base::dot;
using base::minus;
using base::plus;
using base::scaled;
using treeform::detail::geometry::lexicographically_less;

constexpr std::uint32_t no_prism = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t prism_points = 6, prism_faces = 8;
constexpr double least_cosine = 0.70710678118654752;  // of 45 degrees

/// A face of an operand, counter-clockwise as seen from outside.
struct outward_face {
    std::array<point3, 3> at;
    point3 normal;  ///< of length 1; zero of a face without an area
    operand_element source;
};

/// In twice the precision of double, since the corners of a sliver are nearly on a line.
point3 normal_of(const std::array<point3, 3>& at) {
    point3 u = minus(at[1], at[0]), v = minus(at[2], at[0]);
    const double size = std::max(base::largest_of(u), base::largest_of(v));
    if (!(size > 0.0) || !std::isfinite(size)) return {0, 0, 0};
    u = scaled(u, 1.0 / size);
    v = scaled(v, 1.0 / size);
    const auto minor = [&](std::size_t i, std::size_t j) {
        return (base::product_of(u[i], v[j]) + -base::product_of(u[j], v[i])).high;
    };
    const point3 n{minor(1, 2), minor(2, 0), minor(0, 1)};
    const double length = std::sqrt(dot(n, n));
    return length > 0.0 ? scaled(n, 1.0 / length) : point3{0, 0, 0};
}

/// Those of an operand that is inside out are turned.
std::vector<outward_face> outward_faces(std::span<const mesh_view> operands) {
    std::vector<outward_face> all;
    for (std::uint32_t k = 0; k < operands.size(); ++k) {
        const bool is_turned = signed_volume(operands[k]) < 0.0;
        for (std::uint32_t f = 0; f < operands[k].faces.size(); ++f) {
            std::array<point3, 3> at = base::triangle_of(operands[k], f);
            if (is_turned) std::swap(at[1], at[2]);
            all.push_back({at, normal_of(at), {k, f}});
        }
    }
    return all;
}

/// The part of f in the column above and below g.
std::vector<point3> part_over(const outward_face& f, const outward_face& g) {
    std::vector<point3> part(f.at.begin(), f.at.end()), inside;
    for (std::size_t k = 0; k < 3 && !part.empty(); ++k) {
        const point3& from = g.at[k];
        const point3 inward = base::cross(g.normal, minus(g.at[(k + 1) % 3], from));
        inside.clear();
        for (std::size_t i = 0; i < part.size(); ++i) {
            const point3 &p = part[i], &q = part[(i + 1) % part.size()];
            const double at_p = dot(minus(p, from), inward), at_q = dot(minus(q, from), inward);
            if (at_p >= 0.0) inside.push_back(p);
            if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
                inside.push_back(plus(p, scaled(minus(q, p), at_p / (at_p - at_q))));
        }
        part.swap(inside);
    }
    return part;
}

/// Whether a part of f with an area is above g, as g looks, and somewhere by at most `width`.
bool is_just_above(const outward_face& f, const outward_face& g, double width) {
    const std::vector<point3> part = part_over(f, g);
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest, area = 0.0;
    for (std::size_t i = 0; i < part.size(); ++i) {
        const double height = dot(minus(part[i], g.at[0]), g.normal);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
        if (i > 1)
            area +=
                dot(f.normal, base::cross(minus(part[i - 1], part[0]), minus(part[i], part[0])));
    }
    return area > 0.0 && lowest <= width && highest > 0.0;
}

/// Faces that lie over each other are such, and some beside them.
bool are_opposite(const outward_face& f, const outward_face& g, double width) {
    return f.source.operand != g.source.operand && dot(f.normal, g.normal) <= -least_cosine &&
           closest_pair(f.at, g.at).squared_distance <= width * width;
}

/// Where the corners of faces go when these move outward by `height`, or a little more: faces of
/// one operand that lean little move together, so that nothing stays open between them.
std::vector<std::array<point3, 3>> moved_corners(std::span<const outward_face> faces,
                                                 double height) {
    mesh soup;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        soup.points.insert(soup.points.end(), faces[f].at.begin(), faces[f].at.end());
        soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    soup = join_equal_points(soup);
    const base::stars around(soup.points.size(), soup.faces);
    std::vector<std::array<point3, 3>> moved(faces.size());
    std::vector<point3> normals;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            normals.clear();
            point3 sum{0, 0, 0};
            for (const std::uint32_t g : around[soup.faces[f][k]])
                if (faces[g].source.operand == faces[f].source.operand &&
                    dot(faces[f].normal, faces[g].normal) >= least_cosine) {
                    normals.push_back(faces[g].normal);
                    sum = plus(sum, normals.back());
                }
            double least = dot(sum, faces[f].normal);  // how high a step of `sum` is, over all
            for (const point3& normal : normals) least = std::min(least, dot(sum, normal));
            // Where faces wind around a tip, no step is over all: the face goes by itself.
            const bool is_tip = !(least >= 0.5 * static_cast<double>(normals.size()));
            moved[f][k] = plus(faces[f].at[k], is_tip ? scaled(faces[f].normal, height)
                                                      : scaled(sum, height / least));
        }
    return moved;
}

/// A little more than half as far on each side, so that rounding keeps none apart.
tree<3> tree_of_near(std::span<const outward_face> faces, double width) {
    return build(faces, [&](const outward_face& f) {
        aabb<double, 3> box;
        for (const point3& p : f.at) box.include(p);
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] -= 0.75 * width;
            box.max[k] += 0.75 * width;
        }
        return box;
    });
}

}  // namespace

void require_union(const char* function, const boolean_expression& expression) {
    std::vector<std::uint8_t> is_there(expression.operand_count(), 0);
    bool is_union = true;
    for (const std::int32_t token : expression.postfix())
        if (token >= 0)
            is_there[static_cast<std::size_t>(token)] = 1;
        else
            is_union = is_union && token == boolean_expression::add;
    if (!is_union || std::ranges::count(is_there, 0) > 0)
        throw std::invalid_argument("treeform::" + std::string(function) +
                                    ": only a union of all operands can fill gaps");
}

filled_gaps::filled_gaps(std::span<const mesh_view> operands, double width)
    : given_(operands.begin(), operands.end()) {
    const std::vector<outward_face> faces = outward_faces(operands);
    if (faces.empty()) return;
    const tree<3> near = tree_of_near(faces, width);
    const std::vector<id_pair> opposite = search_self_all(
        near,
        [&](std::uint32_t a, std::uint32_t b) { return are_opposite(faces[a], faces[b], width); });
    std::vector<std::uint32_t> prism_of(faces.size(), no_prism);
    for (const auto& [a, b] : opposite)
        if (is_just_above(faces[a], faces[b], width) || is_just_above(faces[b], faces[a], width))
            prism_of[a] = prism_of[b] = 0;
    std::vector<outward_face> bases;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (prism_of[f] == no_prism) continue;
        prism_of[f] = static_cast<std::uint32_t>(bases.size());
        bases.push_back(faces[f]);
        bases_.push_back(faces[f].source);
    }
    const auto tops = moved_corners(bases, width * (1.0 + 0x1p-10));
    for (std::size_t i = 0; i < bases.size(); ++i) add_prism(bases[i].at, tops[i]);
    for (const auto& [a, b] : opposite)
        if (prism_of[a] != no_prism && prism_of[b] != no_prism)
            pairs_.emplace_back(prism_of[a], prism_of[b]);
}

void filled_gaps::add_prism(const std::array<point3, 3>& base, const std::array<point3, 3>& top) {
    points_.insert(points_.end(), base.begin(), base.end());
    points_.insert(points_.end(), top.begin(), top.end());
    faces_.insert(faces_.end(), {{0, 2, 1}, {3, 4, 5}});
    for (std::uint32_t u = 0; u < 3; ++u) {
        const std::uint32_t v = (u + 1) % 3;
        // From the lesser corner up: as the face on the other side of the edge does.
        if (lexicographically_less(base[u], base[v]))
            faces_.insert(faces_.end(), {{u, v, v + 3}, {u, v + 3, u + 3}});
        else
            faces_.insert(faces_.end(), {{u, v, u + 3}, {v, v + 3, u + 3}});
    }
}

std::vector<mesh_view> filled_gaps::operands() const {
    std::vector<mesh_view> all = given_;
    for (std::size_t i = 0; i < size(); ++i)
        all.push_back({std::span(points_).subspan(prism_points * i, prism_points),
                       std::span(faces_).subspan(prism_faces * i, prism_faces)});
    return all;
}

boolean_expression filled_gaps::expression() const {
    std::string formula;
    for (std::size_t k = 0; k < given_.size(); ++k)
        formula += (k == 0 ? "" : "+") + base::operand_name(k);
    for (const auto& [a, b] : pairs_)
        formula += "+" + base::operand_name(given_.size() + a) + "*" +
                   base::operand_name(given_.size() + b);
    return {formula, given_.size() + size()};
}

std::vector<std::uint32_t> filled_gaps::face_groups(std::span<const std::uint32_t> given) const {
    std::vector<std::uint32_t> groups(given.begin(), given.end());
    if (groups.empty()) return groups;
    std::vector<std::size_t> first{0};  // face of each operand
    for (const mesh_view& operand : given_) first.push_back(first.back() + operand.faces.size());
    if (given.size() != first.back())
        throw std::invalid_argument("treeform::boolean: not as many face groups as faces");
    for (const auto& [operand, index] : bases_)
        groups.insert(groups.end(), prism_faces, given[first[operand] + index]);
    return groups;
}

void filled_gaps::name_sources(boolean_result& result) const {
    const auto is_of_prism = [&](const operand_element& e) {
        return e.operand != operand_element::none && e.operand >= given_.size();
    };
    const auto base_of = [&](const operand_element& e) {
        return bases_[e.operand - given_.size()];
    };
    for (auto* faces : {&result.face_source, &result.face_of_cut_vertex})
        for (operand_element& e : *faces)
            if (is_of_prism(e)) e = base_of(e);
    for (std::size_t p = 0; p < result.vertex_source.size(); ++p) {
        operand_element& e = result.vertex_source[p];
        if (!is_of_prism(e)) continue;
        if (!result.face_of_cut_vertex.empty()) result.face_of_cut_vertex[p] = base_of(e);
        e = {};
    }
}

}  // namespace treeform::detail::boolean
