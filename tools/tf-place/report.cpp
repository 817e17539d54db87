#include "tools/shell/align_options.hpp"
#include "tools/shell/console.hpp"
#include "tools/shell/made/report_fields.hpp"
#include "tools/tf-place/assembly/contact_entries.hpp"
#include "tools/tf-place/place.hpp"
#include <treeform/tf.hpp>

#include <string_view>
#include <utility>

namespace tools {
namespace {

constexpr const char* blank_report = R"({
    "format": null, "sha256": null, "precision_in": null, "faces": null, "triangles": null,
    "box": null, "mode": null, "fixed": [],
    "skipped": {"non_finite": null, "parts_not_loaded": 0, "parts_not_indexed": null,
        "primitives_not_indexed": null, "pairs_culled_by_box": null},
    "work": {"face_pairs_in_motion": null, "predicates": null, "exact_predicates": null},
    "clearance": {"given": null, "used": null}, "max_travel": null, "bed": null, "placed": null,
    "reason": null, "status_at_start": null, "status": null, "inside": null, "distance": null,
    "surface_distance": null, "closest": null, "direction": null, "travel": null,
    "backed_off": null, "matrix": null, "contacts": [], "contact_count": null, "sides": [],
    "chosen": null, "corrected": null, "center_of_mass": null, "align": null, "turn": null,
    "features": null, "fits": null, "tries": null, "plates": null, "density": null,
    "tolerance": {"given": null, "used": null}, "parts": [], "not_placed": [], "rounding": null,
    "matrix_file": null, "effort": null, "depth": null, "points": null,
    "deviation": null, "output": null})";

/// The faces were not looked at: nothing is said of how they lie to each other.
void enter_align(json& entry, const tf::align_result& found) {
    for (const char* key : {"status", "status_at_start", "contact_count", "travel", "backed_off"})
        entry[key] = nullptr;
    entry["align"] = align_entry(found);
}

void enter_lay(json& entry, const placing& p) {
    entry.update(lay_entry(*p.laid));
    entry["tolerance"]["used"] = p.used(p.settings.lay.flatness);
}

/// What did not have to be looked at.
void enter_skipped(json& entry, const placing& p) {
    std::uint64_t bodies = 0, faces = 0;
    for (json& file : entry["fixed"]) file.update({{"indexed", false}, {"parts", json::array()}});
    for (std::size_t i = 0; i < p.fixed.shapes.size(); ++i) {
        const std::string& part = p.fixed.part_name(i);
        const tf::prepared_mesh& shape = p.fixed.shapes[i];
        const tf::mesh_view mesh = shape.indexed_view();
        const bool indexed = shape.indexes_built() > 0;
        json& file = entry["fixed"][p.fixed.file_number(i)];
        if (indexed) file["indexed"] = true;
        bodies += indexed ? 0 : 1;
        faces += indexed ? 0 : mesh.faces.size();
        if (!part.empty())
            file["parts"].push_back({{"name", part},
                                     {"triangles", mesh.faces.size()},
                                     {"box", tf::bounding_box(mesh.points)},
                                     {"indexed", indexed}});
    }
    entry["skipped"].update({{"parts_not_indexed", bodies},
                             {"primitives_not_indexed", faces},
                             {"pairs_culled_by_box", p.at.statistics.fixed_culled}});
    entry["work"] = {{"face_pairs_in_motion", p.at.statistics.pairs_tested},
                     {"predicates", p.at.statistics.predicates.calls},
                     {"exact_predicates", p.at.statistics.predicates.undecided}};
}

}  // namespace

void enter_blank_report(job& work, const place_settings& settings) {
    json& entry = work.entry;
    entry.update(json::parse(blank_report));
    entry["mode"] = name_of(settings.mode);
    entry["clearance"]["given"] = settings.clearance.given;
    if (settings.max_travel) entry["max_travel"] = settings.max_travel->given;
    if (settings.mode == place_mode::lay) entry["tolerance"]["given"] = settings.lay.flatness.given;
    if (!settings.matrix.empty()) entry["matrix_file"] = settings.matrix.string();
}

