#pragma once
/// \file
/// That a surface which changes stays within a distance of what it was, both ways.

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

/// Faces that others are to take the place of.
struct change {
    ids old;                        ///< ascending
    std::vector<triangle3> before;  ///< [old]
    ids kept;                       ///< of `old`, those that stay with another corner, ascending
    std::vector<triangle3> after;   ///< [kept]
    bool same_rim = true;           ///< `before` and `after` are disks with the same border

    void clear() {
        for (ids* all : {&old, &kept}) all->clear();
        for (std::vector<triangle3>* all : {&before, &after}) all->clear();
    }
};

/// Bounds for each face: `there`, of points of the input that are near it, and `back`, of its
/// points from the input.
///
/// Each point of the input belongs to a face now that it is near to, and that face has the triangle
/// of the point in its list. When faces change, their points go to the new ones. The two surfaces
/// before and after, seen along a direction in which both face the eye and have one rim, cover each
/// other: so bounds grow by the gap between them (a step). Where that is too much, both bounds are
/// made anew from the input: points of all triangles in lists are covered by faces, and faces by
/// the input, seen along their normals or in pieces.
class distance_proof {
  public:
    /// \param largest no coordinate has a larger magnitude, nor will
    distance_proof(mesh_view given, const connected_faces& now, double largest, double limit);

    [[nodiscard]] bool holds_by_step(const change& c);
    /// \param tree of faces as they are before
    [[nodiscard]] bool holds_anew(const change& c, const dynamic_tree<3>& tree);
    /// Makes the change that was last asked for, and holds.
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
        /// triangles of the input some of whose points belong to it, or that it is near
        ids near{};
    };
    struct input_triangle {
        triangle3 corners{};
        aabb<double, 3> box{};
        std::array<std::uint32_t, 3> mates{};
        std::uint32_t visited = 0;  ///< the last visit
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
    double rounding_;  ///< of boxes
    std::vector<bounded> faces_{};
    covering covering_;
    ids affected_{};                ///< triangles of the input in lists of old faces
    std::vector<bounded> made_{};   ///< [kept] of the change
    std::vector<raised> raised_{};  ///< other faces that points went to
    std::vector<target> targets_{};
    ids others_{};  ///< faces that targets are, after those made
    std::vector<seen_triangle> seen_before_{}, seen_after_{};
    std::uint32_t too_far_ = 0;  ///< triangle of the input where the last proof failed, or ended
    ids waiting_{};
    std::uint32_t visit_ = 0;
};

}  // namespace treeform::detail::simplify
