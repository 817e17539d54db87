#pragma once
/// \file
/// Scale and offset of a LAS file for points that come by runs, more than once.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <limits>
#include <optional>
#include <span>

namespace treeform::detail::io {

/// What of scale and offset somebody has asked for.
struct las_grid_wish {
    std::optional<std::array<double, 3>> scale{};
    std::optional<std::array<double, 3>> offset{};

    /// In a header that a file had.
    void put(las_header& header) const {
        if (scale) header.scale = *scale;
        if (offset) header.offset = *offset;
    }
};

/// The scale is the coarsest power of ten that gives each coordinate back within two units in the
/// last place of the largest one, else the finest of which 32 bits hold all. The steps are counted
/// from 0, or from the middle where that takes more than 32 bits.
///
/// Give all points to `look`, then all to `try_on`, and these again as long as `must_try_again`.
class las_grid_choice {
  public:
    struct range {
        double low = std::numeric_limits<double>::infinity();
        double high = -std::numeric_limits<double>::infinity();
    };
    using digits = std::array<int, 3>;  ///< of each axis: the scale is a tenth to the power of it

    void look(std::span<const point3> points);
    [[nodiscard]] const std::array<range, 3>& ranges() const { return ranges_; }
    /// All that others have looked at.
    void add(std::size_t axis, const range& seen);

    void try_on(std::span<const point3> points);
    /// Whether a finer scale than at the start of the round has been tried.
    [[nodiscard]] bool must_try_again() const { return moved_ && tried_; }
    [[nodiscard]] const digits& tried() const { return digits_; }
    /// The next round; with scales that are at least as fine as these.
    void start_round(const digits& least);

    void put(las_header& header) const;
    /// With what is wished for in its place; the rest goes with that.
    void put(las_header& header, const las_grid_wish& wish) const;

  private:
    static constexpr int most_digits = 12;

    [[nodiscard]] bool may_be(std::size_t axis, int d) const;
    [[nodiscard]] double offset(std::size_t axis, int d) const;
    [[nodiscard]] bool holds(std::size_t axis, std::span<const point3> points) const;

    std::array<range, 3> ranges_{};
    digits digits_{};
    bool tried_ = false;  ///< points, with the scales of the start
    bool moved_ = false;
};

}  // namespace treeform::detail::io
