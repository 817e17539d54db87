#pragma once
/// \file
/// The mesh that is being repaired.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace treeform::detail::repair {

/// Steps renumber and drop faces; points keep the numbers of the input.
struct working_mesh {
    std::vector<point3> points;
    std::vector<face> faces;            ///< each with three different corners
    std::vector<std::uint32_t> source;  ///< [F] input face, or `repair_result::none`

    [[nodiscard]] mesh_view view() const { return {points, faces}; }

    void append(const face& f, std::uint32_t from) {
        faces.push_back(f);
        source.push_back(from);
    }

    /// [F] 1 for faces that fill holes, which have no source; empty if there are none.
    [[nodiscard]] std::vector<std::uint32_t> fillings() const {
        std::vector<std::uint32_t> is_filling;
        if (std::ranges::count(source, repair_result::none) == 0) return is_filling;
        for (const std::uint32_t f : source) is_filling.push_back(f == repair_result::none ? 1 : 0);
        return is_filling;
    }

    /// Drops the faces for which `is_dropped(f)` is true; returns their number.
    template <class Dropped>
    std::uint64_t drop(const Dropped& is_dropped) {
        std::uint32_t kept = 0;
        for (std::uint32_t f = 0; f < faces.size(); ++f) {
            if (is_dropped(f)) continue;
            faces[kept] = faces[f];
            source[kept++] = source[f];
        }
        const std::uint64_t dropped = faces.size() - kept;
        faces.resize(kept);
        source.resize(kept);
        return dropped;
    }
};

[[nodiscard]] inline face turned(const face& f) { return {f[0], f[2], f[1]}; }

/// The corner opposite the edge between u and v.
[[nodiscard]] inline std::uint32_t third_corner(const face& f, std::uint32_t u, std::uint32_t v) {
    return f[0] != u && f[0] != v ? f[0] : f[1] != u && f[1] != v ? f[1] : f[2];
}

/// Whether the face runs from u to v.
[[nodiscard]] inline bool runs_along(const face& f, std::uint32_t u, std::uint32_t v) {
    return (f[0] == u && f[1] == v) || (f[1] == u && f[2] == v) || (f[2] == u && f[0] == v);
}

}  // namespace treeform::detail::repair
