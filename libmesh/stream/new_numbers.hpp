#pragma once
/// \file
/// The numbers that points have when they are welded.

#include <libmesh/stream/cancellable_progress.hpp>
#include <libmesh/stream/tile_steps.hpp>

#include <cstdint>
#include <optional>

namespace treeform::detail::stream {

/// Of kept points those in the files that are written, of others those of the points that they
/// belong to; asked for one by one, from the first point that is assigned to the process on.
class new_numbers {
  public:
    /// Collective: every rank must call this, with its points.
    new_numbers(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                tile_steps& steps, tiles_welded& welded);

    [[nodiscard]] std::uint64_t of(std::uint64_t point);

  private:
    void ask_others(cancellable_progress& pace, const work_folder& folder, const communicator& all,
                    const tile_steps& steps);

    tiles_welded& welded_;
    tile_steps::leaders leaders_;
    std::uint64_t before_ = 0;               ///< kept points of lower ranks
    std::optional<row_merge> of_dropped_{};  ///< of several ranks: points and their numbers
};

}  // namespace treeform::detail::stream
