#pragma once
/// \file
/// The operands: files read, moved, and looked at.

#include "tools/shell/run.hpp"
#include "tools/tf-boolean/settings.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tools {

/// `file.mesh` is as moved, and has the finite triangles only.
struct solid {
    std::string path{};
    tf::mesh_file file{};
    std::vector<std::uint32_t> triangle_of_face{};  ///< in the file; empty: the same
    std::uint64_t triangles = 0;                    ///< in the file
    std::string part{};                             ///< its name in the file, of which it is a part
    /// Of a part and by --repair: the number in the file of each face, or `repair_result::none`.
    std::vector<std::uint32_t> faces_in_file{};

    [[nodiscard]] tf::attribute_source source() const { return {&file, triangle_of_face}; }
    /// The number in the file; `repair_result::none` of what fills a hole.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t face) const {
        return faces_in_file.empty() ? source().face_in_file(face) : faces_in_file[face];
    }
};

/// For people.
[[nodiscard]] inline std::string name_of(const solid& s) {
    return name_of_input(s.path) + (s.part.empty() ? "" : ": " + s.part);
}

/// Reads and moves all inputs, takes the parts that the formula names, or the objects of an input
/// that stands alone, and mends what is to be mended; enters all that in the report. \throws
/// failure
[[nodiscard]] std::vector<solid> read_solids(job& work, const boolean_settings& settings);

[[nodiscard]] std::vector<tf::mesh_view> views_of(const std::vector<solid>& solids);
[[nodiscard]] tf::attribute_sources sources_of(const std::vector<solid>& solids);

/// Length of the diagonal of the box of all solids.
[[nodiscard]] double diagonal_of(const std::vector<solid>& solids);

/// Looks for open edges of each one, and enters in the report where they are; which are open.
[[nodiscard]] std::vector<std::uint32_t> check_operands(job& work,
                                                        const std::vector<solid>& solids);

/// Says why these are no solids. \pre they have been checked
void warn_of_open(job& work, const std::vector<solid>& solids,
                  const std::vector<std::uint32_t>& open);

}  // namespace tools
