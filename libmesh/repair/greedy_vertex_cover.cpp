#include <libmesh/repair/greedy_vertex_cover.hpp>

#include <algorithm>
#include <queue>
#include <utility>

namespace treeform::detail::repair {
namespace {

using pair = std::array<std::uint32_t, 2>;

/// Takes the face in the most pairs, again and again. Pairs are given both ways, ascending.
void take_most_paired(const std::vector<pair>& pairs, std::vector<std::uint8_t>& taken) {
    std::vector<std::uint32_t> left(taken.size(), 0);
    for (const pair& p : pairs) ++left[p[0]];
    std::priority_queue<std::pair<std::uint32_t, std::uint32_t>> queue;  // by ~face: the lower one
    for (std::uint32_t f = 0; f < left.size(); ++f)
        if (left[f] > 0) queue.emplace(left[f], ~f);
    while (!queue.empty()) {
        const auto [count, inverted] = queue.top();
        queue.pop();
        const std::uint32_t f = ~inverted;
        if (taken[f] != 0 || count != left[f]) continue;
        taken[f] = 1;
        for (auto p = std::lower_bound(pairs.begin(), pairs.end(), pair{f, 0});
             p != pairs.end() && (*p)[0] == f; ++p)
            if (const std::uint32_t g = (*p)[1]; taken[g] == 0 && --left[g] > 0)
                queue.emplace(left[g], ~g);
    }
}

}  // namespace

std::vector<std::uint8_t> greedy_vertex_cover(std::span<const pair> pairs,
                                              std::span<const std::uint8_t> spared) {
    std::vector<std::uint8_t> taken(spared.size(), 0);
    for (const auto& [f, g] : pairs) {
        if (f == g || spared[f] == spared[g]) continue;
        taken[spared[f] != 0 ? g : f] = 1;
    }
    for (const auto& [f, g] : pairs)
        if (f == g || (spared[f] != 0 && spared[g] != 0)) taken[f] = taken[g] = 1;
    std::vector<pair> open;
    for (const auto& [f, g] : pairs) {
        if (taken[f] != 0 || taken[g] != 0) continue;
        open.push_back({f, g});
        open.push_back({g, f});
    }
    std::sort(open.begin(), open.end());
    open.erase(std::unique(open.begin(), open.end()), open.end());
    take_most_paired(open, taken);
    return taken;
}

}  // namespace treeform::detail::repair
