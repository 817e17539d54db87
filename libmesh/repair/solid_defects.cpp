#include <libmesh/base/words.hpp>
#include <libmesh/repair/orient_faces.hpp>
#include <libmesh/repair/tetrahedra.hpp>
#include <libmesh/repair/working_mesh.hpp>
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>

#include <utility>

namespace treeform {
namespace {

/// Points that are left without a face may be anything.
mesh joined_usable(mesh_view given, std::uint64_t unusable) {
    if (unusable == 0) return join_meshes({&given, 1});
    mesh usable{{given.points.begin(), given.points.end()},
                {given.faces.begin(), given.faces.end()}};
    (void)drop_unusable_faces(usable);
    const mesh_view left = usable;
    return join_meshes({&left, 1});
}

void count_inverted(mesh joined, solid_defects& found) {
    detail::repair::working_mesh parts{std::move(joined.points), std::move(joined.faces), {}};
    parts.source.resize(parts.faces.size());
    const bool is_solid = found.boundary_edges + found.nonmanifold_edges + found.misoriented_edges +
                              found.nonmanifold_vertices + found.meeting_pairs ==
                          0;
    using detail::repair::turned_as_one;
    detail::repair::closed_components closed(
        parts, turned_as_one::component,
        is_solid ? detail::repair::edge_facts::manifold : detail::repair::edge_facts::unknown);
    const bool is_nested = !is_solid || closed.is_well_nested();
    if (is_solid && is_nested) return;
    found.inverted = closed.turn_outward();
    found.wrongly_nested = !is_nested && (found.inverted == 0 || !closed.is_well_nested());
}

}  // namespace

bool solid_defects::any() const {
    return nonfinite_vertices + unusable_faces + degenerate + repeated + boundary_edges +
                   nonmanifold_edges + misoriented_edges + nonmanifold_vertices + meeting_pairs +
                   inverted >
               0 ||
           wrongly_nested || without_faces;
}

std::string solid_defects::message() const {
    std::string text;
    const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
    const auto add_count = [&](std::uint64_t n, const char* one, const char* several) {
        if (n > 0) add(detail::base::counted(n, one, several));
    };
    add_count(nonfinite_vertices, "vertex that is not finite", "vertices that are not finite");
    add_count(unusable_faces, "face with a corner that is not finite or not a vertex",
              "faces with a corner that is not finite or not a vertex");
    if (without_faces) add("there are points, but no faces");
    if (tetrahedra > 0)
        add("faces are the sides of " +
            detail::base::counted(tetrahedra, "tetrahedron", "tetrahedra"));
    if (boundary_edges > 0)
        add("open at " + detail::base::counted(boundary_edges, "edge", "edges"));
    add_count(nonmanifold_edges, "edge of more than two faces", "edges of more than two faces");
    add_count(misoriented_edges, "edge where faces disagree", "edges where faces disagree");
    add_count(nonmanifold_vertices, "vertex where parts touch", "vertices where parts touch");
    add_count(meeting_pairs, "pair of faces meets", "pairs of faces meet");
    add_count(degenerate, "face without area", "faces without area");
    add_count(repeated, "repeated face", "repeated faces");
    add_count(inverted, "part inside out", "parts inside out");
    if (wrongly_nested) add("parts are wrongly nested");
    return text.empty() ? "no defects" : text;
}

solid_defects find_solid_defects(const mesh_ref& of, const progress_callback& progress) {
    const mesh_view given = of.view();
    solid_defects found;
    const invalid_faces elements = find_invalid_faces(given);
    found.nonfinite_vertices = elements.nonfinite_points.size();
    found.unusable_faces = elements.nonfinite_faces.size() + elements.out_of_range_faces.size();
    found.degenerate = elements.degenerate_faces.size();
    found.without_faces = !given.points.empty() && given.faces.size() == found.unusable_faces;
    mesh joined = joined_usable(given, found.unusable_faces);
    const auto met =
        self_intersections(joined, {.vertices = vertex_identity::by_index, .progress = progress});
    if (met.status == treeform::status::cancelled) {
        found.status = treeform::status::cancelled;
        return found;
    }
    found.meeting_pairs = met.pairs.size();
    found.tetrahedra = detail::repair::count_tetrahedra(joined);
    const topology_counts topology = count_topology(joined.points.size(), joined.faces);
    found.repeated = topology.duplicate_faces;
    found.boundary_edges = topology.boundary_edges;
    found.nonmanifold_edges = topology.nonmanifold_edges;
    found.misoriented_edges = topology.misoriented_edges;
    found.nonmanifold_vertices = topology.nonmanifold_points;
    std::erase_if(joined.faces,
                  [](const face& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; });
    count_inverted(std::move(joined), found);
    return found;
}

}  // namespace treeform
