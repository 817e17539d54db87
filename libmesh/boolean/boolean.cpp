#include <libmesh/arrange/arrange_pairs.hpp>
#include <libmesh/arrange/cells_of.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/base/certify.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/part_of_progress.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/require_share.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/running_sums.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/boolean/active_part.hpp>
#include <libmesh/boolean/bundled_operands.hpp>
#include <libmesh/boolean/check_solid.hpp>
#include <libmesh/boolean/clip_sheet.hpp>
#include <libmesh/boolean/filled_gaps.hpp>
#include <libmesh/boolean/finish_surface.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/labeled_cells.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <libmesh/boolean/near_surface.hpp>
#include <libmesh/boolean/open_input_edges.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/resolve_operand.hpp>
#include <libmesh/boolean/small_parts.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/round/solid_faces.hpp>
#include <treeform/mesh/boolean.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using detail::base::part_of;
using detail::boolean::active_part;
using detail::boolean::bundled_operands;
using detail::boolean::far_faces;
using detail::boolean::finish_surface;
using detail::boolean::joined_operands;
using detail::boolean::label_counts;
using detail::boolean::left_faces;
using detail::boolean::near_result;
using detail::boolean::open_input_edges;
using detail::boolean::operand_edges;
using detail::boolean::resolved_operand;
using detail::boolean::with_counts;

/// Operands, joined, and their arrangement, which has taken their points; their faces stay.
struct arranged_operands {
    joined_operands joined;
    arrange_faces_result arranged;
};

void arrange_joined(arranged_operands& operands, const progress_callback& progress) {
    mesh& all = operands.joined.all;
    operands.arranged = detail::arrange::arrange_without_points(all, {.progress = progress});
    operands.arranged.cut.given_points = std::move(all.points);
}

/// \throws std::invalid_argument for a point that is not finite or beyond 2^1000
joined_operands join_usable(std::span<const mesh_view> operands) {
    joined_operands joined = detail::boolean::join_operands(operands);
    const points_view points = joined.all.points;
    if (detail::base::first_bad(points.size(), [&](std::size_t p) {
            return !(detail::base::largest_of(points[p]) <= 0x1p1000);
        }) != points.size())
        throw std::invalid_argument("treeform::boolean: a coordinate");
    return joined;
}

arranged_operands arrange_operands(std::span<const mesh_view> operands,
                                   const progress_callback& progress) {
    arranged_operands result{join_usable(operands), {}};
    arrange_joined(result, progress);
    return result;
}

/// What `cut` is the arrangement of.
mesh_view input_of(const mesh_arrangement& cut, const joined_operands& joined) {
    return {cut.given_points, joined.all.faces};
}

open_input_edges open_edges_of(const joined_operands& joined, const operand_edges& edges,
                               std::uint32_t sheet = operand_element::none) {
    return detail::boolean::find_open_input_edges(joined.all.points, edges.unbalanced, sheet);
}

certificate open_input(const open_input_edges& found, const joined_operands& joined) {
    certificate result{.status = status::open_input,
                       .open_count = found.count,
                       .boundary_edges = found.boundary_edges,
                       .misoriented_edges = found.misoriented_edges};
    const auto at = [&](std::uint32_t p) {
        const auto [x, y, z] = joined.all.points[p];
        return point3{x + 0.0, y + 0.0, z + 0.0};  // -0 is 0
    };
    for (const auto& [face, ends] : found.stretches)
        result.open.push_back({joined.face_source(face), {at(ends[0]), at(ends[1])}});
    return result;
}

boolean_result open_result(certificate&& found) {
    boolean_result made;
    made.certificate = std::move(found);
    return made;
}

void check_expression(const char* function, std::span<const mesh_view> operands,
                      const boolean_expression& expression) {
    if (expression.operand_count() != operands.size())
        throw std::invalid_argument("treeform::" + std::string(function) + ": the expression has " +
                                    std::to_string(expression.operand_count()) +
                                    " operands, given are " + std::to_string(operands.size()));
}

/// Faces with an area no piece of which is the lowest face's there.
std::uint64_t count_covered(const arrange_faces_result& arranged, std::size_t faces) {
    std::vector<std::uint8_t> is_lowest(faces, 0);
    for_chunks(arranged.cut.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       std::atomic_ref(is_lowest[arranged.cut.covers_of(f).front().face])
                           .store(1, std::memory_order_relaxed);
               });
    for (const std::uint32_t f : arranged.degenerate) is_lowest[f] = 1;
    const auto not_lowest = [&](std::size_t f) { return std::size_t{1} - is_lowest[f]; };
    return detail::base::running_sums(faces, not_lowest).back();
}

