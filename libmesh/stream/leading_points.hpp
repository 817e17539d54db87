#pragma once
/// \file
/// Moves points at the begin of a part of a file to an earlier part, so that all parts have a
/// multiple of some number of points.

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
    /// The process has `mine` points, which follow those of lower ranks; parts must have a multiple
    /// of `together` points. Collective: every rank must call this. \pre the points have no lists
    leading_points(const work_folder& folder, const communicator& all, const std::string& name,
                   const mesh_file& header, std::uint64_t mine, std::uint64_t together);

    /// Removes points that belong to an earlier part from the front of the next block.
    void take_off(io::point_block& block);
    /// Calls `write` with the points of later ranks that complete this part. Collective: every rank
    /// must call this.
    void give(const std::function<void(const io::point_block&)>& write);

  private:
    const mesh_file& header_;
    packed_points packed_;
    all_to_all exchanged_;
    std::uint64_t left_ = 0;  ///< points left that belong to an earlier part
    std::size_t to_ = 0;      ///< the rank of that part
    std::vector<std::uint64_t> row_{};
};

}  // namespace treeform::detail::stream
