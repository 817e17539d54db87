#include <libmesh/arrange/outer_edge.hpp>
#include <libmesh/arrange/parts.hpp>
#include <libmesh/arrange/perturbed_ray.hpp>
#include <libmesh/arrange/radial_order.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/tree.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace treeform::detail::arrange {
namespace {

constexpr std::size_t part_grain = 64;  // parts a chunk
constexpr double infinite = std::numeric_limits<double>::infinity();

using box3 = aabb<double, 3>;

ray<double, 3> ray_along_x(const point3& p) { return {{p.x, p.y, p.z}, {1, 0, 0}}; }

std::vector<outer_edge> find_outer_edges(mesh_view mesh, const mesh_arrangement& cut,
                                         const std::vector<part_extent>& extents) {
    std::vector<outer_edge> edges(extents.size());
    for_chunks(extents.size(), part_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        radial_order radial(mesh, cut);
        for (std::size_t i = begin; i < end; ++i)
            edges[i] = find_outer_edge(mesh, cut, extents[i], radial);
    });
    return edges;
}

/// The parts whose ray meets the box of another.
std::vector<std::uint32_t> parts_behind_others(const std::vector<part_extent>& extents,
                                               const std::vector<outer_edge>& edges) {
    const auto boxes = build(extents, [](const part_extent& e) { return e.box; });
    std::vector<unsigned char> behind(extents.size());
    for_chunks(extents.size(), part_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            behind[i] = any_hit(boxes, ray_along_x(edges[i].from),
                                [&](std::uint32_t other) { return other != i; });
    });
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < behind.size(); ++i)
        if (behind[i] != 0) found.push_back(static_cast<std::uint32_t>(i));
    return found;
}

/// For each input face, the faces of the arrangement it covers.
class pieces {
  public:
    pieces(std::size_t input_faces, const mesh_arrangement& cut)
        : begin_(input_faces + 1), faces_(cut.covers.size()) {
        for (const covering_face& cover : cut.covers) ++begin_[cover.face];
        std::size_t total = 0;
        for (std::size_t& begin : begin_) begin = total += begin;
        for (std::size_t f = cut.faces.size(); f-- > 0;)
            for (const covering_face& cover : cut.covers_of(f))
                faces_[--begin_[cover.face]] = static_cast<std::uint32_t>(f);
    }

    [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t input_face) const {
        return {faces_.data() + begin_[input_face], begin_[input_face + 1] - begin_[input_face]};
    }

  private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> faces_;
};

/// Follows rays to the first face they meet.
class ray_follower {
  public:
    ray_follower(mesh_view mesh, const mesh_arrangement& cut, const box3& reach)
        : mesh_(mesh), cut_(cut), pieces_(mesh.faces.size(), cut) {
        for (std::uint32_t g = 0; g < mesh.faces.size(); ++g)
            if (!pieces_[g].empty() && overlaps(box_of(g), reach)) ids_.push_back(g);
        tree_ = build(ids_, [this](std::uint32_t g) { return box_of(g); });
    }

    /// The side on which the moved ray from `edge` first meets a face. The edge's own part is
    /// behind it.
    [[nodiscard]] std::optional<face_side> follow(const outer_edge& edge) const {
        const perturbed_ray ray(edge.from, edge.toward);
        std::optional<crossing> first;
        std::uint32_t first_face = 0;
        double distance = infinite;
        visit_ray(tree_, ray_along_x(edge.from), [&](std::uint32_t id) {
            const std::uint32_t g = ids_[id];
            const auto met = ray.meet(corners(g));
            if (!met) return distance;
            if (first && ray.compare(*met, *first) >= 0) return distance;
            first = met;
            first_face = g;
            distance = ray.distance(*met);
            return distance;
        });
        if (!first) return std::nullopt;
        return met_side(ray, first_face);
    }

  private:
    [[nodiscard]] triangle3 corners(std::uint32_t g) const {
        const auto& [a, b, c] = mesh_.faces[g];
        return {mesh_.points[a], mesh_.points[b], mesh_.points[c]};
    }

    [[nodiscard]] box3 box_of(std::uint32_t g) const {
        box3 box;
        for (const point3& p : corners(g)) box.include(p);
        return box;
    }

    /// Of the pieces of an input face that the ray passes through, that with the crossing.
    [[nodiscard]] face_side met_side(const perturbed_ray& ray, std::uint32_t g) const {
        for (const std::uint32_t f : pieces_[g]) {
            const auto& [a, b, c] = cut_.faces[f];
            const int faces = passes(ray, a, b, c);
            if (faces != 0) return faces < 0 ? front_of(f) : behind(f);
        }
        throw std::logic_error("treeform::find_cells: the arrangement does not cover face " +
                               std::to_string(g));
    }

    [[nodiscard]] int passes(const perturbed_ray& ray, std::uint32_t a, std::uint32_t b,
                             std::uint32_t c) const {
        const auto& given = cut_.given_points;
        if (std::max({a, b, c}) < given.size()) return ray.passes(given[a], given[b], given[c]);
        return ray.passes(cut_.point(a), cut_.point(b), cut_.point(c));
    }

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    pieces pieces_;
    std::vector<std::uint32_t> ids_;  ///< input faces of the tree
    tree<3> tree_;
};

}  // namespace

std::vector<part_place> place_parts(mesh_view mesh, const mesh_arrangement& cut,
                                    const surface_patches& patches, const numbered_sets& parts) {
    const auto extents = find_extents(cut, patches, parts);
    const auto edges = find_outer_edges(mesh, cut, extents);
    std::vector<part_place> places(parts.count());
    for (std::size_t i = 0; i < places.size(); ++i) places[i].outer = edges[i].side;
    if (places.size() < 2) return places;
    const auto asking = parts_behind_others(extents, edges);
    if (asking.empty()) return places;

    box3 reach;
    for (const std::uint32_t i : asking) reach.include(edges[i].from);
    reach.max[0] = infinite;
    const ray_follower follower(mesh, cut, reach);
    for_chunks(asking.size(), part_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            places[asking[i]].beyond = follower.follow(edges[asking[i]]);
    });
    return places;
}

}  // namespace treeform::detail::arrange
