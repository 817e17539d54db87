#pragma once
/// \file
/// The edges of a mesh, each with the faces that use it.

#include <libmesh/base/fill_stars.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace treeform::detail::weld {

/// A use of an edge by a face; `high` is the higher end of the edge.
struct edge_use {
    std::uint32_t high;
    std::uint32_t face;
};

/// An edge with its uses, by ascending face number.
struct used_edge {
    std::uint32_t low;
    std::uint32_t high;
    std::span<const edge_use> uses;

    [[nodiscard]] std::uint32_t face(std::size_t use) const { return uses[use].face; }
};

/// How faces with a repeated corner are treated.
enum class repeated_corners : std::uint8_t {
    left_out,  ///< they contribute no edges
    counted    ///< if they have two different corners, they use the edge between these twice
};

/// \pre  every corner is less than `point_count`
/// \cost O(V + F log d) time for at most d edges at a point; 24 bytes a face and 8 a point, and
///       temporarily 36 more a face
/// \same on any number of threads
class edge_uses {
  public:
    edge_uses(std::size_t point_count, std::span<const face> faces, repeated_corners repeated);

    /// Calls `body(edge, chunk)` for every edge, in parallel over `chunks()` chunks of points.
    template <class Body>
    void for_each(const Body& body) const {
        for_chunks(size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
            for (std::size_t v = begin; v < end; ++v)
                for_each_at(static_cast<std::uint32_t>(v), chunk, body);
        });
    }
    [[nodiscard]] std::size_t chunks() const { return chunk_count(size(), grain); }

  private:
    static constexpr std::size_t grain = std::size_t{1} << 8;

    [[nodiscard]] std::size_t size() const { return at_.end.size(); }

    template <class Body>
    void for_each_at(std::uint32_t low, std::size_t chunk, const Body& body) const {
        const std::span<const edge_use> uses = at_[low];
        for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
            const std::uint32_t high = uses[begin].high;
            while (end < uses.size() && uses[end].high == high) ++end;
            body(used_edge{low, high, uses.subspan(begin, end - begin)}, chunk);
        }
    }

    base::faces_by_point<std::size_t, edge_use> at_;  ///< by lower end, ascending
};

/// Number of edges of more than two faces, among the faces with three different corners.
[[nodiscard]] std::uint64_t count_nonmanifold_edges(std::size_t point_count,
                                                    std::span<const face> faces);

/// [V] 1 for the ends of edges with exactly one face, among the faces with three different corners.
[[nodiscard]] buffer<std::uint8_t> border_points(std::size_t point_count,
                                                 std::span<const face> faces);

}  // namespace treeform::detail::weld
