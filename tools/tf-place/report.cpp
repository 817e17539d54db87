#include "tools/tf-place/outcome.hpp"
#include <treeform/tf.hpp>

#include <array>
#include <utility>

namespace tools {
namespace {

constexpr const char* blank_report = R"({
    "format": null, "sha256": null, "precision_in": null, "faces": null, "triangles": null,
    "box": null, "mode": null, "fixed": [],
    "skipped": {"non_finite": null, "parts_not_loaded": 0, "parts_not_indexed": null,
        "primitives_not_indexed": null, "pairs_culled_by_box": null,
        "face_pairs_in_motion": null, "filter_calls": null, "exact_calls": null},
    "clearance": {"given": null, "used": null}, "max_travel": null, "bed": null, "placed": null,
    "reason": null, "status_at_start": null, "status": null, "inside": null, "distance": null,
    "surface_distance": null, "closest": null, "direction": null, "travel": null,
    "backed_off": null, "matrix": null, "contacts": [], "contact_count": null, "sides": [],
    "chosen": null, "corrected": null, "fit": null, "fits": null,
    "tolerance": {"given": null, "used": null}, "parts": [], "not_placed": [], "rounding": null,
    "matrix_file": null, "output": null})";

void extend(std::optional<tf::box3>& box, const std::optional<tf::box3>& more) {
    if (box && more)
        box = tf::bounding_box(std::array{box->min, box->max, more->min, more->max});
    else if (more)
        box = more;
}

json side_entry(const body& b, const tf::surface_point& at) {
    json entry{{"point", at.point}};
    const json triangle = b.is.triangle(at.face);
    entry["face"] = or_null(!b.cloud, b.stored_face(at.face));
    entry["triangle"] = or_null(!b.cloud, triangle);
    entry["barycentric"] = or_null(!b.cloud, at.barycentric);
    entry["vertex"] = or_null(b.cloud, triangle);
    return entry;
}

json name_entry(const body& b) { return or_null(!b.is.name.empty(), b.is.name); }

/// How MOVING lies to what is nearest to it.
void enter_nearest(json& entry, const body& moving, const tf::nearest_fixed& near,
                   const body_set& fixed) {
    const body& part = fixed.bodies[near.fixed];
    json there = side_entry(part, near.how.on_b);
    there["file"] = part.path;
    there["part"] = part.file_number;
    there["name"] = name_entry(part);
    entry["distance"] = near.how.distance;
    entry["surface_distance"] = near.how.surface_distance;
    entry["closest"] = {{"moving", side_entry(moving, near.how.on_a)}, {"fixed", std::move(there)}};
    const tf::mesh_relation_result& how = near.how.relation;
    if (how.a_inside_b || how.b_inside_a) entry["inside"] = how.a_inside_b ? "moving" : "fixed";
}

json contacts_entry(const body& moving, const tf::placement& p, const body_set& fixed) {
    json rows = json::array();
    for (const tf::placement_contact& c : p.contacts) {
        const body* const part = c.fixed_face ? &fixed.bodies[c.fixed] : nullptr;
        rows.push_back({{"point", c.point},
                        {"normal", c.normal},
                        {"moving", moving.stored_face(c.moving)},
                        {"fixed", part ? json(part->stored_face(*c.fixed_face)) : json(nullptr)},
                        {"part", part ? json(part->file_number) : json("bed")},
                        {"name", part ? name_entry(*part) : json(nullptr)}});
    }
    return rows;
}

/// The faces were not looked at: nothing is said of how they lie to each other.
void enter_fit(json& entry, const tf::align_result& fit) {
    for (const char* key : {"status", "status_at_start", "contact_count", "travel", "backed_off"})
        entry[key] = nullptr;
    entry["fit"] = {
        {"rms", fit.rms},     {"rms_at_start", fit.rms_at_start}, {"overlap", fit.overlap},
        {"scale", fit.scale}, {"converged", fit.converged},       {"iterations", fit.iterations},
        {"pivot", fit.pivot}, {"pivot_moved", fit.pivot_moved}};
}

void enter_lay(json& entry, const outcome& found) {
    for (const tf::hull_side& side : found.laid->sides)
        entry["sides"].push_back(
            {{"normal", side.normal}, {"area", side.area}, {"center", side.center}});
    entry["chosen"] = found.laid->chosen;
    entry["tolerance"]["used"] = found.flatness;
    entry["corrected"] = found.laid->corrected;
}

