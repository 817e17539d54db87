#pragma once
/// \file
/// How an operation has ended.

#include <cstdint>

namespace treeform {

/// How an operation that makes a mesh has ended.
enum class status : std::uint8_t {
    ok,              ///< all that the operation promises was checked and holds
    open_input,      ///< an operand is not closed; `open` says where; no mesh is returned
    sheet,           ///< the mesh has a border, as was asked for, and is otherwise as promised
    excessive_loss,  ///< more was lost than the caller allows
    not_manifold,    ///< with equal coordinates joined, an edge has more than two faces, or a
                     ///< vertex more than one fan
    not_certified,   ///< faces still meet in the coordinates returned; `meeting` says which
    vanished,        ///< nothing is left: the result is thinner than the coordinates tell apart,
                     ///< or faces cancel each other out
    out_of_range,    ///< a coordinate of the result is beyond the numbers asked for
    no_place,        ///< of a placement: there is no such place, and its `end` says why
    cancelled        ///< `progress` said stop; nothing is returned
};

}  // namespace treeform
