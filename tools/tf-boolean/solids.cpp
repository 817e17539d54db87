#include "tools/tf-boolean/solids.hpp"

#include "tools/common/arrangeable.hpp"
#include "tools/common/console.hpp"
#include "tools/common/matrix_file.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/carry.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

json triple(const tf::point3& p) { return {p.x, p.y, p.z}; }

/// Leaves out the faces that cannot be computed with.
void keep_usable(job& work, solid& s) {
    const std::size_t before = s.file.mesh.faces.size();
    s.triangle_of_face = tf::drop_unusable_faces(s.file.mesh);
    s.non_finite = before - s.file.mesh.faces.size();
    if (s.non_finite == 0) return;
    work.warn("non-finite", name_of_input(s.path) + ": " + counted(s.non_finite, "face", "faces") +
                                " with a NaN or infinite coordinate left out");
}

/// Where faces of an earlier result came from is not what those of this one come from.
void forget_sources(tf::mesh_file& file, const std::string& source) {
    for (tf::element& e : file.attributes.elements)
        if (e.name == "face")
            std::erase_if(e.columns, [&](const tf::column& c) {
                return c.name == source + "_mesh" || c.name == source + "_face";
            });
    std::erase_if(file.attributes.comments, [&](const std::string& comment) {
        return comment.starts_with(source + "_mesh ");
    });
}

solid read_solid(job& work, const std::string& path, const std::filesystem::path& matrix_file,
                 json& about) {
    solid s;
    s.path = path;
    const std::string name = name_of_input(path);
    s.file = work.read(path, about);
    for (const tf::io_warning& w : s.file.warnings) work.warn(w.code, name + ": " + w.text);
    const auto timing = work.time("prepare");
    s.triangles = s.file.mesh.faces.size();
    if (!matrix_file.empty()) {
        const tf::transform<3> matrix = read_matrix(matrix_file);
        for (tf::point3& p : s.file.mesh.points) p = matrix(p);
        tf::transform_normals(s.file, matrix);
        about["matrix"] = matrix_file.string();
    }
    keep_usable(work, s);
    // A mesh of nothing is what a difference may leave; points alone are no mesh.
    if (s.file.mesh.faces.empty() && !s.file.mesh.points.empty())
        throw failure(bad_input, "no-triangles", name + ": no triangle with finite coordinates");
    check_arrangeable(name, s.file.mesh);
    if (s.file.mesh.faces.empty()) work.warn("empty", name + ": no faces: an empty solid");
    about["faces"] = s.file.stored_faces;
    about["triangles"] = s.triangles;
    about["volume"] = tf::signed_volume(s.file.mesh);
    about["skipped"]["non_finite"] = s.non_finite;
    return s;
}

json edge_entry(const tf::open_edge& edge, const solid& s) {
    return {{"face", s.stored_face(edge.face.index)},
            {"from", triple(edge.ends[0])},
            {"to", triple(edge.ends[1])}};
}

std::string reason_of(const tf::certificate& found, const solid& s) {
    const tf::open_edge& first = found.open.front();
    return "its surface ends at " + counted(found.open_count, "edge", "edges") +
           ", the first from " + in_words(first.ends[0]) + " to " + in_words(first.ends[1]) +
           " at face " + std::to_string(s.stored_face(first.face.index));
}

void settle_textures(job& work, std::vector<solid>& solids) {
    std::vector<tf::mesh_file*> files;
    std::vector<std::string> names;
    for (solid& s : solids) {
        files.push_back(&s.file);
        names.push_back(name_of_input(s.path));
    }
    for (const tf::io_warning& w : tf::unite_textures(files, names)) work.warn(w.code, w.text);
}

}  // namespace

std::string in_words(const tf::point3& p) {
    return "(" + shortest(p.x) + ", " + shortest(p.y) + ", " + shortest(p.z) + ")";
}

std::vector<solid> read_solids(job& work, const boolean_settings& settings) {
    std::vector<solid> solids;
    for (std::size_t i = 0; i < work.options.inputs.size(); ++i) {
        const std::string& path = work.options.inputs[i];
        work.entry["inputs"].push_back({{"file", path}});
        json& about = work.entry["inputs"].back();
        for (const char* key : {"format", "sha256", "precision_in", "matrix", "faces", "triangles",
                                "volume", "closed", "reason"})
            about[key] = nullptr;
        about["open"] = {{"count", nullptr}, {"list", json::array()}};
        about["skipped"] = {{"non_finite", nullptr}};
        solids.push_back(read_solid(work, path, settings.matrix_files[i], about));
        forget_sources(solids.back().file, settings.source);
    }
    if (!settings.check && !settings.no_attributes) settle_textures(work, solids);
    return solids;
}

std::vector<tf::mesh_view> views_of(const std::vector<solid>& solids) {
    std::vector<tf::mesh_view> views;
    views.reserve(solids.size());
    for (const solid& s : solids) views.push_back(s.file.mesh);
    return views;
}

std::vector<tf::carry_source> sources_of(const std::vector<solid>& solids) {
    std::vector<tf::carry_source> sources;
    sources.reserve(solids.size());
    for (const solid& s : solids) sources.push_back(s.source());
    return sources;
}

double diagonal_of(const std::vector<solid>& solids) {
    std::vector<tf::point3> corners;
    for (const solid& s : solids)
        if (const auto box = tf::bounding_box(s.file.mesh.points)) {
            corners.push_back(box->min);
            corners.push_back(box->max);
        }
    const auto box = tf::bounding_box(corners);
    return box ? tf::diagonal(*box) : 0.0;
}

std::vector<std::uint32_t> check_solids(job& work, const std::vector<solid>& solids) {
    const auto timing = work.time("check");
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < solids.size(); ++i) {
        const tf::certificate found = tf::check_solid(solids[i].file.mesh, work.progress("check"));
        work.out.end_progress();
        work.keeper.check();
        if (found.status == tf::status::cancelled)
            throw failure(stopped, "stopped", work.name + ": stopped");
        json& about = work.entry["inputs"][i];
        about["closed"] = found.open.empty();
        about["open"]["count"] = found.open_count;
        if (found.open.empty()) continue;
        open.push_back(i);
        for (const tf::open_edge& edge : found.open)
            about["open"]["list"].push_back(edge_entry(edge, solids[i]));
        about["reason"] = reason_of(found, solids[i]);
    }
    return open;
}

void warn_of_open(job& work, const std::vector<solid>& solids,
                  const std::vector<std::uint32_t>& open) {
    for (const std::uint32_t i : open)
        work.warn("open", name_of_input(solids[i].path) + ": no solid: " +
                              work.entry["inputs"][i]["reason"].get<std::string>());
}

}  // namespace tools
