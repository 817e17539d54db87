#pragma once
/// \file
/// A mesh made ready to be asked about with others, many times and wherever it is moved: how far
/// they are apart, and with `mesh_intersections` which of their faces meet.

#include <libmesh/nearness/bounding_cylinders.hpp>
#include <libmesh/nearness/triangle_blocks.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/detail/export.hpp>
#include <treeform/tree/transform.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <limits>
#include <optional>

namespace treeform {

class distance_model;
struct mesh_intersection_options;  // libmesh/intersect/mesh_intersections.hpp
struct mesh_intersection_result;

/// Where each of two meshes is, and how far apart they may be.
struct mesh_distance_options {
    transform<3> move_a{};  ///< corners are moved, rounded to double, and count from there on
    transform<3> move_b{};
    /// Nothing is looked for beyond; inclusive, not squared.
    double radius = std::numeric_limits<double>::infinity();
};

/// The nearest points of two surfaces, as by `mesh_distance` of meshes and trees; but several times
/// as fast where surfaces are nearly flat at the size of their nodes and do not lie along the axes,
/// since the distance of their discs bounds that of nodes better than that of their boxes does.
/// A map that is no rotation, uniform scaling or mirror makes it slower, not wrong.
///
/// \throws std::invalid_argument when the radius is negative or NaN, a map not finite
/// \same   on any number of threads; the same answer as that of the meshes with their trees, but
///         of meshes that meet another pair of faces may be named
[[nodiscard]] TREEFORM_API std::optional<closest_points_result> mesh_distance(
    const distance_model& a, const distance_model& b, const mesh_distance_options& options = {});

/// A tree over the F faces of a mesh, discs around what its nodes hold, and a copy of the
/// triangles in leaf order. Refers to nothing; copies are deep. Queries are const and may run on
/// any threads.
///
/// \cost  some 110 bytes a face; about half as long again to make as a tree
class TREEFORM_API distance_model {
  public:
    /// No face, near to nothing.
    distance_model() = default;
    /// Copies what it needs.
    /// \throws std::invalid_argument naming the face with a corner out of range or not finite
    /// \same   on any number of threads
    explicit distance_model(mesh_view mesh);

    [[nodiscard]] std::size_t size() const { return tree_.size(); }
    [[nodiscard]] const tree<3>& faces_tree() const { return tree_; }

  private:
    friend std::optional<closest_points_result> mesh_distance(const distance_model& a,
                                                              const distance_model& b,
                                                              const mesh_distance_options& options);
    friend mesh_intersection_result mesh_intersections(const distance_model& a,
                                                       const distance_model& b,
                                                       const mesh_intersection_options& options);
    tree<3> tree_;
    detail::buffer<detail::nearness::eight_triangles> triangles_;
    detail::nearness::bounding_cylinders discs_;
};

}  // namespace treeform
