#pragma once
/// \file
/// Short translations that separate a mesh from others.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct apart_options {
    double clearance = 0.0;          ///< minimum distance; 0: no penetration
    std::size_t normals = 24;        ///< maximum number of face normals tried as directions
    std::size_t face_pairs = 64;     ///< pairs of faces whose normals are considered, for each part
    base::effort* effort = nullptr;  ///< limit on the effort; null: none
    progress_callback progress{};
};

/// A translation by `time` times `direction`.
struct separation {
    point3 direction{};  ///< unit vector, rounded
    double time = 0.0;   ///< length of the translation
};

struct separations {
    std::vector<separation> moves{};                 ///< by ascending length
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: `moves` is empty
};

/// Translations of `a` to positions where it penetrates none of `parts` and keeps the clearance;
/// empty when its present position is such a one.
///
/// The directions tried are the six axis directions, both directions of the line between the
/// nearest points, the normals of faces that meet, their sum, and the total of a walk that steps
/// away from the nearest part until none is in reach; then directions around the best one, ever
/// closer to it. In each direction some positions from near to far are tested; from the first free
/// one the mesh slides back, as by `sweep_among`, until contact or to the clearance. The result
/// need not be the least translation in a direction, nor the best of all directions: that is a
/// boundary point of a set with O(n^2 m^2) faces. At least one translation is returned: along an
/// axis, past all boxes. A position whose test exceeds the effort is skipped; a way back whose
/// sweep exceeds it is not taken. With an effort, the translations along the axes past all boxes
/// are always included.
///
/// The positions are those of exact translations, up to rounding; `snap_to_representable` with
/// `forward` decides in the written coordinates.
///
/// \throws std::invalid_argument when the clearance is negative or not finite
/// \cost   for each of some 50 directions up to a dozen `intersects` or `distance`, a
///         `build_face_tree` of `a` and a `sweep_among`
/// \same   on any number of threads
/// \source why the least translation is no target: Dobkin, Hershberger, Kirkpatrick and Suri,
///         Computing the Intersection-Depth of Polyhedra, Algorithmica 9 (1993)
[[nodiscard]] TREEFORM_API separations search_separations(const shape& a,
                                                          std::span<const shape> parts,
                                                          const apart_options& options = {});

}  // namespace treeform::detail::place
