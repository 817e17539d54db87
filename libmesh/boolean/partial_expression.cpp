#include <libmesh/boolean/partial_expression.hpp>

#include <utility>

namespace treeform::detail::boolean {
bool is_inside(fill_rule rule, std::int64_t winding) {
    switch (rule) {
        case fill_rule::even_odd:
            return winding % 2 != 0;
        case fill_rule::positive:
            return winding > 0;
        case fill_rule::nonzero:
            break;
    }
    return winding != 0;
}

partial_expression::partial_expression(const boolean_expression& expression, fill_rule rule)
    : rule_(rule),
      range_(expression.operand_count()),
      leaf_begin_(expression.operand_count() + 1, 0) {
    // Of each token that is an operand, the leaf; leaves are nodes without members.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> leaf_of_operand;
    std::vector<std::uint32_t> values;
    for (const std::int32_t token : expression.postfix()) {
        if (token >= 0) {
            const auto leaf = static_cast<std::uint32_t>(nodes_.size());
            nodes_.push_back({});
            leaf_of_operand.emplace_back(static_cast<std::uint32_t>(token), leaf);
            values.push_back(leaf);
            continue;
        }
        const std::uint32_t right = values.back();
        values.pop_back();
        values.back() = combine(token, values.back(), right);
    }
    for (const auto& [operand, leaf] : leaf_of_operand) ++leaf_begin_[operand + 1];
    for (std::size_t k = 0; k < range_.size(); ++k) leaf_begin_[k + 1] += leaf_begin_[k];
    leaves_.resize(leaf_of_operand.size());
    std::vector<std::size_t> next(leaf_begin_.begin(), leaf_begin_.end() - 1);
    for (const auto& [operand, leaf] : leaf_of_operand) leaves_[next[operand]++] = leaf;
    if (values.empty()) return;
    root_ = values.back();
    if (nodes_[root_].members == 0) {  // a formula of one operand
        nodes_.push_back({});
        const auto above = static_cast<std::uint32_t>(nodes_.size() - 1);
        hang(root_, above);
        root_ = above;
    }
    // At first no count knows of any leaf.
    for (const std::uint32_t leaf : leaves_) count(leaf, truth::unknown, truth::is_false);
}

std::uint32_t partial_expression::combine(std::int32_t token, std::uint32_t left,
                                          std::uint32_t right) {
    kind of = kind::odd;
    if (token == boolean_expression::add) of = kind::any;
    if (token == boolean_expression::intersect || token == boolean_expression::minus)
        of = kind::all;
    const auto can_take = [&](std::uint32_t n) {
        return nodes_[n].members > 0 && nodes_[n].of == of;
    };
    nodes_[right].is_negated = token == boolean_expression::minus;
    if (can_take(left)) {
        hang(right, left);
        return left;
    }
    if (can_take(right) && !nodes_[right].is_negated) {
        hang(left, right);
        return right;
    }
    const auto above = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({.of = of});
    hang(left, above);
    hang(right, above);
    return above;
}

void partial_expression::hang(std::uint32_t below, std::uint32_t above) {
    nodes_[below].parent = above;
    ++nodes_[above].members;
}

partial_expression::truth partial_expression::truth_of(const node& n) {
    if (n.of == kind::any) {
        if (n.are_true > 0) return truth::is_true;
        return n.are_false == n.members ? truth::is_false : truth::unknown;
    }
    if (n.of == kind::all) {
        if (n.are_false > 0) return truth::is_false;
        return n.are_true == n.members ? truth::is_true : truth::unknown;
    }
    if (n.are_true + n.are_false < n.members) return truth::unknown;
    return n.are_true % 2 == 1 ? truth::is_true : truth::is_false;
}

partial_expression::truth partial_expression::truth_of(const winding_range& range) const {
    const auto either = [](bool is_true) { return is_true ? truth::is_true : truth::is_false; };
    switch (rule_) {
        case fill_rule::positive:
            if (range.low > 0 || range.high <= 0) return either(range.low > 0);
            return truth::unknown;
        case fill_rule::even_odd:
            return range.low == range.high ? either(range.low % 2 != 0) : truth::unknown;
        default:
            if (range.low > 0 || range.high < 0) return truth::is_true;
            return range.low == range.high ? truth::is_false : truth::unknown;
    }
}

void partial_expression::count(std::uint32_t at, truth before, truth now) {
    for (; before != now && nodes_[at].parent != none; at = nodes_[at].parent) {
        node& above = nodes_[nodes_[at].parent];
        const truth above_before = truth_of(above);
        const bool turn = nodes_[at].is_negated;
        const auto counter = [&](truth t) {
            return (t == truth::is_true) != turn ? &above.are_true : &above.are_false;
        };
        if (before != truth::unknown) --*counter(before);
        if (now != truth::unknown) ++*counter(now);
        before = above_before;
        now = truth_of(above);
    }
}

void partial_expression::add(std::uint32_t operand, const winding_range& change) {
    winding_range& range = range_[operand];
    const truth before = truth_of(range);
    range.low += change.low;
    range.high += change.high;
    const truth now = truth_of(range);
    for (std::size_t i = leaf_begin_[operand]; i < leaf_begin_[operand + 1]; ++i)
        count(leaves_[i], before, now);
}

std::optional<bool> partial_expression::value() const {
    if (root_ == none) return false;
    const truth result = truth_of(nodes_[root_]);
    if (result == truth::unknown) return std::nullopt;
    return result == truth::is_true;
}

}  // namespace treeform::detail::boolean
