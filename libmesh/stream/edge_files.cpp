#include <libmesh/stream/edge_files.hpp>

#include <algorithm>
#include <system_error>
#include <utility>

namespace treeform::detail::stream {
namespace {

constexpr std::size_t bytes_at_a_time = std::size_t{1} << 20;

/// Sorts uses, and leaves at most three of each edge.
template <class Edge>
void leave_three(std::vector<Edge>& uses) {
    std::sort(uses.begin(), uses.end());
    std::size_t kept = 0;
    for (const Edge& edge : uses)
        if (kept < 3 || uses[kept - 3] != edge) uses[kept++] = edge;
    uses.resize(kept);
}

/// Of sorted uses, at most three an edge.
template <class Edge>
std::uint64_t count_threes(const std::vector<Edge>& uses) {
    std::uint64_t count = 0;
    for (std::size_t i = 2; i < uses.size(); ++i) count += uses[i] == uses[i - 2] ? 1 : 0;
    return count;
}

}  // namespace

template <class Edge>
edge_files<Edge>::edge_files(const work_folder& folder, const communicator& all, std::string name,
                             std::uint64_t uses, std::uint64_t memory)
    : folder_(folder),
      all_(all),
      name_(std::move(name)),
      most_(static_cast<std::size_t>(std::max<std::uint64_t>(memory / sizeof(Edge), 4096))) {
    constexpr std::uint64_t most_buckets = 1024;
    constexpr std::uint64_t buckets_of_each = 8;  // of the ranks, so that shares are alike
    const std::uint64_t least = all.is_alone() ? 1 : buckets_of_each * all.size();
    const std::uint64_t buckets =
        std::min(std::max(uses / (most_ / 4 * 3) + 1, least), most_buckets);
    const std::uint64_t share = std::clamp<std::uint64_t>(memory / buckets, 4096, bytes_at_a_time);
    for (std::size_t b = 0; b < buckets; ++b)
        writers_.emplace_back(path(b, all.rank()), static_cast<std::size_t>(share));
}

template <class Edge>
edge_files<Edge>::~edge_files() {
    std::error_code ignored;
    for (std::size_t b = 0; b < writers_.size(); ++b)
        std::filesystem::remove(path(b, all_.rank()), ignored);
}

template <class Edge>
std::filesystem::path edge_files<Edge>::path(std::size_t bucket, std::size_t rank) const {
    return folder_.file(name_ + "." + std::to_string(bucket) + "." + std::to_string(rank));
}

template <class Edge>
std::uint64_t edge_files<Edge>::count_nonmanifold(cancellable_progress& pace) {
    state_writer mine;
    for (record_writer<Edge>& writer : writers_) store_count(writer.finish_unsynced(), mine);
    std::vector<std::vector<record_count>> counts;  // of [a] process in [b] bucket
    for (state_reader& one : all_.exchange(mine)) {
        std::vector<record_count>& some = counts.emplace_back();
        for (std::size_t b = 0; b < writers_.size(); ++b) some.push_back(load_count(one));
    }
    std::uint64_t count = 0;
    const share buckets = all_.share_of(writers_.size(), all_.rank());
    for (std::uint64_t b = buckets.first; b < buckets.last; ++b)
        count += count_bucket(static_cast<std::size_t>(b), counts, pace);
    return all_.sum(count);
}

template <class Edge>
std::uint64_t edge_files<Edge>::count_bucket(std::size_t bucket,
                                             const std::vector<std::vector<record_count>>& counts,
                                             cancellable_progress& pace) const {
    std::vector<Edge> uses;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        record_reader<Edge> reader(path(bucket, r), counts[r][bucket], bytes_at_a_time);
        for (auto some = reader.next(); !some.empty(); some = reader.next()) {
            uses.insert(uses.end(), some.begin(), some.end());
            if (uses.size() > most_) leave_three(uses);
            pace.check();
        }
        std::filesystem::remove(path(bucket, r));
    }
    leave_three(uses);
    return count_threes(uses);
}

template class edge_files<numbered_edge>;
template class edge_files<placed_edge>;

}  // namespace treeform::detail::stream