boolean_result labeled_of(mesh_view mesh, std::span<const std::uint32_t> is_guess,
                          const boolean_options& options, std::optional<label_counts>& counts,
                          left_faces is_left) {
    auto [joined, arranged] = arrange_operands({&mesh, 1}, part_of(options.progress, 0.0, 0.5));
    boolean_result made = with_counts(arranged);
    if (arranged.cancelled) return made;
    const auto [count, cells] =
        detail::arrange::open_cells_of(input_of(arranged.cut, joined), arranged.cut);
    const auto labels = detail::boolean::label_cells(arranged.cut, cells, count, is_guess, [&] {
        return options.progress && !options.progress(0.6);
    });
    if (!labels) return made;
    counts = {count - 1, labels->dropped_area, labels->turned_area};
    detail::round::solid_faces chosen =
        detail::round::faces_around(arranged.cut, cells, labels->inside);
    finish_surface(made, arranged.cut, std::move(chosen), joined, true, options, is_left);
    return made;
}

boolean_result clip_of(std::span<const mesh_view> operands, std::uint32_t sheet,
                       const boolean_expression& expression, const boolean_options& options) {
    check_expression("clip", operands, expression);
    if (sheet >= operands.size())
        throw std::invalid_argument("treeform::clip: the sheet is no operand");
    if (!expression.needs(sheet))
        throw std::invalid_argument("treeform::clip: the expression holds more than of the sheet");
    joined_operands joined = join_usable(operands);
    const operand_edges edges =
        detail::boolean::find_operand_edges(joined.all, joined.operand_of_face());
    if (const auto open = open_edges_of(joined, edges, sheet); open.count > 0)
        return open_result(open_input(open, joined));
    return detail::boolean::clip_sheet(joined, edges, sheet, expression, options);
}

boolean_result split_of(std::span<const mesh_view> operands, const boolean_options& options) {
    auto [joined, arranged] = arrange_operands(operands, part_of(options.progress, 0.0, 0.7));
    boolean_result result = with_counts(arranged);
    if (arranged.cancelled) return result;
    std::vector<std::uint32_t> all = detail::base::numbers_below(arranged.cut.faces.size());
    result.statistics.covered = count_covered(arranged, joined.all.faces.size());
    boolean_options as_cut = options;
    as_cut.simplify = false;
    as_cut.keep_cuts = true;
    finish_surface(result, arranged.cut, {std::move(arranged.cut.faces), std::move(all)}, joined,
                   false, as_cut);
    return result;
}

/// The result as it is returned: a solid as a manifold, which takes a `split` where it may not be one.
boolean_result finished(boolean_result&& result, bool split, const boolean_options& options) {
    detail::base::describe(result.certificate, result.mesh, options.precision);
    if (!result.certificate) return std::move(result);
    if (result.mesh.faces.empty() && result.statistics.exact_faces > 0) {
        result.certificate.status = status::vanished;
        result.certificate.vanished_faces = result.statistics.exact_faces;
        return std::move(result);
    }
    if (split) detail::boolean::split_nonmanifold(result);
    if (options.min_volume > 0.0) detail::boolean::drop_small_parts(result, options.min_volume);
    return std::move(result);
}

/// What `run` returns for operands that can be computed with.
template <class Run>
boolean_result with_checks(const char* function, std::span<const mesh_view> operands,
                           const boolean_options& options, const Run& run) {
    detail::boolean::check_operands(function, operands);
    detail::base::require_limit(function, options.max_displacement, "the largest displacement");
    detail::base::require_share(function, options.min_volume, "the least volume");
    detail::base::require_share(function, options.gap, "the gap");
    try {
        return run();
    } catch (const std::invalid_argument&) {  // where an operand is to blame, its face is named
        detail::boolean::check_coordinates(function, operands);
        throw;
    }
}

/// What `make` makes of the operands, as returned.
template <class Make>
boolean_result evaluate(const char* function, std::span<const mesh_view> operands,
                        const boolean_options& options, bool solid, const Make& make) {
    if (!solid && (options.min_volume > 0.0 || options.gap > 0.0))
        throw std::invalid_argument("treeform::" + std::string(function) +
                                    ": a least volume, or a gap to fill, is of solids only");
    return with_checks(function, operands, options,
                       [&] { return finished(make(operands, options), solid, options); });
}

