#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/union_find.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace treeform {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Names by their first mention; 0 is that of the faces ahead of all.
struct name_table {
    std::vector<std::string> names{std::string()};
    std::vector<std::uint32_t> of_part{};

    explicit name_table(std::span<const named_faces> parts) {
        std::map<std::pair<std::string_view, std::string_view>, std::uint32_t> known{{{}, 0}};
        for (const named_faces& p : parts) {
            const auto [at, is_new] =
                known.try_emplace({p.object, p.group}, static_cast<std::uint32_t>(names.size()));
            if (is_new) names.push_back(part_name(p));
            of_part.push_back(at->second);
        }
    }
};

/// [F] The name of each face.
std::vector<std::uint32_t> names_of_faces(std::size_t faces, std::span<const named_faces> parts,
                                          std::span<const std::uint32_t> number,
                                          const name_table& table) {
    std::vector<std::uint32_t> name(faces, 0);
    std::size_t next = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        const std::size_t stored = number.empty() ? f : number[f];
        while (next < parts.size() && parts[next].first_face <= stored) ++next;
        if (next > 0) name[f] = table.of_part[next - 1];
    }
    return name;
}

}  // namespace

std::vector<scene_part> scene_parts(mesh_view mesh, std::span<const named_faces> names,
                                    std::span<const std::uint32_t> number, bool joined_at_points) {
    if (!number.empty() && number.size() != mesh.faces.size())
        throw std::invalid_argument("treeform::scene_parts: expected one number for each face");
    detail::base::check_faces("scene_parts", mesh.points.size(), mesh.faces);
    const name_table table(names);
    const std::vector<std::uint32_t> name = names_of_faces(mesh.faces.size(), names, number, table);
    detail::base::union_find sets(table.names.size());
    std::vector<std::uint32_t> name_at(mesh.points.size(), nobody);
    for (std::size_t f = 0; joined_at_points && f < mesh.faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f]) {
            if (name_at[corner] == nobody)
                name_at[corner] = name[f];
            else
                sets.join(name_at[corner], name[f]);
        }

    std::vector<scene_part> parts;
    std::vector<std::uint32_t> part_of_set(table.names.size(), nobody);
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        std::uint32_t& mine = part_of_set[sets.root(name[f])];
        if (mine == nobody) {
            mine = static_cast<std::uint32_t>(parts.size());
            parts.push_back({.name = table.names[name[f]]});
        }
        parts[mine].faces.push_back(f);
    }
    for (scene_part& p : parts) {
        std::vector<point3> points;
        for (const std::uint32_t f : p.faces)
            for (const std::uint32_t corner : mesh.faces[f]) points.push_back(mesh.points[corner]);
        p.box = bounding_box(points);
    }
    return parts;
}

}  // namespace treeform
