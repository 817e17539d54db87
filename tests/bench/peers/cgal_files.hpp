#pragma once
/// \file
/// Files through CGAL.

#include "bench/peers/file_kind.hpp"
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <functional>
#include <memory>
#include <string>

namespace treeform::bench {

/// A file as `CGAL::IO::read_polygon_soup` reads it.
struct cgal_soup;
[[nodiscard]] std::shared_ptr<const cgal_soup> cgal_read(const std::string& path);
[[nodiscard]] tf::mesh mesh_of(const std::shared_ptr<const cgal_soup>& soup);

/// Writes `mesh`, which is converted before, to `path` by `CGAL::IO::write_polygon_soup`; text with
/// the nine digits that suffice for any float32.
[[nodiscard]] std::function<void()> cgal_writer(const tf::mesh& mesh, const std::string& path,
                                                const file_kind& kind);

}  // namespace treeform::bench
