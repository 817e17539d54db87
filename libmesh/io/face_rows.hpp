#pragma once
/// \file
/// The faces of a file from the front to the back, a run at a time, with the places of their
/// corners; for meshes larger than memory.

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

/// A triangle of a file; a polygon has several.
struct placed_triangle {
    std::uint32_t stored = 0;  ///< the face in the file
    face corners{};            ///< numbers of its points in the file
    std::array<point3, 3> at{};
};

/// Where the points of a PLY are while its faces are read.
class point_store {
  public:
    virtual ~point_store() = default;
    /// Those of the part, from its first one on.
    virtual void put(points_view points) = 0;
    /// A point of the file, when all parts have put theirs.
    [[nodiscard]] virtual point3 at(std::uint32_t point) = 0;
};

/// Of a part; together all parts have the triangles of the file.
struct face_rows {
    mesh_file
        head{};  ///< format, precision and warnings; that of PLY is single where the part's is
    std::uint64_t points = 0;        ///< of the file
    std::uint64_t stored_faces = 0;  ///< of the file
    std::optional<box3> bounds{};    ///< of all finite points, where these come ahead of the faces
    std::vector<point3>
        sample{};  ///< finite corners from all over it; at most `sample_size` of the file
    /// Appends the next triangles, about `most` of them. Returns false when there are none left;
    /// then the last part has been read to its end, and `warnings` got what was to be said.
    std::function<bool(std::vector<placed_triangle>& triangles, std::size_t most,
                       std::vector<io_warning>& warnings)>
        append{};
    /// Of PLY: faces of fewer than three corners that have been passed over.
    std::function<std::uint64_t()> left_out{};
    /// Of PLY: as of `point_rows`.
    std::function<std::vector<row_place>(std::size_t count)> row_parts{};
    /// Of PLY: `append` gives the triangles of the rows from `first` on, up to row `end`, and looks
    /// at the end of the file behind the last row. Not called: of all rows.
    std::function<void(const row_place& first, std::optional<std::uint64_t> end)> go_to{};
};

inline constexpr std::size_t sample_size = std::size_t{1} << 17;

/// What is read by runs. `in` must outlive what comes back, and so must what is `known` of its
/// records. An STL has the faces of the part. Of a PLY the points of the part are put into what
/// `make_store` gives for so many of them.
///
/// \throws io_error; of `kind::blocks` for a PLY that `has_rows_to_look_at` is not true of
[[nodiscard]] face_rows open_stl_faces(const source& in, const file_part& part = {});
[[nodiscard]] face_rows open_ply_faces(
    const source& in, const std::function<std::unique_ptr<point_store>(std::size_t)>& make_store,
    const file_part& part = {}, const record_index* known = nullptr);

}  // namespace treeform::detail::io
