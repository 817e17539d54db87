#pragma once
/// \file
/// Files as inputs of operations that carry attributes.

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>

#include <tools/c/handles.hpp>

#include <deque>

namespace glue {

/// A file without unusable faces.
class usable_input {
  public:
    explicit usable_input(const tf::mesh_file& file)
        : file_(file),
          triangle_of_face_(tf::drop_unusable_faces(file_.mesh)),
          non_finite_(file.mesh.faces.size() - file_.mesh.faces.size()) {}
    [[nodiscard]] tf::attribute_source source() const { return {&file_, triangle_of_face_}; }
    [[nodiscard]] std::size_t non_finite() const { return non_finite_; }  ///< faces

  private:
    tf::mesh_file file_;
    std::vector<std::uint32_t> triangle_of_face_;
    std::size_t non_finite_;
};

/// Inputs for `attribute_sources`: with the faces that the operation used. A file is not copied if
/// all of its faces were used.
class carry_inputs {
  public:
    carry_inputs(const treeform_attribute_source* inputs, std::size_t count) {
        for (const treeform_attribute_source& one : array(inputs, count, "inputs")) {
            const tf::mesh_file& file = content(one.file, "the file of an input");
            sources_.push_back({&file, {}});
            if (!one.triangle_of_face) continue;
            tf::mesh_file& copy = files_.emplace_back(file);
            copy.mesh.faces.clear();
            for (const std::uint32_t triangle : std::span(one.triangle_of_face, one.face_count)) {
                if (triangle >= file.mesh.faces.size())
                    throw std::invalid_argument("triangle " + std::to_string(triangle) +
                                                " is out of range for the file of an input");
                copy.mesh.faces.push_back(file.mesh.faces[triangle]);
            }
            sources_.back() = {&copy, {one.triangle_of_face, one.face_count}};
        }
    }
    [[nodiscard]] std::span<const tf::attribute_source> sources() const { return sources_; }

  private:
    std::deque<tf::mesh_file> files_;
    std::vector<tf::attribute_source> sources_;
};

}  // namespace glue
