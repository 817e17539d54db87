#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/reach.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform {
namespace {

using numbers = std::vector<std::uint32_t>;

constexpr std::size_t largest_count = std::numeric_limits<std::uint32_t>::max() - 1;

/// Cuts the members of one place, ascending, into what may be joined, and writes the first
/// of each part. By `first`, one agrees with the earliest that was kept.
void split_kept(std::span<const std::uint32_t> members, const weld_options& options,
                numbers& first_of) {
    numbers kept;
    for (const std::uint32_t i : members) {
        const auto agreed = std::find_if(kept.begin(), kept.end(), [&](std::uint32_t other) {
            return options.may_merge(i, other);
        });
        first_of[i] = agreed == kept.end() ? i : *agreed;
        if (agreed == kept.end()) kept.push_back(i);
    }
}

/// By `chain`, one joins all parts in which another agrees with it.
void split_chains(std::span<const std::uint32_t> members, const weld_options& options,
                  numbers& first_of) {
    std::vector<numbers> parts;
    for (const std::uint32_t i : members) {
        numbers joined;
        std::erase_if(parts, [&](const numbers& part) {
            const bool agreed = std::any_of(part.begin(), part.end(), [&](std::uint32_t other) {
                return options.may_merge(i, other);
            });
            if (agreed) joined.insert(joined.end(), part.begin(), part.end());
            return agreed;
        });
        joined.push_back(i);
        parts.push_back(std::move(joined));
    }
    for (const numbers& part : parts)
        for (const std::uint32_t i : part)
            first_of[i] = *std::min_element(part.begin(), part.end());
}

/// Equal points that differ by `may_merge`.
void split_by_agreement(const weld_options& options, numbers& first_of) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> placed;  // first, then point
    for (std::uint32_t i = 0; i < first_of.size(); ++i)
        if (first_of[i] != i) placed.emplace_back(first_of[i], i);
    std::sort(placed.begin(), placed.end());
    for (std::size_t begin = 0; begin < placed.size();) {
        numbers members{placed[begin].first};
        std::size_t end = begin;
        for (; end < placed.size() && placed[end].first == members[0]; ++end)
            members.push_back(placed[end].second);
        if (!options.chain)
            split_kept(members, options, first_of);
        else
            split_chains(members, options, first_of);
        begin = end;
    }
}

numbers by_equality(points_view points, const weld_options& options) {
    numbers first_of = detail::weld::equal_firsts(points, options.label);
    detail::base::for_numbers(points.size(), [&](std::size_t i) {
        if (first_of[i] != i && !detail::base::is_finite(points[i]))
            first_of[i] = static_cast<std::uint32_t>(i);
    });
    if (options.may_merge) split_by_agreement(options, first_of);
    return first_of;
}

void check(const char* called, points_view points, const weld_options& options) {
    const auto refuse = [&](const std::string& why) {
        throw std::invalid_argument(std::string("treeform::") + called + ": " + why);
    };
    detail::weld::check_tolerance(called, options.tolerance);
    if (points.size() > largest_count) refuse("more than 2^32 - 2 points");
    if (!options.label.empty() && options.label.size() != points.size())
        refuse(std::to_string(options.label.size()) + " labels for " +
               std::to_string(points.size()) + " points");
}

}  // namespace

point_groups detail::weld::find_groups(const char* called, points_view points,
                                       const weld_options& given, neighbor_search search) {
    check(called, points, given);
    bool stopped = false;
    double furthest = 0.0;
    weld_options options = given;
    if (given.progress)
        options.progress = [&](double done) {
            furthest = std::max(furthest, done);
            stopped = stopped || !given.progress(furthest);
            return !stopped;
        };
    const auto may_continue = [&](double done) {
        return !options.progress || options.progress(done);
    };

    point_groups result;
    numbers& first_of = result.group_of_point;
    const bool by_first = !options.chain;
    if (!may_continue(0.0)) return {{}, {}, status::cancelled};
    if (options.tolerance == 0.0) {
        first_of = by_equality(points, options);
    } else {
        const bool in_tiles =
            search == neighbor_search::automatic && detail::weld::can_be_tiled(points, options);
        const auto missing = [&] { return first_of.size() != points.size() && !stopped; };
        if (!in_tiles || !detail::weld::is_window_wide(points, options.tolerance))
            first_of = by_first ? detail::weld::sparse_leaders(points, options, search)
                                : detail::weld::sparse_chains(points, options, search);
        if (in_tiles && missing()) first_of = detail::weld::tiled_leaders(points, options);
        if (missing())
            first_of = by_first ? detail::weld::dense_leaders(points, options)
                                : detail::weld::dense_chains(points, options);
    }
    if (stopped || !may_continue(0.95)) return {{}, {}, status::cancelled};
    result.first_of_group = detail::weld::number_groups(first_of);
    if (!may_continue(1.0)) return {{}, {}, status::cancelled};
    return result;
}

std::uint64_t detail::weld::count_groups_of_several(const point_groups& groups) {
    const std::vector<std::uint32_t>& group_of = groups.group_of_point;
    std::vector<std::uint8_t> has_several(groups.first_of_group.size(), 0);
    detail::base::for_numbers(group_of.size(), [&](std::size_t i) {
        if (groups.first_of_group[group_of[i]] != i)
            std::atomic_ref(has_several[group_of[i]]).store(1, std::memory_order_relaxed);
    });
    return static_cast<std::uint64_t>(std::ranges::count(has_several, 1));
}

point_groups group_points(points_view points, const weld_options& options) {
    return detail::weld::find_groups("group_points", points, options);
}

std::uint64_t count_nearly_equal(points_view points, double distance) {
    const std::size_t distinct = group_points(points, {.tolerance = 0.0}).first_of_group.size();
    return distinct - group_points(points, {.tolerance = distance}).first_of_group.size();
}

mesh point_groups::joined(mesh_view mesh) const {
    const point_groups& groups = *this;
    if (groups.group_of_point.size() != mesh.points.size())
        throw std::invalid_argument("treeform::join_groups: groups of " +
                                    std::to_string(groups.group_of_point.size()) + " points for " +
                                    std::to_string(mesh.points.size()));
    detail::base::check_faces("join_groups", mesh.points.size(), mesh.faces);
    treeform::mesh result;
    result.points.reserve(groups.first_of_group.size());
    for (const std::uint32_t i : groups.first_of_group) result.points.push_back(mesh.points[i]);
    result.faces.reserve(mesh.faces.size());
    for (const face& f : mesh.faces)
        result.faces.push_back({groups.group_of_point[f[0]], groups.group_of_point[f[1]],
                                groups.group_of_point[f[2]]});
    return result;
}

}  // namespace treeform
