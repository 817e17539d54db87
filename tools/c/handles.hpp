#pragma once
/// \file
/// Handles of meshes and files: as arguments, and in results.

#include <tools/c/glue.hpp>

#include <algorithm>

struct treeform_mesh {
    void* owner;
    treeform::mesh arrays;                    ///< unless they are the caller's
    treeform::prepared_mesh mine;             ///< unless it is that of a body or part
    const treeform::prepared_mesh* prepared;  ///< `mine`, or that one
    bool one_use;
};

struct treeform_file {
    void* owner;
    treeform::mesh_file content;
};

namespace glue {

/// The data of a handle.
template <class Handle>
[[nodiscard]] auto& content(Handle* handle, const char* name) {
    auto& found = need(handle, name).content;
    if constexpr (requires { *found; })
        return *found;
    else
        return found;
}
/// The mesh as the caller passed it.
[[nodiscard]] inline tf::mesh_view view(const treeform_mesh* mesh) {
    return tf::mesh_ref(*need(mesh, "mesh").prepared).view();
}
[[nodiscard]] inline tf::mesh copy_of(const treeform_mesh* mesh) {
    const tf::mesh_view all = view(mesh);
    return {{all.points.begin(), all.points.end()}, {all.faces.begin(), all.faces.end()}};
}
/// \throws std::invalid_argument naming a face with a corner that is not finite
[[nodiscard]] tf::mesh_view finite_view(const treeform_mesh* mesh);

/// A mesh as the argument of a function: prepared, so that it keeps its indexes, or a view.
[[nodiscard]] tf::mesh_ref ref(const treeform_mesh* mesh, const char* name);
/// The same for queries in pieces: later pieces reuse the indexes that the first one built.
[[nodiscard]] inline tf::mesh_ref ref_for_pieces(const treeform_mesh* mesh, const char* name) {
    return thread_progress() ? tf::mesh_ref(*need(mesh, name).prepared) : ref(mesh, name);
}

/// Handles of several meshes, which keep their indexes.
[[nodiscard]] const treeform_mesh* const* handles(keeper& kept,
                                                  const std::vector<tf::prepared_mesh>& row);

[[nodiscard]] tf::mesh_refs refs(const treeform_mesh* const* meshes, std::size_t count,
                                 const char* name);
[[nodiscard]] std::vector<tf::mesh_view> views(const treeform_mesh* const* meshes,
                                               std::size_t count, const char* name);

[[nodiscard]] inline std::vector<tf::face_pair> pairs_of(const treeform_mesh* mesh,
                                                         const treeform_face_pair* pairs,
                                                         std::size_t count) {
    return pairs_of(view(mesh).faces.size(), pairs, count);
}

/// A resulting mesh, and optionally the sources of its elements.
struct made_mesh {
    tf::mesh mesh;
    std::vector<std::uint32_t> index;
};
void fill(keeper& kept, const made_mesh& from, treeform_made_mesh& to);
void fill(keeper& kept, const tf::mesh& from, treeform_made_mesh& to);
[[nodiscard]] const double* positions_of(keeper& kept, const std::vector<tf::curve_point>& from);
/// [F] numbers in the file, counting polygons.
[[nodiscard]] const std::vector<std::uint32_t>& faces_in_file(keeper& kept,
                                                              const tf::usable_mesh& from);

/// A file within a result.
[[nodiscard]] const treeform_file* keep(keeper& owner, tf::mesh_file&& file);
/// The result of an operation on a file, with the file.
template <class C, class T>
void give_file(T&& found, C** out) {
    auto made = make<C>();
    auto& kept = made->keep(std::forward<T>(found));
    fill(*made, kept, made->value);
    made->value.file = keep(*made, std::move(kept.file));
    made->value.mesh = arrays(made->value.file->content.mesh);
    (void)give(std::move(made), out);
}
/// Returns the result of writing, unless the caller passed null.
template <class Write>
void give_written(const Write& write, treeform_written** out) {
    if (out) *out = nullptr;
    tf::write_result written = write();
    check(written.status);
    if (out) (void)give(std::move(written), out);
}

/// Calls `ask(a, b, positions)` for `count` positions, given as consecutive matrices; null: the
/// mesh is not moved. Writes the answers to `out`.
template <class Ask, class T>
void in_positions(const treeform_mesh* a, const treeform_mesh* b, const double* transforms_a,
                  const double* transforms_b, std::size_t count, const Ask& ask, std::span<T> out,
                  double radius = infinity) {
    std::vector<tf::mesh_pair_options> where(count);
    for (std::size_t i = 0; i < count; ++i) {
        where[i].radius = radius;
        if (transforms_a) where[i].transform_a = matrix(transforms_a + 12 * i);
        if (transforms_b) where[i].transform_b = matrix(transforms_b + 12 * i);
    }
    const tf::mesh_ref x = ref_for_pieces(a, "a"), y = ref_for_pieces(b, "b");
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        const auto found = ask(x, y, std::span(where).subspan(begin, end - begin));
        std::copy(found.begin(), found.end(), out.data() + begin);
    });
}

}  // namespace glue
