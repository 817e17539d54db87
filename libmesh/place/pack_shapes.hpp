#pragma once
/// \file
/// Parts to be packed, each in all its turns.

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

/// A part in one of its turns, as the raster sees it.
struct candidate {
    unsigned turn = 0;
    point3 size{};
    footprint cells{};
    std::uint32_t kind = 0;  ///< its number among all footprints, equal ones by one number
};

struct part_shape {
    std::vector<candidate> candidates{};  ///< those that are not larger than the plate
    double room = 0.0;                    ///< area covered, or volume, of the first
    double longest = 0.0;                 ///< side of its box, of those that count
};

/// All parts of a packing. Equal parts share a shape.
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
    [[nodiscard]] double cell() const { return cell_; }  ///< length; 0: no part has a candidate
    [[nodiscard]] std::size_t kinds() const { return kinds_; }
    /// The part in the turn of its candidate `c`. May be asked for on any threads at once.
    [[nodiscard]] std::shared_ptr<const turned> in_turn(std::uint32_t part, std::size_t c) const;

  private:
    struct slot {
        once made{};
        std::shared_ptr<const turned> part{};
    };

    void number_kinds();

    std::span<const prepared_mesh> parts_;
    std::vector<std::uint32_t> distinct_;  ///< [P] the first part equal to each
    std::vector<part_shape> shapes_;       ///< by part; of others than the first of equals empty
    double cell_ = 0.0;
    std::size_t kinds_ = 0;
    std::vector<std::unique_ptr<slot[]>> slots_;  ///< by part and candidate; none: not to be kept
};

}  // namespace treeform::detail::place
