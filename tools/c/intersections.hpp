#pragma once
/// \file
/// Intersections of meshes, in C.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/clash.hpp>
#include <treeform/mesh/intersections.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <tools/c/made/structs.hpp>

struct treeform_shared_search {
    void* owner;
    std::optional<treeform::shared_search> content;
};

namespace glue {

/// All pairs of faces that meet in a point that is neither a shared corner nor on a shared edge.
/// Exact on the coordinates as given.
inline tf::face_pair_result self_intersections(const tf::mesh_ref& mesh,
                                               const treeform_face_pair_options* options) {
    tf::face_pair_options how = read(options);
    if (options && options->component_of_face)
        how.component_of_face = {options->component_of_face, mesh.view().faces.size()};
    return tf::self_intersections(mesh, how);
}

/// Whether a face of `a` and a face of `b` have a common point, each moved by a matrix (null: not
/// moved); exact.
inline bool intersects(const tf::mesh_ref& a, const tf::mesh_ref& b,
                       const tf::transform<3>& transform_a, const tf::transform<3>& transform_b) {
    return tf::intersects(a, b, tf::mesh_pair_options{transform_a, transform_b});
}

/// The same for many positions, in parallel: `transforms_a` and `transforms_b` are [count][12], or
/// null if the mesh is not moved; `meet` is [count].
/// Surfaces count; for solids, `treeform_check_poses`.
inline void intersects_poses(const treeform_mesh* a, const treeform_mesh* b,
                             const double* transforms_a, const double* transforms_b,
                             std::size_t count, std::uint8_t* meet) {
    const std::span out = array(meet, count, "meet");
    in_positions(
        a, b, transforms_a, transforms_b, count,
        [&](const auto& x, const auto& y, auto where) { return tf::intersects(x, y, where); }, out);
}

/// The faces, ascending, that have a point in the closed box; exact.
inline std::vector<std::uint32_t> faces_in_box(const treeform_mesh* mesh, const tf::box3& box) {
    return tf::faces_in_box(finite_view(mesh), box.min, box.max);
}

inline answer_of<treeform_segments> intersection_curves(tf::mesh_view mesh,
                                                        std::span<const tf::face_pair> pairs) {
    auto made = make<treeform_segments>();
    const auto& found = made->keep(tf::intersection_curves(mesh, pairs));
    made->value.begin = found.begin.data();
    made->value.ends = flat(found.answers);
    made->value.count = found.size();
    return made;
}

/// Writes the intersection curves of pairs as lines, OBJ or PLY, by `format` or, if null, by the
/// extension of `path`.
inline void write_curves(const std::filesystem::path& path, tf::mesh_view mesh,
                         std::span<const tf::face_pair> pairs, std::string_view format) {
    tf::write_curves(path, mesh, pairs, {}, std::string(format));
}

/// Colors the faces of `file` that meet, and gives faces the properties tf_class and tf_region.
/// `part` is the part of this file that was searched, and `pairs` are pairs of faces of its mesh.
inline void color_pairs(tf::mesh_file& file, const treeform_usable_mesh* part,
                        const treeform_face_pair* pairs, std::size_t count) {
    const treeform_usable_mesh& p = need(part, "part");
    const std::size_t faces = p.mesh.face_count;
    tf::usable_mesh searched;
    searched.mesh.points = copied_as<tf::point3>(p.mesh.points, p.mesh.point_count, "points");
    searched.mesh.faces = copied_as<tf::face>(p.mesh.faces, faces, "faces");
    if (p.triangle_of_face)
        searched.triangle_of_face.assign(p.triangle_of_face, p.triangle_of_face + faces);
    searched.face_of_triangle = file.face_of_triangle;
    for (std::uint32_t f = 0; f < faces; ++f)
        if (searched.triangle(f) >= file.mesh.faces.size())
            throw std::invalid_argument("the part is not of this file");
    const auto found = pairs_of(faces, pairs, count);
    tf::face_marks(faces, found, tf::group_pairs(searched.mesh, found)).color(file, searched);
}

/// Whether the file has a format that can be searched in tiles; an error if it cannot be read, or
/// its header is damaged. `format` may be null.
inline bool is_searched_in_tiles(const std::filesystem::path& path, std::string_view format) {
    return tf::shared_search::accepts(path, format);
}

/// Begins a search. All processes must pass the same input and options, except for `progress`.
inline tf::shared_search shared_search_create(const std::filesystem::path& path,
                                              const tf::file_search_options& options) {
    return {path, options};
}

/// Writes the faces of each tile, unless already done. `result`, which may be null, is the number
/// of tiles. Called by one process.
inline void shared_search_scatter(tf::shared_search& search, std::size_t* result) {
    check(search.scatter());
    if (result) *result = search.tiles();
}

/// Number of tiles; an error if no process has completed `scatter`.
inline std::size_t shared_search_tiles(tf::shared_search& search) { return search.tiles(); }

/// Numbers of the tiles that are not finished.
inline std::vector<std::uint32_t> shared_search_unfinished(tf::shared_search& search) {
    return numbers_of(search.unfinished());
}

/// Searches a tile, unless it is finished. Each process calls it for its share of the tiles.
inline void shared_search_tile(tf::shared_search& search, std::size_t tile) {
    check(search.search_tile(tile));
}

/// Combines the results of all tiles; an error unless all tiles are finished. A step that is called
/// too early fails, and ends the search.
inline tf::file_search_result shared_search_finish(tf::shared_search& search) {
    return search.finish();
}

/// Removes the folder of the tiles.
inline void shared_search_remove_folder(tf::shared_search& search) { search.remove_folder(); }

}  // namespace glue