void enter_inputs(json& entry, const tf::body_file& moving, const fixed_meshes& fixed) {
    entry["fixed"] = fixed.entries;
    entry["faces"] = moving.content.stored_faces;
    entry["triangles"] = moving.content.mesh.faces.size();
    entry["box"] = moving.box;
    std::uint64_t non_finite = moving.non_finite;
    for (const tf::body_file& file : fixed.bodies.files) non_finite += file.non_finite;
    entry["skipped"]["non_finite"] = non_finite;
}

void enter_place(json& entry, const placing& p) {
    const tf::placement& at = p.at;
    enter_skipped(entry, p);
    entry["clearance"]["used"] = at.clearance;
    if (at.bed)
        entry["bed"] = {{"given", p.settings.bed.value_or(0.0)},
                        {"used", *at.bed},
                        {"reached", at.outcome == tf::placement_outcome::bed}};
    entry["placed"] = static_cast<bool>(at);
    entry["status_at_start"] = name_of(at.relation_at_start);
    entry["status"] = name_of(at.relation);
    for (const tf::placement_contact& c : at.contacts)
        entry["contacts"].push_back(contact_entry(p.moving, p.fixed, c));
    entry["contact_count"] = at.contact_count;
    if (at.effort.bound > 0) entry["effort"] = effort_entry(at.effort);
    if (at.nearest) enter_nearest(entry, p.moving, p.fixed, p.settings.fixed, at);
    if (p.settings.mode == place_mode::turn) entry["turn"] = turn_entry(p.settings.turn, at);
    if (p.mated) entry["features"] = mating_entry(*p.mated, at);
    if (!at) {
        entry["reason"] = p.reason + p.remedy;
        entry["not_placed"].push_back(entry["input"]);
        return;
    }
    entry["direction"] = or_null(at.travel > 0.0, at.direction);
    entry["travel"] = at.travel;
    entry["backed_off"] = at.statistics.backed_off;
    entry["matrix"] = p.matrix;
    if (p.laid) enter_lay(entry, p);
    if (p.aligned) enter_align(entry, *p.aligned);
}

std::string sentence(const placing& p) {
    const tf::placement& at = p.at;
    std::string relation = at.relation_in_words(p.moving, p.fixed);
    if (!at) {
        std::string pairs;  // of faces, behind "penetrating other.stl"
        if (at.relation == tf::mesh_relation::penetrating && at.nearest) {
            const std::string seen = "penetrating " + p.fixed.label(at.nearest_fixed);
            pairs = relation.substr(std::min(seen.size(), relation.size()));
        }
        return "not placed: " + p.reason + pairs + p.remedy;
    }
    if (p.settings.mode == place_mode::measure) return relation;
    if (p.aligned) return p.aligned->message();
    if (p.laid) return "laid " + p.laid->message() + "; " + relation;
    if (p.settings.mode == place_mode::turn && at.angle > 0.0)
        return "turned by " + brief(at.angle) + " degrees; " + relation;
    if (p.mated) return "mated; " + relation;
    if (at.travel == 0.0) return "not moved; " + relation;
    const bool drops = p.settings.mode == place_mode::drop;
    const char* const moved = drops && at.direction.z > 0.0          ? "lifted by "
                              : drops                                ? "dropped by "
                              : p.settings.mode == place_mode::slide ? "slid by "
                                                                     : "moved by ";
    return moved + brief(at.travel) + "; " + relation + skipped_in_words(at.effort);
}

void say_place(job& work, const placing& p) {
    const tf::placement& at = p.at;
    work.out.result(work.name + ": " + sentence(p));
    if (!work.out.shows(level::info)) return;
    const auto say = [&](const std::string& text) { work.out.info(work.name + ": " + text); };
    const auto& rows = at.matrix.rows;
    say("translation " + in_words({rows[0][3], rows[1][3], rows[2][3]}) + ", " +
        std::to_string(at.statistics.backed_off) + " steps back because of rounding");
    if (at.nearest)
        say("nearest points " + in_words(at.nearest->on_a.point) + " and " +
            in_words(at.nearest->on_b.point) + " of " + p.fixed.label(at.nearest_fixed));
    const std::size_t all = p.fixed.shapes.size();
    const auto not_indexed = work.entry["skipped"]["parts_not_indexed"].get<std::size_t>();
    say(counted(all - not_indexed, "fixed part", "fixed parts") + " of " + std::to_string(all) +
        " indexed, " + grouped(at.statistics.pairs_tested) + " pairs of faces tested in motion");
}

}  // namespace tools
