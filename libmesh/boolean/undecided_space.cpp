#include <libmesh/boolean/space_divider.hpp>
#include <libmesh/boolean/undecided_space.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::boolean {
namespace {

using node = halved_space::node;

/// Boxes that are worked on in parallel, and how many follow each other in a copy of the
/// expression.
constexpr std::size_t most_tasks = 512;
constexpr std::size_t tasks_a_chunk = 8;

/// Divides a box with all that is below it. One thread's work.
class subdivision {
  public:
    /// `state` is that of the boxes to be divided, and is given back as it was.
    subdivision(const divider& division, partial_expression& state)
        : division_(division), state_(state) {}

    /// The first node is the box.
    [[nodiscard]] std::vector<node> divide(const box_node& p) {
        nodes_.resize(1);
        if (!state_.value()) static_cast<void>(divide(p, 0));
        return std::move(nodes_);
    }

  private:
    /// Returns what has not been spent.
    double divide(const box_node& p, std::size_t own) {
        halves parts;
        const auto decides = [&](const std::vector<decided_component>& gone) {
            const auto changes = division_.changes_by(gone, p);
            decide(changes, true);
            const bool is_decided = state_.value().has_value();
            decide(changes, false);
            return is_decided;
        };
        if (!division_.is_worth_halving(p) || division_.cannot_prune(p, state_) ||
            !division_.halve(p, parts, decides)) {
            nodes_[own].axis = node::undecided;
            division_.mark_faces(p);
            return p.budget;
        }
        const std::size_t below = nodes_.size();
        nodes_[own] = {static_cast<std::uint8_t>(parts.axis), parts.at,
                       static_cast<std::uint32_t>(below)};
        nodes_.resize(below + 2);  // decided, until it turns out that they are not
        const std::array<half*, 2> part = {&parts.lower, &parts.upper};
        std::array<std::vector<range_change>, 2> known;
        std::array<bool, 2> is_decided{parts.lower.is_decided, parts.upper.is_decided};
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
            if (is_decided[i]) continue;
            known[i] = division_.changes_in(*part[i], p);
            decide(known[i], true);
            is_decided[i] = state_.value().has_value();
            decide(known[i], false);
        }
        double unspent = 0.0;
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
            if (is_decided[i])
                unspent += part[i]->budget +
                           pay_of_face * static_cast<double>(p.faces - part[1 - i]->faces);
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
            if (is_decided[i]) continue;
            part[i]->budget += unspent;
            decide(known[i], true);
            unspent = divide(*part[i], below + i);
            decide(known[i], false);
        }
        return unspent;
    }

    void decide(const std::vector<range_change>& known, bool is_known) {
        const std::int64_t sign = is_known ? 1 : -1;
        for (const auto& [operand, by] : known)
            state_.add(operand, {sign * by.low, sign * by.high});
    }

    const divider& division_;
    partial_expression& state_;
    std::vector<node> nodes_{};
};

/// A box that a task begins with.
struct task {
    box_node begin;
    std::vector<decided_component> known;  ///< that wind around it
    std::size_t at = 0;                    ///< its node
};

/// Halves everything into tasks, wide first, so that they are the same however many threads there
/// are; `nodes` are above them.
std::vector<task> divide_into_tasks(const divider& division, box_node&& everything,
                                    std::vector<node>& nodes) {
    nodes.resize(1);
    std::vector<task> tasks;
    tasks.push_back({std::move(everything), {}, 0});
    std::vector<task> whole;
    for (std::size_t next = 0; next < tasks.size(); ++next) {
        task above = std::move(tasks[next]);
        halves parts;
        if (tasks.size() - next + whole.size() >= most_tasks ||
            !division.is_worth_halving(above.begin) ||
            !division.halve(above.begin, parts, [](const auto&) { return false; })) {
            whole.push_back(std::move(above));
            continue;
        }
        const std::size_t below = nodes.size();
        nodes[above.at] = {static_cast<std::uint8_t>(parts.axis), parts.at,
                           static_cast<std::uint32_t>(below)};
        nodes.resize(below + 2);
        for (half* part : {&parts.lower, &parts.upper}) {
            std::vector<decided_component> known = std::move(part->gone);
            std::erase_if(known, [](const decided_component& c) { return c.winding == 0; });
            known.insert(known.end(), above.known.begin(), above.known.end());
            tasks.push_back(
                {std::move(*part), std::move(known), part == &parts.lower ? below : below + 1});
        }
    }
    return whole;
}

/// Puts what is below a task's box into `nodes`.
void append(const std::vector<node>& below, std::size_t at, std::vector<node>& nodes) {
    const auto shift = static_cast<std::uint32_t>(nodes.size() - 1);
    const auto moved = [&](node n) {
        n.below += shift;
        return n;
    };
    nodes[at] = moved(below.front());
    for (std::size_t i = 1; i < below.size(); ++i) nodes.push_back(moved(below[i]));
}

}  // namespace

bool undecided_space::is_divided(const surface_components& components,
                                 const division_limits& limits) {
    std::vector<std::uint8_t> none;
    const divider division(components, limits, none);
    return division.is_worth_halving(division.everything());
}

undecided_space::undecided_space(const surface_components& components,
                                 const partial_expression& at_nowhere,
                                 const division_limits& limits)
    : is_undecided_face_(components.mesh().faces.size(), 0) {
    const divider division(components, limits, is_undecided_face_);
    box_node everything = division.everything();
    halves_.box = everything.box;
    std::vector<node>& nodes = halves_.nodes;
    std::vector<task> tasks = divide_into_tasks(division, std::move(everything), nodes);
    std::vector<std::vector<node>> found(tasks.size());
    for_chunks(tasks.size(), tasks_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        partial_expression state = at_nowhere;
        for (std::size_t i = begin; i < end; ++i) {
            const auto assign = [&](std::int64_t sign) {
                division.assign(state, tasks[i].begin, sign > 0);
                for (const auto& [c, winding] : tasks[i].known)
                    state.add(components.operand(c), winding_range::only(sign * winding));
            };
            assign(1);
            found[i] = subdivision(division, state).divide(tasks[i].begin);
            assign(-1);
            tasks[i].begin = {};
        }
    });
    for (std::size_t i = 0; i < tasks.size(); ++i) append(found[i], tasks[i].at, nodes);
}

}  // namespace treeform::detail::boolean
