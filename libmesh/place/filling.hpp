#pragma once
/// \file
/// One try to put parts on plates, in some order.

#include <libmesh/place/pack_shapes.hpp>
#include <libmesh/place/plate.hpp>
#include <treeform/mesh/pack.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// In what a try differs from others, beside the order.
struct filling_style {
    bool square = false;   ///< spacing along the axes, as rows of boxes have it
    bool compact = false;  ///< of the turns the one that the box around all grows least by
    /// [P] The one turn to use, as a random number; empty, or 0: all.
    std::vector<std::uint32_t> only_turn{};
};

/// A plate that is filled part by part.
class plate_filling {
  public:
    plate_filling(const pack_shapes& shapes, const pack_options& options,
                  const filling_style& style);

    /// At the first free places of all its turns, and of these where it reaches least far.
    bool put(std::uint32_t part);

    [[nodiscard]] plate& result() { return plate_; }

  private:
    /// The free places of a part in one of its turns, one after the other.
    struct search {
        const candidate* what;
        std::size_t number;  ///< of the candidate
        cell_place inside;   ///< the last place on the plate
        cell_place last;     ///< the last that the gaps of the raster may let it be moved from
        cell_place from;
        std::uint64_t skip = 1;         ///< rows not to look beyond `inside` after the next failure
        std::uint64_t beyond_from = 0;  ///< row, counted through all layers
        std::optional<cell_place> found{};

        [[nodiscard]] bool beyond() const {
            return found->layer > inside.layer || found->row > inside.row ||
                   found->column > inside.column;
        }
        [[nodiscard]] std::uint64_t row() const {
            return std::uint64_t{found->layer} * (std::uint64_t{last.row} + 1) + found->row;
        }
        [[nodiscard]] bool at_end() const {
            return last.layer > 0 ? found->layer > inside.layer : found->row > inside.row;
        }
        [[nodiscard]] cell_place next_row() const { return {found->layer, found->row + 1, 0}; }
    };

    [[nodiscard]] search begin(const candidate& c, std::size_t number) const;
    void find(search& s) const;
    void next(search& s) const;
    [[nodiscard]] std::array<double, 3> reach(const search& s) const;

    const pack_shapes& shapes_;
    const pack_options& options_;
    const filling_style& style_;
    double cell_;
    plate plate_;
    std::vector<cell_place> searched_;  ///< by kind: nothing before is free
};

/// Plates that are filled part by part, and what has found no place.
class filling {
  public:
    filling(const pack_shapes& shapes, const pack_options& options, const filling_style& style);

    /// On the first plate that takes it.
    void put(std::uint32_t part);

    [[nodiscard]] const std::vector<std::uint32_t>& left() const { return left_; }
    [[nodiscard]] double room_left() const { return room_left_; }
    [[nodiscard]] unsigned plates_used() const { return static_cast<unsigned>(plates_.size()); }
    [[nodiscard]] std::uint64_t pairs_measured();
    /// All parts, where they are. What was built is gone then.
    [[nodiscard]] std::vector<packed_part> take_parts();

  private:
    const pack_shapes& shapes_;
    const pack_options& options_;
    const filling_style& style_;
    std::vector<pack_options> plate_options_;
    std::vector<std::unique_ptr<plate_filling>> plates_;
    std::vector<std::uint32_t> left_;
    double room_left_ = 0.0;
};

}  // namespace treeform::detail::place
