#include <libmesh/arrange/patch_regions.hpp>
#include <libmesh/arrange/patches.hpp>
#include <libmesh/arrange/perturbed_ray.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/boolean/active_cells.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace treeform::detail::boolean {
namespace {

using box3 = aabb<double, 3>;
using arrange::surface_patches;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t seeds_a_chunk = 64;

/// A box around point p of an arrangement.
box3 box_of(const mesh_arrangement& cut, std::uint32_t p) {
    box3 box;
    if (p < cut.given_points.size()) {
        box.include(cut.given_points[p]);
        return box;
    }
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const implicit_point& point = cut.constructed[p - cut.given_points.size()];
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] = std::nextafter(point.center()[k] - point.radius(), -infinite);
        box.max[k] = std::nextafter(point.center()[k] + point.radius(), infinite);
    }
    return box;
}

/// Where the faces of an arrangement are.
struct face_places {
    std::vector<std::uint8_t> is_within;  ///< [F'] all of it is in active space
    std::vector<std::uint8_t> is_hidden;  ///< [F'] a corner is not
};

face_places find_places(const mesh_arrangement& cut, const active_space& space) {
    face_places places;
    places.is_within.resize(cut.faces.size(), 0);
    places.is_hidden.resize(cut.faces.size(), 0);
    for_chunks(cut.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f) {
            std::array<box3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) corner[k] = box_of(cut, cut.faces[f][k]);
            if (space.is_within_active(corner))
                places.is_within[f] = 1;
            else
                for (const box3& box : corner)
                    if (!space.reaches_active(box)) places.is_hidden[f] = 1;
        }
    });
    return places;
}

surface_patches find_active_patches(const mesh_arrangement& cut,
                                    std::span<const std::uint32_t> operand_of_face,
                                    const active_space& space, const face_places& places) {
    const auto judge = [&](const std::array<std::uint32_t, 2>& points,
                           std::span<const arrange::face_side> sides) {
        const auto within = std::ranges::count_if(sides, [&](arrange::face_side side) {
            return places.is_within[arrange::face_of(side)] != 0;
        });
        if (within == std::ssize(sides)) return arrange::edge_use::all;
        const std::array<box3, 2> ends = {box_of(cut, points[0]), box_of(cut, points[1])};
        if (within == 0 && !space.is_within_active(ends)) return arrange::edge_use::nothing;
        return arrange::edge_use::junction;
    };
    surface_patches patches = arrange::find_patches(cut, operand_of_face, judge);
    if (patches.open_count > 0)
        throw std::logic_error("treeform::boolean: faces are missing at the edge between points " +
                               std::to_string(patches.open[0].points[0]) + " and " +
                               std::to_string(patches.open[0].points[1]));
    return patches;
}

/// Where a line meets a face of an arrangement within.
struct pierced_face {
    arrange::perturbed_ray ray;
    arrange::crossing at;
};

/// A line through a face of the arrangement, along the axis that it faces most if that will do.
std::optional<pierced_face> find_line(mesh_view mesh, const mesh_arrangement& cut, std::size_t f) {
    const triangle3 whole = base::triangle_of(mesh, cut.covers_of(f).front().face);
    const point3 normal =
        base::cross(base::minus(whole[1], whole[0]), base::minus(whole[2], whole[0]));
    std::array<int, 3> axes = {0, 1, 2};
    const auto size = [&](int k) { return std::abs(normal[static_cast<std::size_t>(k)]); };
    std::ranges::stable_sort(axes, [&](int i, int j) { return size(i) > size(j); });
    const auto& [a, b, c] = cut.faces[f];
    const implicit_point p = cut.point(a), q = cut.point(b), r = cut.point(c);
    constexpr std::array<std::array<double, 3>, 4> shares = {
        {{1 / 3.0, 1 / 3.0, 1 / 3.0}, {0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}}};
    for (const int axis : axes)
        for (const auto& share : shares) {
            point3 from;
            for (std::size_t k = 0; k < 3; ++k)
                from[k] =
                    share[0] * p.center()[k] + share[1] * q.center()[k] + share[2] * r.center()[k];
            if (!base::is_finite(from)) continue;
            const arrange::perturbed_ray ray = arrange::ray_beside(from, axis);
            if (ray.passes(p, q, r) == 0) continue;
            if (const auto at = ray.cross(whole)) return pierced_face{ray, *at};
        }
    return std::nullopt;
}

