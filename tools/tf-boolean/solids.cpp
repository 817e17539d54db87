#include "tools/tf-boolean/solids.hpp"

#include "tools/shell/console.hpp"
#include "tools/shell/curve_file.hpp"
#include "tools/shell/usable_input.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/measure.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

solid read_solid(job& work, const std::string& path, const std::filesystem::path& matrix_file,
                 json& about) {
    solid s;
    s.path = path;
    const std::string name = name_of_input(path);
    s.file = work.read(path, about);
    work.warn(s.file.warnings, name + ": ");
    const auto timing = work.time("prepare");
    s.triangles = s.file.mesh.faces.size();
    if (!matrix_file.empty()) {
        const tf::transform<3> matrix = read_matrix(matrix_file);
        s.file.move(matrix);
        about["matrix"] = matrix_file.string();
    }
    s.triangle_of_face = tf::drop_unusable_faces(s.file.mesh);
    const std::uint64_t dropped = s.triangles - s.file.mesh.faces.size();
    work.warn_of_non_finite(dropped, "face", "faces", name + ": ");
    // A mesh of nothing is what a difference may leave; points alone are no mesh.
    if (s.file.mesh.faces.empty() && !s.file.mesh.points.empty())
        throw no_triangles(name, s.triangles, s.file.mesh.points.size());
    check_arrangeable(name, s.file.mesh);
    if (s.file.mesh.faces.empty()) work.warn("empty", name + ": no faces; used as an empty solid");
    about["faces"] = s.file.stored_faces;
    about["triangles"] = s.triangles;
    about["volume"] = tf::signed_volume(s.file.mesh);
    about["skipped"]["non_finite"] = dropped;
    return s;
}

void mend(job& work, const boolean_settings& settings, solid& s, json& about) {
    const std::string name = name_of(s);
    const tf::repair_options options{
        .as_one = true, .keep_cuts = settings.keep_cuts, .progress = work.progress("repair")};
    tf::repaired_file made = tf::repair_file(s.source(), options);
    work.call_ended(made.certificate.status == tf::status::cancelled);
    about["repair"] = steps_entry(made.statistics, options);
    if (!made.certificate) {
        about["reason"] = made.certificate.message();
        throw failure(found, "not-repaired",
                      name + ": cannot be repaired: " + made.certificate.message());
    }
    work.out.info(name + ": " + repair_summary(made.statistics));
    made.file.stored_as = s.file.stored_as;
    s.file = std::move(made.file);
    s.triangle_of_face.clear();
    for (std::uint32_t& f : made.face_source)
        if (f != tf::repair_result::none && !s.faces_in_file.empty()) f = s.faces_in_file[f];
    s.faces_in_file = std::move(made.face_source);
}

/// The parts of these names, in place of the inputs that they are of. Of one input they may be
/// letters, in order, where not all are names.
std::vector<solid> named_parts(job& work, std::vector<std::string> names,
                               const std::vector<solid>& wholes) {
    std::vector<std::string> known;
    std::vector<std::vector<tf::file_part>> parts;
    for (const solid& whole : wholes)
        for (const tf::file_part& part : parts.emplace_back(tf::file_parts(whole.source(), true)))
            known.push_back(part.name);
    const auto is_name = [&](auto& name) { return std::ranges::count(known, name) > 0; };
    if (wholes.size() == 1 && !std::ranges::all_of(names, is_name))
        for (std::string& name : names)
            if (const auto n = std::size_t(name[0] - 'a'); name.size() == 1 && n < known.size())
                name = known[n];
    std::vector<solid> named(names.size());
    json entries = json::array();
    for (std::size_t i = 0; i < wholes.size(); ++i)
        for (tf::file_part& part : parts[i]) {
            const auto at = std::size_t(std::ranges::find(names, part.name) - names.begin());
            if (at == names.size() || !named[at].path.empty()) continue;
            json& about = entries[at] = work.entry["inputs"][i];
            about["part"] = part.name;
            about["volume"] = tf::signed_volume(part.file.mesh);
            about["faces"] = about["triangles"] = part.file.mesh.faces.size();
            named[at] = {.path = wholes[i].path,
                         .file = std::move(part.file),
                         .triangles = part.face_in_file.size(),
                         .part = part.name,
                         .faces_in_file = std::move(part.face_in_file)};
        }
    std::erase(known, "");
    if (known.empty()) refuse_unknown(names, wholes.size());
    for (std::size_t k = 0; k < names.size(); ++k)
        if (named[k].path.empty())
            refuse("--expr: no part is named " + names[k] + "; the parts are " + joined(known));
    work.entry["inputs"] = std::move(entries);
    work.out.info(work.name + ": operands in order: " + joined(names));
    return named;
}

