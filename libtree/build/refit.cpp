#include <treeform/tree/detail/node_bounds.hpp>
#include <treeform/tree/detail/refit_levels.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/refit.hpp>

#include <algorithm>
#include <limits>

namespace treeform {
namespace detail {
namespace {

constexpr std::size_t nodes_per_chunk = 512;

/// Below this many blocks a touched place, sweeping a byte a block beats sorting the places.
constexpr std::size_t blocks_per_place = 16;

std::vector<leaf_slots> slots_by_sorting(std::vector<std::uint32_t> places) {
    std::sort(places.begin(), places.end());
    std::vector<leaf_slots> result;
    for (const std::uint32_t place : places) {
        if (result.empty() || result.back().block != place / 8) result.push_back({place / 8, 0});
        result.back().slots = static_cast<std::uint8_t>(result.back().slots | 1U << place % 8);
    }
    return result;
}

/// The parents of nodes that are given ascending.
void to_parents(std::vector<std::uint32_t>& nodes) {
    for (std::uint32_t& node : nodes) node /= 8;
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// The sum of the extents of the boxes of a node, empty ones left out. Those of float boxes, even
/// infinite ones, are far from the ends of double.
template <std::size_t D>
double extents(const wide_node<D>& node) {
    constexpr float limit = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t slot = 0; slot < tree<D>::width; ++slot)
        for (std::size_t k = 0; k < D && node.min[0][slot] <= node.max[0][slot]; ++k)
            sum += static_cast<double>(std::min(node.max[k][slot], limit)) -
                   static_cast<double>(std::max(node.min[k][slot], -limit));
    return sum;
}

}  // namespace

std::vector<leaf_slots> slots_at(std::span<const std::uint32_t> places, std::size_t size) {
    const std::size_t blocks = chunk_count(size, 8);
    if (places.size() < blocks / blocks_per_place)
        return slots_by_sorting({places.begin(), places.end()});
    std::vector<std::uint8_t> slots(blocks);
    for (const std::uint32_t place : places)
        slots[place / 8] = static_cast<std::uint8_t>(slots[place / 8] | 1U << place % 8);
    std::vector<leaf_slots> result;
    result.reserve(std::min(blocks, places.size()));
    for (std::uint32_t block = 0; block < blocks; ++block)
        if (slots[block] != 0) result.push_back({block, slots[block]});
    return result;
}

template <std::size_t D>
std::size_t write_boxes(tree<D>& tree, const box_block<D>& boxes,
                        std::span<const std::uint32_t> places) {
    split_record records[box_block<D>::size];
    half_extents halves[box_block<D>::size];
    const std::size_t sound = round_boxes(tree.frame(), boxes, places.size(), 0, records, halves);
    wide_node<D>* const leaves = tree.level_data(tree.levels() - 1);
    for (std::size_t i = 0; i < sound; ++i) {
        wide_node<D>& leaf = leaves[places[i] / 8];
        for (std::size_t k = 0; k < D; ++k) {
            const float half = halves[i].template on_axis<D>(k);
            leaf.min[k][places[i] % 8] = records[i].center[k] - half;
            leaf.max[k][places[i] % 8] = records[i].center[k] + half;
        }
    }
    return sound;
}

template <std::size_t D>
void lift_inner(tree<D>& tree) {
    for (unsigned level = tree.levels() - 1; level-- > 1;)
        for_chunks(tree.nodes_in_level(level), 8 * nodes_per_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t node = begin; node < end; ++node) lift(tree, level, node);
                   });
}

template <std::size_t D>
void lift_inner(tree<D>& tree, std::span<const leaf_slots> changed) {
    std::vector<std::uint32_t> nodes(changed.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = changed[i].block;
    for (unsigned level = tree.levels() - 1; level-- > 1;) {
        to_parents(nodes);
        for_chunks(nodes.size(), nodes_per_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t) {
                       for (std::size_t i = begin; i < end; ++i) lift(tree, level, nodes[i]);
                   });
    }
}

template std::size_t write_boxes(tree<2>&, const box_block<2>&, std::span<const std::uint32_t>);
template std::size_t write_boxes(tree<3>&, const box_block<3>&, std::span<const std::uint32_t>);
template void lift_inner(tree<2>&);
template void lift_inner(tree<3>&);
template void lift_inner(tree<2>&, std::span<const leaf_slots>);
template void lift_inner(tree<3>&, std::span<const leaf_slots>);

}  // namespace detail

template <std::size_t D>
double search_cost(const tree<D>& tree) {
    if (tree.empty()) return 1.0;
    const detail::node_bounds<D> bounds(tree.level(0)[0]);
    wide_node<D> whole;
    for (std::size_t slot = 0; slot < tree.width; ++slot) detail::clear_slot(whole, slot);
    for (std::size_t k = 0; k < D; ++k) {
        whole.min[k][0] = bounds.min[k];
        whole.max[k][0] = bounds.max[k];
    }
    const double of_whole = detail::extents(whole);
    double sum = of_whole;
    for (unsigned level = 0; level + 1 < tree.levels(); ++level) {
        const std::span<const wide_node<D>> nodes = tree.level(level);
        std::vector<double> sums(chunk_count(nodes.size(), detail::nodes_per_chunk));
        for_chunks(nodes.size(), detail::nodes_per_chunk,
                   [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                       for (std::size_t node = begin; node < end; ++node)
                           sums[chunk] += detail::extents(nodes[node]);
                   });
        for (const double part : sums) sum += part;
    }
    return of_whole > 0.0 ? sum / of_whole : 1.0;
}

template <std::size_t D>
std::vector<std::uint32_t> leaf_positions(const tree<D>& tree) {
    std::vector<std::uint32_t> places(tree.size());
    for_chunks(tree.size(), std::size_t{1} << 14,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                   for (std::size_t place = begin; place < end; ++place)
                       places[tree.ids()[place]] = static_cast<std::uint32_t>(place);
               });
    return places;
}

template double search_cost(const tree<2>&);
template double search_cost(const tree<3>&);
template std::vector<std::uint32_t> leaf_positions(const tree<2>&);
template std::vector<std::uint32_t> leaf_positions(const tree<3>&);

}  // namespace treeform
