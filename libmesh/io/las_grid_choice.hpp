#pragma once
/// \file
/// Chooses scale and offset of a LAS file from points in blocks, in several passes.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <limits>
#include <optional>
#include <span>

namespace treeform::detail::io {

/// Requested scale and offset.
struct las_grid_wish {
    std::optional<std::array<double, 3>> scale{};
    std::optional<std::array<double, 3>> offset{};

    /// Sets them in the header of a file.
    void put(las_header& header) const {
        if (scale) header.scale = *scale;
        if (offset) header.offset = *offset;
    }
};

/// The scale is the coarsest power of ten that reproduces each coordinate within two units in the
/// last place of the largest one, else the finest one for which 32 bits suffice. The offset is 0,
/// or the middle of the range if 32 bits do not suffice with 0.
///
/// Pass all points to `look`, then all to `try_on`; repeat the latter as long as `must_try_again`.
class las_grid_choice {
  public:
    struct range {
        double low = std::numeric_limits<double>::infinity();
        double high = -std::numeric_limits<double>::infinity();
    };
    /// for each axis: the scale is 10 to the power of minus this
    using digits = std::array<int, 3>;

    void look(std::span<const point3> points);
    [[nodiscard]] const std::array<range, 3>& ranges() const { return ranges_; }
    /// Adds the range of points that others have passed to `look`.
    void add(std::size_t axis, const range& seen);

    void try_on(std::span<const point3> points);
    /// Whether the scale became finer in this round.
    [[nodiscard]] bool must_try_again() const { return moved_ && tried_; }
    [[nodiscard]] const digits& tried() const { return digits_; }
    /// Begins the next round, with scales at least as fine as `least`.
    void start_round(const digits& least);

    void put(las_header& header) const;
    /// Sets the requested values, and chooses the others to match.
    void put(las_header& header, const las_grid_wish& wish) const;

  private:
    static constexpr int most_digits = 12;

    [[nodiscard]] bool may_be(std::size_t axis, int d) const;
    [[nodiscard]] double offset(std::size_t axis, int d) const;
    [[nodiscard]] bool holds(std::size_t axis, std::span<const point3> points) const;

    std::array<range, 3> ranges_{};
    digits digits_{};
    bool tried_ = false;  ///< whether points were tried with the scales of the start of the round
    bool moved_ = false;
};

}  // namespace treeform::detail::io
