#pragma once
/// \file
/// Short translations that take a mesh out of others, or away from them.

#include <libmesh/base/effort.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace treeform::detail::place {

struct apart_options {
    double clearance = 0.0;          ///< the least distance wanted; 0: not to penetrate
    std::size_t normals = 24;        ///< normals of faces that are tried as directions, at most
    std::size_t face_pairs = 64;     ///< pairs of faces whose normals are looked at, for each part
    base::effort* effort = nullptr;  ///< that it may spend, if there is a bound
    progress_callback progress{};
};

/// A translation by `time` times `direction`.
struct separation {
    point3 direction{};  ///< of length 1, rounded
    double time = 0.0;   ///< its length
};

struct separations {
    std::vector<separation> moves{};                 ///< the shortest first
    treeform::status status = treeform::status::ok;  ///< or `cancelled`: `moves` is empty
};

/// Translations of `a` to places where it penetrates none of `parts` and keeps the clearance;
/// none when it does so where it is.
///
/// The directions tried are the six of the axes, those of the line between the nearest points, the
/// normals of faces that meet, their sum, and the way of a walk that steps out of the reach of the
/// nearest part until none is; then others around the best, ever closer to it. In each, some places
/// from near to far are looked at; from the first free one the mesh slides back, as `sweep_among`
/// does, until contact or to the clearance. That need not be the least translation in a direction,
/// nor the best of all directions, which is a boundary point of a set with O(n^2 m^2) faces. At
/// least one is given: along an axis, past all boxes. A place of which it takes too much effort to
/// say that it is free is passed over, a way back of which it does is not gone. With an
/// effort, the ways along the axes past all boxes are always among those given.
///
/// The places are those of exact translations except for rounding: `snap_to_representable`, backing
/// off `forward`, decides in the coordinates that are written.
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
