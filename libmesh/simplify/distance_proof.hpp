#pragma once
/// \file
/// Proves that a changing surface and its original stay within a distance of each other.

#include <libmesh/simplify/connected_faces.hpp>
#include <libmesh/simplify/covering.hpp>
#include <libmesh/simplify/seen_along.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/tree/dynamic_tree.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::simplify {

/// A replacement of faces by others.
struct change {
    ids old;                        ///< ascending
    std::vector<triangle3> before;  ///< [old]
    ids kept;  ///< the faces of `old` that remain, with a changed corner; ascending
    std::vector<triangle3> after;  ///< [kept]
    bool same_rim = true;          ///< `before` and `after` are disks with the same border

    void clear() {
        for (ids* all : {&old, &kept}) all->clear();
        for (std::vector<triangle3>* all : {&before, &after}) all->clear();
    }
};

/// Two bounds for each face: `there`, of the distance of the input points assigned to it, and
/// `back`, of the distance of its points to the input.
///
/// Each point of the input is assigned to a nearby current face, and that face lists the triangle
/// of the point. When faces are replaced, their points are assigned to the new ones. If the old and
/// the new faces all face the viewer along some direction and have the same rim, they cover each
/// other in that view; so the bounds grow by the gap between them (a step). If that is too much,
/// both bounds are recomputed from the input: the listed triangles are covered by faces, and faces
/// by the input, in views along their normals or in pieces.
class distance_proof {
  public:
    /// \param largest bound of the magnitude of all coordinates, also of future ones
    distance_proof(mesh_view given, const connected_faces& now, double largest, double limit);

    [[nodiscard]] bool holds_by_step(const change& c);
    /// \param tree the faces before the change
    [[nodiscard]] bool holds_anew(const change& c, const dynamic_tree<3>& tree);
    /// Applies the change that was tested last. \pre that test returned true
    void accept(const change& c);

    [[nodiscard]] const triangle3& given(std::uint32_t t) const { return given_[t].corners; }
    [[nodiscard]] const aabb<double, 3>& box_of_given(std::uint32_t t) const {
        return given_[t].box;
    }
    [[nodiscard]] const std::array<std::uint32_t, 3>& mates_of_given(std::uint32_t t) const {
        return given_[t].mates;
    }
    [[nodiscard]] const ids& near(std::uint32_t f) const { return faces_[f].near; }
    [[nodiscard]] double there(std::uint32_t f) const { return faces_[f].there; }
    [[nodiscard]] double back(std::uint32_t f) const { return faces_[f].back; }

  private:
    struct bounded {
        triangle3 now{};
        double there = 0.0, back = 0.0;
        /// triangles of the input with points assigned to the face, or near it
        ids near{};
    };
    struct input_triangle {
        triangle3 corners{};
        aabb<double, 3> box{};
        std::array<std::uint32_t, 3> mates{};
        std::uint32_t visited = 0;  ///< mark of the last visit
    };
    struct raised {
        std::uint32_t face, given;
        double there;
    };
    void make_room(const change& c);
    void find_targets(const change& c, const dynamic_tree<3>& tree);
    [[nodiscard]] bool covers_there(const change& c);
    [[nodiscard]] bool covers_back(std::size_t i, const triangle3& t);
    [[nodiscard]] bool is_under(std::size_t i, const triangle3& t);
    void find_affected(const change& c);

    std::vector<input_triangle> given_{};
    double limit_;
    double rounding_;  ///< rounding margin of boxes
    std::vector<bounded> faces_{};
    covering covering_;
    ids affected_{};                ///< triangles of the input listed by old faces
    std::vector<bounded> made_{};   ///< [kept] new faces of the change
    std::vector<raised> raised_{};  ///< other faces to which points were assigned
    std::vector<target> targets_{};
    ids others_{};  ///< face numbers of the targets after the new faces
    std::vector<seen_triangle> seen_before_{}, seen_after_{};
    std::uint32_t too_far_ = 0;  ///< triangle of the input at which the last proof failed or ended
    ids waiting_{};
    std::uint32_t visit_ = 0;
};

}  // namespace treeform::detail::simplify
