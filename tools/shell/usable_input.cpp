#include "tools/shell/usable_input.hpp"

#include "tools/shell/arrangeable.hpp"
#include <treeform/mesh/as_mesh.hpp>

#include <cstddef>

namespace tools {

usable_input read_usable(job& work) {
    usable_input input;
    input.file = work.read();
    const auto timing = work.time("prepare");
    tf::mesh& mesh = input.file.mesh;
    const std::size_t triangles = mesh.faces.size();
    input.triangle_of_face = tf::drop_unusable_faces(mesh);
    input.non_finite = triangles - mesh.faces.size();
    work.warn_of_non_finite(input.non_finite, "face", "faces");
    if (mesh.faces.empty())
        throw failure(bad_input, "no-triangles",
                      work.name + ": no triangle with finite coordinates");
    check_arrangeable(work.name, mesh);
    return input;
}

}  // namespace tools
