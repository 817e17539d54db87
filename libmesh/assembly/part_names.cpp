#include <libmesh/assembly/part_names.hpp>
#include <treeform/mesh/clash.hpp>

#include <algorithm>

namespace treeform {

using detail::assembly::matches;

bool detail::assembly::matches(std::string_view pattern, std::string_view name) {
    // Where a star is behind us, the rest may begin one further on.
    std::size_t p = 0, n = 0, star = std::string_view::npos, after_star = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            after_star = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++after_star;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

std::vector<part_pair> pairs_named(std::span<const std::string> names, std::string_view first,
                                   std::string_view second) {
    std::vector<std::uint32_t> of_first, of_second;
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        if (matches(first, names[i])) of_first.push_back(i);
        if (matches(second, names[i])) of_second.push_back(i);
    }
    std::vector<part_pair> pairs;
    for (const std::uint32_t i : of_first)
        for (const std::uint32_t j : of_second)
            if (i != j) pairs.push_back({std::min(i, j), std::max(i, j)});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace treeform
