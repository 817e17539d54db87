#include "tools/tf-place/assembly/contact_entries.hpp"

#include "tools/shell/console.hpp"

namespace tools {
namespace {

/// A point of a body: of a mesh on a face, of a cloud a vertex.
json side_entry(const tf::body_set& set, std::size_t body, const tf::surface_point& at) {
    const bool cloud = set.file_of(body).cloud;
    const json number = set.triangle(body, at.face);
    return {{"point", at.point},
            {"face", or_null(!cloud, set.face_in_file(body, at.face))},
            {"triangle", or_null(!cloud, number)},
            {"barycentric", or_null(!cloud, at.barycentric)},
            {"vertex", or_null(cloud, number)}};
}

json name_entry(const tf::body_set& set, std::size_t body) {
    return or_null(!set.part_name(body).empty(), set.part_name(body));
}

}  // namespace

void enter_nearest(json& entry, const tf::body_set& moving, const tf::body_set& fixed,
                   const std::vector<std::string>& files, const tf::placement& at) {
    const tf::relation_result& near = *at.nearest;
    const std::size_t file = fixed.file_number(at.nearest_fixed);
    json there = side_entry(fixed, at.nearest_fixed, near.on_b);
    there.update(
        {{"file", files[file]}, {"part", file}, {"name", name_entry(fixed, at.nearest_fixed)}});
    entry["distance"] = near.distance;
    entry["surface_distance"] = near.surface_distance;
    entry["closest"] = {{"moving", side_entry(moving, 0, near.on_a)}, {"fixed", there}};
    const bool cloud = moving.file_of(0).cloud || fixed.file_of(at.nearest_fixed).cloud;
    if (!cloud && (near.a_inside_b || near.b_inside_a))
        entry["inside"] = near.a_inside_b ? "moving" : "fixed";
}

json contact_entry(const tf::body_set& moving, const tf::body_set& fixed,
                   const tf::placement_contact& c) {
    const bool on_bed = !c.fixed_face;
    return {{"point", c.point},
            {"normal", c.normal},
            {"moving", moving.face_in_file(0, c.moving)},
            {"fixed", on_bed ? json(nullptr) : json(fixed.face_in_file(c.fixed, *c.fixed_face))},
            {"part", on_bed ? json("bed") : json(fixed.file_number(c.fixed))},
            {"name", on_bed ? json(nullptr) : name_entry(fixed, c.fixed)}};
}

std::string skipped_in_words(const tf::search_effort& effort) {
    if (effort.skipped_candidates == 0) return {};
    return "; the search ended after " + counted(effort.pairs, "pair", "pairs") +
           " of faces, so a shorter translation may exist";
}

}  // namespace tools
