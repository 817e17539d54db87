#pragma once
/// \file
/// The codes of packing and alignment that did not succeed.

#include <treeform/mesh/align.hpp>
#include <treeform/mesh/pack.hpp>

#include <tools/c/made/structs.hpp>

namespace glue {

inline treeform_code give(tf::packing&& found, treeform_packing** out) {
    check(found.certificate.status);
    if (found.not_placed.empty()) return hand_out(std::move(found), out), TREEFORM_OK;
    say(found.message().c_str());
    return hand_out(std::move(found), out), TREEFORM_NO_PLACE;
}

inline treeform_code give(tf::align_result&& found, treeform_align_result** out) {
    check(found.status);
    if (found.converged) return hand_out(std::move(found), out), TREEFORM_OK;
    say(found.message().c_str());
    return hand_out(std::move(found), out), TREEFORM_NO_PLACE;
}

}  // namespace glue
