#pragma once
/// \file
/// What corners of triangles have of their own: texture coordinates and normals.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// Texture coordinates and normals that corners name by their numbers, as in an OBJ: a point may
/// have others in each of its triangles (a seam, a sharp edge), and corners that share one share it
/// in a file that is written, too.
struct corner_values {
    /// In place of a number: the corner has none.
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::array<double, 3>> texture{};  ///< u, v, w
    bool has_w = false;                            ///< else every w is 0 and stands in no file
    std::vector<point3> normals{};
    std::vector<face> texture_of_corner{};  ///< [F] numbers in `texture`; empty: no corner has any
    std::vector<face> normal_of_corner{};   ///< [F] numbers in `normals`; empty: no corner has any

    friend bool operator==(const corner_values&, const corner_values&) = default;
};

/// The corners of the triangles `triangles`, in that order; `texture` and `normals` stay whole.
///
/// \pre each one is less than the number of triangles that `c` is for
[[nodiscard]] TREEFORM_API corner_values gather(const corner_values& c,
                                                std::span<const std::uint32_t> triangles);

/// Puts those of `more` behind those of `triangles` triangles that `to` is for.
///
/// \pre both together have fewer rows of a kind than `corner_values::none`
TREEFORM_API void append(corner_values& to, std::size_t triangles, const corner_values& more,
                         std::size_t more_triangles);

/// What is wrong with `c` as values of `triangles` triangles, in words; empty when nothing is.
[[nodiscard]] TREEFORM_API std::string fault_of(const corner_values& c, std::size_t triangles);

}  // namespace treeform
