#include "tools/common/certified_output.hpp"

#include "tools/common/output_file.hpp"
#include <libmesh/io/io_error.hpp>
#include <libmesh/io/read.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace tools {
namespace {

bool is_text(const std::string& format) {
    return format.ends_with("ascii") || format.starts_with("obj") || format.starts_with("off") ||
           format.starts_with("xyz") || format.starts_with("csv");
}

bool same_corners(const tf::mesh& a, const tf::mesh& b) {
    if (a.faces.size() != b.faces.size()) return false;
    for (std::size_t f = 0; f < a.faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            if (!(a.points[a.faces[f][k]] == b.points[b.faces[f][k]])) return false;
    return true;
}

/// The faces by their corners' coordinates, each from its least corner on, ascending.
std::vector<std::array<std::array<double, 3>, 3>> sorted_corners(const tf::mesh& mesh) {
    std::vector<std::array<std::array<double, 3>, 3>> all(mesh.faces.size());
    for (std::size_t f = 0; f < all.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const tf::point3& p = mesh.points[mesh.faces[f][k]];
            all[f][k] = {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 is 0
        }
        std::rotate(all[f].begin(), std::min_element(all[f].begin(), all[f].end()), all[f].end());
    }
    std::sort(all.begin(), all.end());
    return all;
}

/// GLB is read by others, which renumber points, and has faces by colour. Builds without a reader
/// for it have nothing to look with.
void look_again_at_glb(const std::filesystem::path& path, const tf::mesh& surface) {
    if (!tf::reads_scenes()) return;
    if (sorted_corners(tf::read_mesh(path, "glb").mesh) != sorted_corners(surface))
        throw std::logic_error("the file written does not hold what was certified");
}

/// What was certified is what is on the disk now.
void look_again(const std::filesystem::path& path, const std::string& format,
                const tf::mesh& surface) {
    std::error_code error;
    if (path == "-" || !std::filesystem::is_regular_file(path, error)) return;
    if (format == "glb") return look_again_at_glb(path, surface);
    const tf::mesh_file written = tf::read_mesh(path, format);
    if (!same_corners(written.mesh, surface) ||
        (written.indexed && written.mesh.faces != surface.faces))
        throw std::logic_error("the file written does not hold what was certified");
}

}  // namespace

bool writes_single(const common_options& o, const std::optional<std::filesystem::path>& output,
                   std::span<const property_source> inputs) {
    if (output) {
        const std::string format = mesh_format(o, *output);
        if (format == "glb" || (format == "stl" && !o.ascii)) return true;
    }
    if (o.precision != "keep") return o.precision == "float";
    return std::all_of(inputs.begin(), inputs.end(), [](const property_source& s) {
        return s.file->stored_as == tf::precision::single_ && !is_text(s.file->format) &&
               tf::fits_single(s.file->mesh.points);
    });
}

tf::write_result write_certified(job& work, tf::mesh_file& file,
                                 const std::filesystem::path& path) {
    const common_options& o = work.options;
    const std::string format = mesh_format(o, path);
    output_place place(path, o.force, work.keeper);
    tf::write_result written;
    try {
        written = tf::write_mesh(place.writable(), file,
                                 {.format = format, .ascii = o.ascii, .precision = file.stored_as});
        look_again(place.writable(), format, file.mesh);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    if (written.largest_move > 0.0)
        throw std::logic_error("coordinates were rounded that had been certified");
    place.commit();
    return written;
}

}  // namespace tools
