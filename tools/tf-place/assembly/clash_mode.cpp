#include "tools/shell/console.hpp"
#include "tools/shell/made/report_fields.hpp"
#include "tools/shell/mesh_output.hpp"
#include "tools/tf-place/assembly/assembly.hpp"
#include "tools/tf-place/assembly/contact_entries.hpp"
#include "tools/tf-place/assembly/measured.hpp"
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <utility>

namespace tools {
namespace {

using tf::mesh_relation;

constexpr std::size_t most_lines = 20;
constexpr std::size_t most_faces = 1000;  // listed of a region and part

/// The first of them, as numbers in the file.
json faces_entry(const tf::body_set& set, std::size_t body,
                 const std::vector<std::uint32_t>& faces) {
    json listed = json::array();
    for (std::size_t i = 0; i < std::min(faces.size(), most_faces); ++i)
        listed.push_back(set.face_in_file(body, faces[i]));
    return listed;
}

json regions_entry(const named_assembly& all, const tf::part_clash& one) {
    json regions = json::array();
    for (const tf::contact_region& region : one.regions) {
        const json faces_a = faces_entry(all.set, one.a, region.faces_a);
        const json faces_b = faces_entry(all.set, one.b, region.faces_b);
        regions.push_back({{"box", region.box},
                           {"face_pairs", region.face_pairs},
                           {"faces_a", faces_a},
                           {"faces_b", faces_b}});
    }
    return regions;
}

json clash_entry(const named_assembly& all, const tf::part_clash& one) {
    return {{"a", all.names[one.a]},
            {"b", all.names[one.b]},
            {"status", name_of(one.relation)},
            {"inside", one.a_inside_b   ? json("a")
                       : one.b_inside_a ? json("b")
                                        : json(nullptr)},
            {"distance", one.distance},
            {"nearest", one.nearest},
            {"volume", one.volume},
            {"depth", one.depth},
            {"move", or_null(one.depth.has_value(), one.move)},
            {"effort", or_null(one.depth.has_value(), effort_entry(one.depth_effort))},
            {"face_pairs", one.face_pairs},
            {"regions", regions_entry(all, one)}};
}

std::string sentence(const named_assembly& all, const tf::part_clash& one) {
    std::string text = all.names[one.a] + " and " + all.names[one.b] + ": " + name_of(one.relation);
    if (one.relation == mesh_relation::closer_than_clearance)
        return text + ", " + brief(one.distance);
    if (one.a_inside_b) text += ", the first inside the second";
    if (one.b_inside_a) text += ", the second inside the first";
    if (one.depth) text += ", at most " + brief(*one.depth) + " deep";
    if (one.volume) text += ", common volume " + brief(*one.volume);
    if (one.depth) text += skipped_in_words(one.depth_effort);
    if (!one.regions.empty())
        text += "; " + counted(one.regions.size(), "region", "regions") + ", " +
                counted(one.face_pairs, "pair", "pairs") + " of faces";
    return text;
}

/// "12 parts: 1 pair penetrates, 3 touch"
std::string totals(const named_assembly& all, const tf::clash_result& r) {
    const auto number = [&](mesh_relation how) { return r.counts[static_cast<std::size_t>(how)]; };
    std::string text =
        counted(all.names.size(), "part", "parts") + ": " +
        counted(number(mesh_relation::penetrating), "pair penetrates", "pairs penetrate") + ", " +
        grouped(number(mesh_relation::touching)) + " touch";
    if (number(mesh_relation::closer_than_clearance) + number(mesh_relation::clear) > 0)
        text += ", " + grouped(number(mesh_relation::closer_than_clearance)) +
                " closer than the clearance";
    return text;
}

void say(job& work, const named_assembly& all, const tf::clash_result& r) {
    const std::vector<const tf::part_clash*> worst = gravest_first(r);
    const std::size_t shown = work.out.shows(level::info) ? worst.size() : most_lines;
    for (std::size_t i = 0; i < std::min(worst.size(), shown); ++i)
        work.out.result(work.name + ": " + sentence(all, *worst[i]));
    if (worst.size() > shown)
        work.out.result(work.name + ": and " + counted(worst.size() - shown, "pair", "pairs") +
                        " more; -v lists all");
    work.out.result(work.name + ": " + totals(all, r));
}

/// What the file has as one part may be several.
void warn_of_one(job& work, const tf::prepared_mesh& part) {
    const auto [points, faces] = part.indexed_view();
    if (part.is_cloud()) return;
    const std::uint64_t components = tf::count_topology(points.size(), faces).components_by_point;
    if (components > 1)
        work.warn("one-part", "there is only one part, and it has " + grouped(components) +
                                  " components; split them with tf-cut parts");
}

/// How each face of each part lies to others: as its gravest pair.
std::vector<std::vector<mesh_relation>> face_relations(const named_assembly& all,
                                                       const tf::clash_result& r) {
    std::vector<std::vector<mesh_relation>> relations(all.names.size());
    const auto mark = [&](std::size_t part, const std::vector<std::uint32_t>& faces,
                          mesh_relation how) {
        relations[part].resize(all.set.shapes[part].indexed_view().faces.size());
        for (const std::uint32_t f : faces) relations[part][f] = std::max(relations[part][f], how);
    };
    for (const tf::part_clash& pair : r.pairs)  // faces that meet: touching < penetrating
        for (const tf::contact_region& region : pair.regions) {
            mark(pair.a, region.faces_a, pair.relation);
            mark(pair.b, region.faces_b, pair.relation);
        }
    return relations;
}

void write_parts(job& work, const named_assembly& all, const tf::clash_result& r) {
    const auto path = mesh_output(work.options, work.path);
    if (!path || work.options.dry_run) return;
    const auto timing = work.time("write");
    std::vector<const tf::mesh_file*> inputs;
    std::vector<std::string> names, labels;
    for (const tf::body_file& file : all.set.files) {
        inputs.push_back(&file.content);
        names.push_back(file.name);
        labels.push_back(file.label);
    }
    const written_form form = form_of(work, all.set.files[0].content, *path);
    tf::mesh_file file = tf::scene_of(inputs, names, labels);
    work.warn(file.warnings);
    if (form.format == "ply" || form.format == "glb") {
        const tf::box3 box = tf::bounding_box(file.mesh.points).value_or(tf::box3{});
        file.split_polygons();
        tf::placement::color(file, all.set.relations_in_files(face_relations(all, r), false),
                             0.02 * box.diagonal());
    }
    static_cast<void>(write_mesh(work, file,
                                 {.format = form.format,
                                  .ascii = form.ascii,
                                  .precision = written_precision(work.options, form, inputs)},
                                 *path));
}

}  // namespace

std::vector<const tf::part_clash*> gravest_first(const tf::clash_result& r) {
    std::vector<const tf::part_clash*> worst;
    for (const tf::part_clash& one : r.pairs) worst.push_back(&one);
    const auto rank = [](const tf::part_clash* one) {
        return std::pair(one->relation == mesh_relation::penetrating             ? 0
                         : one->relation == mesh_relation::closer_than_clearance ? 1
                                                                                 : 2,
                         -one->depth.value_or(0.0));
    };
    std::stable_sort(worst.begin(), worst.end(),
                     [&](const auto* x, const auto* y) { return rank(x) < rank(y); });
    return worst;
}

exit_status clash_all(job& work, const assembly_settings& settings) {
    work.entry.update({{"mode", "clash"},
                       {"inputs", json::array()},
                       {"parts", nullptr},
                       {"clearance", {{"given", settings.clearance.given}, {"used", nullptr}}},
                       {"counts", nullptr},
                       {"pairs", json::array()},
                       {"skipped", json::object()},
                       {"output", nullptr}});
    check_outputs(work, {});
    const named_assembly all = read_assembly(work);
    const auto ignored = ignored_pairs(work, settings, all.names);
    std::vector<tf::point3> corners;
    for (const tf::body_file& file : all.set.files)
        if (file.box) corners.insert(corners.end(), {file.box->min, file.box->max});
    tf::clash_options options;
    options.clearance = settings.clearance.used(tf::bounding_box(corners)->diagonal());
    options.depths = !settings.no_depth;
    options.limit = static_cast<std::size_t>(-1);  // all are colored
    options.ignored = ignored;
    options.progress = work.progress("search");
    tf::clash_result found;
    {
        const auto timing = work.time("search");
        found = tf::clash(all.set.shapes, options);
    }
    work.call_ended(found.status == tf::status::cancelled);
    json& entry = work.entry;
    entry["parts"] = all.names.size();
    entry["clearance"]["used"] = options.clearance;
    for (std::size_t i = 0; i < found.counts.size(); ++i)
        entry["counts"][name_of(static_cast<mesh_relation>(i))] = found.counts[i];
    for (const tf::part_clash& one : found.pairs) entry["pairs"].push_back(clash_entry(all, one));
    entry["skipped"].update({{"pairs_ignored", found.ignored},
                             {"pairs_culled_by_box", found.boxes_apart},
                             {"parts_not_indexed", all.names.size() - found.parts_indexed}});
    for (std::size_t i = 0; i < all.names.size(); ++i)  // others are apart, whatever is inside
        if (all.set.shapes[i].indexes_built() > 0)
            warn_of_inside_out(work, all.set.shapes[i], all.names[i]);
    say(work, all, found);
    if (all.names.size() == 1) warn_of_one(work, all.set.shapes[0]);
    write_parts(work, all, found);
    write_page(work, all, found, totals(all, found));
    return found.clashes > 0 ? tools::found : done;
}

}  // namespace tools
