#include <libmesh/stream/edge_files.hpp>

#include <algorithm>
#include <system_error>

namespace treeform::detail::stream {
namespace {

/// Sorts uses, and leaves at most three of each edge.
void leave_three(std::vector<std::uint64_t>& uses) {
    std::sort(uses.begin(), uses.end());
    std::size_t kept = 0;
    for (const std::uint64_t edge : uses)
        if (kept < 3 || uses[kept - 3] != edge) uses[kept++] = edge;
    uses.resize(kept);
}

/// Of sorted uses, at most three an edge.
std::uint64_t count_threes(const std::vector<std::uint64_t>& uses) {
    std::uint64_t count = 0;
    for (std::size_t i = 2; i < uses.size(); ++i) count += uses[i] == uses[i - 2] ? 1 : 0;
    return count;
}

}  // namespace

edge_files::edge_files(const work_folder& folder, const std::string& name, std::uint64_t uses,
                       std::uint64_t memory)
    : most_(static_cast<std::size_t>(std::max<std::uint64_t>(memory / 8, 4096))) {
    constexpr std::uint64_t most_files = 1024;
    const std::uint64_t files = std::min(uses / (most_ / 4 * 3) + 1, most_files);
    const std::uint64_t share = std::clamp<std::uint64_t>(memory / files, 4096, piece_of_edges);
    for (std::uint64_t i = 0; i < files; ++i) {
        paths_.push_back(folder.file(name + "." + std::to_string(i)));
        writers_.emplace_back(paths_.back(), static_cast<std::size_t>(share));
    }
}

edge_files::~edge_files() {
    std::error_code ignored;
    for (const auto& path : paths_) std::filesystem::remove(path, ignored);
}

std::uint64_t edge_files::count_nonmanifold(pacer& pace) {
    std::vector<record_count> counts;
    for (row_writer& writer : writers_) counts.push_back(writer.finish_unsynced());
    std::uint64_t count = 0;
    std::vector<std::uint64_t> uses;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        uses.clear();
        record_reader<std::uint64_t> reader(paths_[i], counts[i], piece_of_edges);
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

}  // namespace treeform::detail::stream
