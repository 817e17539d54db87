#include "tools/shell/shared_digests.hpp"

#include "tools/shell/sha256.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Files one after the other as one run of bytes, which one process after the other reads on.
class digests {
  public:
    explicit digests(const std::vector<fs::path>& paths) : paths_(paths) {
        for (const fs::path& path : paths) {
            std::error_code error;
            const std::uint64_t size = fs::file_size(path, error);
            sizes_.push_back(error ? 0 : size);
            total_ += sizes_.back();
        }
    }

    [[nodiscard]] std::uint64_t total() const { return total_; }
    [[nodiscard]] std::vector<std::string> finished() && { return std::move(finished_); }

    /// Reads so many bytes, and finishes the files that end with them.
    void read(std::uint64_t bytes) {
        while (finished_.size() < paths_.size()) {
            const std::size_t file = finished_.size();
            const std::uint64_t some = std::min(bytes, sizes_[file] - at_);
            is_read_ = is_read_ && open_.add_from(paths_[file], at_, some);
            at_ += some;
            bytes -= some;
            if (at_ < sizes_[file]) return;
            finished_.push_back(is_read_ ? open_.hex() : std::string());
            open_ = {};
            is_read_ = true;
            at_ = 0;
        }
    }

    /// What another process needs to go on.
    [[nodiscard]] std::string sent() const {
        std::string text;
        for (const std::string& one : finished_) text += one.empty() ? unreadable : one;
        return text + open_.state() + (is_read_ ? '1' : '0');
    }
    /// What another rank has sent, which has read so many bytes of all.
    void take(std::string_view received, std::uint64_t read) {
        const std::size_t state_size = open_.state().size();
        finished_.clear();
        at_ = read;
        for (; received.size() > state_size + 1; received.remove_prefix(unreadable.size())) {
            const std::string_view one = received.substr(0, unreadable.size());
            at_ -= std::min(at_, sizes_[finished_.size()]);
            finished_.emplace_back(one == unreadable ? std::string_view() : one);
        }
        open_ = sha256(received.substr(0, state_size));
        is_read_ = received.back() == '1';
    }

  private:
    static inline const std::string unreadable = std::string(64, '-');

    const std::vector<fs::path>& paths_;
    std::vector<std::uint64_t> sizes_{};
    std::uint64_t total_ = 0;
    std::vector<std::string> finished_{};
    sha256 open_{};         ///< of the next file
    bool is_read_ = true;   ///< what was to be read of it
    std::uint64_t at_ = 0;  ///< bytes of it
};

}  // namespace

std::vector<std::string> digests_for_report(const std::vector<fs::path>& paths,
                                            const tile_options& tiles) {
    const tf::communicator& all_ranks = tiles.communicator;
    if (tiles.report.empty()) return std::vector<std::string>(paths.size());
    digests all(paths);
    const auto begin = [&](std::uint64_t rank) {
        return all.total() / all_ranks.size * rank +
               all.total() % all_ranks.size * rank / all_ranks.size;
    };
    for (std::size_t rank = 0; rank < all_ranks.size; ++rank) {
        const bool mine = rank == all_ranks.rank;
        if (mine) all.read(begin(rank + 1) - begin(rank));
        if (all_ranks.size == 1) break;
        const std::vector<std::string> received =
            all_ranks.exchange(mine ? all.sent() : std::string());
        all.take(received[rank], begin(rank + 1));
    }
    return std::move(all).finished();
}

}  // namespace tools
