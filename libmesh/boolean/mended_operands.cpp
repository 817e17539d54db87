#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/mended_operands.hpp>
#include <libmesh/round/displacement.hpp>
#include <libmesh/round/mending_schedule.hpp>
#include <libmesh/round/snap_nearby.hpp>
#include <libmesh/round/snap_to_grid.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// Operands as joined, each with its own points, and the way back.
struct near_operands {
    std::vector<mesh> meshes;
    std::vector<std::vector<std::uint32_t>> face_of;   ///< [k][F] face of all operands as given
    std::vector<std::vector<std::uint32_t>> point_of;  ///< [k][V] point of all, or beyond them

    near_operands(const round::joined_near& near, const std::vector<std::uint32_t>& operand_of_face,
                  std::size_t operands)
        : meshes(operands), face_of(meshes.size()), point_of(meshes.size()) {
        constexpr std::uint32_t none = operand_element::none;
        std::vector<std::uint32_t> number(near.surface.points.size(), none);
        const auto& faces = near.surface.faces;
        for (std::size_t f = 0, end = 0; f < faces.size(); f = end) {
            const std::uint32_t k = operand_of_face[near.face_of[f]];
            for (; end < faces.size() && operand_of_face[near.face_of[end]] == k; ++end) {
                face local = faces[end];
                for (std::uint32_t& corner : local) {
                    const std::uint32_t p = corner;
                    if (number[p] == none) {
                        number[p] = static_cast<std::uint32_t>(point_of[k].size());
                        point_of[k].push_back(p);
                        meshes[k].points.push_back(near.surface.points[p]);
                    }
                    corner = number[p];
                }
                meshes[k].faces.push_back(local);
                face_of[k].push_back(near.face_of[end]);
            }
            for (const std::uint32_t p : point_of[k]) number[p] = none;
        }
    }
};

/// Faces of the operands whose boxes are next to a broken place.
std::vector<std::uint8_t> next_to(const std::vector<aabb<double, 3>>& broken, mesh_view all,
                                  double reach) {
    std::vector<std::uint8_t> marked(all.faces.size(), 0);
    const tree<3> tree = build_face_tree(all);
    for (aabb<double, 3> box : broken) {
        for (std::size_t k = 0; k < 3; ++k) {
            box.min[k] -= reach;
            box.max[k] += reach;
        }
        search(tree, box, [&](std::uint32_t f) { marked[f] = 1; });
    }
    return marked;
}

/// Of all corners, the largest coordinate there is, without its sign.
point3 largest_point(std::span<const mesh_view> operands) {
    double largest = 0.0;
    for (const mesh_view& operand : operands)
        for (const face& f : operand.faces)
            for (const std::uint32_t corner : f) {
                const double here = base::largest_of(operand.points[corner]);
                if (std::isfinite(here)) largest = std::max(largest, here);
            }
    return {largest, largest, largest};
}

/// A try of the operands after that of them as they are.
struct operand_try {
    int number = 0;  ///< from 1; each reaches further; 0: as they are
    bool grid = false;
    round_options::joining join = round_options::joining::never;  ///< of the surface
    bool surface_on_grids = true;
};

/// Of the operands as they are.
rounding_try first_try(std::span<const mesh_view> operands, const boolean_options& options,
                       const round::mending_schedule& schedule) {
    rounding_try how{options};
    how.rounding_steps = schedule.surface_steps;
    const bool to_float = options.precision == precision::float32;
    if (!to_float && !std::isfinite(options.max_displacement)) return how;
    const point3 largest = largest_point(operands);
    if (to_float) {
        const double grid = schedule.grid_of_surface({&largest, 1}, 0);
        how.join = round_options::joining::where_few_meet;
        how.grids = {grid};
        if (grid > options.max_displacement) how.rounding_steps = 0;
    } else if (schedule.reach_of_surface({&largest, 1}, 4) > options.max_displacement) {
        how.rounding_steps = 0;
    }
    return how;
}

/// The question once more, of operands joined where they are next to broken places.
class mending {
  public:
    /// \pre the operands have been checked
    mending(std::span<const mesh_view> operands, const boolean_options& options,
            const round::mending_schedule& schedule, const boolean_statistics& so_far,
            std::uint64_t meeting)
        : options_(options),
          schedule_(schedule),
          given_(join_operands(operands)),
          operand_of_face_(given_.operand_of_face()),
          pairs_given_(so_far.pairs),
          meeting_given_(meeting),
          rounds_(schedule.precision == precision::float32 ? so_far.rounding_steps : 0) {
        source_.resize(given_.all.faces.size());
        std::iota(source_.begin(), source_.end(), 0U);
    }

