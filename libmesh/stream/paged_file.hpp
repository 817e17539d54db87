#pragma once
/// \file
/// Records of a file, read in any order with a bounded share of memory.

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

/// Keeps the pages that were read last, each in the one slot that it can be in.
template <class Record>
class paged_file {
  public:
    /// Of `count` records; about `memory` bytes are held.
    paged_file(std::filesystem::path path, std::uint64_t count, std::uint64_t memory)
        : file_(std::move(path)), count_(count) {
        const std::uint64_t most = std::max<std::uint64_t>(memory / (page * sizeof(Record)), 16);
        slots_ = static_cast<std::size_t>(std::min(most, count / page + 1));
        held_.assign(slots_, none);
        records_.resize(slots_ * page);
    }

    /// \pre    `i` is less than the count
    /// \throws stream_error
    [[nodiscard]] const Record& at(std::uint64_t i) {
        const std::uint64_t p = i / page;
        const std::size_t slot = static_cast<std::size_t>(p % slots_);
        if (held_[slot] != p) load(p, slot);
        return records_[slot * page + static_cast<std::size_t>(i % page)];
    }

  private:
    static constexpr std::size_t page = sizeof(Record) > 8 ? 128 : 512;
    static constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();

    void load(std::uint64_t p, std::size_t slot) {
        const auto some =
            static_cast<std::size_t>(std::min<std::uint64_t>(page, count_ - p * page));
        const auto bytes = std::as_writable_bytes(std::span(records_).subspan(slot * page, some));
        held_[slot] = none;
        if (file_.read(p * page * sizeof(Record), bytes) != bytes.size())
            fail_damaged(file_.path());
        held_[slot] = p;
    }

    open_file file_;
    std::uint64_t count_;
    std::size_t slots_ = 1;
    std::vector<std::uint64_t> held_{};
    std::vector<Record> records_{};
};

}  // namespace treeform::detail::stream
