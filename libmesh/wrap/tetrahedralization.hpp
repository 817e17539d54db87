#pragma once
/// \file
/// An incremental tetrahedralization of a box.

#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::wrap {

/// Corners a, b, c, d, with orient3d(a, b, c, d) > 0.
struct tetrahedron {
    std::array<std::uint32_t, 4> corners{};
    /// [i] the neighbor across the face opposite corner i, or none
    std::array<std::uint32_t, 4> neighbors{};
};

/// Tetrahedra that fill a box: any two share a corner, an edge, a face or nothing; that is exact.
/// They are Delaunay up to rounding of the circumspheres.
class tetrahedralization {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Six tetrahedra around a diagonal of the box; the corners of the box are points 0 to 7.
    /// \pre the box has a positive extent along each axis
    explicit tetrahedralization(const box3& around);

    [[nodiscard]] const std::vector<point3>& points() const { return points_; }
    /// Upper bound of tetrahedron numbers; some may be unused.
    [[nodiscard]] std::size_t size() const { return all_.size(); }
    [[nodiscard]] std::size_t count() const { return all_.size() - unused_.size(); }
    [[nodiscard]] const tetrahedron& operator[](std::uint32_t t) const { return all_[t]; }
    /// Generation counter of a tetrahedron number: changes when the tetrahedron is created or
    /// removed; even while unused.
    [[nodiscard]] std::uint32_t births(std::uint32_t t) const { return births_[t]; }
    [[nodiscard]] bool is_used(std::uint32_t t) const { return (births_[t] & 1) != 0; }

    /// The face opposite corner i, counter-clockwise as seen from that corner.
    [[nodiscard]] std::array<std::uint32_t, 3> face(std::uint32_t t, std::size_t i) const {
        const auto& c = all_[t].corners;
        const auto& k = faces[i];
        return {c[k[0]], c[k[1]], c[k[2]]};
    }
    [[nodiscard]] std::array<point3, 4> corners(std::uint32_t t) const {
        const auto& c = all_[t].corners;
        return {points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]};
    }

    /// Inserts `p` as a corner. The tetrahedra that contain it, and connected ones with `p` in
    /// their circumspheres, are replaced by new ones. Returns false, and changes nothing, when `p`
    /// is outside of the box, or nearer than `apart` to a corner of one of these tetrahedra.
    ///
    /// \param near  a tetrahedron near `p`, where the walk to it starts
    /// \cost  a few microseconds, and the walk from `near` to `p`
    /// \source Bowyer, Computing Dirichlet Tessellations, The Computer Journal 24 (1981); the
    ///         cavity is restricted so that `p` is strictly inside of all its faces
    bool insert(const point3& p, std::uint32_t near, double apart);

    /// The tetrahedra created by the last `insert`.
    [[nodiscard]] std::span<const std::uint32_t> made() const { return made_; }

  private:
    static constexpr std::array<std::array<std::size_t, 3>, 4> faces{
        {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

    /// A face of the cavity of a new corner.
    struct wall {
        std::array<std::uint32_t, 3> corners;  ///< counter-clockwise from inside
        std::uint32_t behind;                  ///< the tetrahedron behind it, or none
        std::size_t face_behind;               ///< number of this face in `behind`
    };

    [[nodiscard]] int side(std::uint32_t t, std::size_t i, const point3& p) const;
    [[nodiscard]] bool is_in_sphere(std::uint32_t t, const point3& p, double margin) const;
    [[nodiscard]] bool holds(std::uint32_t t, const point3& p) const;
    [[nodiscard]] std::uint32_t locate(const point3& p, std::uint32_t near) const;
    [[nodiscard]] std::size_t face_towards(std::uint32_t t, std::uint32_t neighbor) const;
    bool find_core(const point3& p, std::uint32_t first);
    void grow(const point3& p);
    void make_star(const point3& p);
    [[nodiscard]] bool is_near_corner(const point3& p, double apart) const;
    void find_walls();
    void fill_room(std::uint32_t p);
    void link_made();
    std::uint32_t take_number();

    std::vector<point3> points_;
    std::vector<tetrahedron> all_;
    std::vector<std::uint32_t> births_;
    std::vector<std::uint32_t> unused_;
    enum class part : std::uint8_t { none, dropped, room, core };
    std::vector<part> part_;           ///< [tetrahedra] role in the cavity of the new corner
    std::vector<std::uint32_t> room_;  ///< tetrahedra of the cavity
    std::vector<wall> walls_;
    std::vector<std::uint32_t> made_;
    struct edge_of_made {
        std::uint64_t ends;
        std::uint32_t of;
        std::uint32_t opposite;  ///< corner of `of` opposite the face
    };
    std::vector<edge_of_made> edges_;
};

}  // namespace treeform::detail::wrap
