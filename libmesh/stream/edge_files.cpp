#include <libmesh/stream/edge_files.hpp>

#include <algorithm>
#include <system_error>

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
edge_files<Edge>::edge_files(const work_folder& folder, const std::string& name, std::uint64_t uses,
                             std::uint64_t memory)
    : most_(static_cast<std::size_t>(std::max<std::uint64_t>(memory / sizeof(Edge), 4096))) {
    constexpr std::uint64_t most_files = 1024;
    const std::uint64_t files = std::min(uses / (most_ / 4 * 3) + 1, most_files);
    const std::uint64_t share = std::clamp<std::uint64_t>(memory / files, 4096, bytes_at_a_time);
    for (std::uint64_t i = 0; i < files; ++i) {
        paths_.push_back(folder.file(name + "." + std::to_string(i)));
        writers_.emplace_back(paths_.back(), static_cast<std::size_t>(share));
    }
}

template <class Edge>
edge_files<Edge>::~edge_files() {
    std::error_code ignored;
    for (const auto& path : paths_) std::filesystem::remove(path, ignored);
}

template <class Edge>
std::uint64_t edge_files<Edge>::count_nonmanifold(pacer& pace) {
    std::vector<record_count> counts;
    for (record_writer<Edge>& writer : writers_) counts.push_back(writer.finish_unsynced());
    std::uint64_t count = 0;
    std::vector<Edge> uses;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        uses.clear();
        record_reader<Edge> reader(paths_[i], counts[i], bytes_at_a_time);
        for (auto some = reader.next(); !some.empty(); some = reader.next()) {
            uses.insert(uses.end(), some.begin(), some.end());
            if (uses.size() > most_) leave_three(uses);
            pace.check();
        }
        leave_three(uses);
        count += count_threes(uses);
        std::filesystem::remove(paths_[i]);
    }
    return count;
}

template class edge_files<numbered_edge>;
template class edge_files<placed_edge>;

}  // namespace treeform::detail::stream
