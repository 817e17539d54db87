#include "tools/tf-place/body.hpp"

#include "tools/common/console.hpp"
#include "tools/common/matrix_file.hpp"
#include "tools/common/mesh_output.hpp"
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

/// Adds what `file` holds: its parts, or all of it as one. What is left out is said by `work`.
/// \throws failure (bad_input) when there is nothing to place
void add_bodies(job& work, const std::string& path, tf::mesh_file file, bool in_parts,
                body_set& to) {
    const auto timing = work.time("prepare");
    const auto shared = std::make_shared<tf::mesh_file>(std::move(file));
    tf::file_bodies found = in_parts ? tf::bodies_of(*shared) : tf::whole_body(*shared);
    work.warn_of_non_finite(found.left_out, found.cloud ? "point" : "face",
                            found.cloud ? "points" : "faces", name_of_input(path) + ": ");
    if (found.bodies.empty())
        throw failure(bad_input, "no-triangles",
                      name_of_input(path) + ": no triangle with finite coordinates (" +
                          counted(shared->mesh.points.size(), "point", "points") + ")");
    const std::size_t file_number = to.entries.size();
    for (std::size_t i = 0; i < found.bodies.size(); ++i) {
        const tf::mesh_view mesh = found.shapes[i].view();
        to.bodies.push_back({.path = path,
                             .file = shared,
                             .file_number = file_number,
                             .is = std::move(found.bodies[i]),
                             .cloud = found.cloud,
                             .faces = mesh.faces.size(),
                             .box = tf::bounding_box(mesh.points),
                             .non_finite = i == 0 ? found.left_out : 0});
        to.shapes.push_back(std::move(found.shapes[i]));
    }
}

}  // namespace

std::string body::label() const {
    return is.name.empty() ? name_of_input(path) : name_of_input(path) + ": " + is.name;
}

std::vector<std::string> body_set::labels() const {
    std::vector<std::string> all;
    for (const body& b : bodies) all.push_back(b.label());
    return all;
}

std::size_t body_set::indexed() const {
    return static_cast<std::size_t>(
        std::count_if(shapes.begin(), shapes.end(),
                      [](const tf::prepared_mesh& m) { return m.indexes_built() > 0; }));
}

json read_body(job& work, const std::string& path, const tf::transform<3>& start, body_set& to) {
    json about{{"input", path}};
    tf::mesh_file file = work.read(path, about);
    for (const char* key : {"format", "sha256", "precision_in"})
        if (!work.options.joined) work.entry[key] = about[key];
    work.warn(file.warnings, work.options.joined ? name_of_input(path) + ": " : "");
    if (start != tf::transform<3>{})
        for (tf::point3& p : file.mesh.points) p = start(p);
    add_bodies(work, path, std::move(file), false, to);
    return about;
}

void read_fixed(job& work, const place_settings& settings, bool as_single, body_set& fixed) {
    if (fixed.read && fixed.as_single == as_single) return;
    fixed = {};
    fixed.as_single = as_single;
    for (const std::string& path : settings.fixed) {
        json about{{"input", path}};
        tf::mesh_file file = work.read(path, about);
        const std::string whose = name_of_input(path) + ": ";
        work.warn(file.warnings, whose);
        if (as_single) warn_of_rounding(work, tf::round_to_float32(file), whose);
        // Alignment is to all of a file, which may be a cloud.
        add_bodies(work, path, std::move(file), settings.mode != place_mode::fit, fixed);
        fixed.entries.push_back(std::move(about));
    }
    fixed.read = true;
}

tf::transform<3> start_of(const place_settings& settings) {
    return settings.start.empty() ? tf::transform<3>{} : read_matrix(settings.start);
}

}  // namespace tools
