#pragma once
/// \file
/// A mesh file as tools that cut it take it; standard input that is read more than once.

#include "tools/shell/abrupt_exit.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/run.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tools {

/// \throws failure (of the input) naming a point in use with a coordinate beyond 2^1000
inline void check_arrangeable(const std::string& name, const tf::mesh& mesh) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f])
            for (std::size_t k = 0; k < 3; ++k)
                if (std::abs(mesh.points[corner][k]) > 0x1p1000)
                    throw failure(bad_input, "too-large",
                                  name + ": triangle " + std::to_string(f) +
                                      " has a coordinate beyond 2^1000 (about 1e301), which is too "
                                      "large; scale the mesh down");
}

/// A file, and its triangles that can be computed with.
struct usable_input {
    tf::mesh_file file{};
    std::vector<std::uint32_t> triangle_of_face{};  ///< in the file; empty: the same
    std::uint64_t non_finite = 0;                   ///< triangles with a corner that is not finite

    [[nodiscard]] tf::attribute_source source() const { return {&file, triangle_of_face}; }
};

/// Reads the job's input, and warns of what is left out.
///
/// \throws failure (of the input) when no triangle is left, or as `check_arrangeable`
[[nodiscard]] usable_input read_usable(job& work);

/// Standard input as a file for as long as this lives; what is read from standard input then comes
/// from there, too. What processes that were killed have left of theirs is removed.
class spooled_input {
  public:
    /// The file's name begins with `beside`. \throws failure
    spooled_input(job& work, const std::filesystem::path& beside);
    spooled_input(const spooled_input&) = delete;
    spooled_input& operator=(const spooled_input&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return path_.path(); }

  private:
    guard& keeper_;
    unfinished_path path_;
};

}  // namespace tools
