#pragma once
/// \file
/// The faces of a file from the front to the back, a run at a time, with the places of their
/// corners; for meshes larger than memory.

#include <libmesh/io/scratch.hpp>
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

struct face_rows {
    mesh_file head{};  ///< format, precision and warnings
    std::uint64_t points = 0;
    std::uint64_t stored_faces = 0;
    std::optional<box3> bounds{};  ///< of all finite points, where these come ahead of the faces
    std::vector<point3> sample{};  ///< finite corners from all over the file; at most `sample_size`
    /// Appends the next triangles, about `most` of them. Returns false when there are none left; then
    /// the file has been read to its end, and `warnings` got what was to be said.
    std::function<bool(std::vector<placed_triangle>& triangles, std::size_t most,
                       std::vector<io_warning>& warnings)>
        append{};
};

inline constexpr std::size_t sample_size = std::size_t{1} << 17;

/// What is read by runs. `in` must outlive what comes back. The points of a PLY are meanwhile in
/// what `make_scratch` gives for their bytes; at most about `memory` bytes of it are held in memory.
///
/// \throws io_error, also for a PLY that `has_face_runs` is not true of
[[nodiscard]] face_rows open_stl_faces(const source& in);
[[nodiscard]] face_rows open_ply_faces(
    const source& in, const std::function<std::unique_ptr<scratch>(std::size_t)>& make_scratch,
    std::uint64_t memory);

/// Whether vertices come ahead of faces, and these are no triangle strips. \throws io_error
[[nodiscard]] bool has_face_runs(const source& ply);

}  // namespace treeform::detail::io
