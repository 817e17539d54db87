#include <libmesh/arrange/cells.hpp>
#include <libmesh/arrange/mesh_arrangement.hpp>
#include <libmesh/detail/union_find.hpp>
#include <libmesh/round/detail/turned_faces.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace tf::detail {
namespace {

struct edge_use {
    std::uint32_t low, high;
    std::uint32_t face;
};

/// The edges with both ends at one of `faces`, of all faces of the surface, sorted.
std::vector<edge_use> edges_at(mesh_view surface, std::span<const std::uint32_t> faces) {
    std::vector<std::uint8_t> at(surface.points.size(), 0);
    for (const std::uint32_t f : faces)
        for (const std::uint32_t corner : surface.faces[f]) at[corner] = 1;
    std::vector<edge_use> uses;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = surface.faces[f][i];
            const std::uint32_t b = surface.faces[f][i == 2 ? 0 : i + 1];
            if (at[a] != 0 && at[b] != 0) uses.push_back({std::min(a, b), std::max(a, b), f});
        }
    std::sort(uses.begin(), uses.end(), [](const edge_use& x, const edge_use& y) {
        return std::tie(x.low, x.high, x.face) < std::tie(y.low, y.high, y.face);
    });
    return uses;
}

/// The surface as the arrangement that it is.
mesh_arrangement as_arrangement(mesh_view surface) {
    mesh_arrangement cut;
    cut.given_points.assign(surface.points.begin(), surface.points.end());
    cut.faces.assign(surface.faces.begin(), surface.faces.end());
    cut.cover_begin.resize(cut.faces.size() + 1);
    std::iota(cut.cover_begin.begin(), cut.cover_begin.end(), std::size_t{0});
    cut.covers.resize(cut.faces.size());
    for (std::uint32_t f = 0; f < cut.faces.size(); ++f) cut.covers[f] = {f, false};
    return cut;
}

}  // namespace

bool may_be_turned(mesh_view surface, std::span<const std::uint8_t> sound,
                   std::span<const std::uint32_t> near) {
    const std::size_t count = surface.faces.size();
    if (std::none_of(sound.begin(), sound.end(), [](std::uint8_t s) { return s != 0; }))
        return true;
    std::vector<std::uint8_t> held(count, 1);  // by faces that are as they were
    for (const std::uint32_t f : near) held[f] = 0;
    const std::vector<edge_use> uses = edges_at(surface, near);
    union_find parts(count);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        while (end < uses.size() && uses[end].low == uses[begin].low &&
               uses[end].high == uses[begin].high)
            ++end;
        if (end - begin == 1) held[uses[begin].face] = 1;
        if (end - begin == 2) parts.join(uses[begin].face, uses[begin + 1].face);
    }
    std::vector<std::uint8_t> part_held(count, 0);
    for (std::uint32_t f = 0; f < count; ++f)
        if (held[f] != 0) part_held[parts.root(f)] = 1;
    return std::any_of(near.begin(), near.end(), [&](std::uint32_t f) {
        return sound[f] == 0 && part_held[parts.root(f)] == 0;
    });
}

turned_faces find_turned_faces(mesh_view surface) {
    turned_faces result;
    const std::vector<std::uint32_t> one_operand(surface.faces.size(), 0);
    const arrangement_cells cells = find_cells(surface, as_arrangement(surface), one_operand, 1);
    result.open = cells.open_count > 0;
    if (result.open) return result;
    for (std::uint32_t f = 0; f < surface.faces.size(); ++f) {
        const auto [front, behind] = cells.cell_of_side[f];
        if (cells.winding[front] != 0 || cells.winding[behind] != 1) result.faces.push_back(f);
    }
    return result;
}

}  // namespace tf::detail
