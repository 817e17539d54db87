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
#include <libmesh/boolean/bundled_operands.hpp>
#include <libmesh/boolean/check_operand.hpp>
#include <libmesh/boolean/filled_gaps.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/labeled_cells.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <libmesh/boolean/near_surface.hpp>
#include <libmesh/boolean/open_input_edges.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/resolve_operand.hpp>
#include <libmesh/boolean/sheet_labels.hpp>
#include <libmesh/boolean/small_parts.hpp>
#include <libmesh/boolean/split_nonmanifold.hpp>
#include <libmesh/boolean/undecided_part.hpp>
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
using detail::boolean::bundled_operands;
using detail::boolean::bundles;
using detail::boolean::cut_faces;
using detail::boolean::cut_near;
using detail::boolean::cut_what;
using detail::boolean::disposition;
using detail::boolean::joined_operands;
using detail::boolean::label_counts;
using detail::boolean::left_faces;
using detail::boolean::near_result;
using detail::boolean::open_input_edges;
using detail::boolean::operand_edges;
using detail::boolean::resolved_operand;
using detail::boolean::undecided_part;

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

/// Where the surfaces of operands end; none where they do not.
std::optional<certificate> open_input(const joined_operands& joined, const operand_edges& edges) {
    const open_input_edges found =
        detail::boolean::find_open_input_edges(joined.all.points, edges.unbalanced);
    if (found.count == 0) return std::nullopt;
    certificate result{.status = status::open_input,
                       .open_count = found.count,
                       .boundary_edges = found.boundary_edges,
                       .misoriented_edges = found.misoriented_edges};
    const auto at = [&](std::uint32_t p) {
        const auto [x, y, z] = joined.all.points[p];
        return point3{x + 0.0, y + 0.0, z + 0.0};  // -0 is 0
    };
    for (const auto& [face, ends] : found.stretches) {
        result.open_edges.push_back({at(ends[0]), at(ends[1])});
        result.open_faces.push_back(joined.face_source(face));
    }
    return result;
}

std::optional<certificate> open_input(const joined_operands& joined) {
    return open_input(joined,
                      detail::boolean::find_operand_edges(joined.all, joined.operand_of_face()));
}

boolean_result stopped_result() {
    boolean_result made;
    made.certificate.status = status::cancelled;
    return made;
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
                                    std::to_string(expression.operand_count()) + " operands, but " +
                                    std::to_string(operands.size()) + " were given");
}

/// The result as it is returned: a solid as a manifold, which takes a `split` where it may not be
/// one.
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
    } catch (const detail::boolean::stopped&) {
        return finished(stopped_result(), false, options);
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
                                    ": min_volume and gap need solids");
    return with_checks(function, operands, options, [&] {
        near_result made = make(operands, options);
        return finished(std::move(made.result), solid && !made.is_manifold, options);
    });
}

/// Faces that lie entirely on lower ones.
std::uint64_t count_covered(const cut_faces& cut) {
    std::vector<std::uint8_t> is_lowest(cut.near.local.faces.size(), 0);
    const mesh_arrangement& pieces = cut.arranged.cut;
    for_chunks(pieces.faces.size(), light_grain,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t f = begin; f < end; ++f)
                       std::atomic_ref(is_lowest[pieces.covers_of(f).front().face])
                           .store(1, std::memory_order_relaxed);
               });
    const auto not_lowest = [&](std::size_t f) { return std::size_t{1} - is_lowest[f]; };
    return detail::base::running_sums(is_lowest.size(), not_lowest).back();
}

/// The chosen faces as a result, with those that nothing meets.
near_result surface_of(const bundles& operands, cut_faces& cut,
                       detail::boolean::chosen_surface chosen, const boolean_options& options,
                       bool solid, left_faces is_kept) {
    cut.near.local.points = {};  // as large as the operands, perhaps
    return detail::boolean::surface_of(operands, cut.near, cut.arranged, std::move(chosen), options,
                                       solid, is_kept);
}

