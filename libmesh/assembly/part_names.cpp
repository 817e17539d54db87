#include <libmesh/assembly/part_names.hpp>
#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/topology/select_faces.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
using detail::assembly::matches;

bool detail::assembly::matches(std::string_view pattern, std::string_view name) {
    // Where a star is behind us, the rest may begin one further on.
    std::size_t p = 0, n = 0, star = std::string_view::npos, after_star = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            after_star = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++after_star;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

std::vector<part_pair> pairs_named(std::span<const std::string> names, std::string_view first,
                                   std::string_view second) {
    std::vector<std::uint32_t> of_first, of_second;
    for (std::uint32_t i = 0; i < names.size(); ++i) {
        if (matches(first, names[i])) of_first.push_back(i);
        if (matches(second, names[i])) of_second.push_back(i);
    }
    std::vector<part_pair> pairs;
    for (const std::uint32_t i : of_first)
        for (const std::uint32_t j : of_second)
            if (i != j) pairs.push_back({std::min(i, j), std::max(i, j)});
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

body_file& body_set::add_named_parts(mesh_file content, std::string label, std::string name) {
    body_file& file = add(std::move(content), std::move(label), std::move(name));
    const std::vector<named_faces>& names = file.content.attributes.parts;
    if (!file.box || file.cloud || names.empty()) return file;
    const std::size_t whole = bodies_.size() - 1, count = shapes[whole].indexed_view().faces.size();
    std::vector<std::uint32_t> triangle, stored;
    for (std::uint32_t f = 0; f < count; ++f) {
        triangle.push_back(this->triangle(whole, f));
        stored.push_back(face_in_file(whole, f));
    }
    const auto parts = scene_parts(select_faces(file.content.mesh, triangle), names, stored, false);
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
