#include "tools/tf-place/assembly/contact_entries.hpp"

namespace tools {
namespace {

/// A point of a body: of a mesh on a face, of a cloud a vertex.
json side_entry(const tf::body_set& set, std::size_t body, const tf::surface_point& at) {
    const bool cloud = set.file_of(body).cloud;
    const json number = set.bodies[body].triangle(at.face);
    return {{"point", at.point},
            {"face", or_null(!cloud, set.stored_face(body, at.face))},
            {"triangle", or_null(!cloud, number)},
            {"barycentric", or_null(!cloud, at.barycentric)},
            {"vertex", or_null(cloud, number)}};
}

json name_entry(const tf::file_body& body) { return or_null(!body.name.empty(), body.name); }

}  // namespace

void enter_nearest(json& entry, const tf::body_set& moving, const tf::body_set& fixed,
                   const std::vector<std::string>& files, const tf::nearest_fixed& near) {
    const tf::file_body& body = fixed.bodies[near.fixed];
    json there = side_entry(fixed, near.fixed, near.how.on_b);
    there.update({{"file", files[body.file]}, {"part", body.file}, {"name", name_entry(body)}});
    entry["distance"] = near.how.distance;
    entry["surface_distance"] = near.how.surface_distance;
    entry["closest"] = {{"moving", side_entry(moving, 0, near.how.on_a)}, {"fixed", there}};
    const tf::mesh_measure& how = near.how;
    const bool cloud = moving.file_of(0).cloud || fixed.file_of(near.fixed).cloud;
    if (!cloud && (how.a_inside_b || how.b_inside_a))
        entry["inside"] = how.a_inside_b ? "moving" : "fixed";
}

json contact_entry(const tf::body_set& moving, const tf::body_set& fixed,
                   const tf::placement_contact& c) {
    const tf::file_body* const body = c.fixed_face ? &fixed.bodies[c.fixed] : nullptr;
    return {{"point", c.point},
            {"normal", c.normal},
            {"moving", moving.stored_face(0, c.moving)},
            {"fixed", body ? json(fixed.stored_face(c.fixed, *c.fixed_face)) : json(nullptr)},
            {"part", body ? json(body->file) : json("bed")},
            {"name", body ? name_entry(*body) : json(nullptr)}};
}

std::string cut_in_words(const tf::search_effort& effort) {
    if (effort.cut == 0) return {};
    return "; the search ended after " + counted(effort.pairs, "pair", "pairs") +
           " of faces: a shorter way may exist";
}

}  // namespace tools
