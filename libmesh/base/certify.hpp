#pragma once
/// \file
/// Fills in certificates.

#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <cstddef>

namespace treeform::detail::base {

/// Sets `meeting_at` and `precision`.
inline void describe(certificate& known, mesh_view mesh, precision of) {
    known.precision = of;
    known.meeting_at.clear();
    for (const auto& [f, g] : known.meeting)
        if (f < mesh.faces.size())  // the mesh is empty if cancelled
            known.meeting_at.push_back(mesh.points[mesh.faces[f][0]]);
}

/// For functions of one mesh: open faces without an operand.
inline void name_no_operand(certificate& known) {
    for (operand_element& face : known.open_faces) face.operand = operand_element::none;
}

/// Sets the status `not_certified` for pairs of faces that meet, and lists the first 100.
template <class Pairs>
void refuse_meeting(certificate& known, const Pairs& pairs, mesh_view mesh) {
    known.status = status::not_certified;
    known.meeting_count = pairs.size();
    for (std::size_t i = 0; i < pairs.size() && i < 100; ++i)
        known.meeting.push_back({pairs[i].a, pairs[i].b});
    describe(known, mesh, known.precision);
}

}  // namespace treeform::detail::base
