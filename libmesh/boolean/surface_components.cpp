#include <libmesh/arrange/cells_of.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/arrange/perturbed_ray.hpp>
#include <libmesh/arrange/winding_beside.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/intersect/pairs_by_tree.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::uint32_t no_component = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t components_a_chunk = 16;
/// Components with more than a pair of their faces meeting for so many faces are not cut on their
/// own to know their range: they will be cut once more.
constexpr std::size_t most_pairs_of_faces = 4;
constexpr std::size_t most_unusual_boxes = 64;
constexpr double infinite = std::numeric_limits<double>::infinity();

using box3 = aabb<double, 3>;

ray<double, 3> ray_from(const point3& p, int along) {
    ray<double, 3> result{{p.x, p.y, p.z}, {}};
    result.direction[static_cast<std::size_t>(along)] = 1.0;
    return result;
}

/// The axis along which it is the least way from q out of a box.
int shortest_way_out(const box3& box, const point3& q) {
    std::size_t best = 0;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
        if (box.max[k] - q[k] < box.max[best] - q[best]) best = k;
    return static_cast<int>(best);
}

bool contains(const box3& box, const point3& q) {
    for (std::size_t k = 0; k < 3; ++k)
        if (q[k] < box.min[k] || q[k] > box.max[k]) return false;
    return true;
}

/// The range of a closed surface that has q on one side of all its faces. Any line through q meets
/// it as often as it winds around q, on either half: so that many faces, and no fewer than none,
/// are ahead of a point on the way out, all turned alike. None where q is in the plane of a face
/// with an area, or faces are turned both ways.
template <class Corners>
std::optional<winding_range> range_seen_from(const point3& q, std::size_t count,
                                             const Corners& corners) {
    const arrange::perturbed_ray ray = arrange::ray_beside(q, 0);
    int common = 0;
    std::int64_t winding = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const triangle3 t = corners(i);
        const int side = orient3d(t[0], t[1], t[2], q);
        if (side == 0) {
            if (collinear(t[0], t[1], t[2])) continue;
            return std::nullopt;
        }
        if (side == -common) return std::nullopt;
        common = side;
        const auto [low_y, high_y] = std::minmax({t[0].y, t[1].y, t[2].y});
        const auto [low_z, high_z] = std::minmax({t[0].z, t[1].z, t[2].z});
        if (q.y < low_y || q.y > high_y || q.z < low_z || q.z > high_z) continue;
        if (const auto met = ray.meet(t)) winding += met->faces;
    }
    return winding_range{std::min<std::int64_t>(winding, 0), std::max<std::int64_t>(winding, 0)};
}

/// The sign of the volume of a closed surface, or 0 where rounding may have decided it.
///
/// Of each of the F determinants, the differences are off by 2^-53 of themselves, products and sums
/// by as much, all of them together by less than 2^-49 of the same sum with all signs plus; adding
/// determinants up is off by F 2^-53 times the sum of these.
template <class Corners>
int sign_of(std::size_t count, const Corners& corners) {
    const point3 origin = count > 0 ? corners(0)[0] : point3{};
    struct sums {
        double volume = 0.0, size = 0.0;
    };
    std::vector<sums> parts(chunk_count(count, light_grain));
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t part) {
        sums sum;
        for (std::size_t i = begin; i < end; ++i) {
            const triangle3 t = corners(i);
            const point3 a = base::minus(t[0], origin), b = base::minus(t[1], origin);
            const point3 c = base::minus(t[2], origin);
            sum.volume += base::dot(a, base::cross(b, c));
            const auto length = [](const point3& p) {
                return std::abs(p.x) + std::abs(p.y) + std::abs(p.z);
            };
            sum.size += length(a) * length(b) * length(c);
        }
        parts[part] = sum;
    });
    double volume = 0.0, size = 0.0;
    for (const sums& sum : parts) {
        volume += sum.volume;
        size += sum.size;
    }
    const double off = size * (0x1p-48 + static_cast<double>(count) * 0x1p-52);
    if (!(off < infinite)) return 0;
    return volume > off ? 1 : volume < -off ? -1 : 0;
}

