#include <libmesh/weld/agreement.hpp>
#include <libmesh/weld/vertex_values.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace treeform::detail::weld {

agreement::agreement(std::vector<condition> conditions) : conditions_(std::move(conditions)) {
    transitive_ = std::all_of(conditions_.begin(), conditions_.end(),
                              [](const condition& c) { return c.tolerance == 0.0; });
}

bool agreement::holds(const std::uint64_t* a, const std::uint64_t* b) const {
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const condition& c = conditions_[i];
        if (a[i] == b[i]) continue;
        if (c.tolerance == 0.0 || !keys_agree(c.whole, a[i], b[i], c.tolerance)) return false;
    }
    return true;
}

bool agreement::same(const std::uint64_t* a, const std::uint64_t* b) const {
    return std::equal(a, a + conditions_.size(), b);
}

std::uint64_t agreement::salt(const std::uint64_t* values) const {
    std::uint64_t h = 0;
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        if (conditions_[i].tolerance > 0.0) continue;
        h = (h ^ values[i] ^ h >> 32) * 0x9e3779b97f4a7c15;
        h ^= h >> 29;
    }
    return h;
}

bool agreement::equal_before(const std::uint64_t* a, const std::uint64_t* b) const {
    for (std::size_t i = 0; i < conditions_.size(); ++i)
        if (conditions_[i].tolerance == 0.0 && a[i] != b[i]) return a[i] < b[i];
    return false;
}

std::vector<std::uint32_t> agreement::labels(std::span<const std::uint64_t> rows) const {
    if (size() == 0) return {};
    std::vector<std::uint32_t> order(rows.size() / size());
    std::iota(order.begin(), order.end(), 0U);
    const auto row = [&](std::uint32_t i) { return rows.data() + i * size(); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return equal_before(row(a), row(b)); });
    std::vector<std::uint32_t> label(order.size());
    for (std::size_t k = 1; k < order.size(); ++k)
        label[order[k]] =
            label[order[k - 1]] + (equal_before(row(order[k - 1]), row(order[k])) ? 1U : 0U);
    return label;
}

}  // namespace treeform::detail::weld
