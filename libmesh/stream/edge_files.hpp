#pragma once
/// \file
/// Counts edges of more than two faces, for more faces than fit into memory, distributed over
/// ranks.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/communicator.hpp>
#include <libmesh/stream/record_file.hpp>
#include <libmesh/stream/work_folder.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
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

}  // namespace treeform::detail::stream