    /// How far steps reach.
    [[nodiscard]] double reach(int number) const {
        return number == 0 ? 0.0 : schedule_.reach_of_operands(given_.all.points, number);
    }

    /// None where far more faces meet than met.
    template <class Ask>
    std::optional<unmended_result> step(const operand_try& next,
                                        const std::vector<aabb<double, 3>>& broken,
                                        const Ask& ask) {
        const double reach = this->reach(next.number);
        const round::joined_near near = join(next_to(broken, given_.all, reach), reach, next.grid);
        const near_operands joined(near, operand_of_face_, given_.first_face.size() - 1);
        rounding_try how = rounding_of(next);
        using round::mending_schedule;
        const auto most = next.grid || options_.precision == precision::float32
                              ? mending_schedule::most_pairs(pairs_given_)
                              : mending_schedule::most_pairs_joined(pairs_given_);
        if (count_pairs(near.surface) > most) return std::nullopt;
        how.volumes = false;
        if (options_.progress) how.progress = [&](double) { return options_.progress(1.0); };
        std::vector<std::uint32_t> groups;
        if (!how.face_groups.empty()) {
            for (const auto& faces : joined.face_of)
                for (const std::uint32_t f : faces) groups.push_back(options_.face_groups[f]);
            how.face_groups = groups;
        }
        const std::vector<mesh_view> views(joined.meshes.begin(), joined.meshes.end());
        unmended_result made = ask(std::span<const mesh_view>(views), how);
        boolean_result& result = made.result;
        if (options_.precision == precision::float32 || made.on_grid)
            rounds_ += result.statistics.rounding_steps;
        if (std::isfinite(result.certificate.max_displacement))
            // No corner was joined further away than that, and those that are gone are measured no more.
            result.certificate.max_displacement =
                std::max(displacement(result, joined), std::min(near.moved, reach));
        for (operand_element& face : result.face_source) face = face_source(joined, face);
        for (operand_element& face : result.face_of_cut_vertex) face = face_source(joined, face);
        for (operand_element& point : result.vertex_source) point = point_source(joined, point);
        return made;
    }

  private:
    /// Grids for the surface, none of more rounds than are left.
    [[nodiscard]] rounding_try rounding_of(const operand_try& next) const {
        rounding_try how{options_};
        how.rounding_steps = schedule_.surface_steps;
        how.join = next.join;
        if (next.surface_on_grids) {
            how.grids = schedule_.grids_of_surface(given_.all.points, std::max(next.number, 1),
                                                   options_.max_displacement);
            if (how.grids.empty() && how.join == round_options::joining::never)
                how.rounding_steps = 0;
        }
        how.most_rounds =
            round::mending_schedule::rounds_of_try(round::mending_schedule::most_rounds - rounds_);
        how.most_meeting = round::mending_schedule::most_meeting(meeting_given_);
        return how;
    }

    /// How far the result of joined operands is from those given.
    [[nodiscard]] double displacement(const boolean_result& result,
                                      const near_operands& joined) const {
        std::vector<std::uint32_t> point_of;
        for (const auto& [operand, index] : result.vertex_source)
            point_of.push_back(operand == operand_element::none ? operand
                                                                : joined.point_of[operand][index]);
        return round::displacement(result.mesh.points, point_of, given_.all);
    }

    [[nodiscard]] std::uint64_t count_pairs(mesh_view mesh) const {
        progress_callback progress;
        if (options_.progress) progress = [&](double) { return options_.progress(1.0); };
        const auto found = self_intersections(
            mesh, {.vertices = vertex_identity::by_index, .limit = 0, .progress = progress});
        return std::accumulate(found.counts.begin(), found.counts.end(), std::uint64_t{0});
    }

    /// The operands with what is next to the faces marked, on a grid or not.
    [[nodiscard]] round::joined_near join(const std::vector<std::uint8_t>& marked, double reach,
                                          bool grid) const {
        round::joined_near near{given_.all, source_};
        if (reach == 0.0) return near;
        if (grid)
            near = round::snap_to_grid(given_.all, marked, {.step = reach, .of_operands = true});
        std::vector<std::uint8_t> still_marked;
        std::vector<std::uint32_t> operand;
        for (const std::uint32_t f : near.face_of) {
            still_marked.push_back(marked[f]);
            operand.push_back(operand_of_face_[f]);
        }
        round::joined_near last = round::snap_nearby(
            near.surface, still_marked,
            {.reach = reach, .source = near.face_of, .solid = false, .operand = operand});
        for (std::uint32_t& f : last.face_of) f = near.face_of[f];
        last.moved += near.moved;
        return last;
    }

