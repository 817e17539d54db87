#include "tools/common/certified_output.hpp"

#include "tools/common/console.hpp"
#include "tools/common/output_file.hpp"
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace tools {
namespace {

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

/// GLB is read by others, which renumber points, and has faces by color. Builds without a reader
/// for it have nothing to look with.
void look_again_at_glb(const std::filesystem::path& path, const tf::mesh& surface) {
    if (!tf::reads_scenes()) return;
    if (sorted_corners(tf::read(path, "glb").mesh) != sorted_corners(surface))
        throw std::logic_error("the file written does not hold what was certified");
}

/// What was certified is what is on the disk now.
void look_again(const std::filesystem::path& path, const std::string& format,
                const tf::mesh& surface) {
    std::error_code error;
    if (path == "-" || !std::filesystem::is_regular_file(path, error)) return;
    if (format == "glb") return look_again_at_glb(path, surface);
    const tf::mesh_file written = tf::read(path, format);
    if (!same_corners(written.mesh, surface) ||
        (written.indexed && written.mesh.faces != surface.faces))
        throw std::logic_error("the file written does not hold what was certified");
}

}  // namespace

void warn_of_moves(job& work, tf::points_view points, double max_move, bool to_single) {
    const double step =
        tf::coordinate_step(points, to_single ? tf::precision::float32 : tf::precision::float64);
    if (!(max_move > step)) return;
    work.warn("moved", "so that no faces meet when rounded, points moved by up to " +
                           shortest(max_move) + ", " + shortest(std::ceil(max_move / step)) +
                           " steps of the " + (to_single ? "float32" : "double") +
                           " numbers there; --max-move DIST sets a limit");
}

tf::write_result write_certified(job& work, tf::mesh_file& file, const written_form& form,
                                 const std::filesystem::path& path) {
    const common_options& o = work.options;
    output_place place(path, o.force || o.in_place, work.keeper);
    tf::write_result written;
    try {
        written =
            tf::write(place.writable(), file,
                      {.format = form.format, .ascii = form.ascii, .precision = file.stored_as});
        look_again(place.writable(), form.format, file.mesh);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    if (written.max_displacement > 0.0)
        throw std::logic_error("coordinates were rounded that had been certified");
    place.commit();
    return written;
}

}  // namespace tools
