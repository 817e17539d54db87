#pragma once
/// \file
/// Parts of a file that have a multiple of some number of points: those at the begin of a part that
/// make up an earlier one.

#include <libmesh/stream/all_to_all.hpp>
#include <libmesh/stream/kept_rows.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace treeform::detail::stream {

class leading_points {
  public:
    /// Of a process that has `mine` of the points, between those of lower and of higher ranks;
    /// parts have a multiple of `together`. Collective: every rank must call this. \pre no lists
    leading_points(const work_folder& folder, const communicator& all, const std::string& name,
                   const mesh_file& header, std::uint64_t mine, std::uint64_t together);

    /// Takes those of an earlier part off the front of the next points.
    void take_off(io::point_block& block);
    /// Gives those of later processes that make up the part. Collective: every rank must call this.
    void give(const std::function<void(const io::point_block&)>& write);

  private:
    const mesh_file& header_;
    packed_points packed_;
    all_to_all exchanged_;
    std::uint64_t left_ = 0;  ///< that are of an earlier part
    std::size_t to_ = 0;      ///< and whose
    std::vector<std::uint64_t> row_{};
};

}  // namespace treeform::detail::stream
