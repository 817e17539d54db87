#include <libmesh/boolean/minimum_cut.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace treeform::detail::boolean {
namespace {

constexpr std::uint32_t far_off = std::numeric_limits<std::uint32_t>::max();

/// The largest flow, path by path in layers of equal distance from the source.
class flow {
  public:
    explicit flow(const network& given)
        : source_(static_cast<std::uint32_t>(given.from_source.size())),
          sink_(source_ + 1),
          first_(std::size_t{sink_} + 2, 0),
          distance_(std::size_t{sink_} + 1) {
        std::vector<network_edge> edges = given.edges;
        for (std::uint32_t v = 0; v < source_; ++v) {
            // What flows through one node alone is in no one's way.
            const std::int64_t through = std::min(given.from_source[v], given.to_sink[v]);
            edges.push_back({source_, v, given.from_source[v] - through});
            edges.push_back({v, sink_, given.to_sink[v] - through});
        }
        std::erase_if(edges,
                      [](const network_edge& e) { return e.capacity == 0 || e.from == e.to; });
        for (const network_edge& e : edges) {
            ++first_[e.from + std::size_t{1}];
            ++first_[e.to + std::size_t{1}];
        }
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        next_ = first_;
        ways_.resize(2 * edges.size());
        for (const network_edge& e : edges) {
            const std::size_t there = next_[e.from]++, back = next_[e.to]++;
            ways_[there] = {e.to, back, e.capacity};
            ways_[back] = {e.from, there, 0};
        }
    }

    /// False where `stop` said so.
    bool run(function_ref<bool()> stop) {
        while (measure()) {
            next_ = first_;
            if (!push_through_layers(stop)) return false;
        }
        return true;
    }

    /// After the last round: whether there is still a way from the source.
    [[nodiscard]] bool is_reached(std::uint32_t v) const { return distance_[v] != far_off; }

  private:
    struct way {
        std::uint32_t to = 0;
        std::size_t back = 0;  ///< the same way, the other way round
        std::int64_t left = 0;
    };

    /// Distances from the source; whether they reach the sink.
    bool measure() {
        std::ranges::fill(distance_, far_off);
        distance_[source_] = 0;
        std::vector<std::uint32_t> queue{source_};
        for (std::size_t i = 0; i < queue.size(); ++i)
            for (std::size_t w = first_[queue[i]]; w < first_[queue[i] + std::size_t{1}]; ++w) {
                const std::uint32_t to = ways_[w].to;
                if (ways_[w].left == 0 || distance_[to] != far_off) continue;
                distance_[to] = distance_[queue[i]] + 1;
                queue.push_back(to);
            }
        return distance_[sink_] != far_off;
    }

    /// Fills every way that leads from layer to layer; false where `stop` said so.
    bool push_through_layers(function_ref<bool()> stop) {
        constexpr std::size_t steps_between_questions = std::size_t{1} << 16;
        std::vector<std::size_t> path;
        std::uint32_t at = source_;
        for (std::size_t step = 1;; ++step) {
            if (step % steps_between_questions == 0 && stop()) return false;
            if (at == sink_) {
                at = push_along(path);
                continue;
            }
            const std::size_t end = first_[at + std::size_t{1}];
            std::size_t& w = next_[at];
            while (w < end && (ways_[w].left == 0 || distance_[ways_[w].to] != distance_[at] + 1))
                ++w;
            if (w < end) {
                path.push_back(w);
                at = ways_[w].to;
            } else if (path.empty()) {
                return true;
            } else {
                at = ways_[ways_[path.back()].back].to;
                ++next_[at];
                path.pop_back();
            }
        }
    }

    /// As much as the path takes; it is cut where it is full first, and ends there.
    std::uint32_t push_along(std::vector<std::size_t>& path) {
        std::int64_t most = std::numeric_limits<std::int64_t>::max();
        for (const std::size_t w : path) most = std::min(most, ways_[w].left);
        std::size_t full = path.size();
        for (std::size_t i = path.size(); i-- > 0;) {
            way& w = ways_[path[i]];
            w.left -= most;
            ways_[w.back].left += most;
            if (w.left == 0) full = i;
        }
        const std::uint32_t from = ways_[ways_[path[full]].back].to;
        path.resize(full);
        return from;
    }

    std::uint32_t source_;
    std::uint32_t sink_;
    std::vector<std::size_t> first_;  ///< [N + 3] where the ways from each node begin
    std::vector<std::size_t> next_{};
    std::vector<way> ways_{};
    std::vector<std::uint32_t> distance_;
};

}  // namespace

std::optional<std::vector<std::uint8_t>> minimum_cut(const network& given,
                                                     function_ref<bool()> stop) {
    flow most(given);
    if (stop() || !most.run(stop)) return std::nullopt;
    std::vector<std::uint8_t> side(given.from_source.size());
    for (std::uint32_t v = 0; v < side.size(); ++v) side[v] = most.is_reached(v) ? 1 : 0;
    return side;
}

}  // namespace treeform::detail::boolean
