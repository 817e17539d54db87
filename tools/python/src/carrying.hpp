#pragma once
/// \file
/// Gives results what their operands have besides points and faces.

#include "file_data.hpp"
#include "held_mesh.hpp"

namespace binding {

/// \throws std::invalid_argument where attributes are not those of the mesh
void require_rows(const tf::mesh_file& file, std::size_t operand);

/// The operands of an operation, with their attributes as they are now.
class carrying {
  public:
    /// \throws std::invalid_argument where attributes are not those of the mesh that has them
    explicit carrying(const held_meshes& operands);

    /// Keeps all cuts where vertices have values, unless `simplify` is asked for.
    void keep_apart(tf::boolean_options& options) const;
    /// Whether merging faces may mix values, of one group or not.
    [[nodiscard]] bool mixes() const;
    /// `boolean_options::face_groups` for merging coplanar faces: only those of equal values.
    [[nodiscard]] std::vector<std::uint32_t> face_groups() const;

    /// The attributes of what was made of the operands; None where these have none.
    [[nodiscard]] py::object to(const tf::mesh& made, const tf::carried_elements& elements) const;
    [[nodiscard]] py::object to(const tf::mesh& made, std::span<const std::uint32_t> face_source,
                                std::span<const std::uint32_t> vertex_source,
                                std::span<const std::uint32_t> face_of_new_vertex = {},
                                std::span<const std::uint32_t> cap = {}) const;

  private:
    template <class Carry>
    py::object carried(const tf::mesh& made, Carry&& carry) const;

    std::vector<tf::mesh_file> files_;
    tf::carry_sources sources_{
        std::vector<tf::carry_source>{}};  ///< empty: there is nothing to carry
};

/// The faces of a body that `by` moves, turned over where it mirrors, and a copy of what the body has,
/// with normals turned likewise; None where it has nothing.
py::tuple turned_over(const held_mesh& body, const tf::transform<3>& by);

}  // namespace binding
