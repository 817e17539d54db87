#pragma once
/// \file
/// The vertices of a mesh, or the points of a cloud with their properties, welded: what is kept of
/// each group, what must agree, and what becomes of the faces.

#include <libmesh/attributes.hpp>
#include <libmesh/mesh.hpp>
#include <libmesh/weld/weld_points.hpp>
#include <libtree/export.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tf {

/// A vertex property that must agree for two points to be put together.
struct weld_condition {
    std::string property{};  ///< a column of the element "vertex"
    double tolerance = 0.0;  ///< largest difference of two values, inclusive; NaN agrees with NaN
};

/// Which point of a group gives its place and its properties to what is kept.
enum class weld_keep : std::uint8_t {
    first,   ///< the lowest-numbered; nothing that is kept moves
    last,    ///< the highest-numbered
    mean,    ///< the mean of the places and of floating-point properties; the rest is the first's
    lowest,  ///< the one with the least value of `keep_by`; of equal ones the first
    highest  ///< the one with the greatest
};

struct mesh_weld_options {
    weld_options points{};  ///< `kind` and `agree` come on top of `conditions`
    std::vector<weld_condition> conditions{};
    weld_keep keep = weld_keep::first;
    std::string keep_by{};        ///< for `lowest` and `highest`: a column of "vertex"
    bool only_borders = false;    ///< only points on edges of one face; others stay as they are
    bool keep_manifold = false;   ///< leave a group apart where it would make an edge of more than
                                  ///< two faces, or a point where fans of faces meet
    bool keep_collapsed = false;  ///< keep faces that repeat a corner
};

struct mesh_weld_result {
    tf::mesh mesh{};
    tf::attributes attributes{};  ///< rows of "vertex" and "face" follow points and faces
    point_groups groups{};        ///< of the points given; group numbers are points of `mesh`
    std::vector<std::uint32_t> point_of_group{};  ///< [G] the point that gave its properties
    std::vector<std::uint32_t> face_of_new{};     ///< [F'] the face given that each face was
    std::uint64_t collapsed = 0;  ///< faces that repeat a corner after the welding only
    double largest_move = 0.0;    ///< distance of a point from where it ended up, rounded up
    std::uint64_t nonmanifold_before = 0;  ///< edges of more than two faces
    std::uint64_t nonmanifold_after = 0;
    std::uint64_t flipped = 0;     ///< kept faces whose normal turned by more than a right angle
    std::uint64_t left_alone = 0;  ///< groups that `keep_manifold` kept apart
};

/// Welds the points of `mesh`. Points keep the order of the groups' first points, faces theirs;
/// a mesh without faces is a cloud. With tolerance 0 and `weld_keep::first` the result has the
/// coordinates given, bit for bit.
///
/// \throws std::invalid_argument as `weld_points`, for a corner that is no point, a property that
/// is
///         not there or is a list, or rows that are not one a point and one a face
/// \cost   as `weld_points`, and O(F log F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh_weld_result weld_mesh(mesh_view mesh, const attributes& properties,
                                                      const mesh_weld_options& options);

}  // namespace tf
