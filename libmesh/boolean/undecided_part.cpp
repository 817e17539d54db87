#include <libmesh/base/compact.hpp>
#include <libmesh/base/face_boxes.hpp>
#include <libmesh/boolean/sample_faces.hpp>
#include <libmesh/boolean/undecided_part.hpp>
#include <libmesh/intersect/meetings.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace treeform::detail::boolean {
namespace {

/// The least share of faces that has to be hidden: below, halving boxes costs more than it saves.
constexpr double least_hidden = 0.25;
/// Cutting costs in proportion to the faces near each other, and so may finding out what is hidden.
constexpr double neighbors_of_effort = 8.0, least_effort = 0.125, most_effort = 64.0;

constexpr std::size_t pairs_a_chunk = 1024;

}  // namespace

std::unique_ptr<const undecided_part> undecided_part::find(joined_operands& joined,
                                                           operand_edges&& edges,
                                                           const boolean_expression& expression,
                                                           fill_rule rule) {
    surface_components components(joined.all, joined.operand_of_face(), edges);
    edges = {};
    const partial_expression at_nowhere(expression, rule);
    const face_samples samples = sample_faces(components, at_nowhere);
    if (samples.hidden < least_hidden) return nullptr;
    const double effort =
        std::clamp(samples.neighbors / neighbors_of_effort, least_effort, most_effort);
    return std::make_unique<const undecided_part>(std::move(joined), std::move(components),
                                                  at_nowhere, division_limits{.effort = effort});
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

std::vector<face_pair> undecided_part::pairs_within(mesh_view mesh,
                                                    std::span<const face_pair> pairs) const {
    const auto box_of = base::face_boxes(mesh.points);
    std::vector<std::uint8_t> is_within(pairs.size());
    for_chunks(pairs.size(), pairs_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b, kind] = pairs[i];
            const auto around = common_box(box_of(mesh.faces[a]), box_of(mesh.faces[b]));
            is_within[i] =
                space_.reaches_undecided(around) &&
                        space_.reaches_undecided(intersect::box_of_meeting(mesh, pairs[i]))
                    ? 1
                    : 0;
        }
    });
    std::vector<face_pair> within;
    base::compact(
        pairs.size(), [&](std::size_t i) { return is_within[i] != 0; },
        [&](std::size_t count) { within.resize(count); },
        [&](std::size_t i, std::size_t place) { within[place] = pairs[i]; });
    return within;
}

}  // namespace treeform::detail::boolean
