#include "tools/shell/curve_file.hpp"

#include "tools/shell/common_options.hpp"
#include "tools/shell/exit_status.hpp"
#include "tools/shell/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

namespace tools {

void check_curve_path(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (!path.empty() && path != "-" && extension != "ply" && extension != "obj")
        refuse(path.string() + ": curves can be written as obj or ply");
}

void write_curves(const job& work, const std::filesystem::path& path, tf::mesh_view mesh,
                  std::span<const tf::face_pair> pairs,
                  const std::vector<tf::pair_column>& numbers) {
    if (path.empty() || work.options.dry_run) return;
    output_place place(path, work.options.force);
    try {
        tf::write_curves(place.writable(), mesh, pairs, numbers, path == "-" ? "obj" : "");
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
}

}  // namespace tools
