#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/mended_operands.hpp>
#include <libmesh/round/mending_schedule.hpp>
#include <libmesh/round/snap_nearby.hpp>
#include <treeform/tree/aabb.hpp>
#include <treeform/tree/search.hpp>

#include <cmath>
#include <cstddef>
#include <numeric>
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

/// The question once more, of operands joined where they are next to broken places.
class mending {
  public:
    /// \pre the operands have been checked
    mending(std::span<const mesh_view> operands, const boolean_options& options,
            const round::mending_schedule& schedule)
        : options_(options),
          schedule_(schedule),
          given_(join_operands(operands)),
          operand_of_face_(given_.operand_of_face()) {
        source_.resize(given_.all.faces.size());
        std::iota(source_.begin(), source_.end(), 0U);
    }

    template <class Ask>
    unmended_result step(int number, const std::vector<aabb<double, 3>>& broken, const Ask& ask) {
        const double reach = schedule_.reach_of_operands(given_.all.points, number);
        const round::joined_near near = round::snap_nearby(
            given_.all, next_to(broken, given_.all, reach),
            {.reach = reach, .source = source_, .solid = false, .operand = operand_of_face_});
        const near_operands joined(near, operand_of_face_, given_.first_face.size() - 1);
        boolean_options how = options_;
        how.rounding_steps = schedule_.surface_steps;
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
        result.certificate.max_displacement += near.moved;
        for (operand_element& face : result.face_source) face = face_source(joined, face);
        for (operand_element& face : result.face_of_cut_vertex) face = face_source(joined, face);
        for (operand_element& point : result.vertex_source) point = point_source(joined, point);
        return made;
    }

  private:
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

}  // namespace

boolean_result with_mended_operands(
    std::span<const mesh_view> operands, const boolean_options& options,
    function_ref<unmended_result(std::span<const mesh_view>, const boolean_options&)> ask) {
    const auto schedule =
        round::mending_schedule::of_operands(options.rounding_steps, options.precision);
    boolean_options first = options;
    first.rounding_steps = schedule.surface_steps;
    auto [result, broken] = ask(operands, first);
    const auto is_done = [&](const certificate& c) {
        return c.status != status::not_certified || !std::isfinite(c.max_displacement);
    };
    if (is_done(result.certificate) || schedule.operand_steps == 0) return result;
    mending again(operands, options, schedule);
    for (int step = 1; step <= schedule.operand_steps; ++step) {
        auto [mended, broken_again] = again.step(step, broken, ask);
        if (mended.certificate.status == status::cancelled) {
            result.certificate.status = status::cancelled;
            break;
        }
        ++result.statistics.rounding_steps;
        broken.insert(broken.end(), broken_again.begin(), broken_again.end());
        if (is_done(mended.certificate) && !mended.certificate) continue;
        const std::uint64_t before = result.certificate.meeting_count;
        const std::uint64_t after = mended.certificate.meeting_count;
        if (mended.certificate || after < before) take_surface(result, std::move(mended));
        if (result.certificate || !schedule.mends_operands(before, after)) break;
    }
    return std::move(result);
}

}  // namespace treeform::detail::boolean