/// The windings of faces that are cut along each other. A cell is around what its boundary is
/// around, and so in the box of the faces that its boundary is of.
///
/// \param usual the range of all cells but few
component_windings windings_of_cells(points_view points, std::vector<face> faces,
                                     const winding_range& usual) {
    std::vector<std::uint32_t> used;
    for (const face& f : faces) used.insert(used.end(), f.begin(), f.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    treeform::mesh local;
    for (const std::uint32_t p : used) local.points.push_back(points[p]);
    for (face& f : faces)
        for (std::uint32_t& p : f)
            p = static_cast<std::uint32_t>(std::ranges::lower_bound(used, p) - used.begin());
    local.faces = std::move(faces);
    const mesh_arrangement cut = arrange_faces(local).cut;
    const std::vector<std::uint32_t> one_operand(local.faces.size(), 0);
    const arrangement_cells cells = arrange::cells_of(local, cut, one_operand, 1);
    if (cells.winding.empty()) return {};
    const auto [low, high] = std::ranges::minmax(cells.winding);
    component_windings result(winding_range{low, high});
    if (low >= usual.low && high <= usual.high) return result;
    std::vector<box3> box_of(cells.winding.size());
    const auto box_of_face = base::face_boxes(local.points);
    std::size_t unusual = 0;
    for (std::size_t f = 0; f < cut.faces.size(); ++f)
        for (const std::uint32_t cell : cells.cell_of_side[f]) {
            const std::int32_t winding = cells.winding[cell];
            if (winding >= usual.low && winding <= usual.high) continue;
            if (box_of[cell].empty()) ++unusual;
            box_of[cell].include(box_of_face(local.faces[cut.covers_of(f).front().face]));
        }
    if (unusual > most_unusual_boxes) return result;
    result.usual = usual;
    for (const box3& box : box_of)
        if (!box.empty()) result.unusual.push_back(box);
    return result;
}

}  // namespace

surface_components::surface_components(mesh_view joined,
                                       std::span<const std::uint32_t> operand_of_face,
                                       const operand_edges& edges)
    : mesh_(joined) {
    collect(operand_of_face, edges);
    // The range of an operand's only component says nothing that its winding numbers, where they
    // are known, do not.
    const std::size_t operands = operand_of_face.empty() ? 0 : operand_of_face.back() + 1;
    std::vector<std::uint32_t> components_of(operands, 0);
    for (const component& c : components_) ++components_of[c.operand];
    for_chunks(components_.size(), components_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t i = begin; i < end; ++i)
                       prepare(components_[i], components_of[components_[i].operand] > 1);
               });
    boxes_ = build(components_, [](const component& c) { return c.box; });
    for (const component& c : components_) box_.include(c.box);
}

void surface_components::collect(std::span<const std::uint32_t> operand_of_face,
                                 const operand_edges& edges) {
    const std::size_t pieces = edges.piece.count();
    std::vector<std::uint8_t> is_unbalanced(pieces, 0);
    for (const unbalanced_edge& e : edges.unbalanced) is_unbalanced[edges.piece[e.face]] = 1;
    std::vector<std::uint32_t> component_of(pieces);
    std::uint32_t open_operand = no_component;  // pieces ascend by operand
    std::uint32_t open_component = no_component;
    for (std::size_t p = 0; p < pieces; ++p) {
        const std::uint32_t operand = operand_of_face[edges.piece.lowest[p]];
        if (is_unbalanced[p] != 0 && open_operand == operand) {
            component_of[p] = open_component;
            continue;
        }
        component_of[p] = static_cast<std::uint32_t>(components_.size());
        components_.push_back({.operand = operand, .is_manifold = edges.is_manifold[p] != 0});
        if (is_unbalanced[p] == 0) continue;
        open_operand = operand;
        open_component = component_of[p];
    }
    const std::size_t count = mesh_.faces.size();
    for (std::size_t f = 0; f < count; ++f) ++components_[component_of[edges.piece[f]]].end;
    std::size_t total = 0;
    for (component& c : components_) {
        const std::size_t faces = c.end;
        c.begin = c.end = total;
        total += faces;
    }
    faces_.resize(count);
    for (std::size_t f = 0; f < count; ++f)
        faces_[components_[component_of[edges.piece[f]]].end++] = static_cast<std::uint32_t>(f);
}

