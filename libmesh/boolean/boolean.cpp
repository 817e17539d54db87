#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/boolean/boolean.hpp>
#include <libmesh/boolean/detail/joined_operands.hpp>
#include <libmesh/boolean/detail/sound_pair.hpp>
#include <libmesh/intersect/point_location.hpp>
#include <libmesh/round/detail/solid_faces.hpp>
#include <libmesh/round/round_surface.hpp>
#include <libtree/parallel.hpp>

#include <cstddef>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace tf {
namespace {

using detail::joined_operands;

/// `callback` as it is told of a step that does the share from `begin` to `end` of the work.
progress_callback part_of(const progress_callback& callback, double begin, double end) {
    if (!callback) return {};
    return [&callback, begin, end](double done) { return callback(begin + (end - begin) * done); };
}

bool is_inside(inside_rule rule, std::int32_t winding) {
    switch (rule) {
        case inside_rule::odd:
            return winding % 2 != 0;
        case inside_rule::positive:
            return winding > 0;
        case inside_rule::nonzero:
            break;
    }
    return winding != 0;
}

/// By cell: whether the solid holds it.
std::vector<std::uint8_t> inside_of_cells(const arrangement_cells& cells, inside_rule rule,
                                          const boolean_expression& expression) {
    const std::size_t operands = cells.operands;
    const std::size_t count = operands == 0 ? 1 : cells.winding.size() / operands;
    std::vector<std::uint8_t> inside(count, 0);
    constexpr std::size_t grain = std::size_t{1} << 10;
    for_chunks(count, grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto in = std::make_unique<bool[]>(operands);
        for (std::size_t c = begin; c < end; ++c) {
            const auto windings = cells.winding_of(static_cast<std::uint32_t>(c));
            for (std::size_t k = 0; k < operands; ++k) in[k] = is_inside(rule, windings[k]);
            inside[c] = expression({in.get(), operands}) ? 1 : 0;
        }
    });
    return inside;
}

std::vector<open_operand_edge> open_edges(const arrangement_cells& cells,
                                          const mesh_arrangement& cut,
                                          const joined_operands& joined) {
    std::vector<open_operand_edge> edges;
    for (const open_arrangement_edge& e : cells.open)
        edges.push_back({joined.face_source(e.face),
                         {rounded(cut.point(e.points[0])), rounded(cut.point(e.points[1]))}});
    return edges;
}

solid_result with_counts(const arrange_faces_result& arranged) {
    solid_result result;
    result.pairs = arranged.pairs;
    result.cut_faces = arranged.cut_faces;
    result.degenerate = arranged.degenerate.size();
    result.cancelled = arranged.cancelled;
    return result;
}

/// Whether two faces are one, turned or not.
bool same_corners(const face& f, const face& g) { return f == g || f == face{g[0], g[2], g[1]}; }

/// `exact_faces` are faces of `cut`, `face_of` says which; both become the surface of `result`.
void finish(solid_result& result, mesh_arrangement& cut, std::vector<face> exact_faces,
            const std::vector<std::uint32_t>& face_of, const joined_operands& joined, bool solid,
            const boolean_options& options) {
    exact_surface exact{std::move(cut.given_points), std::move(cut.constructed),
                        std::move(exact_faces), std::vector<std::uint8_t>(face_of.size())};
    for (std::size_t f = 0; f < face_of.size(); ++f) {
        const std::uint32_t source = cut.covers_of(face_of[f]).front().face;
        exact.sound[f] =
            cut.whole[face_of[f]] != 0 && same_corners(exact.faces[f], joined.all.faces[source]);
    }
    const std::size_t given = exact.given.size();
    rounded_surface r =
        round_surface(std::move(exact), {.to_float = options.to_float,
                                         .solid = solid,
                                         .steps = options.rounding_steps,
                                         .progress = part_of(options.progress, 0.7, 1.0)});
    result.cancelled = r.cancelled;
    if (r.cancelled) return;
    result.surface = std::move(r.surface);
    result.max_move = r.max_move;
    result.certified = r.certified;
    result.meeting_faces = std::move(r.meeting);
    result.meeting_count = r.meeting_count;
    result.rounding_steps = r.steps;
    result.source_face.reserve(r.face_of.size());
    for (const std::uint32_t f : r.face_of)
        result.source_face.push_back(joined.face_source(cut.covers_of(face_of[f]).front().face));
    result.source_point.reserve(r.point_of.size());
    for (const std::uint32_t p : r.point_of)
        result.source_point.push_back(p < given ? joined.point_source(p) : operand_element{});
}

}  // namespace

solid_result boolean(std::span<const mesh_view> operands, const boolean_expression& expression,
                     const boolean_options& options) {
    if (expression.operand_count() != operands.size())
        throw std::invalid_argument("tf::boolean: the expression has " +
                                    std::to_string(expression.operand_count()) +
                                    " operands, given are " + std::to_string(operands.size()));
    if (options.sound_operands && operands.size() == 2)
        if (auto result = detail::boolean_of_sound_pair(operands.first<2>(), expression, options))
            return std::move(*result);
    const joined_operands joined = detail::join_operands("boolean", operands);
    arrange_faces_result arranged =
        arrange_faces(joined.all, {.progress = part_of(options.progress, 0.0, 0.5)});
    solid_result result = with_counts(arranged);
    if (result.cancelled) return result;
    const arrangement_cells cells =
        find_cells(joined.all, arranged.cut, joined.operand_of_face, operands.size());
    if (!cells.open.empty()) {
        result.open = open_edges(cells, arranged.cut, joined);
        result.open_count = cells.open_count;
        return result;
    }
    const auto inside = inside_of_cells(cells, options.inside, expression);
    result.cells = inside.size();
    detail::solid_faces chosen = detail::faces_around(arranged.cut, cells, inside);
    finish(result, arranged.cut, std::move(chosen.faces), chosen.face_of, joined, true, options);
    return result;
}

solid_result split(std::span<const mesh_view> operands, const boolean_options& options) {
    const joined_operands joined = detail::join_operands("split", operands);
    arrange_faces_result arranged =
        arrange_faces(joined.all, {.progress = part_of(options.progress, 0.0, 0.7)});
    solid_result result = with_counts(arranged);
    if (result.cancelled) return result;
    std::vector<std::uint32_t> all(arranged.cut.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    finish(result, arranged.cut, std::move(arranged.cut.faces), all, joined, false, options);
    return result;
}

solid_check check_solid(mesh_view mesh, const progress_callback& progress) {
    const joined_operands joined = detail::join_operands("check_solid", {&mesh, 1});
    if (!find_open_edge(joined.all)) return {};
    const arrange_faces_result arranged =
        arrange_faces(joined.all, {.progress = part_of(progress, 0.0, 1.0)});
    if (arranged.cancelled) return {.cancelled = true};
    const arrangement_cells cells = find_cells(joined.all, arranged.cut, joined.operand_of_face, 1);
    return {.open = open_edges(cells, arranged.cut, joined), .open_count = cells.open_count};
}

}  // namespace tf