/// What meets is cut, both sides of its pieces labeled, and what bounds the result put
/// together with the faces that nothing meets.
near_result boolean_of(bundled_operands& operands, const boolean_expression& expression,
                       const boolean_options& options, left_faces is_kept) {
    operands.find_pairs(part_of(options.progress, 0.0, 0.2));
    cut_faces cut =
        cut_near(operands, cut_what::near_beside_far, part_of(options.progress, 0.2, 0.5));
    if (cut.arranged.cancelled) return {stopped_result()};
    detail::boolean::chosen_surface chosen;
    std::optional<operand_volumes> volumes;
    {
        const detail::boolean::near_labels labels(operands.all(), cut.near, cut.arranged.cut,
                                                  {std::move(*cut.far[0]), std::move(*cut.far[1])},
                                                  operands.part());
        if (options.volumes) volumes = labels.volumes(options.fill_rule);
        chosen = labels.choose(expression, options.fill_rule);
    }
    near_result made;
    if (!made.may_continue(options.progress, 0.6)) return made;
    made = surface_of(operands.all(), cut, std::move(chosen), options, true, is_kept);
    made.result.volumes = volumes;
    if (operands.part() != nullptr)
        made.result.statistics.skipped_faces = operands.part()->left_out();
    return made;
}

/// All faces, cut along each other.
near_result split_of(std::span<const mesh_view> views, boolean_options options) {
    bundled_operands operands(views);
    operands.find_pairs(part_of(options.progress, 0.0, 0.2));
    cut_faces cut = cut_near(operands, cut_what::near, part_of(options.progress, 0.2, 0.7));
    if (cut.arranged.cancelled) return {stopped_result()};
    const std::uint64_t covered = count_covered(cut);
    std::vector<std::uint32_t> pieces = detail::base::numbers_below(cut.arranged.cut.faces.size());
    detail::boolean::chosen_surface chosen{
        {cut.arranged.cut.faces, std::move(pieces)},
        detail::boolean::dispositions_of(operands.all(), cut.near, disposition::kept)};
    options.merge_coplanar = false;
    options.keep_cuts = true;
    near_result made = surface_of(operands.all(), cut, std::move(chosen), options, false, nullptr);
    made.result.statistics.covered = covered;
    return made;
}

/// A mesh that need not be closed, cut along itself, and what bounds the cells that are inside by
/// the labels with the least disagreement.
near_result labeled_of(mesh_view mesh, std::span<const std::uint32_t> is_guess,
                       const boolean_options& options, std::optional<label_counts>& counts,
                       left_faces is_kept) {
    bundled_operands operands(std::span(&mesh, 1));
    operands.find_pairs(part_of(options.progress, 0.0, 0.2));
    cut_faces cut = cut_near(operands, cut_what::all, part_of(options.progress, 0.2, 0.5));
    if (cut.arranged.cancelled) return {stopped_result()};
    const mesh_arrangement& pieces = cut.arranged.cut;
    const auto [count, cells] = detail::arrange::open_cells_of(cut.near.local, pieces);
    std::vector<std::uint32_t> guesses;
    for (const std::uint32_t f : cut.near.face_of)
        guesses.push_back(is_guess[operands.all()[0].number_as_given(f)]);
    const auto labels = detail::boolean::label_cells(
        pieces, cells, count, guesses, [&] { return options.progress && !options.progress(0.6); });
    if (!labels) return {stopped_result()};
    counts = {count - 1, labels->dropped_area, labels->flipped_area};
    detail::boolean::chosen_surface chosen{
        detail::round::faces_around(pieces, cells, labels->inside),
        detail::boolean::dispositions_of(operands.all(), cut.near, disposition::dropped)};
    return surface_of(operands.all(), cut, std::move(chosen), options, true, is_kept);
}

/// Values of all faces, those of the sheet before those of the others.
std::vector<std::uint32_t> sheet_first(std::span<const std::uint32_t> values,
                                       std::span<const mesh_view> views, std::uint32_t sheet) {
    std::vector<std::uint32_t> result(values.begin(), values.end());
    std::size_t begin = 0;
    for (std::uint32_t k = 0; k < sheet; ++k) begin += views[k].faces.size();
    const std::size_t end = begin + views[sheet].faces.size();
    if (end <= values.size())
        std::rotate(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(begin),
                    result.begin() + static_cast<std::ptrdiff_t>(end));
    return result;
}