/// Regions between patches, as far as edges tell, and the patches at each.
class region_graph {
  public:
    region_graph(mesh_view mesh, const mesh_arrangement& cut, const surface_patches& patches,
                 std::span<const std::uint8_t> conduct)
        : patches_(patches) {
        arrange::patch_regions joined(patches);
        joined.join_about_edges(mesh, cut, conduct);
        region_ = joined.number();
        begin_.resize(region_.count() + 1, 0);
        patches_at_.resize(2 * std::size_t{patches.count()});
        for (std::uint32_t p = 0; p < patches.count(); ++p) {
            ++begin_[front(p)];
            ++begin_[behind(p)];
        }
        std::size_t total = 0;
        for (std::size_t& begin : begin_) begin = total += begin;
        for (std::uint32_t p = patches.count(); p-- > 0;) {
            patches_at_[--begin_[front(p)]] = p;
            patches_at_[--begin_[behind(p)]] = p;
        }
    }

    [[nodiscard]] std::size_t size() const { return region_.count(); }
    [[nodiscard]] std::uint32_t front(std::uint32_t p) const {
        return region_[2 * std::size_t{p} + 1];
    }
    [[nodiscard]] std::uint32_t behind(std::uint32_t p) const {
        return region_[2 * std::size_t{p} + 2];
    }
    [[nodiscard]] std::uint32_t beyond(std::uint32_t p, std::uint32_t region) const {
        return front(p) == region ? behind(p) : front(p);
    }
    [[nodiscard]] std::span<const std::uint32_t> patches_at(std::uint32_t region) const {
        return {patches_at_.data() + begin_[region], begin_[region + 1] - begin_[region]};
    }

    /// [R] the lowest of the regions that patches link with each.
    [[nodiscard]] buffer<std::uint32_t> groups() const {
        base::union_find linked(size());
        for (std::uint32_t p = 0; p < patches_.count(); ++p) linked.join(front(p), behind(p));
        return linked.take_roots();
    }

  private:
    const surface_patches& patches_;
    arrange::numbered_sets region_{};
    std::vector<std::size_t> begin_{};         ///< where the patches of each region begin
    std::vector<std::uint32_t> patches_at_{};  ///< region by region
};

/// A region about which a line has told how often operands wind around it.
struct seed {
    std::uint32_t region = 0;
    std::vector<operand_winding> windings{};
};

class finder {
  public:
    finder(mesh_view mesh, const mesh_arrangement& cut,
           std::span<const std::uint32_t> operand_of_face, const surface_components& components,
           const active_space& space, const partial_expression& at_nowhere)
        : mesh_(mesh),
          cut_(cut),
          operand_of_face_(operand_of_face),
          components_(components),
          at_nowhere_(at_nowhere),
          places_(find_places(cut, space)),
          patches_(find_active_patches(cut, operand_of_face, space, places_)),
          regions_(mesh, cut, patches_, places_.is_within),
          is_hidden_(patches_.count(), 0),
          inside_(regions_.size(), 0) {
        for (std::size_t f = 0; f < cut.faces.size(); ++f)
            if (places_.is_hidden[f] != 0) is_hidden_[patches_.patch[f]] = 1;
    }

