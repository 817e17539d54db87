#pragma once
/// \file
/// Reads the faces of a file sequentially, in blocks, with the positions of their corners; for
/// meshes larger than memory.

#include <libmesh/io/file_part.hpp>
#include <libmesh/io/record_index.hpp>
#include <libmesh/io/source.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace treeform::detail::io {

/// A triangle of a file, with its positions; a polygon has several.
struct placed_triangle {
    std::uint32_t stored = 0;  ///< number of the face in the file
    face corners{};            ///< point numbers in the file
    std::array<point3, 3> at{};
};

/// Storage for the points of a PLY while its faces are read.
class point_store {
  public:
    virtual ~point_store() = default;
    /// Adds the points of this part, in order.
    virtual void put(points_view points) = 0;
    /// A point of the file; call it after all parts have put theirs.
    [[nodiscard]] virtual point3 at(std::uint32_t point) = 0;
};

/// The faces of a part of a file; all parts together have all triangles.
struct face_rows {
    mesh_file
        head{};  ///< format, precision and warnings; for PLY, the precision is that of the part
    std::uint64_t points = 0;        ///< of the file
    std::uint64_t stored_faces = 0;  ///< of the file
    std::optional<box3> bounds{};    ///< box of all finite points, if these precede the faces
    std::vector<point3>
        sample{};  ///< finite corners spread over the part; at most `sample_size` for the file
    /// Appends the next triangles, about `most`. Returns false if none are left; the last part then
    /// added the warnings about the end of the file.
    std::function<bool(std::vector<placed_triangle>& triangles, std::size_t most,
                       std::vector<io_warning>& warnings)>
        append{};
    /// For PLY: number of skipped faces with fewer than three corners.
    std::function<std::uint64_t()> left_out{};
    /// For PLY: as in `point_rows`.
    std::function<std::vector<row_place>(std::size_t count)> row_parts{};
    /// For PLY: restricts `append` to the rows from `first` up to row `end`; the end of the file is
    /// checked after the last row. If it is not called, all rows are read.
    std::function<void(const row_place& first, std::optional<std::uint64_t> end)> go_to{};
};

inline constexpr std::size_t sample_size = std::size_t{1} << 17;

/// Open a file for reading faces in blocks. `in` and `known`, the index of its records, must
/// outlive the result. For an STL, the faces of the part are read. For a PLY, the points of the
/// part are put into the store that `make_store` returns for their number.
///
/// \throws io_error; of `kind::blocks` for a PLY for which `has_rows_to_look_at` is false
[[nodiscard]] face_rows open_stl_faces(const source& in, const file_part& part = {});
[[nodiscard]] face_rows open_ply_faces(
    const source& in, const std::function<std::unique_ptr<point_store>(std::size_t)>& make_store,
    const file_part& part = {}, const record_index* known = nullptr);

}  // namespace treeform::detail::io
