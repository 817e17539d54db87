#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/weld/few_equal_points.hpp>
#include <libmesh/weld/joined_faces.hpp>
#include <treeform/tree/parallel.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::detail::weld {

joined_faces join_faces(mesh_view mesh) {
    joined_faces result;
    const auto equal = few_equal_points(mesh.points);
    if (!equal) return result;
    result.changed = true;
    result.faces.resize(mesh.faces.size());
    constexpr std::size_t grain = std::size_t{1} << 15;
    for_chunks(mesh.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t f = begin; f < end; ++f)
            for (std::size_t i = 0; i < 3; ++i)
                result.faces[f][i] = equal->first_of_group[equal->group_of_point[mesh.faces[f][i]]];
    });
    return result;
}

const joined_faces& join_faces(const prepared_mesh& mesh) {
    constexpr base::slot<joined_faces> slot{base::slot_name::joined_corners};
    return base::prepared_slots::get(mesh, slot, [&] { return join_faces(mesh.view()); });
}

}  // namespace treeform::detail::weld
