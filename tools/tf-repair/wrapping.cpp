#include "tools/tf-repair/wrapping.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/mesh_output.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tools {
namespace {

tf::offset_result wrapped(job& work, const dirty_mesh& input, const wrap_settings& settings,
                          tf::precision precision) {
    const auto timing = work.time("repair");
    tf::offset_options options{.precision = precision, .progress = work.progress("wrap")};
    if (settings.offset) options.offset = settings.offset->used(input.diagonal);
    try {
        tf::offset_result made =
            tf::wrap(input.file.mesh, settings.size->used(input.diagonal), options);
        work.call_ended(made.certificate.status == tf::status::cancelled);
        return made;
    } catch (const std::invalid_argument& what) {
        std::string text = what.what();
        if (const std::string head = "treeform::wrap: "; text.starts_with(head))
            text.erase(0, head.size());
        throw failure(bad_usage, "wrap", "--wrap: " + work.name + ": " + text);
    }
}

void enter(job& work, const dirty_mesh& input, const tf::offset_result& made, double volume) {
    const auto topology = tf::count_topology(made.mesh.points.size(), made.mesh.faces);
    work.entry["wrap"] = {{"certified", static_cast<bool>(made.certificate)},
                          {"size", made.resolution},
                          {"offset", made.distance},
                          {"points", made.tetrahedra_points},
                          {"tetrahedra", made.tetrahedra},
                          {"filled", made.filled_tetrahedra},
                          {"volume", {{"before", input.volume}, {"after", volume}}},
                          {"precision_out", name_of(made.certificate.precision)},
                          {"vertices", made.mesh.points.size()},
                          {"faces", made.mesh.faces.size()},
                          {"components", topology.components_by_point}};
}

/// If a surface has a hole wider than about twice the size, the wrap covers both sides of it, and
/// encloses less volume.
void warn_of_skin(job& work, const dirty_mesh& input, const tf::offset_result& made,
                  double volume) {
    constexpr double much = 0.9;
    if (volume > much * std::abs(input.volume)) return;
    const tf::mesh_view mesh = input.file.mesh;
    const tf::mesh joined = tf::join_meshes({&mesh, 1});
    const auto edges = tf::count_topology(joined.points.size(), joined.faces);
    // Where parts overlap or are within each other, volumes say nothing.
    if (edges.boundary_edges <= edges.nonmanifold_edges) return;
    work.warn("double-walled",
              "the wrap covers both sides of faces, since it enters holes wider than about " +
                  brief(2.0 * made.resolution) + "; a larger --wrap closes them");
}

}  // namespace

void add_wrapping(command_line& line, wrap_settings& target) {
    line.group("Last resort, instead of the steps");
    line.option(target.size, {"--wrap", "SIZE",
                              "a closed surface around all faces; closes gaps and\n"
                              "holes narrower than about twice SIZE"});
    line.option(target.offset,
                {"--offset", "DIST", "distance of the surface from the faces", "SIZE / 30"});
}

void check_wrapping(const command_line& line, const wrap_settings& settings) {
    if (!settings.size) {
        if (settings.offset) refuse("--offset needs --wrap");
        return;
    }
    for (const char* name :
         {"--check", "--gap", "--holes", "--strays", "--fill-rule", "--sheet", "--keep-cuts",
          "--max-loss", "--accept-loss", "--max-move", "--source", "--curves", "--no-join",
          "--no-orient", "--no-fill", "--no-resolve", "--no-detach"})
        if (line.given(name)) refuse(std::string(name) + ": --wrap replaces all steps");
    if (!(settings.size->value > 0.0)) refuse("--wrap: expected a SIZE greater than 0");
    if (settings.offset && !(settings.offset->value > 0.0))
        refuse("--offset: expected a DIST greater than 0");
}

exit_status wrap(job& work, const dirty_mesh& input, const wrap_settings& settings,
                 const std::optional<std::filesystem::path>& output) {
    std::optional<written_form> form;
    if (output) form = form_of(work, input.file, *output);
    const tf::mesh_file* const inputs = &input.file;
    tf::offset_result made =
        wrapped(work, input, settings, written_precision(work.options, form, {&inputs, 1}));
    const double volume = tf::signed_volume(made.mesh);
    enter(work, input, made, volume);
    if (!made.certificate)
        throw std::logic_error("the wrap is no solid: " + made.certificate.message());
    const std::string verdict = "wrap, " + counted(made.mesh.faces.size(), "face", "faces") +
                                ", volume " + brief(volume) + " (was " + brief(input.volume) +
                                "), " + brief(made.distance) + " from the faces";
    work.out.result(work.name + ": " + verdict);
    warn_of_skin(work, input, made, volume);
    write_page(work, input, verdict, true, made.mesh,
               std::vector(made.mesh.faces.size(), tf::repair_result::none));
    if (!output || work.options.dry_run) return done;
    const auto timing = work.time("write");
    tf::mesh_file file = file_of(std::move(made.mesh), made.certificate);
    file.attributes.comments = input.file.attributes.comments;  // such as the unit
    write_certified(work, file, *form, *output, 0.0);
    return done;
}

}  // namespace tools