/// What did not have to be looked at.
void enter_skipped(json& entry, const tf::placement& p, const body_set& fixed) {
    std::uint64_t faces = 0;
    for (json& one : entry["fixed"]) {
        one["indexed"] = false;
        one["parts"] = json::array();
    }
    for (std::size_t i = 0; i < fixed.bodies.size(); ++i) {
        const body& part = fixed.bodies[i];
        json& one = entry["fixed"][part.file_number];
        const bool indexed = fixed.shapes[i].indexes_built() > 0;
        if (indexed)
            one["indexed"] = true;
        else
            faces += part.faces;
        if (part.is.name.empty()) continue;
        one["parts"].push_back({{"name", part.is.name},
                                {"triangles", part.faces},
                                {"box", part.box},
                                {"indexed", indexed}});
    }
    json& skipped = entry["skipped"];
    skipped["parts_not_indexed"] = fixed.bodies.size() - fixed.indexed();
    skipped["primitives_not_indexed"] = faces;
    skipped["pairs_culled_by_box"] = p.statistics.fixed_culled;
    skipped["face_pairs_in_motion"] = p.statistics.pairs_tested;
    skipped["filter_calls"] = p.statistics.predicates.calls;
    skipped["exact_calls"] = p.statistics.predicates.undecided;
}

}  // namespace

json rows_of(const tf::transform<3>& matrix) {
    json rows = json::array();
    for (const auto& row : matrix.rows) rows.push_back(row);
    rows.push_back({0.0, 0.0, 0.0, 1.0});
    return rows;
}

void enter_blank_report(job& work, const place_settings& settings) {
    json& entry = work.entry;
    entry.update(json::parse(blank_report));
    entry["mode"] = name_of(settings.mode);
    entry["clearance"]["given"] = settings.clearance.given;
    if (settings.max_travel) entry["max_travel"] = settings.max_travel->given;
    if (settings.mode == place_mode::lay) entry["tolerance"]["given"] = settings.flatness.given;
    if (!settings.matrix.empty()) entry["matrix_file"] = settings.matrix.string();
}

void enter_bodies(job& work, const body& moving, const body_set& fixed) {
    json& entry = work.entry;
    entry["fixed"] = fixed.entries;
    entry["faces"] = moving.file->stored_faces;
    entry["triangles"] = moving.file->mesh.faces.size();
    entry["box"] = moving.box;
    std::uint64_t non_finite = moving.non_finite;
    std::vector<std::optional<tf::box3>> boxes(entry["fixed"].size());
    for (const body& part : fixed.bodies) {
        json& one = entry["fixed"][part.file_number];
        one["faces"] = part.file->stored_faces;
        extend(boxes[part.file_number], part.box);
        one["box"] = boxes[part.file_number];
        non_finite += part.non_finite;
    }
    entry["skipped"]["non_finite"] = non_finite;
}

void enter_report(job& work, const body& moving, const outcome& found, const body_set& fixed,
                  const place_settings& settings, const tf::transform<3>& matrix) {
    json& entry = work.entry;
    const tf::placement& p = found.at;
    enter_skipped(entry, p, fixed);
    entry["clearance"]["used"] = p.clearance;
    if (p.bed)
        entry["bed"] = {
            {"given", settings.bed.value_or(0.0)}, {"used", *p.bed}, {"reached", p.on_bed}};
    entry["placed"] = static_cast<bool>(p);
    if (!p) entry["reason"] = found.reason;
    entry["status_at_start"] = name_of(p.at_start);
    entry["status"] = name_of(p.at_place);
    entry["contacts"] = contacts_entry(moving, p, fixed);
    entry["contact_count"] = p.contact_count;
    if (p.nearest) enter_nearest(entry, moving, *p.nearest, fixed);
    if (!p) {
        entry["not_placed"].push_back(work.entry["input"]);
        return;
    }
    entry["direction"] = or_null(p.travel > 0.0, p.direction);
    entry["travel"] = p.travel;
    entry["backed_off"] = p.statistics.backed_off;
    entry["matrix"] = rows_of(matrix);
    if (found.laid) enter_lay(entry, found);
    if (found.aligned) enter_fit(entry, *found.aligned);
}

}  // namespace tools
