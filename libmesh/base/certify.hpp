#pragma once
/// \file
/// What certificates say for people.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

namespace treeform::detail::base {

/// Adds where the faces of `mesh` meet, and the numbers its coordinates are.
inline void describe(certificate& known, mesh_view mesh, precision of) {
    known.precision = of;
    known.meeting_at.clear();
    for (const auto& [f, g] : known.meeting)
        if (f < mesh.faces.size())  // there is no mesh where `progress` said stop
            known.meeting_at.push_back(mesh.points[mesh.faces[f][0]]);
}

}  // namespace treeform::detail::base
