#pragma once
/// \file
/// Gives results what their operands have besides points and faces.

#include "file_data.hpp"
#include "held_mesh.hpp"

namespace binding {

/// \throws std::invalid_argument where attributes are not those of the mesh
void require_rows(const tf::mesh_file& file, std::size_t operand);

/// The mesh with all that it has, as a file has it.
tf::mesh_file file_of(const held_mesh& mesh);

/// The operands of an operation, with their attributes as they are now.
class carrying {
  public:
    /// \throws std::invalid_argument where attributes are not those of the mesh that has them
    explicit carrying(const held_meshes& operands);

    /// Has options merge no faces of different values, nor any where vertices have values, unless
    /// `simplify` is asked for. They refer to this.
    template <class Options>
    void keep_apart(Options& options) {
        if constexpr (std::is_same_v<Options, tf::boolean_options>) {
            if (!options.simplify && sources_.has_vertex_values()) options.keep_cuts = true;
            options.face_groups = groups_ = sources_.face_groups(true, false);
        } else if constexpr (requires { options.keep_cuts; }) {
            options.keep_cuts = options.keep_cuts || sources_.merging_mixes_values();
        }
    }

    /// `tf::simplify` of a single operand, with what is carried kept at borders and seams.
    [[nodiscard]] tf::simplify_result simplify(const tf::mesh_ref& mesh, double max_distance,
                                               std::span<const std::uint32_t> face_groups,
                                               tf::simplify_options options) const;

    /// The attributes of what was made of the operands; None where these have none.
    [[nodiscard]] py::object to(const tf::mesh& made,
                                std::span<const tf::operand_element> face_source,
                                std::span<const tf::operand_element> vertex_source,
                                std::span<const tf::operand_element> face_of_cut_vertex = {}) const;
    [[nodiscard]] py::object to(const tf::mesh& made, std::span<const std::uint32_t> face_source,
                                std::span<const std::uint32_t> vertex_source,
                                std::span<const std::uint32_t> face_of_new_vertex = {},
                                std::span<const std::uint32_t> corner_source = {},
                                std::span<const std::uint32_t> cap = {}) const;

  private:
    template <class Carry>
    py::object carried(const tf::mesh& made, Carry&& carry) const;

    std::vector<tf::mesh_file> files_;
    std::vector<std::uint32_t> groups_;
    tf::carry_sources sources_{
        std::vector<tf::carry_source>{}};  ///< empty: there is nothing to carry
};

/// The faces of a body that `by` moves, turned over where it mirrors, and a copy of what the body
/// has, with normals turned likewise; None where it has nothing.
py::tuple turned_over(const held_mesh& body, const tf::transform<3>& by);

}  // namespace binding
