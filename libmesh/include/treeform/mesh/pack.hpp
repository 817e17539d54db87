#pragma once
/// \file
/// Parts put beside each other on a plate.

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

/// Turns about the vertical that are tried.
enum class plate_turns : std::uint8_t {
    none,
    quarter,  ///< 4, by 90 degrees
    eighth,   ///< 8, by 45 degrees
    any,      ///< 24, by 15 degrees
};

struct pack_options {
    /// Length, depth and height of the plate or box. The height may be infinite.
    point3 size{0.0, 0.0, std::numeric_limits<double>::infinity()};
    point3 corner{};  ///< of the plate: lowest x, y; its z is the bed
    double spacing =
        2.0;  ///< least distance of any two parts; nothing is kept from the plate's rim
    plate_turns turns = plate_turns::quarter;
    bool tighten = true;     ///< close the gaps that the raster leaves
    std::uint64_t seed = 0;  ///< of the orders tried when not all parts fit in the first one
    unsigned attempts = 4;   ///< orders tried in all; at least 1
    treeform::precision precision = treeform::precision::float64;  ///< of the points returned
    progress_callback progress{};
};

struct packed_part {
    bool placed = false;
    /// [V] as they are to be written; as they were when the part is not placed.
    std::vector<point3> points{};
    /// new = M * old, a turn about z and a translation; the identity when the part is not placed.
    /// `points` are within a few units in the last place of the largest coordinate, old or new.
    transform<3> matrix{};
};

struct packing {
    std::vector<packed_part> parts{};         ///< [P] in the order given
    std::vector<std::uint32_t> not_placed{};  ///< numbers of parts that found no place, ascending
    /// Pairs of parts whose boxes are nearer than the spacing, so that their faces were looked at.
    std::uint64_t pairs_measured = 0;
    double bed = 0.0;  ///< z of the lowest point of each placed part, as written
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: the rest is empty
};

/// Places for the parts on the plate, each part turned about z by one of `turns` and standing on
/// the bed with its lowest point.
///
/// What is said of the coordinates in `points`, as written: the lowest z of a placed part is
/// exactly that of the bed (the least float32 not below it, where these are asked for); no
/// coordinate is outside of the plate or above its height; any two placed parts are at least
/// `spacing` apart, decided on the exact boxes or by `distance` (not squared) less its error. With
/// a spacing of 0 parts have no common point unless it is in a plane that separates their boxes.
/// Parts are not put on or under each other, except for what `tighten` moves below an overhang; a
/// small one may stand in the hole of another.
///
/// It is a search: parts in the order of the area they cover, each at the free place of the least
/// y, then x, found on a raster of some 512 cells a side and then moved down y and x until
/// something is in the way. A part that is not placed may have had a place. Parts without faces
/// take no room and are left where they are, placed; points that no face uses move along with their
/// part and do not count.
///
/// \throws std::invalid_argument naming the part with a corner out of range or not finite, and
///         for options that are negative, NaN, or (except for the height) not finite
/// \cost   for each part and turn its raster, O(F), and a few milliseconds to search a free place;
///         for the place chosen a `build_face_tree` and some `distance` to each neighbor
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API packing pack(std::span<const mesh_view> parts,
                                        const pack_options& options);
[[nodiscard]] TREEFORM_API packing pack(std::span<const prepared_mesh> parts,
                                        const pack_options& options);

}  // namespace treeform
