#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/parallel_invoke.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/weld/carried_rows.hpp>
#include <libmesh/weld/edge_uses.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/kept_values.hpp>
#include <libmesh/weld/vertex_values.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

/// Numbers that are equal where the numbers in `label` are and where the values of both columns
/// are; NaN equals NaN here, and a point that takes no part nothing. Empty arrays do not tell
/// points apart.
std::vector<std::uint32_t> refine(std::size_t count, std::span<const std::uint32_t> label,
                                  std::span<const std::uint8_t> takes_part,
                                  std::span<const double> a, std::span<const double> b) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    buffer<point3> keys(count);
    for_chunks(count, light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        const auto value = [](std::span<const double> values, std::size_t i) {
            return values.empty() ? 0.0 : values[i];
        };
        for (std::size_t i = begin; i < end; ++i) {
            const double u = value(a, i);
            const double v = value(b, i);
            const bool no_u = std::isnan(u);
            const bool no_v = std::isnan(v);
            const std::uint64_t number = (label.empty() ? 0 : std::uint64_t{label[i]}) * 4 +
                                         (no_u ? 2U : 0U) + (no_v ? 1U : 0U);
            const bool alone = !takes_part.empty() && takes_part[i] == 0;
            keys[i] = {alone ? nan : static_cast<double>(number), no_u ? 0.0 : u, no_v ? 0.0 : v};
        }
    });
    return find_equal_points(keys.span()).group_of_point;
}

/// Conditions with a tolerance of 0 become labels; the others become a predicate on pairs of
/// points.
class conditions {
  public:
    /// `asked` replaces `options.same`, with one condition for each column. `options.label` must
    /// outlive this object. `takes_part` is [V], 0 for points that are never merged; empty: all may
    /// be.
    ///
    /// \throws std::invalid_argument as `weld`
    conditions(points_view points, const attributes& properties, const weld_options& options,
               std::span<const weld_condition> asked, std::span<const std::uint8_t> takes_part)
        : given_(options) {
        if (!given_.label.empty() && given_.label.size() != points.size())
            refuse(std::to_string(given_.label.size()) + " labels for " +
                   std::to_string(points.size()) + " points");
        std::vector<buffer<double>> equal;
        // Two columns a round.
        const auto refine_by_columns = [&] {
            const auto values = [&](std::size_t i) {
                return i < equal.size() ? equal[i].span() : std::span<const double>{};
            };
            label_ = refine(points.size(), label_.empty() ? given_.label : label_, takes_part,
                            values(0), values(1));
            equal.clear();
        };
        for (const weld_condition& condition : asked) {
            const double tolerance = condition.tolerance;
            if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
                refuse("the tolerance of '" + condition.property +
                       "' must be finite and not negative");
            vertex_values values(points, properties, condition.property);
            if (tolerance > 0.0) {
                questions_.push_back({std::move(values), tolerance});
                continue;
            }
            for (buffer<double>& column : std::move(values).take_columns()) {
                equal.push_back(std::move(column));
                if (equal.size() == 2) refine_by_columns();
            }
        }
        if (!equal.empty() || (label_.empty() && !takes_part.empty())) refine_by_columns();
    }

    /// \pre the object is not moved while the options are in use
    [[nodiscard]] weld_options options() const {
        weld_options options = given_;
        if (!label_.empty()) options.label = label_;
        if (!questions_.empty())
            options.may_merge = [this](std::uint32_t i, std::uint32_t j) {
                return std::ranges::all_of(
                           questions_,
                           [&](const question& q) { return q.values.agree(i, j, q.tolerance); }) &&
                       (!given_.may_merge || given_.may_merge(i, j));
            };
        return options;
    }

  private:
    struct question {
        vertex_values values;
        double tolerance;
    };

    weld_options given_;
    std::vector<std::uint32_t> label_;  ///< [V]; empty: use the given labels
    std::vector<question> questions_;
};

}  // namespace
}  // namespace treeform::detail::weld

