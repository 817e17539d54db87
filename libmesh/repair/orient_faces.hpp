#pragma once
/// \file
/// Orients faces consistently, and outward.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::repair {

/// Flips faces until any two that share an edge with no third face are consistent; returns the
/// number of flipped faces. In each patch, the minority is flipped; on a tie, the lowest face is
/// kept. A one-sided patch, such as a Moebius strip, is not changed.
///
/// \cost O(V + F)
/// \same on any number of threads
std::uint64_t make_faces_agree(working_mesh& mesh);

/// The unit that is flipped: all faces linked by edges, or shells (`shells`), of which several may
/// touch along edges. Shells are for meshes that were inconsistent there; otherwise orientations at
/// edges are taken as intended, and a shell may be a wedge where the surface passes through itself.
enum class turned_as_one : std::uint8_t { component, shell };

/// Known properties of all edges of a mesh.
enum class edge_facts : std::uint8_t {
    unknown,
    closed,   ///< all signed face counts are zero
    manifold  ///< closed, and the faces at each vertex form one fan
};

/// A closed component.
struct closed_component {
    std::vector<std::uint32_t> faces{};
    box3 box{};
    double volume = 0.0;
    bool is_filled = false;                  ///< whether some of its faces are fillings
    std::optional<prepared_mesh> surface{};  ///< its mesh; on demand
    std::optional<prepared_mesh> given{};    ///< the same without fillings; on demand
};

/// The closed components of a mesh, that is, those whose signed face counts of edges are all zero,
/// and their orientation.
class closed_components {
  public:
    /// \cost O(V + F)
    closed_components(working_mesh& mesh, turned_as_one what, edge_facts known);

    /// Flips the components that have a negative volume and lie inside no other; returns their
    /// number. Components inside one of these are flipped with it if, from outside, every second
    /// one is inward: a solid with cavities that is inside out. Cavities stay inside a filled
    /// component, even if the filling passes through them.
    ///
    /// \cost for an inward component, a winding number around each component whose box contains its
    ///       box
    /// \same on any number of threads
    std::uint64_t turn_outward();

    /// Whether every component has a positive volume.
    [[nodiscard]] bool is_outward() const;
    /// The sum of their volumes.
    [[nodiscard]] double volume() const;

    /// Whether the winding number of the others is 1 around every component with a negative volume,
    /// and 0 around every other component.
    ///
    /// \pre no two components meet; `turned_as_one::component`
    [[nodiscard]] bool is_well_nested();

  private:
    working_mesh& mesh_;
    std::vector<closed_component> all_{};
};

}  // namespace treeform::detail::repair
