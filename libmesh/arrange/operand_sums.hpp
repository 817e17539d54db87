#pragma once
/// \file
/// Signed counts of covering faces, by operand.

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

namespace treeform::detail::arrange {

/// An input face, counted +1 or -1 for its operand.
struct counted_face {
    std::uint32_t operand;
    std::uint32_t face;
    int sign;
    friend auto operator<=>(const counted_face&, const counted_face&) = default;
};

/// Calls `visit(c)` for the lowest face of each operand whose signs do not add up to 0, ascending
/// by operand. Sorts `counted`.
template <class Visit>
void for_each_remaining(std::vector<counted_face>& counted, const Visit& visit) {
    std::sort(counted.begin(), counted.end());
    for (auto at = counted.begin(); at != counted.end();) {
        const auto first = at;
        std::int64_t sum = 0;
        for (; at != counted.end() && at->operand == first->operand; ++at) sum += at->sign;
        if (sum != 0) visit(*first);
    }
}

[[nodiscard]] inline bool cancel_out(std::vector<counted_face>& counted) {
    bool nothing_remains = true;
    for_each_remaining(counted, [&](const counted_face&) { nothing_remains = false; });
    return nothing_remains;
}

}  // namespace treeform::detail::arrange