namespace treeform {
namespace {

[[nodiscard]] point_groups find_groups(mesh_view mesh, const attributes& properties,
                                       const weld_options& options,
                                       std::span<const std::uint32_t> order) {
    const auto asked = options.conditions(properties, !mesh.faces.empty());
    detail::buffer<std::uint8_t> border;
    if (options.only_borders) border = detail::weld::border_points(mesh.points.size(), mesh.faces);
    const detail::weld::conditions conditions(mesh.points, properties, options, asked,
                                              border.span());
    const weld_options all = conditions.options();
    return order.empty() ? detail::weld::find_groups("weld", mesh.points, all)
                         : detail::weld::find_groups_in_order("weld", mesh.points, all, order);
}

std::uint64_t count_non_finite(points_view points) {
    std::vector<std::uint64_t> counts(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            if (!detail::base::is_finite(points[i])) ++counts[c];
    });
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

/// What a chunk of faces comes to.
struct face_counts {
    std::size_t kept = 0;
    std::uint64_t collapsed = 0;
    std::uint64_t degenerate = 0;
};

/// Gives the faces their new corners and leaves out those that repeat one, if asked for.
void carry_faces(std::span<const face> faces, bool keep_degenerate, weld_result& result) {
    const std::vector<std::uint32_t>& group_of = result.groups.group_of_point;
    const auto welded = [&](const face& f) {
        return face{group_of[f[0]], group_of[f[1]], group_of[f[2]]};
    };
    std::vector<face_counts> counts(chunk_count(faces.size(), light_grain));
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        face_counts mine;
        for (std::size_t i = begin; i < end; ++i) {
            const bool three = detail::base::has_three_corners(welded(faces[i]));
            mine.kept += three || keep_degenerate ? 1 : 0;
            if (three) continue;
            ++(detail::base::has_three_corners(faces[i]) ? mine.collapsed : mine.degenerate);
        }
        counts[c] = mine;
    });
    std::size_t total = 0;
    for (face_counts& n : counts) {
        total += std::exchange(n.kept, total);
        result.statistics.collapsed += n.collapsed;
        result.statistics.degenerate += n.degenerate;
    }
    detail::base::resize_all(total, result.mesh.faces, result.face_source);
    for_chunks(faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::size_t at = counts[c].kept;
        for (std::size_t i = begin; i < end; ++i) {
            const face f = welded(faces[i]);
            if (!keep_degenerate && !detail::base::has_three_corners(f)) continue;
            result.mesh.faces[at] = f;
            result.face_source[at++] = static_cast<std::uint32_t>(i);
        }
    });
}

/// Places of the groups, and their properties.
void carry_points(points_view points, const attributes& properties, const weld_options& options,
                  weld_result& result) {
    std::vector<point3>& places = result.mesh.points;
    detail::base::resize_all(result.vertex_source.size(), places);
    detail::base::for_numbers(places.size(),
                              [&](std::size_t g) { places[g] = points[result.vertex_source[g]]; });
    result.attributes = detail::weld::carry_rows(properties, result);
    if (options.keep != weld_keep::mean) return;
    const detail::weld::group_members members(result.groups);
    detail::weld::take_means(points, members, places);
    const element* vertices = properties.find("vertex");
    if (vertices == nullptr) return;
    detail::weld::take_means(*vertices, members,
                             result.attributes.find_or_add("vertex", places.size()));
}

}  // namespace

weld_result weld(const mesh_ref& given, const attributes& properties, const weld_options& options) {
    const mesh_view mesh = given.view();
    detail::base::check_faces("weld", mesh.points.size(), mesh.faces);
    detail::weld::check_rows(properties, mesh.points.size(), mesh.faces.size());
    detail::weld::check_choices("weld", options.keep, !options.keep_by.empty(),
                                !options.order_by.empty(), options.highest_first);
    const bool by_property =
        options.keep == weld_keep::lowest || options.keep == weld_keep::highest;
    if (by_property) static_cast<void>(detail::weld::column_to_keep_by(properties, options));
    const std::vector<std::uint32_t> order =
        detail::weld::points_in_order(mesh.points, properties, options);
    weld_result result;
    weld_statistics& statistics = result.statistics;
    result.groups = find_groups(mesh, properties, options, order);
    result.status = result.groups.status;
    if (result.status == status::cancelled) return result;
    if (options.keep_manifold && !mesh.faces.empty()) {
        detail::weld::manifold_groups split = detail::weld::split_to_manifold(mesh, result.groups);
        result.groups = std::move(split.groups);
        if (!order.empty()) detail::weld::put_earliest_first(order, result.groups);
        statistics.kept_apart = split.split_up;
    }
    statistics.groups = detail::weld::count_groups_of_several(result.groups);
    statistics.non_finite = count_non_finite(mesh.points);
    result.vertex_source =
        detail::weld::kept_points(mesh.points, properties, options, result.groups);
    carry_faces(mesh.faces, options.keep_degenerate, result);
    carry_points(mesh.points, properties, options, result);
    if (options.tolerance > 0.0)  // else nothing has moved
        statistics.max_displacement = detail::weld::max_displacement(
            mesh.points, result.groups.group_of_point, result.mesh.points);
    if (mesh.faces.empty()) return result;
    if (statistics.max_displacement > 0.0)
        statistics.flipped = detail::weld::count_flipped(mesh, result.mesh, result.face_source);
    detail::base::parallel_invoke(
        [&] {
            statistics.nonmanifold_before =
                detail::weld::count_nonmanifold_edges(mesh.points.size(), mesh.faces);
        },
        [&] {
            statistics.nonmanifold_after =
                detail::weld::count_nonmanifold_edges(result.mesh.points.size(), result.mesh.faces);
        });
    return result;
}

weld_result weld(const mesh_ref& mesh, const weld_options& options) {
    return weld(mesh, {}, options);
}

}  // namespace treeform
