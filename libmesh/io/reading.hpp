#pragma once
/// \file
/// How a file is to be read.

#include <treeform/mesh/mesh_file.hpp>

#include <string>
#include <string_view>

namespace treeform::detail::io {

/// With the format: an extension without its dot, or nothing.
struct reading {
    std::string format{};
    read_options options{};
};

}  // namespace treeform::detail::io