/// What meets is cut, what is on both sides of its pieces told, and what bounds the result put
/// together with the faces that nothing meets.
near_result boolean_of(bundled_operands& operands, const boolean_expression& expression,
                       const boolean_options& options, left_faces is_left) {
    near_result made;
    operands.find_pairs(part_of(options.progress, 0.0, 0.2));
    if (!made.goes_on(options.progress, 0.2)) return made;
    detail::boolean::near_faces near =
        detail::boolean::find_near_faces(operands.all(), operands.once());
    if (!made.goes_on(options.progress, 0.4)) return made;
    arrange_faces_result arranged;
    std::array<std::optional<far_faces>, 2> far;
    const auto find_far = [&](std::size_t k) {
        far[k].emplace(*operands.all()[k].mesh, near.is_near[k]);
    };
    detail::base::parallel_invoke(
        [&] {
            arranged = detail::arrange::arrange_pairs(near.local, near.pairs, {},
                                                      part_of(options.progress, 0.4, 0.5));
        },
        [&] { find_far(0); }, [&] { find_far(1); });
    if (arranged.cancelled || !made.goes_on(options.progress, 0.5)) {
        made.result.certificate.status = status::cancelled;
        return made;
    }
    detail::boolean::chosen_surface chosen;
    std::optional<operand_volumes> volumes;
    {
        const detail::boolean::near_labels labels(operands.all(), near, arranged.cut,
                                                  {std::move(*far[0]), std::move(*far[1])},
                                                  operands.part());
        if (options.volumes) volumes = labels.volumes(options.inside);
        chosen = labels.choose(expression, options.inside);
    }
    if (!made.goes_on(options.progress, 0.6)) return made;
    near.local.points = {};  // as large as the operands, perhaps
    made = detail::boolean::surface_of(operands.all(), near, arranged, std::move(chosen), options,
                                       is_left);
    made.result.volumes = volumes;
    if (operands.part() != nullptr)
        made.result.statistics.skipped_faces = operands.part()->left_out();
    return made;
}

/// Operands as one mesh, or what of it can be on the surface of the result.
near_result boolean_of_joined(std::span<const mesh_view> views,
                              const boolean_expression& expression, const boolean_options& options,
                              left_faces is_left) {
    joined_operands joined = join_usable(views);
    operand_edges edges = detail::boolean::find_operand_edges(joined.all, joined.operand_of_face());
    if (const auto open = open_edges_of(joined, edges); open.count > 0)
        return {open_result(open_input(open, joined)), false};
    near_result made;
    if (!made.goes_on(options.progress, 0.1)) return made;
    std::unique_ptr<const active_part> part;
    if (!options.volumes)  // which ask for more than the expression does
        part = active_part::find(joined, std::move(edges), expression, options.inside);
    bundled_operands bundled(std::move(joined), std::move(part));
    return boolean_of(bundled, expression, options, is_left);
}

near_result boolean_of(std::span<const mesh_operand> operands, std::span<const mesh_view> views,
                       const boolean_expression& expression, boolean_options options,
                       left_faces is_left = nullptr) {
    options.volumes = options.volumes && views.size() == 2;
    if (views.size() > 2) return boolean_of_joined(views, expression, options, is_left);
    bundled_operands bundled(operands);
    double looked = 0.0;  // no share of the work where all is known
    const progress_callback report = [&](double done) {
        looked = done;
        return !options.progress || options.progress(done);
    };
    const bool may_hide = bundled.open().count > 0 || !bundled.have_few_pairs(report);
    boolean_options rest = options;
    rest.progress = part_of(options.progress, looked, 1.0);
    if (may_hide) return boolean_of_joined(views, expression, rest, is_left);
    return boolean_of(bundled, expression, rest, is_left);
}

/// The union with the gaps filled between operands; none where there are none.
std::optional<near_result> union_without_gaps(const char* function,
                                              std::span<const mesh_view> operands,
                                              const boolean_expression& expression,
                                              const boolean_options& options) {
    detail::boolean::require_union(function, expression);
    detail::boolean::check_coordinates(function, operands);
    const detail::boolean::filled_gaps gaps(operands, options.gap);
    if (gaps.empty()) return std::nullopt;
    boolean_options rest = options;
    const std::vector<std::uint32_t> groups = gaps.face_groups(options.face_groups);
    rest.face_groups = groups;
    rest.volumes = false;
    const std::vector<mesh_view> all = gaps.operands();
    const std::vector<mesh_operand> given(all.begin(), all.end());
    near_result made = boolean_of(given, all, gaps.expression(), rest);
    gaps.name_sources(made.result);
    if (made.result.certificate) made.result.statistics.filled_faces = gaps.size();
    return made;
}