/// The names of the objects of a file that stands alone, where these are the operands. A union is
/// of all that the file has, and keeps their names; only what is inside out would be missing in it.
std::vector<std::string> operand_names(job& work, const boolean_settings& settings,
                                       const solid& s) {
    const bool unites = settings.operation == "union",
               has_parts = s.file.attributes.parts.size() > 1;
    std::vector<std::string> names;
    bool is_mixed = !unites;
    if (has_parts)
        for (const tf::file_part& one : tf::file_parts(s.source(), true)) {
            names.push_back(one.name);
            is_mixed = is_mixed || tf::count_inside_out(one.file.mesh) > 0;
        }
    if (names.size() < 2 && !unites && settings.expression.empty())
        work.warn("one-operand",
                  std::string("there is only one operand") +
                      (has_parts ? ", since its parts are pieces of one surface" : "") +
                      "; its overlaps are merged");
    return names.size() > 1 && is_mixed ? names : std::vector<std::string>{};
}

void settle_textures(job& work, std::vector<solid>& solids) {
    std::vector<tf::mesh_file*> files;
    std::vector<std::string> names;
    for (solid& s : solids) {
        files.push_back(&s.file);
        names.push_back(name_of_input(s.path));
    }
    work.warn(tf::unite_textures(files, names));
}

}  // namespace

std::vector<solid> read_solids(job& work, const boolean_settings& settings) {
    std::vector<solid> solids;
    for (std::size_t i = 0; i < work.options.inputs.size(); ++i) {
        const std::string& path = work.options.inputs[i];
        work.entry["inputs"].push_back({{"file", path}});
        json& about = work.entry["inputs"].back();
        for (const char* key : {"part", "format", "sha256", "precision_in", "matrix", "faces",
                                "triangles", "volume", "closed", "reason", "repair"})
            about[key] = nullptr;
        about["open"] = {{"count", nullptr},
                         {"boundary_edges", nullptr},
                         {"misoriented_edges", nullptr},
                         {"list", json::array()}};
        about["skipped"] = {{"non_finite", nullptr}};
        solids.push_back(read_solid(work, path, settings.matrix_files[i], about));
        tf::set_source_columns(solids.back().file, settings.source, {}, {});
    }
    std::vector<std::string> names = settings.names;
    if (solids.size() == 1 && names.empty() && !settings.check && !settings.splits())
        names = operand_names(work, settings, solids[0]);
    if (!names.empty()) solids = named_parts(work, std::move(names), solids);
    for (std::size_t i = 0; settings.repair && i < solids.size(); ++i)
        mend(work, settings, solids[i], work.entry["inputs"][i]);
    if (!settings.check && !settings.no_attributes) settle_textures(work, solids);
    return solids;
}

std::vector<tf::mesh_view> views_of(const std::vector<solid>& solids) {
    std::vector<tf::mesh_view> views;
    for (const solid& s : solids) views.push_back(s.file.mesh);
    return views;
}

tf::attribute_sources sources_of(const std::vector<solid>& solids) {
    std::vector<tf::attribute_source> sources;
    for (const solid& s : solids) sources.push_back(s.source());
    return sources;
}

double diagonal_of(const std::vector<solid>& solids) {
    std::vector<tf::point3> corners;
    for (const solid& s : solids)
        if (const auto box = tf::bounding_box(s.file.mesh.points))
            corners.insert(corners.end(), {box->min, box->max});
    const auto box = tf::bounding_box(corners);
    return box ? box->diagonal() : 0.0;
}

std::vector<std::uint32_t> check_operands(job& work, const std::vector<solid>& solids) {
    const auto timing = work.time("check");
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < solids.size(); ++i) {
        const tf::certificate known =
            tf::check_operand(solids[i].file.mesh, work.progress("check"));
        work.call_ended(known.status == tf::status::cancelled);
        const auto face_in_file = [&](std::uint32_t f) { return solids[i].face_in_file(f); };
        json& about = work.entry["inputs"][i];
        about["closed"] = known.open_edges.empty();
        about["open"] = open_entry(known, face_in_file);
        if (known.open_edges.empty()) continue;
        open.push_back(i);
        about["reason"] = message_of(known, face_in_file);
    }
    return open;
}

void warn_of_open(job& work, const std::vector<solid>& solids,
                  const std::vector<std::uint32_t>& open) {
    for (const std::uint32_t i : open)
        work.warn("open", name_of(solids[i]) + ": not a solid: " +
                              work.entry["inputs"][i]["reason"].get<std::string>());
}

}  // namespace tools
