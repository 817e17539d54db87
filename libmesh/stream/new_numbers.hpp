#pragma once
/// \file
/// The numbers of points after welding.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <cstdint>
#include <optional>

namespace treeform::detail::stream {

/// The number of a kept point in the written file, or that of the kept point of its group. Must be
/// requested one by one, from the first point assigned to the process on.
class new_numbers {
  public:
    /// Collective: every rank must call this, for its points.
    new_numbers(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                tile_steps& steps, tiles_welded& welded);

    [[nodiscard]] std::uint64_t of(std::uint64_t point);

  private:
    void ask_others(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                    const tile_steps& steps);

    tiles_welded& welded_;
    tile_steps::leaders leaders_;
    std::uint64_t before_ = 0;  ///< number of kept points of lower ranks
    /// with several ranks: dropped points and their numbers
    std::optional<row_merge> of_dropped_{};
};

}  // namespace treeform::detail::stream