boolean_result evaluate(const char* function, std::span<const mesh_operand> operands,
                        const boolean_expression& expression, boolean_options options,
                        left_faces is_left = nullptr) {
    std::vector<mesh_view> views;
    for (const mesh_operand& operand : operands) views.push_back(operand.view());
    // Where few pairs are looked for and many found, the search begins once more.
    const progress_callback given = std::move(options.progress);
    detail::base::work_progress heard(given);
    options.progress = heard.part(0.0, 1.0);
    return with_checks(function, views, options, [&] {
        check_expression("boolean", views, expression);
        try {
            std::optional<near_result> made;
            if (options.gap > 0.0) made = union_without_gaps(function, views, expression, options);
            if (!made) made = boolean_of(operands, views, expression, options, is_left);
            return finished(std::move(made->result), !made->is_manifold, options);
        } catch (const detail::boolean::stopped&) {
            return finished(with_counts({}), false, options);
        }
    });
}

/// What `make(is_left)` makes of a mesh.
template <class Make>
resolved_operand resolved(mesh_view mesh, const Make& make) {
    resolved_operand result;
    result.is_left.assign(mesh.faces.size(), 0);
    result.made = make(&result.is_left);
    for (const operand_element& e : result.made.face_source) result.is_left[e.index] = 1;
    return result;
}

}  // namespace

boolean_result boolean(std::span<const mesh_view> operands, const boolean_expression& expression,
                       const boolean_options& options) {
    return boolean(std::vector<mesh_operand>(operands.begin(), operands.end()), expression,
                   options);
}

boolean_result boolean(std::span<const mesh_operand> operands, const boolean_expression& expression,
                       const boolean_options& options) {
    return evaluate("boolean", operands, expression, options);
}

boolean_result unite(const mesh_operand& a, const mesh_operand& b, const boolean_options& options) {
    return evaluate("unite", std::array{a, b}, boolean_expression::union_of(2), options);
}

boolean_result intersection(const mesh_operand& a, const mesh_operand& b,
                            const boolean_options& options) {
    return evaluate("intersection", std::array{a, b}, boolean_expression::intersection_of(2),
                    options);
}

boolean_result subtract(const mesh_operand& a, const mesh_operand& b,
                        const boolean_options& options) {
    return evaluate("subtract", std::array{a, b}, boolean_expression::difference_of(2), options);
}

boolean_result symmetric_difference(const mesh_operand& a, const mesh_operand& b,
                                    const boolean_options& options) {
    return evaluate("symmetric_difference", std::array{a, b}, boolean_expression::xor_of(2),
                    options);
}

boolean_result clip(std::span<const mesh_view> operands, std::uint32_t sheet,
                    const boolean_expression& expression, const boolean_options& options) {
    return evaluate("clip", operands, options, false, [&](auto given, const auto& how) {
        return clip_of(given, sheet, expression, how);
    });
}

boolean_result split(std::span<const mesh_view> operands, const boolean_options& options) {
    return evaluate("split", operands, options, false, split_of);
}

resolved_operand detail::boolean::resolve_by_split(mesh_view mesh, const boolean_options& options) {
    return resolved(mesh, [&](left_faces) {
        return evaluate("resolve_self_intersections", std::span(&mesh, 1), options, false,
                        split_of);
    });
}

resolved_operand detail::boolean::resolve_by_union(mesh_view mesh, const boolean_options& options) {
    return resolved(mesh, [&](left_faces is_left) {
        return evaluate("resolve_self_intersections", std::array{mesh_operand(mesh)},
                        boolean_expression::union_of(1), options, is_left);
    });
}

detail::boolean::labeled_result detail::boolean::resolve_by_labels(
    mesh_view mesh, std::span<const std::uint32_t> is_guess, const boolean_options& options) {
    std::optional<label_counts> counts;
    resolved_operand made = resolved(mesh, [&](left_faces is_left) {
        return evaluate("resolve_self_intersections", std::span(&mesh, 1), options, true,
                        [&](auto given, const auto& how) {
                            return labeled_of(given.front(), is_guess, how, counts, is_left);
                        });
    });
    return {std::move(made), counts.value_or(label_counts{})};
}

const mesh& boolean_result::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh boolean_result::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

certificate check_solid(mesh_view mesh, const progress_callback& progress) {
    return detail::boolean::check_solid("check_solid", mesh, progress);
}

certificate detail::boolean::check_solid(const char* called, mesh_view mesh,
                                         const progress_callback& progress) {
    check_operands(called, {&mesh, 1});
    check_coordinates(called, {&mesh, 1});
    const joined_operands joined = join_operands({&mesh, 1});
    const auto open =
        open_edges_of(joined, find_operand_edges(joined.all, joined.operand_of_face()));
    if (progress && !progress(1.0)) return {.status = status::cancelled};
    return open.count == 0 ? certificate{} : open_input(open, joined);
}

}  // namespace treeform
