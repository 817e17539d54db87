#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/boolean/active_boolean.hpp>
#include <libmesh/boolean/active_cells.hpp>
#include <libmesh/boolean/active_space.hpp>
#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/sample_faces.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/round/solid_faces.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

/// Two components hide little of each other that is not cut anyway.
constexpr std::size_t fewest_components = 3;
/// The least share of faces that has to be hidden, and then be left out; else it is better to cut
/// them all.
constexpr double least_hidden = 0.25, least_left_out = 0.3;
/// Cutting costs in proportion to the faces near each other, and so may finding out what is hidden.
constexpr double neighbors_of_effort = 8.0;

/// The active faces; none where too few others are left out.
std::optional<std::vector<std::uint32_t>> active_faces(const active_space& space) {
    const auto is_active = space.is_active_face();
    std::vector<std::uint32_t> faces;
    for (std::size_t f = 0; f < is_active.size(); ++f)
        if (is_active[f] != 0) faces.push_back(static_cast<std::uint32_t>(f));
    const auto all = static_cast<double>(is_active.size());
    if (all - static_cast<double>(faces.size()) < least_left_out * all) return std::nullopt;
    return faces;
}

}  // namespace

std::optional<boolean_result> boolean_in_active_space(joined_operands& joined,
                                                      operand_edges&& edges,
                                                      const boolean_expression& expression,
                                                      const boolean_options& options,
                                                      left_faces is_left) {
    if (edges.piece.count() < fewest_components) return std::nullopt;
    // What each face has a number in goes as soon as it may: the crowd is far larger than the result.
    std::vector<std::uint32_t> operand_of_face = joined.operand_of_face();
    const surface_components components(joined.all, operand_of_face, edges);
    edges = {};
    if (components.size() < fewest_components) return std::nullopt;
    const auto stops = [&](double done) { return options.progress && !options.progress(done); };
    if (stops(0.1)) return with_counts({});
    const partial_expression at_nowhere(expression, options.inside);
    const face_samples samples = sample_faces(components, at_nowhere);
    if (samples.hidden < least_hidden) return std::nullopt;
    const active_space space(
        components, at_nowhere,
        {.effort = std::clamp(samples.neighbors / neighbors_of_effort, 0.125, 4.0)});
    auto number = active_faces(space);
    if (!number) return std::nullopt;
    if (stops(0.2)) return with_counts({});
    const std::size_t all = joined.all.faces.size();

    std::vector<face> faces;
    std::vector<std::uint32_t> operands;
    for (const std::uint32_t f : *number) {
        faces.push_back(joined.all.faces[f]);
        operands.push_back(operand_of_face[f]);
    }
    operand_of_face = std::vector<std::uint32_t>();
    const mesh_view active{joined.all.points, faces};
    arrange_faces_result arranged = arrange::arrange_where(
        active, [&](const aabb<double, 3>& box) { return space.reaches_active(box); },
        {.progress = base::part_of(options.progress, 0.2, 0.5)});
    boolean_result made = with_counts(arranged);
    made.statistics.skipped_faces = all - faces.size();
    if (arranged.cancelled) return made;
    // The points stay where they are in memory.
    arranged.cut.given_points = std::move(joined.all.points);
    const active_cells cells =
        find_active_cells(active, arranged.cut, operands, components, space, at_nowhere);
    round::solid_faces chosen = round::faces_around(arranged.cut, cells.cells, cells.inside);
    joined.all.faces = std::move(faces);
    joined.number_of_face = std::move(*number);
    finish_surface(made, arranged.cut, std::move(chosen), joined, true, options, is_left);
    return made;
}

}  // namespace treeform::detail::boolean
