#include <libmesh/arrange/point_numbering.hpp>
#include <libmesh/base/compact.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/base/running_sums.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/intersect/same_points.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace treeform::detail::arrange {
namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t cuts_a_chunk = 64;
constexpr std::size_t points_a_chunk = std::size_t{1} << 7;  // they are large

/// `named`, and the points that clusters made, which are taken from them.
std::vector<implicit_point> with_made(std::vector<implicit_point> named,
                                      std::vector<cut_cluster>& cuts,
                                      std::vector<std::uint32_t>& made_begin) {
    const std::vector<std::size_t> made =
        base::running_sums(cuts.size(), [&](std::size_t c) { return cuts[c].made.size(); });
    const std::size_t count = named.size();
    // Points are large: room for all that are made, and no more.
    if (made.back() > 0) {
        std::vector<implicit_point> all;
        base::resize_all(count + made.back(), all);
        for_chunks(count, points_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
            std::copy(named.data() + begin, named.data() + end, all.data() + begin);
        });
        named = std::move(all);
    }
    made_begin.resize(cuts.size());
    for_chunks(cuts.size(), cuts_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t c = begin; c < end; ++c) {
            made_begin[c] = static_cast<std::uint32_t>(count + made[c]);
            std::copy(cuts[c].made.begin(), cuts[c].made.end(), named.data() + made_begin[c]);
            cuts[c].made = std::vector<implicit_point>();
        }
    });
    return named;
}

/// \throws std::invalid_argument where two given points are equal
void check_same(std::size_t given, const std::vector<cut_cluster>& cuts) {
    const auto is_bad = [&](const std::pair<std::uint32_t, std::uint32_t>& same) {
        return std::max(same.first, same.second) < given;
    };
    const std::size_t bad = base::first_bad(
        cuts.size(), [&](std::size_t c) { return std::ranges::any_of(cuts[c].same, is_bad); });
    if (bad == cuts.size()) return;
    const auto [a, b] = *std::ranges::find_if(cuts[bad].same, is_bad);
    throw std::invalid_argument("treeform::arrange_faces: points " +
                                std::to_string(std::min(a, b)) + " and " +
                                std::to_string(std::max(a, b)) + " are equal");
}

/// Joins items that are one point, and returns which of them are given ones: item, given point.
std::vector<std::array<std::uint32_t, 2>> join_same(std::size_t given,
                                                    const std::vector<cut_cluster>& cuts,
                                                    base::union_find& sets) {
    std::vector<std::vector<std::array<std::uint32_t, 2>>> is_given(
        chunk_count(cuts.size(), cuts_a_chunk));
    for_chunks(cuts.size(), cuts_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                   for (std::size_t c = begin; c < end; ++c)
                       for (auto [a, b] : cuts[c].same) {
                           if (a > b) std::swap(a, b);
                           const auto item = static_cast<std::uint32_t>(b - given);
                           if (a < given)
                               is_given[chunk].push_back({item, a});
                           else
                               sets.join(static_cast<std::uint32_t>(a - given), item);
                       }
               });
    return base::flattened(std::move(is_given));
}

}  // namespace

point_numbering number_points(std::size_t given, std::vector<implicit_point> named,
                              std::vector<cut_cluster>& cuts) {
    point_numbering result;
    std::vector<implicit_point> items = with_made(std::move(named), cuts, result.made_begin);
    base::union_find sets(items.size());
    check_same(given, cuts);
    const auto is_given = join_same(given, cuts, sets);
    for (const auto& [a, b] : intersect::equal_pairs(items)) sets.join(a, b);
    std::vector<std::uint32_t>& number = result.of_item;  // by root first
    number.assign(items.size(), no_number);
    for (const auto& [item, point] : is_given) number[sets.root(item)] = point;

    // Named points that no face kept (they are corners by another name, or lie in faces that a
    // lower name covers) take no number of their own: a set is numbered once.
    const auto root = sets.take_roots();
    std::vector<std::uint32_t> kept;
    base::compact(
        items.size(), [&](std::size_t i) { return root[i] == i && number[i] == no_number; },
        [&](std::size_t count) { kept.resize(count); },
        [&](std::size_t i, std::size_t place) {
            number[i] = static_cast<std::uint32_t>(given + place);
            kept[place] = static_cast<std::uint32_t>(i);
        });
    for_chunks(items.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i)
            if (root[i] != i) number[i] = number[root[i]];
    });
    if (kept.size() < items.size()) {
        base::resize_all(kept.size(), result.constructed);
        for_chunks(kept.size(), points_a_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i)
                           result.constructed[i] = items[kept[i]];
                   });
    } else {
        result.constructed = std::move(items);
    }
    return result;
}

}  // namespace treeform::detail::arrange
