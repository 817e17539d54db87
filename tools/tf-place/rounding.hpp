#pragma once
/// \file
/// What the coordinates that are written have lost at the place.

#include "tools/tf-place/body.hpp"
#include <libmesh/round/rounding_harm.hpp>
#include <treeform/tf.hpp>

#include <optional>
#include <vector>

namespace tools {

struct rounding {
    double max_move = 0.0;  ///< largest change of a coordinate beside that of the move
    double step = 0.0;      ///< between neighbouring numbers, at the largest coordinate
    bool noticeable = false;
    std::optional<tf::rounding_harm> harm{};  ///< looked at where steps are coarser than before
};

/// Compares `b` with its points at the place, to which `matrix` is the move. It is noticeable where
/// doubles become float32, and where a move is more than a millionth of the size.
/// \pre `b.file` is still what was read, or was moved by --start
[[nodiscard]] rounding look_at_rounding(job& work, const body& b, const tf::transform<3>& matrix,
                                        const std::vector<tf::point3>& placed, bool to_single);

/// Enters them, as one, in the report, and says what is noticeable or harmful.
void enter_rounding(job& work, const std::vector<rounding>& all, bool to_single);

}  // namespace tools
