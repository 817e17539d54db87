#pragma once
/// \file
/// Faces that agree on what is outside.

#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::repair {

/// Turns faces until two that have an edge to themselves run along it opposite ways; returns how
/// many. Of each patch, the fewer are turned, and of as many, not the lowest face. A patch with one
/// side only, as the Moebius strip, stays as it is.
///
/// \cost O(V + F)
/// \same on any number of threads
std::uint64_t make_faces_agree(working_mesh& mesh);

/// What is turned as one: all that edges link, or shells (`shells`), of which several may touch
/// along edges. Shells are for meshes that disagreed there: else what runs along an edge says what
/// is meant, and a shell may be a wedge where the surface passes through itself.
enum class turned_as_one : std::uint8_t { component, shell };

/// What is known of all edges of a mesh.
enum class edge_facts : std::uint8_t {
    unknown,
    closed,   ///< faces run as often one way as the other
    manifold  ///< closed, and the faces at each vertex are one fan
};

/// Its faces, and what is known of it.
struct closed_component {
    std::vector<std::uint32_t> faces{};
    box3 box{};
    double volume = 0.0;
    bool is_filled = false;                  ///< some of its faces are guesses
    std::optional<prepared_mesh> surface{};  ///< where it was asked for
    std::optional<prepared_mesh> given{};    ///< without what was guessed; likewise
};

/// The closed components of a mesh, those whose faces run as often one way as the other along each
/// edge, and which way they face.
class closed_components {
  public:
    /// \cost O(V + F)
    closed_components(working_mesh& mesh, turned_as_one what, edge_facts known);

    /// Turns those outward that have a negative volume and lie inside no other; returns how many.
    /// What lies inside of one is turned with it, if from outside every second one is inward: a
    /// solid with cavities, inside out. Cavities stay inside of what was filled, whether or not the
    /// filling passes through them.
    ///
    /// \cost for a component turned inward, a winding number around each one whose box holds its
    ///       own
    /// \same on any number of threads
    std::uint64_t turn_outward();

    /// Whether every one has a positive volume.
    [[nodiscard]] bool is_outward() const;
    /// Of all of them.
    [[nodiscard]] double volume() const;

    /// Whether the others wind once around every component that has a negative volume, and not
    /// around any that has a positive one, so that each bounds what is inside.
    ///
    /// \pre no two components meet; `turned_as_one::component`
    [[nodiscard]] bool is_well_nested();

  private:
    working_mesh& mesh_;
    std::vector<closed_component> all_{};
};

}  // namespace treeform::detail::repair
