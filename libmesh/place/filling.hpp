#pragma once
/// \file
/// One attempt to put parts on plates, in a given order.

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

/// The parameters of an attempt, other than the order.
struct filling_style {
    bool square = false;   ///< measure the spacing along the axes, which suits rows of boxes
    bool compact = false;  ///< prefer the turn that enlarges the bounding box of all parts least
    /// [P] Random numbers r: only the turn r modulo the number of turns is used; 0, or empty: all.
    std::vector<std::uint32_t> only_turn{};
};

/// A plate that is filled part by part.
class plate_filling {
  public:
    plate_filling(const pack_shapes& shapes, const pack_options& options,
                  const filling_style& style);

    /// Puts the part at the first free position of one of its turns: the one that extends least
    /// far. Returns whether there is any.
    bool put(std::uint32_t part);

    [[nodiscard]] plate& result() { return plate_; }

  private:
    /// Enumerates the free positions of a part in one of its turns.
    struct search {
        const candidate* what;
        std::size_t number;  ///< number of the candidate
        cell_place inside;   ///< the last position on the plate
        cell_place last;     ///< the last position from which it may still move onto the plate
        cell_place from;
        /// rows that are not searched beyond `inside` after the next failure
        std::uint64_t skip = 1;
        /// row to search beyond `inside` from, counted through all layers
        std::uint64_t beyond_from = 0;
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
    std::vector<cell_place> searched_;  ///< by kind: no earlier position is free
};

/// Plates that are filled part by part, and the parts that fit on none.
class filling {
  public:
    filling(const pack_shapes& shapes, const pack_options& options, const filling_style& style);

    /// Puts the part on the first plate with a free position.
    void put(std::uint32_t part);

    [[nodiscard]] const std::vector<std::uint32_t>& left() const { return left_; }
    [[nodiscard]] double room_left() const { return room_left_; }
    [[nodiscard]] unsigned plates_used() const { return static_cast<unsigned>(plates_.size()); }
    [[nodiscard]] std::uint64_t pairs_measured();
    /// Moves out all parts with their positions; the plates are consumed.
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
