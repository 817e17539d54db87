#pragma once
/// \file
/// The model parts of a 3MF package.

#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/io/zip_archive.hpp>

#include <string_view>

namespace treeform::detail::io {

/// The build of the package and the objects that it needs; other objects are not looked at. `root`
/// is the name of the model part that the package starts with. Other parts are read where items
/// and components of the root name them (production extension).
///
/// Each reference leads to an object of `objects`; objects may still be components of themselves.
///
/// \throws io_error
[[nodiscard]] model_3mf parse_3mf(const source& in, zip_archive& archive, std::string_view root);

}  // namespace treeform::detail::io
