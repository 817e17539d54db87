#include <libmesh/arrange/corner_line.hpp>
#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/active_cells.hpp>
#include <libmesh/boolean/region_graph.hpp>
#include <libmesh/boolean/way_out.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using box3 = aabb<double, 3>;
using arrange::surface_patches;

constexpr std::size_t seeds_a_chunk = 64;

/// A box around point p of an arrangement.
box3 box_of(const mesh_arrangement& cut, std::uint32_t p) {
    if (p >= cut.given_points.size())
        return arrange::box_around(cut.constructed[p - cut.given_points.size()]);
    box3 box;
    box.include(cut.given_points[p]);
    return box;
}

/// Where the faces of an arrangement are.
struct face_places {
    std::vector<std::uint8_t> is_within;  ///< [F'] all of it is in active space
    std::vector<std::uint8_t> is_hidden;  ///< [F'] a corner is not
};

/// Which points of an arrangement are in active space; each is found out where it is first asked
/// for, by two threads at once, if need be.
class point_places {
  public:
    point_places(const mesh_arrangement& cut, const active_space& space)
        : cut_(cut), space_(space), known_(cut.given_points.size() + cut.constructed.size(), 0) {}

    [[nodiscard]] bool is_active(std::uint32_t p) {
        constexpr std::uint8_t hidden = 1, active = 2;
        const std::atomic_ref known(known_[p]);
        std::uint8_t place = known.load(std::memory_order_relaxed);
        if (place == 0) {
            place = space_.reaches_active(box_of(cut_, p)) ? active : hidden;
            known.store(place, std::memory_order_relaxed);
        }
        return place == active;
    }

  private:
    const mesh_arrangement& cut_;
    const active_space& space_;
    std::vector<std::uint8_t> known_;
};

face_places find_places(const mesh_arrangement& cut, const active_space& space,
                        point_places& points) {
    face_places places;
    places.is_within.resize(cut.faces.size(), 0);
    places.is_hidden.resize(cut.faces.size(), 0);
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            const face& corners = cut.faces[f];
            const bool hidden =
                !std::ranges::all_of(corners, [&](std::uint32_t p) { return points.is_active(p); });
            places.is_hidden[f] = hidden ? 1 : 0;
            if (hidden) continue;
            std::array<box3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) corner[k] = box_of(cut, corners[k]);
            places.is_within[f] = space.is_within_active(corner) ? 1 : 0;
        }
    });
    return places;
}

surface_patches find_active_patches(const mesh_arrangement& cut,
                                    std::span<const std::uint32_t> operand_of_face,
                                    const active_space& space, const face_places& places,
                                    point_places& at) {
    const auto judge = [&](const std::array<std::uint32_t, 2>& points,
                           std::span<const arrange::face_side> sides) {
        const auto within = std::ranges::count_if(sides, [&](arrange::face_side side) {
            return places.is_within[arrange::face_of(side)] != 0;
        });
        if (within == std::ssize(sides)) return arrange::edge_use::all;
        if (within > 0) return arrange::edge_use::junction;
        if (!at.is_active(points[0]) || !at.is_active(points[1])) return arrange::edge_use::nothing;
        const std::array<box3, 2> ends = {box_of(cut, points[0]), box_of(cut, points[1])};
        return space.is_within_active(ends) ? arrange::edge_use::junction
                                            : arrange::edge_use::nothing;
    };
    return arrange::find_closed_patches(cut, operand_of_face, judge);
}

arrange::numbered_sets find_regions(mesh_view mesh, const mesh_arrangement& cut,
                                    const surface_patches& patches,
                                    std::span<const std::uint8_t> conduct) {
    arrange::patch_regions joined(patches);
    joined.join_about_edges(mesh, cut, conduct);
    return joined.number();
}

class cell_finder {
  public:
    cell_finder(mesh_view mesh, const mesh_arrangement& cut,
                std::span<const std::uint32_t> operand_of_face,
                const surface_components& components, const active_space& space,
                const partial_expression& at_nowhere)
        : mesh_(mesh),
          cut_(cut),
          components_(components),
          at_nowhere_(at_nowhere),
          points_(cut, space),
          places_(find_places(cut, space, points_)),
          patches_(find_active_patches(cut, operand_of_face, space, places_, points_)),
          regions_(cut, operand_of_face, patches_,
                   find_regions(mesh, cut, patches_, places_.is_within)),
          is_hidden_(patches_.count(), 0) {
        for (std::size_t f = 0; f < cut.faces.size(); ++f)
            if (places_.is_hidden[f] != 0) is_hidden_[patches_.patch[f]] = 1;
    }

    active_cells run() {
        const std::vector<region_seed> seeds = find_seeds();
        active_cells result{{}, std::vector<std::uint8_t>(regions_.size(), 0)};
        for_chunks(seeds.size(), seeds_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       partial_expression state = at_nowhere_;
                       for (std::size_t i = begin; i < end; ++i)
                           regions_.spread(seeds[i], state, result.inside);
                   });
        result.cells.cell_of_side.resize(cut_.faces.size(), {0, 0});
        for (std::size_t f = 0; f < cut_.faces.size(); ++f)
            if (const std::uint32_t p = patches_.patch[f]; is_hidden_[p] == 0)
                result.cells.cell_of_side[f] = {regions_.patches().front(p),
                                                regions_.patches().behind(p)};
        return result;
    }

  private:
    /// One for each group of regions with a patch that is not hidden.
    [[nodiscard]] std::vector<region_seed> find_seeds() const {
        const buffer<std::uint32_t> group = regions_.groups();
        std::vector<std::uint32_t> asked;  // the first face of each group
        std::vector<std::uint8_t> is_asked(regions_.size(), 0);
        for (std::uint32_t f = 0; f < cut_.faces.size(); ++f) {
            const std::uint32_t p = patches_.patch[f];
            if (is_hidden_[p] != 0 || is_asked[group[regions_.patches().front(p)]] != 0) continue;
            is_asked[group[regions_.patches().front(p)]] = 1;
            asked.push_back(f);
        }
        std::vector<region_seed> seeds(asked.size());
        for_chunks(asked.size(), seeds_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i) seeds[i] = ask(asked[i]);
                   });
        return seeds;
    }

    [[nodiscard]] region_seed ask(std::uint32_t f) const {
        const way_out out = find_way_out(mesh_, cut_, f, components_.box());
        const std::uint32_t p = patches_.patch[f];
        const bool in_front = (out.line.faces() > 0) == out.ahead;
        return {in_front ? regions_.patches().front(p) : regions_.patches().behind(p),
                components_.windings_beside(out.line, out.ahead)};
    }

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    const surface_components& components_;
    const partial_expression& at_nowhere_;
    point_places points_;
    face_places places_;
    surface_patches patches_;
    region_graph regions_;
    std::vector<std::uint8_t> is_hidden_;  ///< by patch
};

}  // namespace

active_cells find_active_cells(mesh_view mesh, const mesh_arrangement& cut,
                               std::span<const std::uint32_t> operand_of_face,
                               const surface_components& components, const active_space& space,
                               const partial_expression& at_nowhere) {
    return cell_finder(mesh, cut, operand_of_face, components, space, at_nowhere).run();
}

}  // namespace treeform::detail::boolean
