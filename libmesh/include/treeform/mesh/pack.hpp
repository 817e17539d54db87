#pragma once
/// \file
/// Puts parts side by side on a plate.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/prepared_mesh.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/transform.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace treeform {

/// How many turns about the vertical are tried for each part.
enum class plate_turns : std::uint8_t {
    none,
    quarter,  ///< 4, by 90 degrees
    eighth,   ///< 8, by 45 degrees
    any,      ///< 24, by 15 degrees
};

/// The plate, and how to fill it.
struct pack_options {
    /// Length, depth and height of the plate or box. The height may be infinite.
    point3 size{0.0, 0.0, std::numeric_limits<double>::infinity()};
    point3 corner{};       ///< corner of the plate with the lowest x and y; its z is the bed
    double spacing = 2.0;  ///< least distance of any two parts; parts may touch the plate's rim
    plate_turns turns = plate_turns::quarter;
    bool tighten = true;     ///< close the gaps that the raster leaves
    std::uint64_t seed = 0;  ///< for the other orders, tried when not all parts fit in the first
    unsigned attempts = 4;   ///< number of orders tried; at least 1
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

/// A part on the plate.
struct packed_part {
    bool placed = false;
    /// [V] the new points, as they are to be written; unchanged when the part is not placed.
    std::vector<point3> points{};
    /// new = M * old, a turn about z and a translation; the identity when the part is not placed.
    /// `points` differ from it by a few units in the last place of the largest coordinate.
    transform<3> matrix{};
};

/// A filled plate.
struct packing {
    std::vector<packed_part> parts{};         ///< [P] in the order of the input
    std::vector<std::uint32_t> not_placed{};  ///< numbers of parts without a place, ascending
    /// Pairs of parts whose faces were compared, because their boxes are nearer than the spacing.
    std::uint64_t pairs_measured = 0;
    double bed = 0.0;  ///< z of the lowest point of each placed part, as written
    /// ok: what `pack` promises of the points holds, also where parts have no place. Otherwise
    /// `cancelled`, and the rest is empty.
    treeform::certificate certificate{};

    explicit operator bool() const { return static_cast<bool>(certificate); }
};

/// Puts the parts on the plate, each turned about z by one of `turns` and standing on the bed with
/// its lowest point.
///
/// For the coordinates in `points`, as written:
/// - The lowest z of a placed part is exactly that of the bed (with float32, the least one not
///   below it).
/// - No coordinate is outside the plate or above its height.
/// - Any two placed parts are at least `spacing` apart, by their exact boxes or by `distance` less
///   its error. With a spacing of 0, parts may touch only in a plane that separates their boxes.
///
/// Parts are not stacked. But a small part may stand in a hole of another, and `tighten` may move a
/// part below an overhang.
///
/// This is a search, and a part that is not placed may have had a place. Parts are taken in the
/// order of the area that they cover. Each goes to the free place of the least y, then x, on a
/// raster of about 512 cells a side, and is then moved down y and x until something is in the way.
/// Parts without faces take no room: they are placed where they are. Points that no face uses move
/// along with their part and are otherwise ignored.
///
/// \throws std::invalid_argument naming the part with a corner out of range or not finite, and
///         for options that are negative, NaN, or (except for the height) not finite
/// \cost   for each part and turn a raster, O(F), and a few milliseconds to search a free place;
///         for the place chosen a tree over the part and some `distance` to each neighbor
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API packing pack(std::span<const mesh_view> parts,
                                        const pack_options& options);
[[nodiscard]] TREEFORM_API packing pack(std::span<const prepared_mesh> parts,
                                        const pack_options& options);

}  // namespace treeform
