#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/boolean/sample_faces.hpp>
#include <libmesh/boolean/undecided_part.hpp>
#include <libmesh/intersect/meetings.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace treeform::detail::boolean {
namespace {

/// What may be spent on a face for each face or neighbor that is hidden, as cutting these is saved.
constexpr double effort_of_hidden = 0.125, most_effort = 64.0;

}  // namespace

std::unique_ptr<const undecided_part> undecided_part::find(joined_operands& joined,
                                                           operand_edges&& edges,
                                                           const boolean_expression& expression,
                                                           fill_rule rule) {
    surface_components components(joined.all, joined.operand_of_face(), edges);
    edges = {};
    const partial_expression at_nowhere(expression, rule);
    const face_samples samples = sample_faces(components, at_nowhere);
    const division_limits limits{
        .effort =
            std::min(effort_of_hidden * samples.hidden * (1.0 + samples.neighbors), most_effort)};
    if (!undecided_space::is_divided(components, limits)) return nullptr;
    return std::make_unique<const undecided_part>(std::move(joined), std::move(components),
                                                  at_nowhere, limits);
}

undecided_part::undecided_part(joined_operands&& joined, surface_components&& components,
                               const partial_expression& at_nowhere, const division_limits& limits)
    : whole_(std::move(joined)),
      components_(std::move(components)),
      space_(components_, at_nowhere, limits) {}

joined_operands undecided_part::faces() const {
    const auto is_undecided = space_.is_undecided_face();
    std::vector<std::uint32_t> numbers;
    base::compact(
        is_undecided.size(), [&](std::size_t f) { return is_undecided[f] != 0; },
        [&](std::size_t count) { numbers.resize(count); },
        [&](std::size_t f, std::size_t place) { numbers[place] = static_cast<std::uint32_t>(f); });
    return part_of(whole_, numbers);
}

std::size_t undecided_part::left_out() const {
    return static_cast<std::size_t>(std::ranges::count(space_.is_undecided_face(), 0));
}

bool undecided_part::is_undecided(mesh_view mesh, const face_pair& pair) const {
    const auto box_of = base::face_boxes(mesh.points);
    const auto around = common_box(box_of(mesh.faces[pair.a]), box_of(mesh.faces[pair.b]));
    return space_.reaches_undecided(around) &&
           space_.reaches_undecided(intersect::box_of_meeting(mesh, pair));
}

}  // namespace treeform::detail::boolean
