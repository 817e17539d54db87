#pragma once
/// \file
/// Parses the model parts of a 3MF package.

#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/source.hpp>
#include <libmesh/io/zip_archive.hpp>

#include <string_view>

namespace treeform::detail::io {

/// The build of the package, and the objects that it needs; other objects are not parsed. `root` is
/// the name of the root model part. Other parts are read if items or components of the root refer
/// to them (production extension).
///
/// All references are valid, but objects may still be components of themselves.
///
/// \throws io_error
[[nodiscard]] model_3mf parse_3mf(const source& in, zip_archive& archive, std::string_view root);

}  // namespace treeform::detail::io