triangle3 surface_components::corners(std::uint32_t f) const {
    const auto& [a, b, c] = mesh_.faces[f];
    return {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
}

void surface_components::prepare(component& c, bool with_range) const {
    const std::span own(faces_.data() + c.begin, c.end - c.begin);
    const auto box_of = base::face_boxes(mesh_.points);
    for (const std::uint32_t f : own) c.box.include(box_of(mesh_.faces[f]));
    c.index = build(own, [&](std::uint32_t f) { return box_of(mesh_.faces[f]); });
    if (with_range) c.windings = windings_of(c);
}

component_windings surface_components::windings_of(const component& c) const {
    const std::uint32_t* const own = faces_.data() + c.begin;
    const std::size_t count = c.end - c.begin;
    const auto corners_of = [&](std::size_t i) { return corners(own[i]); };
    point3 middle, mean;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = 0.5 * c.box.min[k] + 0.5 * c.box.max[k];
    for (std::size_t i = 0; i < count; ++i) mean = base::plus(mean, corners_of(i)[0]);
    mean = base::scaled(mean, 1.0 / static_cast<double>(count));
    for (const point3& q : {middle, mean})
        if (const auto range = range_seen_from(q, count, corners_of))
            return component_windings(*range);
    std::vector<face> faces(count);
    for (std::size_t i = 0; i < count; ++i) faces[i] = mesh_.faces[own[i]];
    const face_pair_result met = intersect::pairs_by_tree({mesh_.points, faces}, c.index,
                                                          {.vertices = vertex_identity::by_index});
    const int sign = sign_of(count, corners_of);
    const winding_range by_sign{sign < 0 ? -1 : 0, sign > 0 ? 1 : 0};
    // What edges link is on the boundary of one region on each of its sides, and the outer one has
    // winding number 0.
    if (met.pairs.empty() && c.is_manifold && sign != 0) return component_windings(by_sign);
    if (most_pairs_of_faces * met.pairs.size() > count) return {};
    return windings_of_cells(mesh_.points, std::move(faces), by_sign);
}

std::int64_t surface_components::winding_around(std::size_t c, const point3& q) const {
    const component& of = components_[c];
    if (!contains(of.box, q)) return 0;
    const int along = shortest_way_out(of.box, q);
    const arrange::perturbed_ray ray = arrange::ray_beside(q, along);
    const std::uint32_t* const own = faces_.data() + of.begin;
    std::int64_t winding = 0;
    visit_ray(of.index, ray_from(q, along), [&](std::uint32_t i) {
        if (const auto met = ray.meet(corners(own[i]))) winding += met->faces;
        return infinite;
    });
    return winding;
}

std::int64_t surface_components::winding_of_others(std::size_t c, const point3& q) const {
    box3 at;
    at.include(q);
    std::int64_t winding = 0;
    visit_overlapping(at, [&](std::uint32_t other) {
        if (other != c) winding += winding_around(other, q);
    });
    return winding;
}

int sign_of_volume(mesh_view closed) {
    return sign_of(closed.faces.size(), [&](std::size_t i) {
        return base::triangle_of(closed, static_cast<std::uint32_t>(i));
    });
}

int surface_components::sign_of_volume(std::size_t c) const {
    return sign_of(faces(c).size(), [&](std::size_t i) { return corners(faces(c)[i]); });
}

std::vector<operand_winding> surface_components::windings_beside(const arrange::corner_line& line,
                                                                 bool ahead) const {
    const box3 way = arrange::way_along(line, ahead);
    std::vector<operand_winding> found;
    search(boxes_, way, [&](std::uint32_t c) {
        const component& of = components_[c];
        const std::uint32_t* const own = faces_.data() + of.begin;
        const std::int64_t winding = arrange::winding_beside(
            of.index, [&](std::uint32_t i) { return corners(own[i]); }, line, way, ahead);
        if (winding != 0) found.push_back({of.operand, winding});
    });
    std::ranges::sort(found, {}, &operand_winding::operand);
    std::size_t left = 0;
    for (const operand_winding& w : found) {
        if (left > 0 && found[left - 1].operand == w.operand)
            found[left - 1].winding += w.winding;
        else
            found[left++] = w;
    }
    found.resize(left);
    return found;
}

}  // namespace treeform::detail::boolean
