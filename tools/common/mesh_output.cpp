#include "tools/common/mesh_output.hpp"

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

/// GLB is read by others, which renumber points, and has faces by color; 3MF has them by part.
/// Builds without a reader for GLB have nothing to look with.
void look_again_at_scene(const std::filesystem::path& path, const std::string& format,
                         const tf::mesh& surface) {
    if (format == "glb" && !tf::reads_scenes()) return;
    if (sorted_corners(tf::read(path, format).mesh) != sorted_corners(surface))
        throw std::logic_error("the file written does not hold what was certified");
}

/// What was certified is what is on the disk now.
void look_again(const std::filesystem::path& path, const std::string& format,
                const tf::mesh& surface) {
    std::error_code error;
    if (path == "-" || !std::filesystem::is_regular_file(path, error)) return;
    if (format == "glb" || format == "3mf") return look_again_at_scene(path, format, surface);
    const tf::mesh_file written = tf::read(path, format);
    if (!same_corners(written.mesh, surface) ||
        (written.indexed && written.mesh.faces != surface.faces))
        throw std::logic_error("the file written does not hold what was certified");
}

/// `check` looks at what was written before it has its name.
tf::write_result write(job& work, const tf::mesh_file& file, const tf::write_options& options,
                       const std::filesystem::path& path, const auto& check) {
    const common_options& o = work.options;
    output_place place(path, o.force || o.in_place, work.keeper);
    tf::write_result written;
    try {
        written = tf::write(place.writable(), file, options);
        check(place.writable(), written);
    } catch (const tf::io_error& error) {
        throw failure(bad_output, "output", place.said_of_path(error.what()));
    }
    place.commit();
    enter_output(work, path, written);
    return written;
}

}  // namespace

void check_outputs(const job& work, std::initializer_list<std::filesystem::path> always,
                   std::initializer_list<std::filesystem::path> also) {
    const common_options& o = work.options;
    const auto check = [&](const std::filesystem::path& path) {
        if (!path.empty()) check_output(path, o.force);
    };
    std::for_each(always.begin(), always.end(), check);
    if (o.dry_run) return;
    std::for_each(also.begin(), also.end(), check);
    if (const auto path = mesh_output(o, work.path)) check_output(*path, o.force || o.in_place);
}

void warn_of_moves(job& work, tf::points_view points, const tf::certificate& known) {
    const double step = tf::coordinate_step(points, known.precision);
    const double moved = known.max_displacement;
    if (!(moved > step)) return;
    work.warn("moved", "so that no faces meet when rounded, points moved by up to " +
                           shortest(moved) + ", " + shortest(std::ceil(moved / step)) +
                           " steps of the " + numbers_of(known.precision) +
                           " numbers there; --max-move DIST sets a limit");
}

void warn_of_rounding(job& work, double max_displacement, const std::string& whose) {
    if (max_displacement > 0.0)
        work.warn("rounded", whose + "written in single precision: coordinates move by up to " +
                                 shortest(max_displacement));
}

void warn_of_folds(job& work, const tf::rounding_defects& defects, tf::precision precision) {
    std::string text;
    if (defects.collapsed > 0)
        text = counted(defects.collapsed, "face has", "faces have") + " no area any more";
    if (defects.meeting > 0)
        text += (text.empty() ? "" : ", ") + counted(defects.meeting, "pair", "pairs") +
                " of faces " + (defects.meeting == 1 ? "meets" : "meet") + " that did not";
    if (text.empty()) return;
    work.warn("folded", "by rounding, " + text + "; " +
                            (precision == tf::precision::float32
                                 ? "--precision double, in a format that has it, may keep them"
                                 : "nearer to the origin they would stay"));
}

void enter_rounding(job& work, const tf::rounding_effects& lost, tf::precision precision) {
    work.entry["rounding"] = {{"max_move", lost.max_displacement},
                              {"step", lost.step},
                              {"collapsed_faces", or_null(lost.compared, lost.collapsed)},
                              {"new_pairs", or_null(lost.compared, lost.meeting)}};
    if (lost.noticeable && precision == tf::precision::float32)
        warn_of_rounding(work, lost.max_displacement);
    else if (lost.noticeable)
        work.warn("rounded", "coordinates move by up to " + shortest(lost.max_displacement));
    if (lost.compared)
        warn_of_folds(work, {.collapsed = lost.collapsed, .meeting = lost.meeting}, precision);
}

void enter_output(job& work, const std::filesystem::path& path, const tf::write_result& written) {
    json& output = work.entry["output"];
    output["file"] = path.string();
    output["format"] = written.format;
    output["precision_out"] = name_of(written.written_as);
    output.emplace("max_move", written.max_displacement);
    work.warn(written.warnings);
}

tf::mesh_file file_of(tf::mesh&& surface, const tf::certificate& known) {
    tf::mesh_file file{.mesh = std::move(surface)};
    file.stored_faces = file.mesh.faces.size();
    file.stored_as = known.precision;
    return file;
}

tf::write_result write_mesh(job& work, const tf::mesh_file& file, const tf::write_options& options,
                            const std::filesystem::path& path) {
    return write(work, file, options, path, [](const auto&, const auto&) {});
}

void write_certified(job& work, const tf::mesh_file& file, const written_form& form,
                     const std::filesystem::path& path) {
    const auto look = [&](const std::filesystem::path& there, const tf::write_result& written) {
        look_again(there, form.format, file.mesh);
        if (written.max_displacement > 0.0)
            throw std::logic_error("coordinates were rounded that had been certified");
    };
    write(work, file, {.format = form.format, .ascii = form.ascii, .precision = file.stored_as},
          path, look);
}

}  // namespace tools