    [[nodiscard]] operand_element face_source(const near_operands& joined,
                                              const operand_element& face) const {
        if (face.operand == operand_element::none) return face;
        return given_.face_source(joined.face_of[face.operand][face.index]);
    }
    [[nodiscard]] operand_element point_source(const near_operands& joined,
                                               const operand_element& point) const {
        if (point.operand == operand_element::none) return point;
        const std::uint32_t p = joined.point_of[point.operand][point.index];
        return p < given_.all.points.size() ? given_.point_source(p) : operand_element{};
    }

    const boolean_options& options_;
    const round::mending_schedule& schedule_;
    joined_operands given_;
    std::vector<std::uint32_t> operand_of_face_;
    std::vector<std::uint32_t> source_;
    std::uint64_t pairs_given_;    ///< of faces of the operands as they are
    std::uint64_t meeting_given_;  ///< of faces of the result of these
    int rounds_ = 0;               ///< of mending that were taken
};

/// The surface of `mended`, and what is certain about it, with the rest as it was said before.
void take_surface(boolean_result& result, boolean_result&& mended) {
    result.mesh = std::move(mended.mesh);
    result.face_source = std::move(mended.face_source);
    result.vertex_source = std::move(mended.vertex_source);
    result.face_of_cut_vertex = std::move(mended.face_of_cut_vertex);
    result.certificate = std::move(mended.certificate);
    result.vanished_components = mended.vanished_components;
    result.vanished_at = std::move(mended.vanished_at);
}

/// Certified, or else where fewer faces meet; of two that are, the one that moved less.
bool is_better(const certificate& now, const certificate& before) {
    if (now && before) return now.max_displacement < before.max_displacement;
    return !before && (now || now.meeting_count < before.meeting_count);
}

/// Grids come first where so many faces met at first that they were mended on one. For doubles,
/// what is near is joined first, in the operands and in the surface, as long as that may do.
std::vector<operand_try> tries_of(const round::mending_schedule& schedule, bool grid_first) {
    using enum round_options::joining;
    const bool to_float = schedule.precision == precision::float32;
    std::vector<operand_try> tries;
    const auto add = [&](const operand_try& next) {
        for (int step = 1; step <= schedule.operand_steps; ++step) {
            tries.push_back(next);
            tries.back().number = step;
        }
    };
    if (grid_first) add({.grid = true});
    add({.join = first, .surface_on_grids = to_float});
    if (!to_float) tries.push_back({.number = 1});
    if (!grid_first) add({.grid = true});
    tries.push_back({});
    return tries;
}

}  // namespace

boolean_result with_mended_operands(
    std::span<const mesh_view> operands, const boolean_options& options,
    function_ref<unmended_result(std::span<const mesh_view>, const rounding_try&)> ask) {
    const auto schedule =
        round::mending_schedule::of_operands(options.rounding_steps, options.precision);
    auto [result, broken, on_grid] = ask(operands, first_try(operands, options, schedule));
    const auto is_done = [&](const certificate& c) {
        return c.status != status::not_certified || !std::isfinite(c.max_displacement);
    };
    if (is_done(result.certificate) || schedule.operand_steps == 0) return std::move(result);
    mending again(operands, options, schedule, result.statistics, result.certificate.meeting_count);
    for (const operand_try& next : tries_of(schedule, on_grid)) {
        if (again.reach(next.number) > options.max_displacement) continue;
        std::optional<unmended_result> tried = again.step(next, broken, ask);
        if (!tried) continue;
        boolean_result& mended = tried->result;
        if (mended.certificate.status == status::cancelled) {
            result.certificate.status = status::cancelled;
            break;
        }
        result.statistics.rounding_steps += mended.statistics.rounding_steps;
        broken.insert(broken.end(), tried->broken.begin(), tried->broken.end());
        if (is_done(mended.certificate) && !mended.certificate) continue;
        if (is_better(mended.certificate, result.certificate))
            take_surface(result, std::move(mended));
        if (result.certificate && result.certificate.max_displacement <= options.max_displacement)
            break;
    }
    return std::move(result);
}

}  // namespace treeform::detail::boolean