    std::optional<active_cells> run() {
        const auto seeds = find_seeds();
        if (!seeds) return std::nullopt;
        std::vector<std::uint8_t> seen(regions_.size(), 0);
        for_chunks(seeds->size(), seeds_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       partial_expression state = at_nowhere_;
                       for (std::size_t i = begin; i < end; ++i) spread((*seeds)[i], state, seen);
                   });
        active_cells result;
        result.cells.cell_of_side.resize(cut_.faces.size(), {0, 0});
        for (std::size_t f = 0; f < cut_.faces.size(); ++f)
            if (const std::uint32_t p = patches_.patch[f]; is_hidden_[p] == 0)
                result.cells.cell_of_side[f] = {regions_.front(p), regions_.behind(p)};
        result.inside = std::move(inside_);
        return result;
    }

  private:
    /// One for each group of regions with a patch that is not hidden.
    [[nodiscard]] std::optional<std::vector<seed>> find_seeds() const {
        const buffer<std::uint32_t> group = regions_.groups();
        std::vector<std::uint32_t> asked;  // the first face of each group
        std::vector<std::uint8_t> is_asked(regions_.size(), 0);
        for (std::uint32_t f = 0; f < cut_.faces.size(); ++f) {
            const std::uint32_t p = patches_.patch[f];
            if (is_hidden_[p] != 0 || is_asked[group[regions_.front(p)]] != 0) continue;
            is_asked[group[regions_.front(p)]] = 1;
            asked.push_back(f);
        }
        std::vector<std::optional<seed>> found(asked.size());
        for_chunks(asked.size(), seeds_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i) {
                           found[i] = ask(asked[i]);
                           if (!found[i]) found[i] = ask_another(group, asked[i]);
                       }
                   });
        std::vector<seed> seeds;
        for (std::optional<seed>& s : found) {
            if (!s) return std::nullopt;
            seeds.push_back(std::move(*s));
        }
        return seeds;
    }

    [[nodiscard]] std::optional<seed> ask(std::uint32_t f) const {
        const auto line = find_line(mesh_, cut_, f);
        if (!line) return std::nullopt;
        const std::uint32_t p = patches_.patch[f];
        return seed{line->at.faces > 0 ? regions_.front(p) : regions_.behind(p),
                    components_.windings_ahead(line->ray, line->at)};
    }

    /// Asks of the faces behind f in its group.
    [[nodiscard]] std::optional<seed> ask_another(const buffer<std::uint32_t>& group,
                                                  std::uint32_t f) const {
        const std::uint32_t own = group[regions_.front(patches_.patch[f])];
        for (std::uint32_t g = f + 1; g < cut_.faces.size(); ++g)
            if (const std::uint32_t p = patches_.patch[g];
                is_hidden_[p] == 0 && group[regions_.front(p)] == own)
                if (auto found = ask(g)) return found;
        return std::nullopt;
    }

    /// Adds what crossing patch p changes on the way out of a region, or takes it back.
    void cross(std::uint32_t p, std::uint32_t from, partial_expression& state) const {
        const int way = regions_.front(p) == from ? 1 : -1;
        for (const covering_face& cover : cut_.covers_of(patches_.first_face(p)))
            state.add(operand_of_face_[cover.face],
                      winding_range::only(cover.opposite ? -way : way));
    }

    /// Goes from region to region across patches, and back the same way.
    void spread(const seed& from, partial_expression& state, std::vector<std::uint8_t>& seen) {
        struct step {
            std::uint32_t region;
            std::uint32_t patch;  ///< across which it was entered
            std::size_t next;     ///< of its patches
        };
        const auto enter = [&](std::uint32_t region) {
            seen[region] = 1;
            inside_[region] = *state.value() ? 1 : 0;
        };
        for (const auto& [operand, winding] : from.windings)
            state.add(operand, winding_range::only(winding));
        std::vector<step> way{{from.region, none, 0}};
        enter(from.region);
        while (!way.empty()) {
            const std::uint32_t region = way.back().region;
            const auto patches = regions_.patches_at(region);
            if (way.back().next < patches.size()) {
                const std::uint32_t p = patches[way.back().next++];
                const std::uint32_t next = regions_.beyond(p, region);
                if (seen[next] != 0) continue;
                cross(p, region, state);
                enter(next);
                way.push_back({next, p, 0});
            } else {
                const std::uint32_t entered = way.back().patch;
                way.pop_back();
                if (entered != none) cross(entered, region, state);
            }
        }
        for (const auto& [operand, winding] : from.windings)
            state.add(operand, winding_range::only(-winding));
    }

    mesh_view mesh_;
    const mesh_arrangement& cut_;
    std::span<const std::uint32_t> operand_of_face_;
    const surface_components& components_;
    const partial_expression& at_nowhere_;
    face_places places_;
    surface_patches patches_;
    region_graph regions_;
    std::vector<std::uint8_t> is_hidden_;  ///< by patch
    std::vector<std::uint8_t> inside_;     ///< by region
};

}  // namespace

std::optional<active_cells> find_active_cells(mesh_view mesh, const mesh_arrangement& cut,
                                              std::span<const std::uint32_t> operand_of_face,
                                              const surface_components& components,
                                              const active_space& space,
                                              const partial_expression& at_nowhere) {
    return finder(mesh, cut, operand_of_face, components, space, at_nowhere).run();
}

}  // namespace treeform::detail::boolean
