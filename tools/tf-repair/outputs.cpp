#include "tools/tf-repair/outputs.hpp"

#include "tools/shell/curve_file.hpp"
#include "tools/shell/mesh_output.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <cstddef>

namespace tools {
namespace {

/// The face that each one lies in, -1 where it fills a hole.
void add_sources(tf::mesh_file& file, const std::string& name,
                 const std::vector<std::uint32_t>& face_source) {
    const std::vector<std::int32_t> sources(face_source.begin(), face_source.end());
    file.attributes.find_or_add("face", file.mesh.faces.size())
        .set(tf::column::of<std::int32_t>(name, sources));
}

json parts_entry(const tf::repaired_file& made) {
    json list = json::array();
    for (const tf::repaired_part& part : made.parts)
        list.push_back({{"name", part.name},
                        {"certified", static_cast<bool>(part.certificate) ||
                                          part.certificate.status == tf::status::sheet},
                        {"solid", static_cast<bool>(part.certificate)},
                        {"first_face", part.first_face},
                        {"faces", part.faces},
                        {"volume", part.statistics.volume_after}});
    return list;
}

}  // namespace

void enter_blank_report(job& work, const dirty_mesh& input, const repair_settings& settings) {
    json& entry = work.entry;
    entry["vertices"] = input.file.mesh.points.size();
    entry["faces"] = input.file.stored_faces;
    entry["triangles"] = input.file.mesh.faces.size() + input.non_finite;
    entry["volume"] = input.volume;
    entry["skipped"] = {{"non_finite", input.non_finite}};
    entry["check"] = settings.check;
    for (const char* key : {"defects", "repair", "wrap", "output"}) entry[key] = nullptr;
}

void enter_repair(job& work, const dirty_mesh& input, const repair_settings& settings,
                  const tf::repaired_file& made) {
    const tf::certificate& known = made.certificate;
    const tf::repair_statistics& did = made.statistics;
    const auto topology = tf::count_topology(made.file.mesh.points.size(), made.file.mesh.faces);
    const bool is_made = known.status != tf::status::open_input;
    work.entry["repair"] = {
        {"certified", static_cast<bool>(known) || known.status == tf::status::sheet},
        {"solid", static_cast<bool>(known)},
        {"steps", steps_entry(did, settings.steps)},
        {"parts", parts_entry(made)},
        {"open", open_entry(known, [](std::uint32_t f) { return f; })},
        {"meeting", meeting_entry(known)},
        {"volume", {{"before", input.volume}, {"after", or_null(is_made, did.volume_after)}}},
        {"area",
         {{"before", did.area_before},
          {"after", or_null(is_made, did.area_after)},
          {"lost", or_null(is_made, did.area_lost)}}},
        {"loss", loss_entry(known)},
        {"lost_components", did.vanished_components},
        {"dropped_shells", did.dropped_shells},
        {"precision_out", name_of(known.precision)},
        {"vertices", made.file.mesh.points.size()},
        {"faces", made.file.mesh.faces.size()},
        {"components", topology.components_by_point}};
}

void write_solid(job& work, const dirty_mesh& input, const repair_settings& settings,
                 tf::repaired_file& made, const std::filesystem::path& path) {
    const auto timing = work.time("write");
    const written_form form = form_of(work, input.file, path);
    if (const tf::attribute_source source = input.source();
        tf::attribute_sources(source).has_values_left_out())
        work.warn("attributes", "not all properties of the input are carried over");
    if (!settings.source.empty()) add_sources(made.file, settings.source, made.face_source);
    write_certified(work, made.file, form, path, made.certificate.max_displacement);
}

void write_curves(job& work, const dirty_mesh& input, const repair_settings& settings) {
    if (settings.curves.empty() || work.options.dry_run) return;
    const tf::mesh_view mesh = input.file.mesh;
    const tf::mesh joined = tf::join_meshes({&mesh, 1});
    const auto found = tf::self_intersections(
        joined, {.vertices = tf::vertex_identity::by_index, .progress = work.progress("curves")});
    work.call_ended(found.status == tf::status::cancelled);
    tf::pair_column kinds{"tf_class", {}};
    for (const tf::face_pair& pair : found.pairs)
        kinds.second.push_back(static_cast<std::uint32_t>(pair.kind) + 1);
    write_curves(work, settings.curves, joined, found.pairs, {std::move(kinds)});
}

}  // namespace tools
