#pragma once
/// \file
/// Counts edges of more than two faces, of more faces than memory holds, which each rank has some
/// of. Records of a file, read in any order with a bounded share of memory.

#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace treeform::detail::stream {

using numbered_edge = std::uint64_t;               ///< by the point numbers of its ends
using placed_edge = std::array<std::uint64_t, 3>;  ///< by the coordinates of its ends, in floats

[[nodiscard]] inline numbered_edge edge_between(std::uint32_t a, std::uint32_t b) {
    return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

/// Equal if the ends have equal coordinates (-0 equals +0). \pre coordinates are float32 values
[[nodiscard]] inline placed_edge edge_between(const point3& a, const point3& b) {
    const auto bits = [](double x) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(x) + 0.0F)};
    };
    std::array<std::uint64_t, 3> from{bits(a.x), bits(a.y), bits(a.z)};
    std::array<std::uint64_t, 3> to{bits(b.x), bits(b.y), bits(b.z)};
    if (to < from) std::swap(from, to);
    return {from[0] << 32 | from[1], from[2] << 32 | to[0], to[1] << 32 | to[2]};
}

/// All uses of an edge are put into the same bucket; each bucket fits into memory. Each rank has a
/// file for its uses in each bucket, and counts a share of the buckets.
template <class Edge>
class TREEFORM_API edge_files {
  public:
    /// For at most `uses` of edges by all ranks together. File names are `name` followed by
    /// numbers. Uses about `memory` bytes.
    edge_files(const work_folder& folder, const communicator& all, std::string name,
               std::uint64_t uses, std::uint64_t memory);
    ~edge_files();
    edge_files(const edge_files&) = delete;
    edge_files& operator=(const edge_files&) = delete;

    /// Adds a use of an edge by a face.
    void put(const Edge& edge) {
        writers_[static_cast<std::size_t>((mixed(edge) >> 32) * writers_.size() >> 32)].put(edge);
    }
    /// The number of edges with more than two faces, over all ranks. Call it once, after all uses
    /// were put. Collective: every rank must call this. \throws io_error, cancelled
    [[nodiscard]] std::uint64_t count_nonmanifold(cancellable_progress& pace);

  private:
    [[nodiscard]] std::filesystem::path path(std::size_t bucket, std::size_t rank) const;
    [[nodiscard]] std::uint64_t count_bucket(std::size_t bucket,
                                             const std::vector<std::vector<record_count>>& counts,
                                             cancellable_progress& pace) const;
    static std::uint64_t mixed(std::uint64_t edge) { return edge * 0x9e3779b97f4a7c15; }
    static std::uint64_t mixed(const placed_edge& edge) {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : edge) sum = mixed(std::rotl(sum, 29) ^ word);
        return sum;
    }

    const work_folder& folder_;
    const communicator& all_;
    std::string name_;
    std::vector<record_writer<Edge>> writers_{};  ///< for each bucket
    std::size_t most_;                            ///< uses in memory at a time
};

extern template class edge_files<numbered_edge>;
extern template class edge_files<placed_edge>;

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
