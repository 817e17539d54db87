#pragma once
/// \file
/// The one exception of the io room.

#include <treeform/tree/export.hpp>

#include <stdexcept>
#include <string>

namespace treeform {

/// A file that cannot be read or written; `what()` names the path, the line or byte, and the
/// reason: "part.obj:17: vertex index 0 (OBJ counts from 1)".
class TREEFORM_API io_error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace treeform
