#pragma once
/// \file
/// The parts of a packing, each in all of its turns.

#include <libmesh/place/plate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/pack.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
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

}  // namespace treeform::detail::place
