#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
namespace {

/// The same faces, each with corners of its own.
mesh loose(mesh_view of, std::span<const std::uint32_t> faces) {
    mesh soup;
    for (const std::uint32_t f : faces) {
        const auto first = static_cast<std::uint32_t>(soup.points.size());
        for (const std::uint32_t corner : of.faces[f]) soup.points.push_back(of.points[corner]);
        soup.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

}  // namespace

body_file& body_set::add_named_parts(mesh_file content, std::string label, std::string name) {
    body_file& file = add(std::move(content), std::move(label), std::move(name));
    const std::vector<part>& names = file.content.attributes.parts;
    if (!file.box || file.cloud || names.empty()) return file;
    const std::size_t whole = bodies_.size() - 1, count = shapes[whole].view().faces.size();
    std::vector<std::uint32_t> triangle, stored;
    for (std::uint32_t f = 0; f < count; ++f) {
        triangle.push_back(this->triangle(whole, f));
        stored.push_back(stored_face(whole, f));
    }
    const auto parts = scene_parts(loose(file.content.mesh, triangle), names, stored);
    shapes.pop_back();
    bodies_.pop_back();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        body one{.file = files.size() - 1, .part = parts[i].name};
        if (one.part.empty() && parts.size() > 1) one.part = "part " + std::to_string(i);
        for (const std::uint32_t f : parts[i].faces) one.triangle_of_face.push_back(triangle[f]);
        shapes.emplace_back(
            join_equal_points(select_faces(file.content.mesh, one.triangle_of_face)));
        bodies_.push_back(std::move(one));
    }
    return file;
}

}  // namespace treeform
