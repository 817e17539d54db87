#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/base/union_find.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/carry/carried.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace treeform::detail::carry {
namespace {

/// An edge of a part, with its corners ascending.
struct part_edge {
    std::uint32_t low, high, part;
    friend auto operator<=>(const part_edge&, const part_edge&) = default;
};

/// The edges that have one face of their part, by their corners. Points of equal coordinates are
/// one.
std::vector<part_edge> open_edges(mesh_view mesh, const std::vector<scene_part>& parts) {
    std::vector<point3> points(mesh.points.size());  // those that no face uses may be anything
    for (const std::uint32_t p : base::used_points(mesh.points.size(), mesh.faces))
        points[p] = mesh.points[p];
    const std::vector<std::uint32_t> number = find_equal_points(points).group_of_point;
    std::vector<part_edge> edges;
    for (std::uint32_t part = 0; part < parts.size(); ++part)
        for (const std::uint32_t f : parts[part].faces)
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [low, high] =
                    std::minmax(number[mesh.faces[f][i]], number[mesh.faces[f][(i + 1) % 3]]);
                edges.push_back({low, high, part});
            }
    std::ranges::sort(edges);
    std::vector<part_edge> open;
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::upper_bound(edge, edges.end(), *edge);
        if (next - edge == 1) open.push_back(*edge);
        edge = next;
    }
    return open;
}

solid_part with_own_points(mesh_view whole, scene_part&& from) {
    solid_part part{.name = std::move(from.name), .faces = std::move(from.faces)};
    for (const std::uint32_t f : part.faces)
        part.points.insert(part.points.end(), whole.faces[f].begin(), whole.faces[f].end());
    std::ranges::sort(part.points);
    part.points.erase(std::unique(part.points.begin(), part.points.end()), part.points.end());
    for (const std::uint32_t p : part.points) part.mesh.points.push_back(whole.points[p]);
    const auto own = [&](std::uint32_t p) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(part.points, p) -
                                          part.points.begin());
    };
    for (const std::uint32_t f : part.faces) {
        const auto [a, b, c] = whole.faces[f];
        part.mesh.faces.push_back({own(a), own(b), own(c)});
    }
    return part;
}

/// The parts of a file with its own vertex numbers (`scene_parts`).
std::vector<scene_part> named_parts(const attribute_source& input, bool joined_at_points) {
    std::vector<std::uint32_t> stored;
    for (std::uint32_t f = 0; f < input.file->mesh.faces.size(); ++f)
        stored.push_back(input.face_in_file(f));
    return scene_parts(input.file->mesh, input.file->attributes.parts, stored, joined_at_points);
}

/// The same, joined at points; also two parts are merged if a border edge of one (an edge with one
/// face of the part) has the same coordinates as a border edge of the other: they are patches of
/// one surface. Solids that touch are not merged. Parts are in the order of their lowest faces;
/// faces in a part ascend. The box of a merged part is that of its first part.
///
/// \cost O(V log V + F log F)
std::vector<scene_part> surface_parts(const attribute_source& input) {
    const mesh_view whole = input.file->mesh;
    std::vector<scene_part> named = named_parts(input, true);
    if (named.size() < 2) return named;

    base::union_find sets(named.size());
    const std::vector<part_edge> open = open_edges(whole, named);
    for (std::size_t i = 0; i + 1 < open.size(); ++i)
        if (open[i].low == open[i + 1].low && open[i].high == open[i + 1].high)
            sets.join(open[i].part, open[i + 1].part);
    for (std::uint32_t part = 0; part < named.size(); ++part) {
        scene_part& first = named[sets.root(part)];
        if (&first == &named[part]) continue;
        first.faces.insert(first.faces.end(), named[part].faces.begin(), named[part].faces.end());
        named[part].faces.clear();
    }
    std::erase_if(named, [](const scene_part& part) { return part.faces.empty(); });
    for (scene_part& part : named) std::ranges::sort(part.faces);
    return named;
}

}  // namespace

std::vector<solid_part> solid_parts(const attribute_source& input) {
    std::vector<solid_part> parts;
    std::vector<scene_part> named = surface_parts(input);
    if (named.size() < 2) return parts;
    for (scene_part& part : named)
        parts.push_back(with_own_points(input.file->mesh, std::move(part)));
    return parts;
}

}  // namespace treeform::detail::carry

namespace treeform {

std::vector<file_part> file_parts(const attribute_source& source, bool combine_patches) {
    const mesh_file& whole = *source.file;
    std::vector<file_part> parts;
    for (scene_part& of : combine_patches ? detail::carry::surface_parts(source)
                                          : detail::carry::named_parts(source, false)) {
        file_part part{.name = std::move(of.name)};
        part.file.mesh = select_faces(whole.mesh, of.faces);
        part.file.stored_faces = of.faces.size();
        part.file.indexed = whole.indexed;
        part.file.stored_as = whole.stored_as;
        part.file.format = whole.format;
        std::vector<face> kept;
        for (const std::uint32_t f : of.faces) {
            kept.push_back(whole.mesh.faces[f]);
            part.face_in_file.push_back(source.face_in_file(f));
        }
        attribute_sources(source).transfer(
            part.file, of.faces, detail::base::used_points(whole.mesh.points.size(), kept));
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace treeform