/// Of an operand that need not be closed, what an expression keeps. The others are cut near it, and
/// nowhere else.
near_result clip_of(std::span<const mesh_view> views, std::uint32_t sheet,
                    const boolean_expression& expression, const boolean_options& options) {
    check_expression("clip", views, expression);
    if (sheet >= views.size())
        throw std::invalid_argument("treeform::clip: the sheet is not an operand");
    if (!expression.is_inside(sheet))
        throw std::invalid_argument(
            "treeform::clip: the expression must be false outside of the sheet");
    bundled_operands operands(views, sheet);
    if (operands.all()[1].known->open.count > 0) {
        std::vector<mesh_view> solids(views.begin(), views.end());
        solids[sheet] = {};
        return {open_result(open_input(join_usable(solids)).value())};
    }
    operands.find_pairs(part_of(options.progress, 0.0, 0.2));
    cut_faces cut =
        cut_near(operands, cut_what::near_beside_far, part_of(options.progress, 0.2, 0.5));
    if (cut.arranged.cancelled) return {stopped_result()};
    const detail::boolean::sheet_labels labels(operands.all(), cut.near, cut.arranged.cut,
                                               *cut.far[0]);
    detail::boolean::chosen_surface chosen = labels.choose(expression, options.fill_rule);
    const std::uint64_t skipped =
        operands.all()[1].view().faces.size() - (cut.near.local.faces.size() - cut.near.first_of_b);
    boolean_options rest = options;
    const std::vector<std::uint32_t> groups = sheet_first(options.face_groups, views, sheet);
    rest.face_groups = groups;
    near_result made = surface_of(operands.all(), cut, std::move(chosen), rest, false, nullptr);
    made.result.statistics.skipped_faces = skipped;
    return made;
}

/// Operands as one mesh, or what of it can be on the surface of the result.
near_result boolean_of_joined(std::span<const mesh_view> views,
                              const boolean_expression& expression, const boolean_options& options,
                              left_faces is_kept) {
    joined_operands joined = join_usable(views);
    operand_edges edges = detail::boolean::find_operand_edges(joined.all, joined.operand_of_face());
    if (auto open = open_input(joined, edges)) return {open_result(std::move(*open)), false};
    near_result made;
    if (!made.may_continue(options.progress, 0.1)) return made;
    std::unique_ptr<const undecided_part> part;
    if (!options.volumes)  // which ask for more than the expression does
        part = undecided_part::find(joined, std::move(edges), expression, options.fill_rule);
    bundled_operands bundled(std::move(joined), std::move(part));
    boolean_options rest = options;
    rest.progress = part_of(options.progress, 0.1, 1.0);
    return boolean_of(bundled, expression, rest, is_kept);
}

near_result boolean_of(std::span<const mesh_ref> operands, std::span<const mesh_view> views,
                       const boolean_expression& expression, boolean_options options,
                       left_faces is_kept = nullptr) {
    options.volumes = options.volumes && views.size() == 2;
    if (views.size() > 2) return boolean_of_joined(views, expression, options, is_kept);
    bundled_operands bundled(operands);
    double looked = 0.0;  // no share of the work where all is known
    const progress_callback report = [&](double done) {
        looked = done;
        return !options.progress || options.progress(done);
    };
    const auto is_open = [&](const detail::boolean::bundle& b) { return b.known->open.count > 0; };
    const bool may_hide =
        std::ranges::any_of(bundled.all(), is_open) || !bundled.have_few_pairs(report);
    boolean_options rest = options;
    rest.progress = part_of(options.progress, looked, 1.0);
    if (may_hide) return boolean_of_joined(views, expression, rest, is_kept);
    return boolean_of(bundled, expression, rest, is_kept);
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
    const std::vector<mesh_ref> given(all.begin(), all.end());
    near_result made = boolean_of(given, all, gaps.expression(), rest);
    gaps.name_sources(made.result);
    if (made.result.certificate) made.result.statistics.filled_faces = gaps.size();
    return made;
}

std::vector<mesh_view> views_of(std::span<const mesh_ref> operands) {
    std::vector<mesh_view> views;
    for (const mesh_ref& operand : operands) views.push_back(operand.view());
    return views;
}

boolean_result evaluate(const char* function, std::span<const mesh_ref> operands,
                        const boolean_expression& expression, boolean_options options,
                        left_faces is_kept = nullptr) {
    const std::vector<mesh_view> views = views_of(operands);
    // Where few pairs are looked for and many found, the search begins once more.
    const progress_callback given = std::move(options.progress);
    detail::base::work_progress heard(given);
    options.progress = heard.part(0.0, 1.0);
    return with_checks(function, views, options, [&] {
        check_expression("boolean", views, expression);
        std::optional<near_result> made;
        if (options.gap > 0.0) made = union_without_gaps(function, views, expression, options);
        if (!made) made = boolean_of(operands, views, expression, options, is_kept);
        return finished(std::move(made->result), !made->is_manifold, options);
    });
}

