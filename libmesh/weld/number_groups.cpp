#include <libmesh/base/resize_all.hpp>
#include <libmesh/weld/number_groups.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>

namespace treeform::detail::weld {

std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point) {
    constexpr std::size_t grain = light_grain;
    std::vector<std::uint32_t>& first = group_of_point;
    std::vector<std::uint32_t> next(chunk_count(first.size(), grain), 0);
    for_chunks(first.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i) next[c] += first[i] == i ? 1 : 0;
    });
    std::uint32_t total = 0;
    for (std::uint32_t& n : next) {
        const std::uint32_t count = n;
        n = total;
        total += count;
    }
    std::vector<std::uint32_t> first_of_group;
    base::resize_all(total, first_of_group);
    buffer<std::uint32_t> number_of(first.size());
    for_chunks(first.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::uint32_t n = next[c];
        for (std::size_t i = begin; i < end; ++i) {
            if (first[i] != i) continue;
            first_of_group[n] = static_cast<std::uint32_t>(i);
            number_of[i] = n++;
        }
    });
    for_chunks(first.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) first[i] = number_of[first[i]];
    });
    return first_of_group;
}

}  // namespace treeform::detail::weld
