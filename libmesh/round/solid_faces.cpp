#include <libmesh/round/detail/solid_faces.hpp>
#include <libtree/parallel.hpp>

#include <cstddef>

namespace tf::detail {

solid_faces faces_around(const mesh_arrangement& cut, const arrangement_cells& cells,
                         const std::vector<std::uint8_t>& inside) {
    constexpr std::size_t grain = std::size_t{1} << 15;
    const auto bounds = [&](std::size_t f) {
        const auto [front, behind] = cells.cell_of_side[f];
        return inside[front] != inside[behind];
    };
    std::vector<std::size_t> first(chunk_count(cut.faces.size(), grain) + 1, 0);
    for_chunks(cut.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::size_t count = 0;
        for (std::size_t f = begin; f < end; ++f) count += bounds(f) ? 1 : 0;
        first[chunk + 1] = count;
    });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    solid_faces result;
    result.faces.resize(first.back());
    result.face_of.resize(first.back());
    for_chunks(cut.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        std::size_t next = first[chunk];
        for (std::size_t f = begin; f < end; ++f) {
            if (!bounds(f)) continue;
            const auto [a, b, c] = cut.faces[f];
            const bool is_behind = inside[cells.cell_of_side[f][1]] != 0;
            result.faces[next] = is_behind ? face{a, b, c} : face{a, c, b};
            result.face_of[next++] = static_cast<std::uint32_t>(f);
        }
    });
    return result;
}

}  // namespace tf::detail
