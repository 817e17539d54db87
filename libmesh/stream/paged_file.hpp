#pragma once
/// \file
/// Random access to the records of a file, with bounded memory.

#include <libmesh/stream/record_file.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

/// A direct-mapped cache of the pages read last.
template <class Record>
class paged_file {
  public:
    /// For `count` records; uses about `memory` bytes.
    paged_file(std::filesystem::path path, std::uint64_t count, std::uint64_t memory)
        : file_(std::move(path)), count_(count) {
        const std::uint64_t most = std::max<std::uint64_t>(memory / (page * sizeof(Record)), 16);
        slots_ = static_cast<std::size_t>(std::min(most, count / page + 1));
        held_.assign(slots_, none);
        records_.resize(slots_ * page);
    }

    /// \pre    `i` is less than the count
    /// \throws io_error
    [[nodiscard]] const Record& at(std::uint64_t i) {
        const std::uint64_t p = i / page;
        const std::size_t slot = static_cast<std::size_t>(p % slots_);
        if (held_[slot] != p) load(p, slot);
        return records_[slot * page + static_cast<std::size_t>(i % page)];
    }
    /// Looks up the records with the numbers `of`, all below 2^32. If the last lookups were
    /// scattered over the file, they are made in ascending order, so that each page is read once.
    ///
    /// \throws io_error
    template <class To>
    void look_up(std::span<const std::uint32_t> of, std::vector<To>& found) {
        constexpr std::uint64_t numbers_a_load = 16;
        const std::uint64_t before = loads_;
        std::uint64_t far = 0;  // lookups far from the one before, which would soon evict its page
        found.resize(of.size());
        if (is_scattered_) {
            sorted_.clear();
            for (std::size_t i = 0; i < of.size(); ++i) {
                const auto [low, high] = std::minmax(of[i], of[i == 0 ? 0 : i - 1]);
                far += high - low > slots_ * page / 4 ? 1 : 0;
                sorted_.push_back(std::uint64_t{of[i]} << 32 | i);
            }
            std::sort(sorted_.begin(), sorted_.end());
            for (const std::uint64_t s : sorted_)
                found[static_cast<std::uint32_t>(s)] = static_cast<To>(at(s >> 32));
        } else {
            for (std::size_t i = 0; i < of.size(); ++i) found[i] = static_cast<To>(at(of[i]));
        }
        is_scattered_ = std::max(loads_ - before, far) * numbers_a_load > of.size();
    }
    /// Whether lookups are scattered; then larger batches read fewer pages.
    [[nodiscard]] bool is_scattered() const { return is_scattered_; }

  private:
    static constexpr std::size_t page = sizeof(Record) > 8 ? 128 : 512;
    static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

    void load(std::uint64_t p, std::size_t slot) {
        const auto some =
            static_cast<std::size_t>(std::min<std::uint64_t>(page, count_ - p * page));
        const auto bytes = std::as_writable_bytes(std::span(records_).subspan(slot * page, some));
        held_[slot] = none;
        ++loads_;
        if (file_.read(p * page * sizeof(Record), bytes) != bytes.size())
            fail_damaged(file_.path());
        held_[slot] = p;
    }

    open_file file_;
    std::uint64_t count_;
    std::size_t slots_ = 1;
    std::vector<std::uint64_t> held_{};
    std::vector<Record> records_{};
    std::uint64_t loads_ = 0;
    bool is_scattered_ = false;
    std::vector<std::uint64_t> sorted_{};  ///< numbers to look up, each with its position
};

}  // namespace treeform::detail::stream
