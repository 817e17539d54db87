#pragma once
/// \file
/// The format and options of reading a file.

#include <treeform/mesh/mesh_file.hpp>

#include <string>
#include <string_view>

namespace treeform::detail::io {

/// `format` is an extension without its dot, or empty.
struct reading {
    std::string format{};
    read_options options{};
};

}  // namespace treeform::detail::io