/// What `make(is_kept)` makes of a mesh.
template <class Make>
resolved_operand resolved(mesh_view mesh, const Make& make) {
    resolved_operand result;
    result.is_kept.assign(mesh.faces.size(), 0);
    result.made = make(&result.is_kept);
    detail::base::name_no_operand(result.made.certificate);
    for (const operand_element& e : result.made.face_source) result.is_kept[e.index] = 1;
    return result;
}

}  // namespace

boolean_result boolean(const mesh_refs& operands, const boolean_expression& expression,
                       const boolean_options& options) {
    return evaluate("boolean", operands.all(), expression, options);
}

boolean_result unite(const mesh_ref& a, const mesh_ref& b, const boolean_options& options) {
    return unite({a, b}, options);
}

boolean_result unite(const mesh_refs& meshes, const boolean_options& options) {
    return evaluate("unite", meshes.all(), boolean_expression::union_of(meshes.size()), options);
}

boolean_result intersection(const mesh_ref& a, const mesh_ref& b, const boolean_options& options) {
    return intersection({a, b}, options);
}

boolean_result intersection(const mesh_refs& meshes, const boolean_options& options) {
    return evaluate("intersection", meshes.all(),
                    boolean_expression::intersection_of(meshes.size()), options);
}

boolean_result difference(const mesh_ref& a, const mesh_refs& b, const boolean_options& options) {
    std::vector<mesh_ref> all{a};
    all.insert(all.end(), b.begin(), b.end());
    return evaluate("difference", all, boolean_expression::difference_of(all.size()), options);
}

boolean_result symmetric_difference(const mesh_ref& a, const mesh_ref& b,
                                    const boolean_options& options) {
    return evaluate("symmetric_difference", std::array{a, b},
                    boolean_expression::symmetric_difference_of(2), options);
}

boolean_result clip(const mesh_refs& operands, std::uint32_t sheet,
                    const boolean_expression& expression, const boolean_options& options) {
    return evaluate(
        "clip", views_of(operands.all()), options, false,
        [&](auto given, const auto& how) { return clip_of(given, sheet, expression, how); });
}

boolean_result split(const mesh_refs& operands, const boolean_options& options) {
    return evaluate("split", views_of(operands.all()), options, false, split_of);
}

resolved_operand detail::boolean::resolve_by_split(mesh_view mesh, const boolean_options& options) {
    return resolved(mesh, [&](left_faces) {
        return evaluate("resolve_self_intersections", std::span(&mesh, 1), options, false,
                        split_of);
    });
}

resolved_operand detail::boolean::resolve_by_union(mesh_view mesh, const boolean_options& options) {
    return resolved(mesh, [&](left_faces is_kept) {
        return evaluate("resolve_self_intersections", std::array{mesh_ref(mesh)},
                        boolean_expression::union_of(1), options, is_kept);
    });
}

detail::boolean::labeled_result detail::boolean::resolve_by_labels(
    mesh_view mesh, std::span<const std::uint32_t> is_guess, const boolean_options& options) {
    std::optional<label_counts> counts;
    resolved_operand made = resolved(mesh, [&](left_faces is_kept) {
        return evaluate("resolve_self_intersections", std::span(&mesh, 1), options, true,
                        [&](auto given, const auto& how) {
                            return labeled_of(given.front(), is_guess, how, counts, is_kept);
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

certificate check_operand(const mesh_ref& mesh, const progress_callback& progress) {
    return detail::boolean::check_operand("check_operand", mesh.view(), progress);
}

certificate detail::boolean::check_operand(const char* called, mesh_view mesh,
                                           const progress_callback& progress) {
    check_operands(called, {&mesh, 1});
    check_coordinates(called, {&mesh, 1});
    const auto open = open_input(join_operands({&mesh, 1}));
    if (progress && !progress(1.0)) return {.status = status::cancelled};
    certificate found = open.value_or(certificate{});
    base::name_no_operand(found);
    return found;
}

}  // namespace treeform
