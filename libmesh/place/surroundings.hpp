#pragma once
/// \file
/// The fixed meshes; only those that matter for a motion are indexed.

#include <libmesh/place/shape.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/parallel.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::place {

/// A selection of the fixed meshes, with their numbers.
struct chosen_parts {
    std::vector<shape> parts{};
    std::vector<std::size_t> number{};
};

/// The relation of a mesh to one of the fixed meshes.
struct measured_part {
    std::size_t number = 0;
    relation_result how{};
};

class surroundings {
  public:
    /// Meshes without faces are ignored.
    surroundings(std::span<const prepared_mesh> all, vertex_identity vertices);

    [[nodiscard]] bool empty() const { return number_.empty(); }
    [[nodiscard]] std::size_t size() const { return number_.size(); }
    [[nodiscard]] std::span<const prepared_mesh> all() const { return all_; }
    /// The meshes whose boxes come within `reach` of `box`, plus a margin for rounding, when `box`
    /// is moved by up to `latest` times `motion`.
    [[nodiscard]] chosen_parts on_the_way(const box3& box, const point3& motion, double latest,
                                          double reach) const;
    /// The meshes whose boxes are within `reach` of `box`, plus a margin for rounding.
    [[nodiscard]] chosen_parts around(const box3& box, double reach) const;
    /// Whether `around` would return meshes that are not in `known`; indexes none.
    [[nodiscard]] bool others_around(const box3& box, double reach,
                                     const chosen_parts& known) const;
    /// The mesh that `a` penetrates, else one that it touches, else the nearest one; ties: the
    /// lowest number. Empty when no mesh is within `radius`. Meshes whose boxes are farther away
    /// are not indexed.
    [[nodiscard]] std::optional<measured_part> nearest(const shape& a, const box3& box,
                                                       double radius,
                                                       const progress_callback& progress) const;
    /// The box of mesh `number`; not empty, since the mesh has faces.
    [[nodiscard]] const std::optional<box3>& box_of(std::size_t number) const {
        return box_of_all_[number];
    }
    [[nodiscard]] shape shape_of(std::size_t number) const {
        return shape(all_[number], vertices_);
    }

  private:
    [[nodiscard]] chosen_parts choose(const std::vector<std::uint32_t>& found) const;
    [[nodiscard]] std::vector<std::uint32_t> met_on_the_way(const box3& box, const point3& motion,
                                                            double latest, double reach) const;

    std::span<const prepared_mesh> all_;
    vertex_identity vertices_;
    std::vector<std::optional<box3>> box_of_all_;
    std::vector<std::uint32_t> number_;  ///< numbers of the meshes with faces
    tree<3> boxes_;                      ///< tree of their boxes
};

}  // namespace treeform::detail::place
