#pragma once
/// \file
/// Carries attributes over from operands to results.

#include "file_data.hpp"
#include "held_mesh.hpp"
#include "tools/bindings/linked_files.hpp"

namespace binding {

/// \throws std::invalid_argument if the attributes do not fit the mesh
void require_rows(const tf::mesh_file& file, std::size_t operand);

/// The mesh with its attributes, as for a file.
tf::mesh_file file_of(const held_mesh& mesh);

/// The operands of an operation, with their current attributes.
class carrying {
  public:
    /// \throws std::invalid_argument if attributes do not fit their mesh
    explicit carrying(const held_meshes& operands);

    /// Sets options so that faces with different values are not merged, nor any faces if vertices
    /// have values, unless `merge_coplanar` is set. The options refer to this object.
    template <class Options>
    void keep_apart(Options& options) {
        if constexpr (std::is_same_v<Options, tf::boolean_options>) {
            if (!options.merge_coplanar && sources_.has_vertex_values()) options.keep_cuts = true;
            options.face_groups = groups_ = sources_.face_groups(true, false);
        } else if constexpr (requires { options.keep_cuts; }) {
            options.keep_cuts = options.keep_cuts || sources_.merging_mixes_values();
        }
    }

    /// `tf::simplify` of a single operand, which preserves borders and seams of its attributes.
    [[nodiscard]] tf::simplify_result simplify(const tf::mesh_ref& mesh, double max_distance,
                                               std::span<const std::uint32_t> face_groups,
                                               tf::simplify_options options) const;

    /// The attributes of a result of the operands; None if these have no attributes.
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
    tf::attribute_sources sources_{
        std::vector<tf::attribute_source>{}};  ///< empty if no operand has attributes
};

/// The faces of a body transformed by `by`, flipped if it mirrors, and a copy of its attributes
/// with transformed normals, or None.
py::tuple turned_over(const held_mesh& body, const tf::transform<3>& by);

}  // namespace binding
