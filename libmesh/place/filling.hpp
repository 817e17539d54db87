#pragma once
/// \file
/// Parts to be packed, each in all its turns; one try to put them on plates, in some order.

#include <libmesh/place/plate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tree/parallel.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// A part in one of its turns, as cells of the raster.
struct candidate {
    unsigned turn = 0;
    point3 size{};
    footprint cells{};
    std::uint32_t kind = 0;  ///< number of its footprint; equal footprints share a number
};

struct part_shape {
    std::vector<candidate> candidates{};  ///< turns that fit on the plate
    double room = 0.0;     ///< area covered (or volume, if stacked) by the first candidate
    double longest = 0.0;  ///< its longest side, of those along the axes used
};

/// All parts of a packing. Equal parts share one shape.
class pack_shapes {
  public:
    /// \pre the parts were checked
    pack_shapes(std::span<const prepared_mesh> parts, const pack_options& options,
                const progress_callback& progress);

    [[nodiscard]] std::size_t size() const { return parts_.size(); }
    [[nodiscard]] const prepared_mesh& part(std::uint32_t i) const { return parts_[i]; }
    [[nodiscard]] const part_shape& operator[](std::uint32_t i) const {
        return shapes_[distinct_[i]];
    }
    /// side of a cell; 0: no part has a candidate
    [[nodiscard]] double cell() const { return cell_; }
    [[nodiscard]] std::size_t kinds() const { return kinds_; }
    /// The part in the turn of its candidate `c`. Thread-safe.
    [[nodiscard]] std::shared_ptr<const turned> in_turn(std::uint32_t part, std::size_t c) const;

  private:
    struct slot {
        once made{};
        std::shared_ptr<const turned> part{};
    };

    void number_kinds();

    std::span<const prepared_mesh> parts_;
    std::vector<std::uint32_t> distinct_;  ///< [P] the first part that equals it
    std::vector<part_shape> shapes_;       ///< by part; empty for duplicates of an earlier part
    double cell_ = 0.0;
    std::size_t kinds_ = 0;
    /// cache by part and candidate; empty: no caching
    std::vector<std::unique_ptr<slot[]>> slots_;
};

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
